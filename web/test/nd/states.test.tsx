/** Every state of guidance, as the display shows it: modes, path, slot, circle, leader and message. */

import { signal } from "@preact/signals";
import { describe, expect, test } from "vitest";
import { createShown } from "../../src/store/shown";
import { GUIDANCES, type Guidance, guidance } from "../../src/store/states";
import { amend } from "../samples";
import { mountDisplay } from "./draw";
import { documentsOf } from "./fixture";
import { flightIn, proposal, T } from "./in-state";

interface Shown {
  /** Lateral mode: engaged, and armed. */
  readonly modes: readonly [string, string];
  /** Dashes of the path, and its colour; null for none. */
  readonly path: readonly [string, string] | null;
  /** Colour of the slot, and whether it is crossed out; null for none. */
  readonly slot: readonly [string, boolean] | null;
  readonly circle: boolean;
  /** Whether the leader is ringed. */
  readonly ringed: boolean;
  readonly message: string;
}

const DASHED = "15 12";
const NEAR = { circle: true, ringed: true } as const;

/** ND.md's table of states, with those that it names in one row apart. */
const TABLE: Record<Guidance, Shown> = {
  off: { modes: ["HDG", ""], path: null, slot: null, circle: false, ringed: false, message: "" },
  designated: {
    ...NEAR,
    modes: ["HDG", ""],
    path: null,
    slot: ["selected", false],
    message: "LDR AF123",
  },
  proposed: {
    ...NEAR,
    modes: ["HDG", ""],
    path: [DASHED, "proposed"],
    slot: ["selected", false],
    message: "CONV PROPOSED – CONFIRM",
  },
  armed: {
    ...NEAR,
    modes: ["HDG", "RG"],
    path: [DASHED, "armed"],
    slot: ["selected", false],
    message: "CONV ACCEPTED – ENGAGE",
  },
  converge: {
    ...NEAR,
    modes: ["RG CNV", "RG CAP"],
    path: ["", "plan"],
    slot: ["plan", false],
    message: "",
  },
  capture: {
    ...NEAR,
    modes: ["RG CAP", "RG TRK"],
    path: ["", "plan"],
    slot: ["plan", false],
    message: "",
  },
  follow: {
    ...NEAR,
    modes: ["RG TRK", ""],
    path: ["", "plan"],
    slot: ["plan", false],
    message: "SPACING 5.4 NM",
  },
  escape: {
    ...NEAR,
    modes: ["RG ESC", "RG"],
    path: ["", "plan"],
    slot: ["caution", true],
    message: "",
  },
  infeasible: {
    ...NEAR,
    modes: ["HDG", ""],
    path: null,
    slot: ["caution", true],
    message: "RG UNABLE: SPEED",
  },
  unable: {
    ...NEAR,
    modes: ["HDG", "RG"],
    path: ["2 11", "superseded"],
    slot: ["caution", true],
    message: "RG UNABLE: SPEED",
  },
  data_lost: {
    ...NEAR,
    modes: ["HDG", ""],
    path: null,
    slot: null,
    message: "LDR DATA LOST",
  },
};

function colour(element: Element | null): string {
  return (element?.getAttribute("stroke") ?? "").replace(/^var\(--(.*)\)$/, "$1");
}

/** The widest line of a path: the ideal one under it is thin. */
function pathOf(root: Element): readonly [string, string] | null {
  const map = [...root.querySelectorAll(".nd-world > g")];
  const strokes = map.flatMap((each) =>
    each.matches("g.nd-proposed, g.nd-armed, g.nd-active, g.nd-old")
      ? [...each.querySelectorAll("path")]
      : [],
  );
  const drawn = strokes.filter(
    (each) =>
      each.matches(".nd-stroke") &&
      (each.getAttribute("d") ?? "") !== "" &&
      Number(each.getAttribute("stroke-width")) >= 2.5,
  );
  const [first] = drawn;
  return first === undefined ? null : [first.getAttribute("stroke-dasharray") ?? "", colour(first)];
}

function read(root: Element): Shown {
  const cells = [...root.querySelectorAll(".nd-fma text")].map((each) => each.textContent ?? "");
  const slot = root.querySelector(".nd-slot");
  const crossed = [...(slot?.querySelectorAll("path") ?? [])].some(
    (each) => each.getAttribute("d") === "M-15 -15L15 15M15 -15L-15 15",
  );
  return {
    modes: [cells[2] ?? "", cells[6] ?? ""],
    path: pathOf(root),
    slot: slot === null ? null : [colour(slot.querySelector(".nd-stroke")), crossed],
    circle: root.querySelector(".nd-circle") !== null,
    ringed: root.querySelector(".nd-leader circle.nd-stroke") !== null,
    message: (root.querySelector(".nd-message text")?.textContent ?? "").replace(
      / \d+\.\d NM$/,
      "",
    ),
  };
}

