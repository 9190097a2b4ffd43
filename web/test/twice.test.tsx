/** Every number that stands twice on the page is the same number, in every frame. */

import { batch, type Signal, signal } from "@preact/signals";
import { render } from "preact";
import { act } from "preact/test-utils";
import { expect, test } from "vitest";
import { NavigationDisplay } from "../src/nd/nd";
import { Aircraft } from "../src/panels/aircraft";
import { PlanNumbers } from "../src/panels/plan";
import type { Camera } from "../src/scene/camera";
import { textsOf } from "../src/scene/texts";
import { createSession } from "../src/session";
import { createFlightStore } from "../src/store/flight";
import type { Shown } from "../src/store/shown";
import { GUIDANCES } from "../src/store/states";
import type { Flight } from "../src/store/types";
import { forecastOf } from "./nd/fixture";
import { flightIn } from "./nd/in-state";
import {
  amend,
  modeChanged,
  planChanged,
  point,
  rightTurn,
  STARTED,
  sample,
  straight,
  tick,
} from "./samples";
import { silentActions } from "./silence";

const FRAMES = 1000;

/** A turn to the right a minute ahead, and the closest approach a while after it. */
function plan() {
  const lead = straight(point(0, 0, 0, 0), 60, 100);
  const turn = rightTurn(90);
  const later = (p: typeof turn.start) => ({ ...p, t_s: p.t_s + 60, y_m: p.y_m + 6000 });
  const moved = { ...turn, start: later(turn.start), end: later(turn.end) };
  const segments = [lead, moved, straight(moved.end, 250 - moved.end.t_s, 100)];
  const separation = { least_m: 10000, at_s: 130, proved_above_m: 9999 };
  return {
    ...planChanged(0, { segments, separation }),
    leader_at_closest: point(130, 14000, 8000, 90),
    pursuer_at_closest: point(130, 6000, 7000, 90),
  };
}

/** What a number is called, and the text of each place where it stands now. */
function standing(place: Element): Record<string, (string | undefined)[]> {
  const texts = (selector: string) =>
    [...place.querySelectorAll(selector)].map((each) => each.textContent ?? "");
  const row = (label: string) => {
    const cells = [...place.querySelectorAll(".nd-spacing > g")].map((group) =>
      [...group.querySelectorAll("text")].map((text) => text.textContent ?? ""),
    );
    return cells.find(([name]) => name === label)?.[1];
  };
  const reading = (label: string) =>
    [...place.querySelectorAll(".reading")].find(
      (each) => each.querySelector("dt")?.textContent === label,
    );
  const figure = (label: string) =>
    reading(label)?.querySelector(".figure")?.textContent ?? undefined;
  const note = (label: string) => reading(label)?.querySelector(".note")?.textContent ?? undefined;
  const own = (label: string) =>
    [...place.querySelectorAll(".states tbody tr")]
      .find((each) => each.querySelector("th")?.textContent?.startsWith(label))
      ?.querySelector("td")?.textContent;
  const label = (found: RegExp) =>
    texts(".nd-label text").flatMap((text) => text.match(found)?.slice(1, 2) ?? []);
  const [name = "", , , , , left] = texts(".nd-next text");
  const [, gs, , tas] = texts(".nd-air text");
  const mode = texts(".nd-fma text");
  const turn = name.startsWith("T") ? [name.slice(3), left] : ["", ""];
  return {
    "time to converge": [
      row("CNV"),
      // without a time to converge the separation stands there
      ...texts(".headline-figure").filter((text) => /^\d+:\d\d$/.test(text)),
      ...label(/^CNV (\d+:\d\d)$/),
      ...(name === "CNV" ? [left] : []),
    ],
    separation: [row("d"), figure("d now"), ...label(/^\d{3}° (\d+\.\d)$/)],
    D: [
      row("D"),
      figure("D required"),
      ...mode.flatMap((text) => text.match(/^D (.*)/)?.[1] ?? []),
    ],
    MIN: [note("Least so far")?.match(/MIN ([\d.]+)/)?.[1], ...label(/^MIN ([\d.]+)$/)],
    "next turn": [turn[0], ...(turn[0] === "" ? [""] : [figure("Next turn")?.replace(" ", "")])],
    "until the next turn": [turn[1], ...(turn[0] === "" ? [""] : [note("Next turn")?.slice(3)])],
    "least separation": [figure("Least forecast"), ...label(/^(\d+\.\d) NM/)],
    "until they are closest": [
      ...label(/^\d+\.\d NM (\d+:\d\d)$/),
      ...(note("Least forecast")?.startsWith("in") ? [note("Least forecast")?.slice(3)] : []),
    ],
    "ground speed": [gs, own("GS")],
    "true airspeed": [tas, own("TAS")],
    "commanded speed": [
      mode.flatMap((text) => text.match(/^(?:RG )?SPD (\d+)/)?.[1] ?? [])[0],
      texts(".commanded b")[1]?.replace(" kt", ""),
    ],
  };
}

