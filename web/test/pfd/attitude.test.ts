import { describe, expect, test } from "vitest";
import { approach, attitudeOf, carryOn, NOMINAL_ATTACK } from "../../src/pfd/attitude";
import type { PairSample } from "../../src/store/pair";
import { aircraft, pairAt } from "../samples";

const BARS = { roll_deg: 12, pitch_deg: 1, commanded_bank_deg: 20, commanded_climb_mps: 0 };

function attitude(changes: Partial<PairSample> = {}, climb = 0) {
  return attitudeOf(pairAt(10, changes), climb);
}

const banked = (bank_deg: number, heading_deg = 90) => ({
  pursuer: aircraft({ bank_deg, heading_deg }),
});

describe("attitude", () => {
  test("the nose stands a nominal angle of attack above the path", () => {
    expect(attitude().pitch).toBe(NOMINAL_ATTACK);
    // 240 m/s up at 240 tan 3°
    expect(attitude({}, 240 * Math.tan(Math.PI / 60)).pitch).toBeCloseTo(NOMINAL_ATTACK + 3, 9);
    expect(attitude({}, -10).pitch).toBeLessThan(NOMINAL_ATTACK);
  });

  test("the bars are those of the sample, and at rest while there are none", () => {
    const seen = attitude({ bars: [BARS] });
    expect([seen.roll, seen.pull]).toEqual([12, 1]);
    const out = attitude({ bars: [] });
    expect([out.roll, out.pull]).toEqual([0, 0]);
  });
});

describe("between two ticks", () => {
  test("bank, bars and heading go on as they went", () => {
    const before = attitude({ ...banked(10, 359), bars: [BARS] });
    const now = attitude({ ...banked(10.5, 1), bars: [{ ...BARS, roll_deg: 11.5 }] });
    const later = carryOn(before, now, 0.05, 0.1);
    expect(later.bank).toBeCloseTo(11.5, 9);
    expect(later.roll).toBeCloseTo(10.5, 9);
    expect(later.heading).toBeCloseTo(5, 9);
  });

  test("nothing goes on from one tick alone, or backward", () => {
    const now = attitude(banked(10));
    expect(carryOn(now, now, 0, 1)).toBe(now);
    expect(carryOn(now, now, 0.05, -1)).toBe(now);
  });
});

describe("the picture", () => {
  test("comes nearer to what is true with each frame, and is there within a tenth of a second by 90 %", () => {
    let shown = attitude(banked(0));
    const truth = attitude(banked(10));
    for (let frame = 0; frame < 6; frame += 1) {
      const next = approach(shown, truth, 1000 / 60);
      expect(next.bank).toBeGreaterThan(shown.bank);
      expect(next.bank).toBeLessThan(10);
      shown = next;
    }
    expect(shown.bank).toBeGreaterThan(9);
  });

  test("goes the short way round through north", () => {
    const shown = approach(attitude(banked(0, 359)), attitude(banked(0, 3)), 40);
    expect(shown.heading > 359 || shown.heading < 3).toBe(true);
  });

  test("is at once where another instant is", () => {
    const truth = attitude(banked(30));
    expect(approach(attitude(banked(-5)), truth, 16)).toBe(truth);
    expect(approach(null, truth, 16)).toBe(truth);
  });
});
