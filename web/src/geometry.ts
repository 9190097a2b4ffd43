/**
 * Where a path is at a time: turns and straights over the ground, exactly as guidance plans them.
 *
 * World frame: x east, y north [m]; headings clockwise from north [deg]. In wind a turn's ground
 * path is a trochoid: the arc flown in the air mass plus wind × time; in calm it is the arc itself.
 */

import { DEG, wrap180, wrap360 } from "./units";
import type { BoundarySegment, PathPoint, PathSegment, TurnSegment, WindCard } from "./wire";

/** A vector in the world frame: x east, y north. */
export interface Vector {
  readonly x: number;
  readonly y: number;
}

export const CALM: Vector = { x: 0, y: 0 };

/** The wind as the velocity of the air over the ground [m/s]. */
export function windVector(wind: WindCard): Vector {
  const from = wind.from_deg * DEG;
  return { x: -wind.speed_mps * Math.sin(from), y: -wind.speed_mps * Math.cos(from) };
}

/** A velocity of size `speed` [m/s] toward `heading` [deg]. */
export function velocity(speed: number, heading: number): Vector {
  return { x: speed * Math.sin(heading * DEG), y: speed * Math.cos(heading * DEG) };
}

/** The point of a segment at time `t` [s], on the clock of its own start and end; held to both ends. */
export function pointAlong(segment: PathSegment, t: number, wind: Vector = CALM): PathPoint {
  const { start, end } = segment;
  if (t <= start.t_s) return start;
  if (t >= end.t_s) return end;
  const elapsed = t - start.t_s;
  if (segment.kind === "straight") {
    const part = elapsed / (end.t_s - start.t_s);
    return {
      t_s: t,
      x_m: start.x_m + part * (end.x_m - start.x_m),
      y_m: start.y_m + part * (end.y_m - start.y_m),
      heading_deg: start.heading_deg,
    };
  }
  if (segment.kind === "boundary") return alongBoundary(segment, t);
  const side = segment.direction === "right" ? 1 : -1;
  const heading = start.heading_deg + (side * segment.angle_deg * elapsed) / segment.duration_s;
  const psi0 = start.heading_deg * DEG;
  const psi = heading * DEG;
  return {
    t_s: t,
    x_m: start.x_m + side * segment.radius_m * (Math.cos(psi0) - Math.cos(psi)) + wind.x * elapsed,
    y_m: start.y_m + side * segment.radius_m * (Math.sin(psi) - Math.sin(psi0)) + wind.y * elapsed,
    heading_deg: wrap360(heading),
  };
}

/** A boundary arc comes as points close enough to join by lines. */
function alongBoundary(segment: BoundarySegment, t: number): PathPoint {
  const points = [segment.start, ...segment.via, segment.end];
  const next = points.findIndex((point) => point.t_s > t);
  const [before, after] = [points[next - 1] ?? segment.start, points[next] ?? segment.end];
  return between(before, after, t);
}

/** Between two points of a path at time `t` [s], held to both; it turns the shorter way. */
export function between(before: PathPoint, after: PathPoint, t: number): PathPoint {
  const span = after.t_s - before.t_s;
  const part = span > 0 ? Math.min(1, Math.max(0, (t - before.t_s) / span)) : 0;
  const turned = wrap180(after.heading_deg - before.heading_deg);
  return {
    t_s: t,
    x_m: before.x_m + part * (after.x_m - before.x_m),
    y_m: before.y_m + part * (after.y_m - before.y_m),
    heading_deg: wrap360(before.heading_deg + part * turned),
  };
}

/** The point of a whole path at time `t` [s], held to both ends; null for an empty path. */
export function pathPointAt(
  segments: readonly PathSegment[],
  t: number,
  wind: Vector = CALM,
): PathPoint | null {
  const segment = segments.find((each) => t <= each.end.t_s) ?? segments.at(-1);
  return segment === undefined ? null : pointAlong(segment, t, wind);
}

/** The part of a segment between two times [s], or null if nothing of it lies there. */
export function cutSegment(
  segment: PathSegment,
  t0: number,
  t1: number,
  wind: Vector = CALM,
): PathSegment | null {
  const from = Math.max(t0, segment.start.t_s);
  const to = Math.min(t1, segment.end.t_s);
  if (!(to > from)) return null;
  const part = (to - from) / (segment.end.t_s - segment.start.t_s);
  const ends = {
    duration_s: segment.duration_s * part,
    start: pointAlong(segment, from, wind),
    end: pointAlong(segment, to, wind),
  };
  switch (segment.kind) {
    case "turn":
      return { ...segment, ...ends, angle_deg: segment.angle_deg * part };
    case "straight":
      return { ...segment, ...ends, length_m: segment.length_m * part };
    case "boundary": {
      const via = segment.via.filter((point) => point.t_s > from && point.t_s < to);
      return { ...segment, ...ends, via };
    }
  }
}

/** The part of a path between two times [s]: what is still to be flown, for one. */
export function cutPath(
  segments: readonly PathSegment[],
  wind: Vector = CALM,
  t0 = -Infinity,
  t1 = Infinity,
): PathSegment[] {
  return segments
    .map((segment) => cutSegment(segment, t0, t1, wind))
    .filter((segment) => segment !== null);
}

/** One turn as points no more than `maxAngle` [deg] of heading apart, both ends included. */
export function sampleTurn(turn: TurnSegment, wind: Vector = CALM, maxAngle = 2): PathPoint[] {
  const count = Math.max(1, Math.ceil(turn.angle_deg / maxAngle));
  const span = turn.end.t_s - turn.start.t_s;
  return Array.from({ length: count + 1 }, (_, i) =>
    pointAlong(turn, turn.start.t_s + (span * i) / count, wind),
  );
}

function sampleSegment(segment: PathSegment, wind: Vector, maxAngle: number): PathPoint[] {
  switch (segment.kind) {
    case "turn":
      return sampleTurn(segment, wind, maxAngle);
    case "straight":
      return [segment.start, segment.end];
    case "boundary":
      return [segment.start, ...segment.via, segment.end];
  }
}

/** A path as points: the ends of straights, and turns every `maxAngle` [deg]; between t0 and t1 [s]. */
export function samplePath(
  segments: readonly PathSegment[],
  wind: Vector = CALM,
  t0 = -Infinity,
  t1 = Infinity,
  maxAngle = 2,
): PathPoint[] {
  const points: PathPoint[] = [];
  for (const segment of cutPath(segments, wind, t0, t1)) {
    const more = sampleSegment(segment, wind, maxAngle);
    points.push(...(points.length === 0 ? more : more.slice(1)));
  }
  return points;
}
