import { describe, expect, test } from "vitest";
import { CALM, pathPointAt, windVector } from "../../src/geometry";
import { pathData, restData, segmentAt } from "../../src/nd/path";
import { layoutOf, type Point, toMap } from "../../src/nd/view";
import type { PathSegment, TurnSegment } from "../../src/wire";
import { documentsOf, type FlightName } from "./fixture";

const RANGES = [10, 40, 320];
const NAMES: FlightName[] = ["fig_6a", "fig_6b", "fig_6b_wind", "left", "crossing"];

/** The drawn line as points half a pixel apart: what SVG makes of M, L and A. */
function drawn(data: string): Point[] {
  const points: Point[] = [];
  for (const [, command, list] of data.matchAll(/([MLA])([^MLA]*)/g)) {
    const numbers = (list ?? "").trim().split(/\s+/).map(Number);
    const [x, y] = numbers.slice(-2) as [number, number];
    const last = points.at(-1);
    if (command === "M" || last === undefined) points.push({ x, y });
    else if (command === "L") points.push(...between(last, { x, y }));
    else points.push(...arc(last, { x, y }, numbers[0] ?? 0, numbers[4] === 1));
  }
  return points;
}

function between(a: Point, b: Point): Point[] {
  const count = Math.max(1, Math.ceil(Math.hypot(b.x - a.x, b.y - a.y) * 2));
  return Array.from({ length: count }, (_, i) => ({
    x: a.x + ((b.x - a.x) * (i + 1)) / count,
    y: a.y + ((b.y - a.y) * (i + 1)) / count,
  }));
}

/** SVG's small arc from a to b: the centre lies right of the chord for sweep 1 (y down: clockwise). */
function arc(a: Point, b: Point, radius: number, clockwise: boolean): Point[] {
  const chord = Math.hypot(b.x - a.x, b.y - a.y);
  if (chord === 0) return [b];
  const height = Math.sqrt(Math.max(0, radius ** 2 - (chord / 2) ** 2));
  const side = clockwise ? 1 : -1;
  const centre = {
    x: (a.x + b.x) / 2 - (side * height * (b.y - a.y)) / chord,
    y: (a.y + b.y) / 2 + (side * height * (b.x - a.x)) / chord,
  };
  const from = Math.atan2(a.y - centre.y, a.x - centre.x);
  const sweep = 2 * Math.asin(Math.min(1, chord / 2 / radius)) * side;
  const count = Math.max(1, Math.ceil(Math.abs(sweep) * radius * 2));
  return Array.from({ length: count }, (_, i) => ({
    x: centre.x + radius * Math.cos(from + (sweep * (i + 1)) / count),
    y: centre.y + radius * Math.sin(from + (sweep * (i + 1)) / count),
  }));
}

function farthest(points: readonly Point[], line: readonly Point[]): number {
  return Math.max(
    ...points.map((point) =>
      Math.min(...line.map((each) => Math.hypot(each.x - point.x, each.y - point.y))),
    ),
  );
}

describe.each(NAMES)("the drawn path of %s", (name) => {
  const { plan, route, started } = documentsOf(name);
  const wind = windVector(started.wind);
  test.each(RANGES)("is within a pixel of what is flown, at %i NM", (range) => {
    const layout = layoutOf("ARC", range);
    for (const { segments } of [plan.plan, route]) {
      const turns = segments.filter((segment) => segment.kind === "turn");
      for (const turn of turns) {
        const line = drawn(pathData(layout, [turn], wind));
        const flown = Array.from({ length: 101 }, (_, i) =>
          pathPointAt([turn], turn.start.t_s + (turn.duration_s * i) / 100, wind),
        )
          .filter((point) => point !== null)
          .map((point) => toMap(layout, point));
        expect(farthest(flown, line)).toBeLessThan(1);
      }
    }
  });
});

const RIGHT: TurnSegment = {
  kind: "turn",
  direction: "right",
  angle_deg: 300,
  bank_deg: 25,
  radius_m: 12_000,
  duration_s: (300 * (Math.PI / 180) * 12_000) / 240,
  start: { t_s: 0, x_m: 0, y_m: 0, heading_deg: 0 },
  end: {
    t_s: (300 * (Math.PI / 180) * 12_000) / 240,
    x_m: 12_000 * (1 - Math.cos((300 * Math.PI) / 180)),
    y_m: 12_000 * Math.sin((300 * Math.PI) / 180),
    heading_deg: 300,
  },
};

test("a turn of more than half a circle goes all the way round, to the right", () => {
  const layout = layoutOf("ROSE", 40);
  const line = drawn(pathData(layout, [RIGHT], CALM));
  const radius = RIGHT.radius_m * layout.scale;
  expect(Math.max(...line.map(({ x }) => x))).toBeCloseTo(2 * radius, 0);
  expect(Math.min(...line.map(({ y }) => y))).toBeCloseTo(-radius, 0);
  expect(pathData(layout, [RIGHT], CALM)).toContain("A");
});

test("in wind a turn is a trochoid: no arcs, and within a pixel", () => {
  const layout = layoutOf("ROSE", 10);
  const wind = { x: 45, y: -20 };
  const segment = {
    ...RIGHT,
    end: {
      ...RIGHT.end,
      x_m: RIGHT.end.x_m + wind.x * RIGHT.duration_s,
      y_m: RIGHT.end.y_m + wind.y * RIGHT.duration_s,
    },
  };
  const data = pathData(layout, [segment], wind);
  expect(data).not.toContain("A");
  const line = drawn(data);
  const flown = Array.from({ length: 501 }, (_, i) =>
    toMap(
      layout,
      pathPointAt([segment], (segment.duration_s * i) / 500, wind) ?? { x_m: 0, y_m: 0 },
    ),
  );
  expect(farthest(flown, line)).toBeLessThan(1);
});

test("what is flown is gone: the rest begins where the own ship is", () => {
  const layout = layoutOf("ROSE", 40);
  const segments: PathSegment[] = documentsOf("crossing").plan.plan.segments;
  for (const t of [10, 60, 150, 300, 480]) {
    const index = segmentAt(segments, t);
    const start = drawn(restData(layout, segments[index], CALM, t))[0];
    const own = toMap(layout, pathPointAt(segments, t) ?? { x_m: 0, y_m: 0 });
    expect(Math.hypot((start?.x ?? 0) - own.x, (start?.y ?? 0) - own.y)).toBeLessThan(0.02);
  }
  expect(segmentAt(segments, 1e6)).toBe(segments.length);
  expect(restData(layout, segments[segments.length], CALM, 1e6)).toBe("");
});
