/** What lies ahead of the two: own trend, turns and minutes of the path, the places that belong in sight. */

import { CALM, pathPointAt, type Vector, velocity, windVector } from "../geometry";
import { KT } from "../units";
import type { PathPoint } from "../wire";
import {
  committedPoint,
  joinTime,
  minutesToCome,
  type Planned,
  type Turn,
  turnsOf,
} from "./committed";
import { moveAircraft } from "./motion";
import { ROLL_IN } from "./numbers";
import type { PairSample } from "./pair";
import type { GuidanceStyle } from "./state-styles";
import type { Moment } from "./types";

/** A turn to come, and where own ship will be when it begins and ends. */
export interface TurnAhead extends Turn {
  /** When it begins and ends [s, flight time]. */
  readonly begins: number;
  readonly ends: number;
  readonly hasBegun: boolean;
  /** Whether its roll-in is due. */
  readonly isRollIn: boolean;
  readonly from: PathPoint;
  readonly to: PathPoint;
}

/** A whole minute of the plan, and where both will be. */
export interface MinuteAhead {
  readonly minute: number;
  readonly own: PathPoint | null;
  readonly leader: PathPoint | null;
}

/** Own ship a while ahead. */
export interface TrendPoint {
  /** How far ahead [s]. */
  readonly in: number;
  readonly x_m: number;
  readonly y_m: number;
  readonly track_deg: number;
}

export type Place = Pick<PathPoint, "x_m" | "y_m">;

/** The paths that lead somewhere. */
export const AHEAD: readonly GuidanceStyle["path"][] = ["proposed", "armed", "committed"];

/** Between two places of the path that are kept in sight [s]. */
const SEEN_EVERY = 30;

export function placesOf(
  flight: Moment,
  now: PairSample | null,
  style: GuidanceStyle | null,
): Place[] {
  if (now === null) return [];
  const places: Place[] = [now.leader];
  if (style === null || !style.designated) return places;
  if (!AHEAD.includes(style.path)) return style.slot === "none" ? places : [...places, now.slot];
  const join = joinTime(flight);
  if (join === null) return [...places, now.slot];
  const count = Math.max(1, Math.ceil((join - now.t_s) / SEEN_EVERY));
  for (let k = 1; k <= count; k += 1) {
    const point = committedPoint(flight, Math.min(join, now.t_s + k * SEEN_EVERY));
    if (point !== null) places.push(point);
  }
  return places;
}

export function windOver(flight: Moment): Vector {
  const wind = flight.started?.wind;
  return wind === undefined ? CALM : windVector(wind);
}

/** The trend is bent every so many seconds, and ends after so many. */
const TREND_STEP = 5;
const TREND_END = 90;
/** Below this there is no trend worth showing [m/s]. */
const SLOWEST = 100 * KT;

export function trendOf({ pursuer }: PairSample): TrendPoint[] {
  if (pursuer.ground_speed_mps < SLOWEST) return [];
  return Array.from({ length: TREND_END / TREND_STEP }, (_, i) => {
    const ahead = TREND_STEP * (i + 1);
    const { x_m, y_m, track_deg } = moveAircraft(pursuer, ahead);
    return { in: ahead, x_m, y_m, track_deg };
  });
}

/** Up to when the path is drawn: the join, or once joined where the leader is now. */
export function shownUntil(flight: Moment, guided: PairSample | null): number {
  if (guided?.mode !== "follow") return joinTime(flight) ?? Number.POSITIVE_INFINITY;
  const length = flight.started?.slot_distance_m ?? 0;
  // Its end moves on in whole seconds, so that what waits stays as it is.
  return Math.ceil(flight.t) + length / Math.max(1, guided.leader.ground_speed_mps);
}

export function turnsAhead(flight: Moment, plan: Planned): TurnAhead[] {
  return turnsOf(plan)
    .map((turn) => ({
      ...turn,
      begins: plan.t_s + turn.segment.start.t_s,
      ends: plan.t_s + turn.segment.end.t_s,
    }))
    .filter(({ ends }) => ends > flight.t)
    .map((turn) => ({
      ...turn,
      hasBegun: flight.t > turn.begins,
      isRollIn: isSoon(turn.begins - flight.t),
      from: committedPoint(flight, turn.begins) ?? turn.segment.start,
      to: committedPoint(flight, turn.ends) ?? turn.segment.end,
    }));
}

function isSoon(left: number): boolean {
  return left > 0 && left <= ROLL_IN;
}

export function minutesAhead(flight: Moment, plan: Planned): MinuteAhead[] {
  return minutesToCome(flight, plan).map(({ minute, t }) => ({
    minute,
    own: committedPoint(flight, t),
    leader: leaderPoint(flight, t),
  }));
}

/** Where the leader is expected at flight time `t` [s]. */
function leaderPoint(flight: Moment, t: number): PathPoint | null {
  const segments = flight.route?.segments ?? [];
  const [from, to] = [segments[0]?.start.t_s ?? 0, segments.at(-1)?.end.t_s ?? 0];
  return t < from || t > to ? null : pathPointAt(segments, t, windOver(flight));
}

export function slotTrack(flight: Moment): Vector {
  const now = flight.now;
  if (now === null) return { x: 0, y: 1 };
  const air = velocity(now.leader.tas_mps, now.slot.heading_deg);
  const wind = windOver(flight);
  const [x, y] = [air.x + wind.x, air.y + wind.y];
  const speed = Math.hypot(x, y) || 1;
  return { x: x / speed, y: y / speed };
}
