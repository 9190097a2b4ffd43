import { expect, test } from "vitest";
import {
  bearing,
  carry,
  edge,
  type Layout,
  layoutOf,
  mapTransform,
  offNose,
  onMap,
  type Point,
  polar,
  project,
  RANGES,
  remedy,
  toMap,
} from "../../src/nd/view";
import { NM } from "../../src/units";

const ROSE = layoutOf("ROSE", 40);
const ARC = layoutOf("ARC", 40);
const POSE = { x_m: 12_000, y_m: -7_000, heading_deg: 90 };

function ahead(miles: number, right: number): { x_m: number; y_m: number } {
  // POSE heads east: ahead is east, right is south.
  return { x_m: POSE.x_m + miles * NM, y_m: POSE.y_m - right * NM };
}

/** What the SVG transform of the map does to a point. */
function carried(transform: string, point: Point): Point {
  const numbers = [...transform.matchAll(/-?\d+(?:\.\d+)?/g)].map(([number]) => Number(number));
  const [cx = 0, cy = 0, angle = 0, dx = 0, dy = 0] = numbers;
  const [sin, cos] = [Math.sin((angle * Math.PI) / 180), Math.cos((angle * Math.PI) / 180)];
  const [x, y] = [point.x + dx, point.y + dy];
  return { x: cx + x * cos - y * sin, y: cy + x * sin + y * cos };
}

/** What a transform of the page does to a point of the glass. */
function glided(transform: string, { centre }: Layout, point: Point): Point {
  const numbers = [...transform.matchAll(/-?\d+(?:\.\d+)?/g)].map(([number]) => Number(number));
  const [angle = 0, dx = 0, dy = 0] = numbers;
  const [sin, cos] = [Math.sin((angle * Math.PI) / 180), Math.cos((angle * Math.PI) / 180)];
  const [x, y] = [point.x + 7.68 * dx - centre.x, point.y + 7.68 * dy - centre.y];
  return { x: centre.x + x * cos - y * sin, y: centre.y + x * sin + y * cos };
}

test.each([ROSE, ARC])("what is carried on stands where it would be drawn in $mode", (layout) => {
  const moved = {
    own: { x: 41, y: -23 },
    turned: 0.5,
    leader: { x: -38, y: 9 },
    slot: { x: 30, y: 30 },
    others: new Map([["BAW12", { x: 12, y: -40 }]]),
  };
  const later = {
    x_m: POSE.x_m + moved.own.x,
    y_m: POSE.y_m + moved.own.y,
    heading_deg: POSE.heading_deg + moved.turned,
  };
  const place = ahead(9, -7);
  const there = project(layout, POSE, place);
  const by = [
    ["map", { x: 0, y: 0 }],
    ["leader", moved.leader],
    ["slot", moved.slot],
    ["other BAW12", { x: 12, y: -40 }],
  ] as const;
  for (const [carrier, { x, y }] of by) {
    const expected = project(layout, later, { x_m: place.x_m + x, y_m: place.y_m + y });
    const seen = glided(carry(layout, POSE.heading_deg, moved, carrier), layout, there);
    expect(seen.x).toBeCloseTo(expected.x, 0.8);
    expect(seen.y).toBeCloseTo(expected.y, 0.8);
  }
  expect(carry(layout, 90, moved, "tape")).toBe("rotate(-0.5deg) translate(0%, 0%)");
  expect(carry(layout, 90, moved, "glass")).toBe("rotate(0deg) translate(0%, 0%)");
});

test.each([ROSE, ARC])("a mile is 12.5 px at 40 NM in $mode", (layout) => {
  const point = project(layout, POSE, ahead(1, 0));
  expect(layout.centre.y - point.y).toBeCloseTo(12.5, 9);
  expect(point.x).toBeCloseTo(layout.centre.x, 9);
});

