/** What the picture shows of a flight: the states looked up in the tables of style. */

import { flownPlan } from "../committed";
import type { Flight } from "../flight";
import { CALM, type Vector, velocity, windVector } from "../geometry";
import type { PairSample } from "../pair";
import type { PathSegment, PlanChanged } from "../wire";
import { age, guidance } from "./states";
import { AGE, GUIDANCE, type GuidanceLook } from "./style";
import type { View } from "./view";

/** What every layer is a pure function of. */
export interface LayerProps {
  readonly flight: Flight;
  readonly view: View;
}

/** A path and the flight time at which its own clock shows 0 [s]. */
export interface TimedPath {
  readonly segments: readonly PathSegment[];
  readonly start: number;
}

/** The flight now, while its map may be shown. */
export function shownNow(flight: Flight): PairSample | null {
  return AGE[age(flight)].map ? flight.now.value : null;
}

/** The flight now, while what guidance says may be shown. */
export function shownGuidance(flight: Flight): { now: PairSample; look: GuidanceLook } | null {
  const now = AGE[age(flight)].guidance ? flight.now.value : null;
  return now === null ? null : { now, look: GUIDANCE[guidance(flight)] };
}

/** The same for numbers to be read. */
export function shownReading(flight: Flight): { now: PairSample; look: GuidanceLook } | null {
  const now = AGE[age(flight)].guidance ? flight.reading.value : null;
  return now === null ? null : { now, look: GUIDANCE[guidance(flight)] };
}

/** The plan that is flown, with its points; null once it is over or cannot be trusted. */
export function shownPlan(flight: Flight): PlanChanged | null {
  return shownGuidance(flight)?.look.points === true ? flownPlan(flight) : null;
}

/** Time on the plan's own clock [s]. */
export function planTime(flight: Flight, plan: PlanChanged): number {
  return flight.simTime.value - plan.t_s;
}

export function windNow(flight: Flight): Vector {
  const wind = flight.started.value?.wind;
  return wind === undefined ? CALM : windVector(wind);
}

/** The direction in which the slot moves over the ground, as a unit vector. */
export function slotTrack(flight: Flight): { x: number; y: number } {
  const now = flight.now.value;
  if (now === null) return { x: 0, y: 1 };
  const air = velocity(now.leader.tas_mps, now.slot.heading_deg);
  const wind = windNow(flight);
  const [x, y] = [air.x + wind.x, air.y + wind.y];
  const speed = Math.hypot(x, y) || 1;
  return { x: x / speed, y: y / speed };
}

/** The roll-in to a turn is announced this long before [s]. */
export const ROLL_IN = 30;

/** What the leader is called. */
export function leaderIdent(flight: Flight): string {
  return flight.started.value?.leader.ident ?? "LEADER";
}
