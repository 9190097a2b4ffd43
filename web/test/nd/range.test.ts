import { expect, test } from "vitest";
import { fittingRange, largestLegible, stepToward } from "../../src/nd/range";
import { layoutOf, onMap, project } from "../../src/nd/view";
import { createShown } from "../../src/store/shown";
import { NM } from "../../src/units";
import { flightAt, setTime } from "./fixture";

const POSE = { x_m: 0, y_m: 0, heading_deg: 0 };

function ahead(miles: number, right = 0) {
  return { x_m: right * NM, y_m: miles * NM };
}

test("all of the plan is on the map, from the first picture to the join", () => {
  for (const mode of ["ROSE", "ARC"] as const) {
    let range = 40 as ReturnType<typeof fittingRange>;
    for (let t = 0; t < 870; t += 10) {
      const flight = flightAt("fig_6b", t);
      const { pose, places } = createShown(flight).picture.value;
      if (pose === null) throw new Error("A flight without own ship.");
      range = fittingRange(mode, pose, places, range);
      const layout = layoutOf(mode, range);
      const seen = places.filter((place) => onMap(layout, project(layout, pose, place)));
      // What is behind in ARC is the leader's alone to be off the map: it has a symbol on the edge.
      if (mode === "ROSE") expect(seen.length).toBe(places.length);
      else expect(seen.length).toBeGreaterThanOrEqual(places.length - 1);
    }
  }
});

test("the range becomes smaller as the join comes near, and does not waver", () => {
  const flight = flightAt("fig_6b", 0);
  const { picture } = createShown(flight);
  const ranges: number[] = [];
  let range = 40 as ReturnType<typeof fittingRange>;
  for (let t = 0; t < 870; t += 1) {
    setTime(flight, t, "converge");
    const { pose, places } = picture.value;
    if (pose === null) throw new Error("A flight without own ship.");
    range = fittingRange("ROSE", pose, places, range);
    if (range !== ranges.at(-1)) ranges.push(range);
  }
  expect(ranges.length).toBeLessThan(7);
  expect(ranges).toEqual([...ranges].sort((a, b) => b - a));
  expect(ranges[0]).toBeGreaterThanOrEqual(80);
  expect(ranges.at(-1)).toBeLessThanOrEqual(20);
});

test("a smaller range is taken only with room to spare, a larger one at once", () => {
  // In ROSE 20 NM show 10 to each side: 9.4 fits, but not with room to spare.
  const place = [ahead(9)];
  expect(fittingRange("ROSE", POSE, place, 20)).toBe(20);
  expect(fittingRange("ROSE", POSE, place, 40)).toBe(40);
  expect(fittingRange("ROSE", POSE, [ahead(7)], 40)).toBe(20);
  expect(fittingRange("ROSE", POSE, [ahead(15)], 20)).toBe(40);
});

test("what is behind does not make ARC useless, but for the leader", () => {
  expect(fittingRange("ARC", POSE, [ahead(5), ahead(-30)], 10)).toBe(10);
  // a leader behind costs one step of the range, and no more: then it is a symbol on the edge
  expect(fittingRange("ARC", POSE, [ahead(-3), ahead(6)], 10)).toBe(20);
  expect(fittingRange("ARC", POSE, [ahead(-20), ahead(6)], 10)).toBe(10);
  expect(fittingRange("ARC", POSE, [ahead(-20)], 10)).toBeGreaterThan(80);
});

test("a range follows by single steps, seconds apart, sooner where what is near is off the map", () => {
  expect(stepToward(320, 10, { since: 3.9, isUrgent: false })).toBe(10);
  expect(stepToward(320, 10, { since: 4, isUrgent: false })).toBe(20);
  expect(stepToward(320, 10, { since: 1, isUrgent: true })).toBe(20);
  expect(stepToward(10, 80, { since: 5, isUrgent: false })).toBe(40);
  expect(stepToward(40, 40, { since: 99, isUrgent: true })).toBe(40);
});

test("the circle of least separation can be told apart in the largest range that is legible", () => {
  for (const mode of ["ROSE", "ARC"] as const) {
    const range = largestLegible(mode, 5 * NM);
    expect(5 * NM * layoutOf(mode, range).scale).toBeGreaterThanOrEqual(20);
    expect(range).toBe(80);
    expect(largestLegible(mode, 0)).toBe(10);
  }
});
