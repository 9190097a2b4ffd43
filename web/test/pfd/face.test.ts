import { describe, expect, test } from "vitest";
import {
  APART,
  apartMarks,
  apartOffset,
  climbOffset,
  pullOffset,
  rollOffset,
} from "../../src/pfd/face";
import { FT, NM } from "../../src/units";

const MINUTE = FT / 60; // a foot a minute in m/s

describe("the bars", () => {
  test("the roll bar moves by one width for each 15° of bank, to the side to bank to", () => {
    const width = rollOffset(15);
    expect(width).toBeGreaterThan(0);
    expect(rollOffset(30)).toBeCloseTo(2 * width, 9);
    expect(rollOffset(-15)).toBe(-width);
    expect(rollOffset(0)).toBe(0);
  });

  test("no farther than for 45° of bank, and for 6° of path", () => {
    expect(rollOffset(60)).toBe(rollOffset(45));
    expect(rollOffset(-90)).toBe(rollOffset(-45));
    expect(pullOffset(40)).toBe(pullOffset(6));
    expect(pullOffset(-40)).toBe(-pullOffset(6));
  });

  test("the pitch bar moves up to ask to pull up", () => {
    expect(pullOffset(1)).toBeGreaterThan(0);
    expect(pullOffset(2)).toBeCloseTo(2 * pullOffset(1), 9);
  });
});

test("a rate of climb stands the higher the faster it is, symmetric, and finest near level flight", () => {
  const rates = Array.from({ length: 61 }, (_, k) => 100 * k);
  const offsets = rates.map((feet) => climbOffset(feet * MINUTE));
  offsets.slice(1).forEach((offset, k) => {
    expect(offset).toBeGreaterThan(offsets[k] ?? 0);
  });
  for (const feet of rates)
    expect(climbOffset(-feet * MINUTE)).toBeCloseTo(-climbOffset(feet * MINUTE), 9);
  expect(climbOffset(500 * MINUTE) / 500).toBeGreaterThan(climbOffset(5000 * MINUTE) / 5000);
  expect(climbOffset(9000 * MINUTE)).toBe(climbOffset(6000 * MINUTE));
});

describe("the scale of separations", () => {
  test.each([0.3, 1, 3, 5, 8, 20])("has a minimum of %s NM within it", (miles) => {
    const marks = apartMarks(miles * NM);
    const [first = 0] = marks;
    expect(first).toBeLessThan(miles);
    expect(apartOffset(miles * NM, first)).toBeGreaterThan(0.05 * APART.width);
    expect(apartOffset(miles * NM, first)).toBeLessThan(0.6 * APART.width);
  });

  test("puts its marks at equal steps, and holds what lies beyond to its ends", () => {
    const [first = 0, ...others] = apartMarks(5 * NM);
    others.forEach((mark, k) => {
      expect(apartOffset(mark * NM, first)).toBeCloseTo(((k + 1) * APART.width) / 5, 6);
    });
    expect(apartOffset(0, first)).toBe(0);
    expect(apartOffset(1e6, first)).toBe(APART.width);
  });
});
