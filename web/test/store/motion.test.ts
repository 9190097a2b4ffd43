import { describe, expect, test } from "vitest";
import { readClock, setClock } from "../../src/store/clock";
import { blend, gap, moveAircraft, moveSample, windOf } from "../../src/store/motion";
import { aircraft, pairAt } from "../samples";

describe("motion from a sample", () => {
  test("straight ahead", () => {
    const later = moveAircraft(aircraft(), 2);
    expect(later).toMatchObject({ x_m: 480, heading_deg: 90 });
    expect(later.y_m).toBeCloseTo(0, 9);
  });

  test("a turn is flown as an arc, not along its tangent", () => {
    const turning = aircraft({ turn_rate_degps: 3 });
    const quarter = moveAircraft(turning, 30);
    const radius = 240 / ((3 * Math.PI) / 180);
    expect(quarter.heading_deg).toBeCloseTo(180, 9);
    expect(quarter.x_m).toBeCloseTo(radius, 6);
    expect(quarter.y_m).toBeCloseTo(-radius, 6);
  });

  test("moving on and back again changes nothing", () => {
    const turning = aircraft({ turn_rate_degps: -1.7, heading_deg: 12, track_deg: 12 });
    const back = moveAircraft(moveAircraft(turning, 9), -9);
    expect(back.x_m).toBeCloseTo(0, 6);
    expect(back.y_m).toBeCloseTo(0, 6);
    expect(back.heading_deg).toBeCloseTo(12, 9);
  });

  test("wind is what ground velocity has beyond that through the air, and drifts a turn", () => {
    const windy = aircraft({ ground_speed_mps: 255, turn_rate_degps: 3 });
    expect(windOf(windy).x).toBeCloseTo(15, 9);
    const still = moveAircraft(aircraft({ turn_rate_degps: 3 }), 10);
    expect(moveAircraft(windy, 10).x_m - still.x_m).toBeCloseTo(150, 6);
    expect(moveAircraft(windy, 10).track_deg).not.toBeCloseTo(
      moveAircraft(windy, 10).heading_deg,
      1,
    );
  });

  test("separation, slot and time to go move along", () => {
    const later = moveSample(pairAt(0), 10);
    expect(later.separation_m).toBeCloseTo(19600, 6);
    expect(later.slot.x_m).toBeCloseTo(12000, 6);
    expect(later.time_to_go_s).toBe(240);
    expect(moveSample(pairAt(0), 1000).time_to_go_s).toBe(0);
  });

  test("a gap to a new sample closes gently, a leap at once", () => {
    const truth = pairAt(1);
    const off = pairAt(1, { pursuer: aircraft({ x_m: 340, heading_deg: 350 }) });
    const found = gap(off, truth);
    expect(blend(truth, found, 0).pursuer.x_m).toBeCloseTo(340, 9);
    expect(blend(truth, found, 0).pursuer).toMatchObject({ heading_deg: 350, track_deg: 350 });
    expect(blend(truth, found, 150).pursuer.x_m).toBeCloseTo(240 + 100 / Math.E, 9);
    expect(blend(truth, found, 5000)).toBe(truth);
    const far = gap(pairAt(1, { pursuer: aircraft({ x_m: 90000 }) }), truth);
    expect(blend(truth, far, 0).pursuer.x_m).toBeCloseTo(240, 9);
  });
});

describe("the flight's clock", () => {
  test("runs at the rate between ticks", () => {
    const clock = setClock(null, { t: 100, rate: 10, wall: 5000 });
    expect(readClock(clock, 5500)).toBeCloseTo(105, 9);
  });

  test("a late tick moves it a little, not all the way", () => {
    let clock = setClock(null, { t: 0, rate: 10, wall: 0 });
    clock = setClock(clock, { t: 0.5, rate: 10, wall: 80 }); // 30 ms late: says 0.5, shown 0.8
    const shown = readClock(clock, 80);
    expect(shown).toBeGreaterThan(0.7);
    expect(shown).toBeLessThan(0.8);
  });

  test("after a pause or a sleep it jumps", () => {
    let clock = setClock(null, { t: 0, rate: 1, wall: 0 });
    clock = setClock(clock, { t: 30, rate: 1, wall: 1000 });
    expect(readClock(clock, 1000)).toBe(30);
    clock = setClock(clock, { t: 30.02, rate: 0, wall: 1050 });
    expect(readClock(clock, 9000)).toBe(30.02);
  });
});
