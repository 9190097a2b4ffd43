/** A flight second by second: who flew, what was asked and what was flown. What a debrief is made of. */

import type { History } from "../store/history";
import type { PairSample } from "../store/pair";
import type { PlanChanged } from "../wire";

/** One second. */
export interface Second {
  /** Flight time [s]. */
  readonly t: number;
  readonly sample: PairSample;
  /** When it would join if the autopilot flew on from here [s, flight time]; null where nothing is known. */
  readonly joins: number | null;
  readonly byHand: boolean;
}

/** The part of a flight that is looked at. */
export interface Flown {
  /** From where time is counted: control was taken, or else guidance was engaged [s]. */
  readonly from: number;
  /** Until joined, or as far as it is known [s]. */
  readonly to: number;
  /** When it joined [s]; null if it has not. */
  readonly joined: number | null;
  /** Whether a crew flew by hand at any time. */
  readonly byHand: boolean;
  /** From `from` to `to`. */
  readonly seconds: readonly Second[];
}

/** Null before guidance was engaged, or where nothing is known of the two. */
export function flownOf(history: History): Flown | null {
  const { knots } = history;
  const times = Array.from(knots.column("t_s"));
  const first = times.findIndex((t) => knots.sampleAt(t)?.autopilot === false);
  const from = first < 0 ? times.find((t) => isEngaged(history, t)) : times[first];
  if (from === undefined || knots.span === null) return null;
  const known = times.filter((t) => t >= from);
  const joined = known.find((t) => Number.isFinite(knots.joinedAt(t))) ?? null;
  const to = joined ?? knots.span.last;
  const seconds = known.filter((t) => t <= to).flatMap((t) => secondAt(history, t, joined));
  return { from, to, joined, byHand: first >= 0, seconds };
}

/** The plans of own ship, none of others that join somebody in the same flight. */
export function plansOf(history: History): PlanChanged[] {
  const { started } = history.knownAt(Number.POSITIVE_INFINITY);
  return history.events
    .filter((each) => each.kind === "plan_changed")
    .filter(({ ident }) => ident === started?.pursuer.ident);
}

function isEngaged({ knots }: History, t: number): boolean {
  return knots.sampleAt(t)?.engagement === "engaged";
}

function secondAt({ knots }: History, t: number, joined: number | null): Second[] {
  const sample = knots.sampleAt(t);
  if (sample === null) return [];
  const isOn = sample.engagement === "engaged" && sample.time_to_go_s > 0;
  const joins = joined !== null && t >= joined ? joined : isOn ? t + sample.time_to_go_s : null;
  return [{ t, sample, joins, byHand: sample.autopilot === false }];
}
