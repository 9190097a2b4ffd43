import { describe, expect, test } from "vitest";
import { alignment } from "../../src/compare/alignment";
import { createComparison } from "../../src/compare/compared";
import { countFigures, figuresOf } from "../../src/compare/figures";
import { referencesIn, splitReference } from "../../src/compare/references";
import { createFlightStore } from "../../src/store/flight";
import { ghostOf } from "../../src/store/ghost";
import { createHistory } from "../../src/store/history";
import { documentsOf, historyOf } from "../flights/recorded";

const [A, B] = [historyOf("fig_6a"), historyOf("fig_6b")];

describe("figures", () => {
  test.each([
    // as `relguide fly --json` gives them
    ["fig_6a", { join: 1016, track: 131.022 * 1852, least: 9998.614, swing: 186.595 }, 3, 32],
    ["fig_6b", { join: 916, track: 118.254 * 1852, least: 9998.611, swing: 45.83 }, 0, 0],
  ] as const)("of a flight that is over are its own: %s", (name, exact, reversals, replans) => {
    const told = figuresOf(historyOf(name));
    expect(told).toMatchObject({ join: exact.join, reversals, replans, isFinal: true });
    expect(told?.track).toBeCloseTo(exact.track, -1);
    expect(told?.least).toBeCloseTo(exact.least, 2);
    expect(told?.swing).toBeCloseTo(exact.swing, 2);
  });

  test.each([A, B])("are the same counted from samples one a second", (history) => {
    const [told, counted] = [figuresOf(history), countFigures(history)];
    expect(counted).toMatchObject({
      join: told?.join,
      reversals: told?.reversals,
      replans: told?.replans,
    });
    expect(counted.least).toBeCloseTo(told?.least ?? 0, 2);
    // chords of a second are shorter than arcs by centimetres
    expect(Math.abs(counted.track - (told?.track ?? 0))).toBeLessThan(5);
    expect(Math.abs(counted.swing - (told?.swing ?? 0))).toBeLessThan(0.2);
  });

  test("of a flight that still flies are those so far", () => {
    const sofar = figuresOf(historyOf("fig_6a", 600));
    expect(sofar).toMatchObject({ join: null, replans: 0, isFinal: false });
    expect(sofar?.track).toBeLessThan(80 * 1852);
    expect(figuresOf(createHistory())).toBeNull();
  });
});

test("two flights are aligned by their clocks, by engagement, or by the join", () => {
  expect(alignment(A, B, "clock")).toBe(0);
  expect(alignment(A, B, "engaged")).toBe(0);
  expect(alignment(A, B, "slot")).toBe(916 - 1016);
  expect(alignment(B, A, "slot")).toBe(100);
  expect(alignment(historyOf("fig_6a", 600), B, "slot")).toBeNull();
  expect(alignment(createHistory(), B, "engaged")).toBeNull();
});

test("the other flight stands where it was at its own time, its leader only where that differs", () => {
  const now = A.knots.sampleAt(840);
  const ghost = ghostOf(A, now, { name: "6B", history: B, t: 840 });
  const there = B.knots.sampleAt(840);
  expect(ghost?.pursuer).toEqual(there?.pursuer);
  expect(ghost?.leader).toBeNull(); // both leaders fly the same
  expect(ghost?.isOutside).toBe(false);
  expect(ghost?.flown.at(-1)).toEqual(there?.pursuer);
  expect(ghost?.own.at(-1)).toEqual(now?.pursuer);
  const later = ghostOf(A, now, { name: "6B", history: B, t: 740 });
  expect(later?.leader?.x_m).toBeLessThan(now?.leader.x_m ?? 0);
  expect(ghostOf(A, now, { name: "6B", history: B, t: 1200 })?.isOutside).toBe(true);
  expect(ghostOf(A, null, { name: "6B", history: B, t: 0 })).toBeNull();
});

test("the ghost follows the clock of the shown flight, aligned as is chosen", () => {
  const store = createFlightStore();
  const { other, how, offset, ghost } = createComparison(store.flight, store.history);
  store.load("fig_6a", documentsOf("fig_6a"), 0);
  expect(ghost.value).toBeNull();
  other.value = { reference: "scenario:fig_6b", title: "6b", history: B };
  store.seek(1016, 0, 0);
  expect(ghost.value?.name).toBe("FIG 6B");
  expect(ghost.value?.pursuer).toEqual(B.knots.sampleAt(1016)?.pursuer);
  how.value = "slot";
  expect(offset.value).toBe(-100);
  expect(ghost.value?.pursuer).toEqual(B.knots.sampleAt(916)?.pursuer);
  store.seek(50, 0, 0);
  expect(ghost.value?.isOutside).toBe(true);
});

test("the address names what is compared", () => {
  expect(referencesIn(new URLSearchParams("compare=scenario:fig_6a,record:3f"))).toEqual([
    "scenario:fig_6a",
    "record:3f",
  ]);
  expect(referencesIn(new URLSearchParams(""))).toEqual([]);
  expect(splitReference("record:a:b")).toEqual(["record", "a:b"]);
  expect(splitReference("nothing")).toEqual(["", "nothing"]);
});
