/** Every number that stands twice is the same number, in every frame. */

import { signal } from "@preact/signals";
import { render } from "preact";
import { act } from "preact/test-utils";
import { expect, test } from "vitest";
import { createFlightStore } from "../src/flight";
import { NavigationDisplay } from "../src/nd/nd";
import { PlanNumbers } from "../src/panels/plan";
import { createSession } from "../src/session";
import { modeChanged, planChanged, STARTED, sample, tick } from "./samples";

test("time to converge and separation: on the display as in the panel", { timeout: 60_000 }, () => {
  const store = createFlightStore();
  const session = createSession(store.flight);
  store.link("open");
  store.receive(tick(0, [STARTED, modeChanged(0), planChanged(0), sample(0)]), 0);
  const place = document.body.appendChild(document.createElement("div"));
  act(() =>
    render(
      <>
        <NavigationDisplay flight={store.flight} mode={signal("ROSE")} range={signal(80)} />
        <PlanNumbers session={session} />
      </>,
      place,
    ),
  );
  const row = (label: string) => {
    const cells = [...place.querySelectorAll(".nd-spacing > g")].map((group) =>
      [...group.querySelectorAll("text")].map((text) => text.textContent),
    );
    return cells.find(([name]) => name === label)?.[1];
  };
  const reading = (label: string) =>
    [...place.querySelectorAll(".reading")]
      .find((each) => each.querySelector("dt")?.textContent === label)
      ?.querySelector(".figure")?.textContent;
  const seen = new Set<string | undefined>();
  // Frames at 60 a second and ticks at 20, neither in step with the readings.
  for (let frame = 1; frame <= 1000; frame += 1) {
    const wall = frame * 16.7;
    act(() => {
      if (frame % 3 === 0) store.receive(tick(wall / 1000, [sample(wall / 1000)]), wall);
      else store.advance(wall);
    });
    const shown = row("CNV");
    seen.add(shown);
    expect(place.querySelector(".headline-figure")?.textContent).toBe(shown);
    const label = [...place.querySelectorAll(".nd-label text")].find((text) =>
      text.textContent?.startsWith("CNV"),
    );
    if (label !== undefined) expect(label.textContent).toBe(`CNV ${shown}`);
    expect(reading("d now")).toBe(row("d"));
  }
  expect(seen.size).toBeGreaterThan(10);
});
