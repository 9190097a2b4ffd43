/** Who flies, on the mode strip: one look for each pilot, whatever guidance does. */

import { signal } from "@preact/signals";
import { describe, expect, test } from "vitest";
import type { PairSample } from "../../src/store/pair";
import { createShown } from "../../src/store/shown";
import { PILOT } from "../../src/store/state-styles";
import { GUIDANCES, type Guidance, PILOTS, pilot } from "../../src/store/states";
import type { Flight } from "../../src/store/types";
import { amend, modeChanged, OWN, pairAt } from "../samples";
import { mountDisplay } from "./draw";
import { flightIn } from "./in-state";

const ENGAGEMENTS = ["off", "designated", "armed", "engaged"] as const;
const MODES = ["heading", "converge", "capture", "follow", "escape"] as const;
const SWITCHES = [true, false].flatMap((autopilot) =>
  [true, false].map((director) => ({ autopilot, director })),
);

/** What is written in the last column: what is switched on, and whether it is the crew's turn. */
function column(autopilot: boolean, director: boolean): readonly string[] {
  const on = [autopilot ? "AP1" : "", director ? "FD" : ""].filter(Boolean).join(" ");
  return autopilot ? [on] : [on, "YOU FLY"];
}

function draw(flight: Flight): Element {
  return mountDisplay({
    shown: createShown(flight),
    mode: signal<"ROSE" | "ARC">("ROSE"),
    range: signal(80),
  });
}

function pilotCells(root: Element): (string | null)[] {
  const cells = [...root.querySelectorAll(".nd-fma text")].map((each) => each.textContent);
  return [cells[4] ?? null, ...cells.slice(7)];
}

function change(
  flight: Flight,
  changes: Partial<PairSample>,
  before: Partial<PairSample> = changes,
) {
  const { sample } = flight.moment.value;
  if (sample === null) throw new Error("An empty flight.");
  const now = { ...sample, ...changes };
  amend(flight, { sample: now, now, before: { ...sample, ...before } });
}

test("each pilot has a look of its own", () => {
  expect(new Set(PILOTS.map((each) => JSON.stringify(PILOT[each]))).size).toBe(PILOTS.length);
});

test.each(
  ENGAGEMENTS.flatMap((engagement) =>
    MODES.flatMap((mode) => SWITCHES.map((each) => ({ engagement, mode, ...each }))),
  ),
)("$engagement, $mode, autopilot $autopilot, director $director", (state) => {
  const { now, next } = PILOT[pilot(pairAt(0, state))];
  expect(next === "" ? [now] : [now, next]).toEqual(column(state.autopilot, state.director));
});

describe.each(GUIDANCES.map((state) => [state] as const))("%s", (state: Guidance) => {
  test.each(SWITCHES)("autopilot $autopilot, director $director", (switches) => {
    const flight = flightIn(state);
    change(flight, switches);
    const root = draw(flight);
    const words = column(switches.autopilot, switches.director);
    // ACCEPTED stands in the lower row
    const isTold = root.querySelector(".nd-atc")?.textContent !== "";
    expect(pilotCells(root)).toEqual(isTold ? [words.join(" ").trim()] : words);
    expect(isTold).toBe(state === "armed");
  });
});

test.each(SWITCHES)(
  "the controller's answer does not hide who flies: autopilot $autopilot, director $director",
  (switches) => {
    const flight = flightIn("converge");
    change(flight, switches);
    const clearance = {
      kind: "clearance_news",
      t_s: flight.moment.value.t,
      ident: OWN,
      clearance_id: "c1",
      clearance: "flying",
      level: "none",
      message: "Cleared.",
      automated: false,
    } as const;
    amend(flight, { clearance });
    const root = draw(flight);
    expect(pilotCells(root)).toEqual([
      column(switches.autopilot, switches.director).join(" ").trim(),
    ]);
    expect(root.querySelector(".nd-atc")?.textContent).toBe("CLEARED");
  },
);

test("a flight of before has its autopilot, and no director", () => {
  expect(pilotCells(draw(flightIn("converge")))).toEqual(["AP1"]);
});

describe("the box", () => {
  const box = (root: Element) =>
    [...root.querySelectorAll(".nd-fma .nd-box")].find(
      (each) => Number(each.getAttribute("x")) > 600,
    );

  test("stands while it is news who flies, in white", () => {
    const flight = flightIn("converge");
    change(flight, { autopilot: false, director: true }, {});
    expect(box(draw(flight))).toBeDefined();
    expect(box(draw(flight))?.getAttribute("style")).toBeNull();
    change(flight, { autopilot: false, director: true });
    expect(box(draw(flight))).toBeUndefined();
  });

  test("is amber where guidance gave up while the crew flew along its bars", () => {
    const flight = flightIn("data_lost");
    const { t } = flight.moment.value;
    change(flight, { autopilot: false, director: true, mode: "heading" });
    amend(flight, { mode: { ...modeChanged(t - 3, "heading"), previous: "converge" } });
    expect(box(draw(flight))?.getAttribute("style")).toContain("--caution");
    amend(flight, { mode: { ...modeChanged(t - 30, "heading"), previous: "converge" } });
    expect(box(draw(flight))).toBeUndefined();
  });
});

test("a speed that the crew has selected is cyan, and guidance does not wait to command it", () => {
  const flight = flightIn("converge");
  amend(flight, {
    assignment: {
      kind: "assignment_changed",
      t_s: flight.moment.value.t - 2,
      ident: OWN,
      slot_distance_m: 10_000,
      min_separation_m: 9260,
      max_bank_deg: 25,
      selected_tas_mps: [220],
      message: "Selected speed 428 kt.",
    },
  });
  const root = draw(flight);
  const cells = [...root.querySelectorAll(".nd-fma text")];
  expect(cells[0]?.textContent).toBe("SPD 428");
  expect(cells[0]?.getAttribute("fill")).toBe("var(--selected)");
  expect(cells[5]?.textContent).toBe("");
});