test(`numbers that stand twice, in ${FRAMES} frames`, { timeout: 120_000 }, () => {
  const store = createFlightStore();
  const session = createSession(store.flight);
  store.link("open");
  store.receive(tick(0, [STARTED, modeChanged(0), plan(), sample(0)]), 0);
  const place = document.body.appendChild(document.createElement("div"));
  act(() =>
    render(
      <>
        <NavigationDisplay shown={session.shown} mode={signal("ROSE")} range={signal(40)} />
        <PlanNumbers session={session} />
        <Aircraft session={session} actions={silentActions()} />
      </>,
      place,
    ),
  );
  const seen = new Map<string, Set<string>>();
  // Frames at 60 a second and ticks at 20, neither in step with the readings; at ten times the pace.
  for (let frame = 1; frame <= FRAMES; frame += 1) {
    const wall = frame * 16.7;
    act(() => {
      const t = wall / 100;
      if (frame % 3 === 0) store.receive(tick(t, [sample(t)], { rate: 10 }), wall);
      else store.advance(wall);
    });
    for (const [name, texts] of Object.entries(standing(place))) {
      expect(new Set(texts).size, `${name} in frame ${frame}: ${texts.join(" | ")}`).toBeLessThan(
        2,
      );
      const twice = texts.length > 1 ? texts[0] : undefined;
      if (twice) seen.set(name, (seen.get(name) ?? new Set()).add(twice));
    }
  }
  // Each stood twice, and those that count down did.
  expect([...seen.keys()].sort()).toEqual(Object.keys(standing(place)).sort());
  for (const name of [
    "time to converge",
    "separation",
    "until the next turn",
    "until they are closest",
  ])
    expect(seen.get(name)?.size ?? 0, name).toBeGreaterThan(5);
});

/** Looks down on the scene from so high that all of it is seen. */
const ABOVE: Camera = {
  projection: [2.4, 0, 0, 0, 0, 2.4, 0, 0, 0, 0, -1, -1, 0, 0, -0.2, 0],
  view: [0, -1, 0, 0, 0, 0, 1, 0, -1, 0, 0, 0, 0, 0, -900, 1],
};

/** What the scene says of the numbers that the page has as well. */
function inScene(shown: Shown): Record<string, string[]> {
  const texts = textsOf(shown, ABOVE, { width: 800, height: 600 });
  const said = (id: string, found: RegExp) =>
    texts
      .filter((text) => text.id === id)
      .flatMap(({ lines }) => lines.flatMap(({ text }) => text.match(found)?.slice(1, 2) ?? []));
  return {
    "time to converge": said("join", /^CNV (\d+:\d\d)$/),
    MIN: said("min", /^MIN ([\d.]+)$/),
    "least separation": said("closest", /^(\d+\.\d) NM/),
    "ground speed": said("own", /^(\d+) kt/),
  };
}

/** Whether a number stands there at all. */
function isRead(text: string | undefined): text is string {
  return text !== undefined && text !== "" && !/^-+:?-*$/.test(text);
}

/** Takes over what is known of another flight. */
function become(flight: Flight, other: Flight): void {
  batch(() => {
    for (const key of Object.keys(flight) as (keyof Flight)[]) {
      (flight[key] as Signal<unknown>).value = (other[key] as Signal<unknown>).value;
    }
  });
}

test(`… and in ${FRAMES} frames of a whole flight, in every state, scene included`, {
  timeout: 240_000,
}, () => {
  const seen = new Map<string, Set<string>>();
  const each = Math.ceil(FRAMES / GUIDANCES.length);
  for (const state of GUIDANCES) {
    const flight = flightIn(state, 0);
    const session = createSession(flight);
    const place = document.body.appendChild(document.createElement("div"));
    act(() =>
      render(
        <>
          <NavigationDisplay shown={session.shown} mode={signal("ROSE")} range={signal(160)} />
          <PlanNumbers session={session} />
          <Aircraft session={session} actions={silentActions()} />
        </>,
        place,
      ),
    );
    for (let frame = 0; frame < each; frame += 1) {
      // from the first second until after the join
      const t = 0.5 + (frame * 960.3) / each;
      const next = flightIn(state, t);
      amend(next, { forecast: forecastOf("fig_6b") });
      act(() => become(flight, next));
      const scene = inScene(session.shown);
      for (const [name, there] of Object.entries(standing(place))) {
        const texts = [...there, ...(scene[name] ?? [])].filter(isRead);
        const what = `${name}, ${state} at ${t.toFixed(1)} s: ${texts.join(" | ")}`;
        expect(new Set(texts).size, what).toBeLessThan(2);
        if (texts.length > 1 && texts[0])
          seen.set(name, (seen.get(name) ?? new Set()).add(texts[0]));
      }
    }
    act(() => render(null, place));
    place.remove();
  }
  for (const name of ["time to converge", "separation", "D", "MIN", "next turn", "ground speed"])
    expect(seen.has(name), name).toBe(true);
  expect(seen.get("time to converge")?.size ?? 0).toBeGreaterThan(150);
});
