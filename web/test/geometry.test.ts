import { describe, expect, test } from "vitest";
import {
  cutPath,
  cutSegment,
  pathPointAt,
  pointAlong,
  samplePath,
  sampleTurn,
  type Vector,
  windVector,
} from "../src/geometry";
import { DEG } from "../src/units";
import type { PathPoint, TurnSegment } from "../src/wire";
import { point, rightTurn, straight } from "./samples";

const WIND = { x: 10, y: -5 };

/** The turn, mirrored east to west. */
function mirrored(turn: TurnSegment): TurnSegment {
  const flip = (p: PathPoint) => point(p.t_s, -p.x_m, p.y_m, (360 - p.heading_deg) % 360);
  return { ...turn, direction: "left", start: flip(turn.start), end: flip(turn.end) };
}

function blown(turn: TurnSegment): TurnSegment {
  const { end } = turn;
  const moved = point(
    end.t_s,
    end.x_m + WIND.x * turn.duration_s,
    end.y_m + WIND.y * turn.duration_s,
    end.heading_deg,
  );
  return { ...turn, end: moved };
}

/** Centre of a turn's circle in calm air [m]. */
function turnCentre(turn: TurnSegment): Vector {
  const side = turn.direction === "right" ? 1 : -1;
  const psi = turn.start.heading_deg * DEG;
  return {
    x: turn.start.x_m + side * turn.radius_m * Math.cos(psi),
    y: turn.start.y_m - side * turn.radius_m * Math.sin(psi),
  };
}

describe("a path over the ground", () => {
  test("a calm turn keeps its distance from its centre and ends where it should", () => {
    for (const turn of [rightTurn(200), mirrored(rightTurn(200))]) {
      const centre = turnCentre(turn);
      for (const p of sampleTurn(turn)) {
        expect(Math.hypot(p.x_m - centre.x, p.y_m - centre.y)).toBeCloseTo(1000, 6);
      }
      const last = pointAlong(turn, turn.end.t_s - 1e-9);
      expect(last.x_m).toBeCloseTo(turn.end.x_m, 3);
      expect(last.y_m).toBeCloseTo(turn.end.y_m, 3);
      expect(last.heading_deg).toBeCloseTo(turn.end.heading_deg, 3);
    }
  });

  test("a right turn from north goes east, a left turn west", () => {
    expect(pointAlong(rightTurn(90), 5).x_m).toBeGreaterThan(0);
    expect(pointAlong(mirrored(rightTurn(90)), 5).x_m).toBeLessThan(0);
  });

  test("in wind a turn is the calm arc plus wind times time", () => {
    const calm = rightTurn(270);
    const windy = blown(calm);
    for (const t of [1, 12, 30, 47]) {
      const a = pointAlong(calm, t);
      const b = pointAlong(windy, t, WIND);
      expect(b.x_m - a.x_m).toBeCloseTo(WIND.x * t, 6);
      expect(b.y_m - a.y_m).toBeCloseTo(WIND.y * t, 6);
      expect(b.heading_deg).toBeCloseTo(a.heading_deg, 9);
    }
    const before = pointAlong(windy, windy.end.t_s - 1e-9, WIND);
    expect(before.x_m).toBeCloseTo(windy.end.x_m, 3);
  });

  test("a straight is covered evenly", () => {
    const leg = straight(point(100, 0, 0, 90), 60, 200);
    expect(pointAlong(leg, 130).x_m).toBeCloseTo(6000, 9);
    expect(pointAlong(leg, 0)).toBe(leg.start);
    expect(pointAlong(leg, 1000)).toBe(leg.end);
  });

  test("a cut path begins and ends where it was cut, and cuts add up", () => {
    const turn = rightTurn(90);
    const path = [turn, straight(turn.end, 60, 100)];
    const middle = turn.duration_s / 3;
    const [before, after] = [cutPath(path, undefined, 0, middle), cutPath(path, undefined, middle)];
    expect(before).toHaveLength(1);
    expect(after).toHaveLength(2);
    expect(before[0]?.end).toEqual(after[0]?.start);
    expect(after[0]).toMatchObject({ kind: "turn", angle_deg: expect.closeTo(60, 9) });
    expect(cutPath(path, undefined, 1000)).toEqual([]);
  });

  test("points along a whole path come in order, joints once", () => {
    const turn = rightTurn(90);
    const path = [turn, straight(turn.end, 60, 100)];
    const times = samplePath(path).map((p) => p.t_s);
    expect(times).toEqual([...new Set(times)].sort((a, b) => a - b));
    expect(times).toHaveLength(47); // 45 pieces of 2° and one straight
    expect(pathPointAt(path, 1e9)).toBe(path[1]?.end);
    expect(pathPointAt([], 0)).toBeNull();
  });

  test("a wind from the west blows east", () => {
    const wind = windVector({ from_deg: 270, speed_mps: 15 });
    expect(wind.x).toBeCloseTo(15, 9);
    expect(wind.y).toBeCloseTo(0, 9);
  });
});

test("a boundary arc is read between its points, and cut like any segment", () => {
  const at = (t_s: number, x_m: number, y_m: number, heading_deg: number) => ({
    t_s,
    x_m,
    y_m,
    heading_deg,
  });
  const ride = {
    kind: "boundary" as const,
    side: "left" as const,
    duration_s: 20,
    start: at(10, 0, 0, 5),
    via: [at(20, 100, 1000, 355)],
    end: at(30, 0, 2000, 345),
  };
  expect(pointAlong(ride, 15)).toEqual(at(15, 50, 500, 0));
  expect(pointAlong(ride, 25).x_m).toBeCloseTo(50);
  const rest = cutSegment(ride, 15, 99);
  expect(rest).toMatchObject({ kind: "boundary", duration_s: 15, via: ride.via });
  expect(samplePath([ride]).map((point) => point.y_m)).toEqual([0, 1000, 2000]);
});
