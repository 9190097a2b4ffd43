/**
 * What guidance is committed to: the plan while it is flown, the flight forecast along it, and when
 * and where the two join and are closest. Everything that shows one of these asks here.
 */

import { pathPointAt, windVector } from "../geometry";
import type { ForecastChanged, PathPoint, PlanChanged, TurnSegment } from "../wire";
import { forecastPoint } from "./forecast";
import { GRAZE, guidance } from "./states";
import type { Moment, Proposal } from "./types";

/** A plan that is flown, or that could be, and when it was made. */
export type Planned = Pick<
  PlanChanged,
  "t_s" | "plan" | "leader_at_closest" | "pursuer_at_closest"
> &
  Pick<Proposal, "ideal">;

/** The plan, while it is flown: not once it is over, and not once guidance has given it up. */
export function flownPlan(flight: Moment): PlanChanged | null {
  if (!isOnItsWay(flight)) return null;
  if (flight.unavailable !== null || flight.unable !== null) return null;
  return flight.plan;
}

/** The path that is proposed, accepted or not; null when there is none, or guidance is engaged. */
export function proposedPlan(flight: Moment): Proposal | null {
  const state = guidance(flight);
  return state === "proposed" || state === "armed" ? flight.proposal : null;
}

/** The plan that is shown: flown or proposed. */
export function shownPlan(flight: Moment): Planned | null {
  return proposedPlan(flight) ?? flownPlan(flight);
}

function isOnItsWay(flight: Moment): boolean {
  const mode = flight.sample?.mode;
  return mode === "converge" || mode === "capture";
}

/** Whether a forecast reaches so far ahead [s, flight time]. */
function reaches(forecast: ForecastChanged | null, t: number): forecast is ForecastChanged {
  return forecast !== null && t <= (forecast.times_s.at(-1) ?? Number.NEGATIVE_INFINITY) + 0.5;
}

/** The aircraft on its committed path at flight time `t` [s]; null if nobody knows. */
export function committedPoint(flight: Moment, t: number): PathPoint | null {
  const proposed = proposedPlan(flight);
  const forecast = proposed === null ? flight.forecast : (proposed.flown ?? null);
  if (reaches(forecast, t)) return forecastPoint(forecast, t);
  const [plan, started] = [proposed ?? flownPlan(flight), flight.started];
  if (plan === null || started === null) return null;
  return pathPointAt(plan.plan.segments, t - plan.t_s, windVector(started.wind));
}

/** How long until it joins [s], as read five times a second; null when there is no way or it is over. */
export function timeToJoin(flight: Moment): number | null {
  const reading = flight.now;
  const proposed = proposedPlan(flight);
  if (reading === null) return null;
  if (proposed !== null) return Math.max(0, proposed.t_s + proposed.promised_s - reading.t_s);
  if (!isOnItsWay(flight) || reading.joined) return null;
  return reading.time_to_go_s > 0 ? reading.time_to_go_s : null;
}

/** When it joins [s, flight time]; null as above. To a hundredth, so that it stands still. */
export function joinTime(flight: Moment): number | null {
  const sample = flight.sample;
  const proposed = proposedPlan(flight);
  if (proposed !== null) return proposed.t_s + proposed.promised_s;
  if (sample === null || !isOnItsWay(flight) || sample.joined || sample.time_to_go_s <= 0)
    return null;
  return Math.round(100 * (sample.t_s + sample.time_to_go_s)) / 100;
}

/** Where own ship joins. */
export function joinPoint(flight: Moment): PathPoint | null {
  const t = joinTime(flight);
  return t === null ? null : committedPoint(flight, t);
}

/** How close the two will come. */
export interface Closest {
  /** Least separation [m]. */
  readonly least: number;
  /** When [s, flight time]. */
  readonly at: number;
  readonly pursuer: PathPoint;
  readonly leader: PathPoint;
  /** Whether that is less than the minimum, by more than a graze. */
  readonly isTooClose: boolean;
}

/** The closest approach on the committed path, past or to come; null if none is flown. */
export function closestApproach(flight: Moment): Closest | null {
  const proposed = proposedPlan(flight);
  const plan = proposed ?? flownPlan(flight);
  if (plan === null) return null;
  const tooClose = (flight.started?.min_separation_m ?? 0) - GRAZE;
  if (proposed !== null)
    return {
      least: proposed.flown_least_m,
      at: proposed.t_s + proposed.plan.separation.at_s,
      pursuer: proposed.pursuer_at_closest,
      leader: proposed.leader_at_closest,
      isTooClose: proposed.flown_least_m < tooClose,
    };
  const at = plan.t_s + plan.plan.separation.at_s;
  const forecast = flight.forecast;
  if (reaches(forecast, joinTime(flight) ?? at)) {
    return {
      least: forecast.least_separation_m,
      at: forecast.pursuer_at_closest.t_s,
      pursuer: forecast.pursuer_at_closest,
      leader: forecast.leader_at_closest,
      isTooClose: forecast.least_separation_m < tooClose,
    };
  }
  return {
    least: plan.plan.separation.least_m,
    at,
    pursuer: plan.pursuer_at_closest,
    leader: plan.leader_at_closest,
    isTooClose: plan.plan.separation.least_m < tooClose,
  };
}

/** Whether they are closest when they join, or after: then that is no point of its own. */
export function isClosestAtJoin(flight: Moment, closest: Closest): boolean {
  const proposed = proposedPlan(flight);
  // What is proposed joins when its ideal path ends, but for braking.
  if (proposed !== null) return closest.at > proposed.t_s + proposed.plan.time_to_converge_s - 1;
  const join = joinTime(flight);
  return join !== null && closest.at > join - 1;
}

/** One turn of the plan as the pilot reads it. */
export interface Turn {
  /** "T2". */
  readonly name: string;
  /** "R42". */
  readonly size: string;
  readonly segment: TurnSegment;
}

/** Turns smaller than this are corrections, not turns to be announced [deg]. */
const SMALLEST_TURN = 1;

/** The turns of a plan, corrections left out. */
export function turnsOf(plan: Planned): Turn[] {
  return plan.plan.segments
    .filter((segment) => segment.kind === "turn")
    .filter((segment) => segment.angle_deg >= SMALLEST_TURN)
    .map((segment, i) => ({
      name: `T${i + 1}`,
      size: `${segment.direction === "right" ? "R" : "L"}${Math.round(segment.angle_deg)}`,
      segment,
    }));
}

/** A turn to come. */
interface NextTurn extends Turn {
  /** When it begins [s, flight time]. */
  readonly at: number;
  /** How long until then [s]. */
  readonly in: number;
}

/** The turn of a plan that begins next, at flight time `t` [s] or after; null when none is left. */
export function nextTurn(plan: Planned, t: number): NextTurn | null {
  const turn = turnsOf(plan).find(({ segment }) => t <= plan.t_s + segment.start.t_s);
  if (turn === undefined) return null;
  const at = plan.t_s + turn.segment.start.t_s;
  return { ...turn, at, in: at - t };
}

/** The minutes of a plan still to come, and when they are over [s, flight time]. */
export function minutesToCome(flight: Moment, plan: Planned): { minute: number; t: number }[] {
  const join = joinTime(flight);
  if (join === null) return [];
  const last = Math.floor((join - plan.t_s - 1) / 60);
  const next = Math.max(1, Math.floor((flight.t - plan.t_s) / 60) + 1);
  return Array.from({ length: Math.max(0, last - next + 1) }, (_, i) => ({
    minute: next + i,
    t: plan.t_s + 60 * (next + i),
  }));
}