test.each([ROSE, ARC])("what is on the right is drawn on the right in $mode", (layout) => {
  const right = project(layout, POSE, ahead(0, 10));
  expect(right.x).toBeCloseTo(layout.centre.x + 125, 9);
  expect(right.y).toBeCloseTo(layout.centre.y, 9);
});

test("a mirrored world is a mirrored picture", () => {
  for (const heading of [0, 30, 135, 280]) {
    const pose = { x_m: 0, y_m: 0, heading_deg: heading };
    const mirror = { x_m: 0, y_m: 0, heading_deg: -heading };
    const a = project(ROSE, pose, { x_m: 3000, y_m: 8000 });
    const b = project(ROSE, mirror, { x_m: -3000, y_m: 8000 });
    expect(b.x - ROSE.centre.x).toBeCloseTo(ROSE.centre.x - a.x, 9);
    expect(b.y).toBeCloseTo(a.y, 9);
  }
});

test("a world turned with the own ship is the same picture", () => {
  const a = project(ARC, { x_m: 0, y_m: 0, heading_deg: 20 }, { x_m: 3000, y_m: 8000 });
  const b = project(ARC, { x_m: 0, y_m: 0, heading_deg: 110 }, { x_m: 8000, y_m: -3000 });
  expect(b.x).toBeCloseTo(a.x, 9);
  expect(b.y).toBeCloseTo(a.y, 9);
});

test("the map's transform and the projection agree to a twentieth of a pixel, anywhere", () => {
  for (const range of RANGES) {
    for (const heading of [0, 47.3, 181.2, 359]) {
      const layout = layoutOf("ARC", range);
      const pose = { x_m: 250_000, y_m: -90_000, heading_deg: heading };
      const place = { x_m: 255_000, y_m: -83_000 };
      const point = carried(mapTransform(layout, pose), toMap(layout, place));
      const truth = project(layout, pose, place);
      // Angles are written to 0.01°: at 200 px that is 0.02 px.
      expect(Math.hypot(point.x - truth.x, point.y - truth.y)).toBeLessThan(0.05);
    }
  }
});

test.each([
  ["ARC", [30, 20, 10]],
  ["ROSE", [10]],
] as const)("the rings of %s stand where they say", (mode, miles) => {
  const { rings, scale } = layoutOf(mode, 40);
  expect(rings.map(({ label }) => Number(label))).toEqual(miles);
  for (const { label, radius } of rings)
    expect(radius / (scale * NM)).toBeCloseTo(Number(label), 9);
});

test.each(["ROSE", "ARC"] as const)("an off-scale symbol stays on its bearing in %s", (mode) => {
  const layout = layoutOf(mode, 40);
  for (let direction = -180; direction < 180; direction += 5) {
    const point = edge(layout, direction);
    expect(onMap(layout, point)).toBe(true);
    const radius = Math.hypot(point.x - layout.centre.x, point.y - layout.centre.y);
    expect(point.x).toBeCloseTo(polar(layout, direction, radius).x, 6);
    expect(point.y).toBeCloseTo(polar(layout, direction, radius).y, 6);
  }
});

test("behind in ARC asks for ROSE, beyond asks for a range, nothing helps at the end of the world", () => {
  expect(remedy(ARC, POSE, ahead(-12, 0))).toBe("→ ROSE");
  expect(remedy(ARC, POSE, ahead(60, 0))).toBe("→ RANGE 80");
  expect(remedy(ROSE, POSE, ahead(30, 5))).toBe("→ RANGE 80");
  expect(remedy(ROSE, POSE, ahead(900, 0))).toBeNull();
});

test("bearings are clockwise from north, and from the nose", () => {
  expect(bearing(POSE, ahead(10, 10))).toBeCloseTo(135, 9);
  expect(offNose(POSE, 135)).toBeCloseTo(45, 9);
  expect(offNose({ ...POSE, heading_deg: 350 }, 10)).toBeCloseTo(20, 9);
});