describe.each(GUIDANCES.map((state) => [state] as const))("%s", (state) => {
  const flight = flightIn(state);
  const root = mountDisplay({
    shown: createShown(flight),
    mode: signal<"ROSE" | "ARC">("ROSE"),
    range: signal(80),
  });

  test("is the state of the flight", () => {
    expect(guidance(flight.moment.value)).toBe(state);
  });

  test("is shown as the table says", () => {
    const expected = TABLE[state];
    const message = expected.message.replace(/ \d+\.\d NM$/, "");
    expect(read(root)).toEqual({ ...expected, message });
  });

  test("the cells of speed, altitude and autopilot are what they are", () => {
    const cells = [...root.querySelectorAll(".nd-fma text")].map((each) => each.textContent ?? "");
    const isSpeedCommanded = state === "capture" || state === "follow";
    expect(cells[0]).toMatch(isSpeedCommanded ? /^RG SPD \d+$/ : /^SPD \d+$/);
    expect([cells[1], cells[4]]).toEqual(["ALT", "AP1"]);
    expect(cells[3] === "").toBe(state === "off" || state === "data_lost");
  });

  test("the heading is flown by guidance or selected by the crew, and looks so", () => {
    const isEngaged = flight.moment.value.sample?.engagement === "engaged";
    if (root.querySelector(".nd-bug") !== null) expect(isEngaged).toBe(false);
    if (!isEngaged) expect(root.querySelector(".nd-bug")).not.toBeNull();
  });
});

describe("the speed column says who commands the speed", () => {
  /** Own ship in converge, `slower` than the crew's speed, and as it was 10 s ago [m/s]. */
  function column(slower: number, slowerBefore = slower) {
    const flight = flightIn("converge");
    const { sample } = flight.moment.value;
    if (sample === null) throw new Error("An empty flight.");
    const commanded = (by: number) => ({
      ...sample,
      commanded_tas_mps: sample.commanded_tas_mps - by,
    });
    const now = commanded(slower);
    amend(flight, { sample: now, now, before: commanded(slowerBefore) });
    const root = mountDisplay({
      shown: createShown(flight),
      mode: signal<"ROSE" | "ARC">("ROSE"),
      range: signal(80),
    });
    const cells = [...root.querySelectorAll(".nd-fma text")].map((each) => each.textContent ?? "");
    const boxes = [...root.querySelectorAll(".nd-fma .nd-box")].map((each) =>
      Number(each.getAttribute("x")),
    );
    return { now: cells[0], next: cells[5], isBoxed: boxes.some((x) => x < 60) };
  }

  test("the crew's, while guidance flies at it", () => {
    expect(column(0)).toEqual({ now: "SPD 467", next: "RG SPD", isBoxed: false });
    expect(column(0.4).now).toMatch(/^SPD/);
  });

  test("guidance, as soon as it brakes on its way; boxed while that is new", () => {
    expect(column(6, 0)).toEqual({ now: "RG SPD 455", next: "", isBoxed: true });
    expect(column(20, 6)).toEqual({ now: "RG SPD 428", next: "", isBoxed: false });
  });
});

test("ghosts of the other paths stand under what is proposed, and go once it is accepted", () => {
  const draw = (state: Guidance) =>
    mountDisplay({
      shown: createShown(flightIn(state)),
      mode: signal<"ROSE" | "ARC">("ROSE"),
      range: signal(80),
    });
  const proposed = draw("proposed");
  const [others, path] = [".nd-others", ".nd-proposed"].map((each) => proposed.querySelector(each));
  expect(others?.querySelector(".nd-stroke")?.getAttribute("d")).toMatch(/^M/);
  const order = others?.compareDocumentPosition(path ?? proposed) ?? 0;
  expect(order & Node.DOCUMENT_POSITION_FOLLOWING).not.toBe(0);
  expect(draw("armed").querySelector(".nd-others")).toBeNull();
});

test("a proposal says when it would join, and how close they would come", () => {
  const shown = createShown(flightIn("proposed"));
  const { toJoin, least } = shown.numbers.value;
  const promised = proposal().promised_s - T;
  const [minutes = 0, seconds = 0] = toJoin.split(":").map(Number);
  expect(60 * minutes + seconds).toBeCloseTo(promised, -0.5);
  expect(least?.miles).toBe("5.9");
});

test("the keep-out circle of a leader that is not heard of grows", () => {
  const radius = (age: number) => {
    const flight = flightIn("data_lost");
    if (flight.moment.value.sample !== null)
      amend(flight, { sample: { ...flight.moment.value.sample, leader_age_s: age } });
    return createShown(flight).picture.value.keepOut;
  };
  const least = documentsOf("fig_6b").started.min_separation_m;
  expect(radius(1)).toBe(least);
  expect(radius(20) - least).toBeCloseTo(0.5 * 9.81 * Math.tan(25 * (Math.PI / 180)) * 400, 6);
});

test.each([
  [3, "CLB"],
  [1, "ALT"],
  [-8, "DES"],
])("own ship that climbs by %s m/s is said to", (climb, said) => {
  const flight = flightIn("converge");
  amend(flight, { climbs: new Map([[flight.moment.value.now?.pursuer.ident ?? "", climb]]) });
  const root = mountDisplay({
    shown: createShown(flight),
    mode: signal<"ROSE" | "ARC">("ARC"),
    range: signal(40),
  });
  const cells = [...root.querySelectorAll(".nd-fma text")].map((each) => each.textContent ?? "");
  expect(cells[1]).toBe(said);
});
