/** Each input that is missing or invalid takes what is drawn of it away, and nothing else. */

import { signal } from "@preact/signals";
import { expect, test } from "vitest";
import type { PairSample } from "../../src/store/pair";
import { createShown } from "../../src/store/shown";
import type { Flight } from "../../src/store/types";
import { amend, noPlan, unable } from "../samples";
import { mountDisplay } from "./draw";
import { flightAt } from "./fixture";
import { flightIn } from "./in-state";
import { isDrawn } from "./pictures";

/** All that is read or drawn of an input, by its place on the display. */
const DRAWN = {
  map: ".nd-map path",
  "tape's numbers": ".nd-tape text",
  "range numbers": ".nd-rings text",
  "own ship": ".nd-ownship path",
  track: ".nd-track path",
  trend: ".nd-trend path",
  GS: ".nd-air text:nth-of-type(2)",
  TAS: ".nd-air text:nth-of-type(4)",
  "wind's direction": ".nd-air text:nth-of-type(5)",
  "wind's speed": ".nd-air text:nth-of-type(7)",
  "wind's arrow": ".nd-air path",
  leader: ".nd-leader path",
  "leader's past": ".nd-history path",
  "declared route": ".nd-intent path",
  slot: ".nd-slot path",
  "early or late": ".nd-timing path",
  minimum: ".nd-circle circle",
  "spacing D": ".nd-spacing g:nth-of-type(1) text:nth-of-type(2)",
  "spacing d": ".nd-spacing g:nth-of-type(2) text:nth-of-type(2)",
  closure: ".nd-spacing g:nth-of-type(3) text:nth-of-type(2)",
  "time to go": ".nd-spacing g:nth-of-type(5) text:nth-of-type(2)",
  "next point": ".nd-next text",
  path: ".nd-active path",
  "proposed path": ".nd-proposed path",
  "other paths": ".nd-others path",
  turns: ".nd-turns path",
  minutes: ".nd-minutes path",
  "final track": ".nd-final path",
  join: ".nd-capture circle",
  "closest approach": ".nd-closest circle",
  "commanded heading": ".nd-commanded path",
} as const;
type Name = keyof typeof DRAWN;

/** What is drawn, less numbers that stand as dashes. */
function drawnOn(flight: Flight): Set<Name> {
  const root = mountDisplay({
    shown: createShown(flight),
    mode: signal<"ROSE" | "ARC">("ROSE"),
    range: signal(80),
  });
  const texts = (selector: string) =>
    [...root.querySelectorAll(selector)].map((each) => each.textContent ?? "");
  return new Set(
    (Object.keys(DRAWN) as Name[]).filter((name) => {
      const selector = DRAWN[name];
      const said = texts(selector).join("");
      return isDrawn(root, selector) && !/^-+:?-*$/.test(said);
    }),
  );
}

function change(flight: Flight, sample: Partial<PairSample>): void {
  if (flight.moment.value.sample === null) throw new Error("An empty flight.");
  const changed = { ...flight.moment.value.sample, ...sample };
  amend(flight, { sample: changed, now: changed });
}

function converging(name: "fig_6b" | "fig_6b_wind" = "fig_6b"): Flight {
  return flightAt(name, 120);
}

interface Case {
  readonly input: string;
  readonly valid: () => Flight;
  readonly spoil: (flight: Flight) => void;
  readonly gone: readonly Name[];
}

/** What is drawn along a path, flown or proposed. */
const ALONG_A_PATH: readonly Name[] = [
  "turns",
  "minutes",
  "final track",
  "join",
  "closest approach",
];

const GUIDANCE: readonly Name[] = [
  "slot",
  "spacing D",
  "spacing d",
  "closure",
  "time to go",
  "next point",
  "path",
  ...ALONG_A_PATH,
];

const CASES: readonly Case[] = [
  {
    input: "own ship's state",
    valid: () => converging("fig_6b_wind"),
    spoil: (flight) => {
      amend(flight, { sample: null, now: null });
    },
    gone: [
      ...GUIDANCE,
      "map",
      "tape's numbers",
      "range numbers",
      "own ship",
      "track",
      "trend",
      "GS",
      "TAS",
      "wind's direction",
      "wind's speed",
      "wind's arrow",
      "leader",
      "leader's past",
      "declared route",
      "minimum",
      "commanded heading",
    ],
  },
  {
    input: "own ship's speed, too slow for a trend",
    valid: () => converging(),
    spoil: (flight) => {
      const pursuer = flight.moment.value.now?.pursuer;
      if (pursuer !== undefined) change(flight, { pursuer: { ...pursuer, ground_speed_mps: 40 } });
    },
    gone: ["trend"],
  },
  {
    input: "wind",
    valid: () => converging("fig_6b_wind"),
    spoil: (flight) => {
      const started = flight.moment.value.started;
      if (started !== null)
        amend(flight, { started: { ...started, wind: { from_deg: 0, speed_mps: 0 } } });
    },
    gone: ["wind's direction", "wind's arrow"],
  },
  {
    input: "the leader's reports",
    valid: () => converging(),
    spoil: (flight) => change(flight, { leader_age_s: 15, engagement: "designated" }),
    gone: [...GUIDANCE, "declared route"],
  },
  {
    input: "the leader's reports, for so long that it is anywhere",
    valid: () => converging(),
    spoil: (flight) => change(flight, { leader_age_s: 30, engagement: "designated" }),
    gone: [...GUIDANCE, "declared route", "leader", "minimum"],
  },
  {
    input: "the leader's intent",
    valid: () => converging(),
    spoil: (flight) => {
      const route = flight.moment.value.route;
      if (route !== null) amend(flight, { route: { ...route, intent_known: false } });
    },
    gone: ["declared route"],
  },
  {
    input: "the plan",
    valid: () => converging(),
    spoil: (flight) => {
      amend(flight, { unavailable: noPlan(120) });
      amend(flight, { unable: unable(120) });
      change(flight, { mode: "heading" });
    },
    gone: ["time to go", "next point", "path", ...ALONG_A_PATH],
  },
  {
    input: "the proposal",
    valid: () => flightIn("proposed"),
    spoil: (flight) => {
      amend(flight, { proposal: null });
    },
    gone: ["time to go", "next point", "proposed path", "other paths", ...ALONG_A_PATH],
  },
  {
    input: "new data for seven seconds, once it follows",
    valid: () => flightIn("follow"),
    spoil: (flight) => {
      amend(flight, { dataAge: 7 });
    },
    gone: [
      "early or late",
      "GS",
      "TAS",
      "wind's speed",
      "spacing D",
      "spacing d",
      "closure",
      "next point",
    ],
  },
];

test.each(CASES)("without $input: what is drawn of it goes", ({ valid, spoil, gone }) => {
  const flight = valid();
  const before = drawnOn(flight);
  for (const name of gone) expect(before, `${name} was there`).toContain(name);
  spoil(flight);
  const after = drawnOn(flight);
  expect([...before].filter((name) => !after.has(name)).sort()).toEqual([...gone].sort());
});

test("each element goes with some input", () => {
  const all = new Set(CASES.flatMap(({ gone }) => gone));
  expect((Object.keys(DRAWN) as Name[]).filter((name) => !all.has(name))).toEqual([]);
});
