/** The leader's route as it declares it, over the ground, and where the slot behind it is. */

import { pointAlong, type Vector, velocity } from "../geometry";
import { DEG, wrap360 } from "../units";
import type { PathPoint, PathSegment, TurnSegment } from "../wire";
import type { Declared, Situation } from "./situation";

/** Gravity [m/s²]. */
const G = 9.80665;
/** What follows the last piece is flown on for ever: it is drawn for so long [s]. */
const FINAL = 7200;

/** The leader's declared pieces one after another, each with its wind, and the final leg. */
export function leaderRoute({ leader }: Pick<Situation, "leader">, wind: Vector): PathSegment[] {
  return declaredRoute(leader, wind);
}

/** The same of any aircraft that says what it will fly. Changes of level take no time of their own. */
export function declaredRoute(
  { x_m, y_m, heading_deg, tas_mps, intent }: Declared,
  wind: Vector,
): PathSegment[] {
  const segments: PathSegment[] = [];
  let at: PathPoint = { t_s: 0, x_m, y_m, heading_deg };
  for (const piece of [...intent, { straight_s: FINAL }]) {
    if ("level_change" in piece) continue;
    const segment =
      "straight_s" in piece
        ? straight(at, tas_mps, piece.straight_s, wind)
        : turn(at, tas_mps, piece, wind);
    segments.push(segment);
    at = segment.end;
  }
  return segments;
}

function straight(start: PathPoint, tas: number, duration: number, wind: Vector): PathSegment {
  const air = velocity(tas, start.heading_deg);
  const end = {
    t_s: start.t_s + duration,
    x_m: start.x_m + (air.x + wind.x) * duration,
    y_m: start.y_m + (air.y + wind.y) * duration,
    heading_deg: start.heading_deg,
  };
  return { kind: "straight", length_m: tas * duration, duration_s: duration, start, end };
}

function turn(
  start: PathPoint,
  tas: number,
  piece: { turn_to_heading_deg: number; direction: "left" | "right"; bank_deg: number },
  wind: Vector,
): TurnSegment {
  const side = piece.direction === "right" ? 1 : -1;
  const angle = wrap360(side * (piece.turn_to_heading_deg - start.heading_deg));
  const radius = tas ** 2 / (G * Math.tan(piece.bank_deg * DEG));
  const duration = (angle * DEG * radius) / tas;
  const segment: TurnSegment = {
    kind: "turn",
    direction: piece.direction,
    angle_deg: angle,
    bank_deg: piece.bank_deg,
    radius_m: radius,
    duration_s: duration,
    start,
    end: { ...start, t_s: start.t_s + duration },
  };
  // Its end is where a point just before it leads to: the same arc, in the same wind.
  const long = { ...segment, end: { ...segment.end, t_s: segment.end.t_s + 1 } };
  return { ...segment, end: pointAlong(long, segment.end.t_s, wind) };
}

/** The slot at t = 0: D back along the leader's final track, had it always been on that. */
interface SlotNow {
  readonly point: PathPoint;
  /** Where the slot would be for D = 0. */
  readonly origin: Vector;
  /** The direction of the final track over the ground, as a unit vector. */
  readonly ahead: Vector;
  /** When the leader is D past the beginning of its final leg [s]; 0 if it has no turn to come. */
  readonly opens: number;
}

export function slotNow(
  { leader, slot_distance_m: distance }: Situation,
  route: readonly PathSegment[],
  wind: Vector,
): SlotNow {
  const start = route.at(-1)?.start ?? { t_s: 0, ...leader };
  const air = velocity(leader.tas_mps, start.heading_deg);
  const ground = { x: air.x + wind.x, y: air.y + wind.y };
  const speed = Math.max(1, Math.hypot(ground.x, ground.y));
  const ahead = { x: ground.x / speed, y: ground.y / speed };
  const origin = { x: start.x_m - ground.x * start.t_s, y: start.y_m - ground.y * start.t_s };
  const point = {
    t_s: 0,
    x_m: origin.x - distance * ahead.x,
    y_m: origin.y - distance * ahead.y,
    heading_deg: start.heading_deg,
  };
  const turns = leader.intent.some((piece) => "direction" in piece);
  return { point, origin, ahead, opens: turns ? start.t_s + distance / speed : 0 };
}
