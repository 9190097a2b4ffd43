/** The states of the picture: how far guidance is engaged, how old the data are, whether the separation holds. */

import { KT } from "../units";
import type { PlanChanged } from "../wire";
import type { PairSample } from "./pair";
import { isOnOther } from "./traffic";
import type { Flight, Moment } from "./types";

/**
 * off: nobody is to be joined; designated: a path is looked for; proposed, armed: there is one, accepted
 * or not; converge, capture, follow, escape: guidance flies; infeasible: there is no path to propose;
 * unable: … nor one to fly; data_lost: nothing was heard of the leader for too long.
 */
export const GUIDANCES = [
  "off",
  "designated",
  "proposed",
  "armed",
  "converge",
  "capture",
  "follow",
  "escape",
  "infeasible",
  "unable",
  "data_lost",
] as const;
export type Guidance = (typeof GUIDANCES)[number];

/** fresh ≤ 2 s < coasting ≤ 5 s < old ≤ 10 s < dropped ≤ 24 s < gone; none: never any data. */
export const AGES = ["fresh", "coasting", "old", "dropped", "gone", "none"] as const;
export type Age = (typeof AGES)[number];

/** predicted: it will be lost within a minute; lost: it is lost now. */
export const SEPARATIONS = ["kept", "predicted", "lost"] as const;
export type Separation = (typeof SEPARATIONS)[number];

/** Data of the leader older than this are flown no more [s]. */
const LEADER_LOST = 10;

export function guidance(flight: Moment): Guidance {
  const sample = flight.sample;
  if (sample === null || sample.engagement === "off") return "off";
  if (sample.leader_age_s > LEADER_LOST) return "data_lost";
  const { mode } = sample;
  if (mode === "capture" || mode === "follow" || mode === "escape") return mode;
  const isMissing = flight.unavailable !== null || flight.unable !== null;
  if (sample.engagement === "engaged") {
    if (flight.unavailable !== null) return "unable";
    return mode === "converge" ? "converge" : "unable";
  }
  if (flight.proposal === null) return isMissing ? "infeasible" : "designated";
  return sample.engagement === "armed" ? "armed" : "proposed";
}

/** Whether the crew had accepted a path, and what is proposed has become another one. */
export function hasLapsed(flight: Moment): boolean {
  const last = flight.engagement;
  return last?.previous === "armed" && last.engagement === "designated";
}

/** Whether guidance was engaged when the leader's data were lost, and the crew has done nothing since. */
export function wasDropped({ engagement: last }: Moment): boolean {
  return last?.previous === "engaged" && last.engagement === "designated";
}

/** Who flies: the autopilot, the crew along the flight director's bars, or the crew without them. */
export const PILOTS = ["autopilot", "both", "director", "hand"] as const;
export type Pilot = (typeof PILOTS)[number];

/** both: the autopilot flies, and the flight director is on. */
export function pilot({ autopilot = true, director = false }: PairSample): Pilot {
  if (autopilot) return director ? "both" : "autopilot";
  return director ? "director" : "hand";
}

/** When guidance last gave up what it commanded, unasked, so that a heading is held [s]. */
export function revertedAt({ mode, engagement }: Moment): number | undefined {
  const isAsked = engagement?.engagement === "off";
  return mode?.mode === "heading" && !isAsked ? mode.t_s : undefined;
}

/** How old all that is shown is. */
export function age(flight: Moment): Age {
  if (flight.now === null) return "none";
  if (flight.ended) return "fresh"; // nothing moves any more, so no data grow old
  return ageOf(flight.dataAge);
}

/** How old what is known of the leader is [s]. */
export function leaderAge(flight: Moment): number {
  const sample = flight.sample;
  if (sample === null || flight.ended) return 0;
  const since = sample.leader_age_s > 0 ? flight.t - sample.t_s : 0;
  return Math.max(flight.dataAge, sample.leader_age_s + since);
}

export function ageOf(seconds: number): Age {
  if (seconds <= 2) return "fresh";
  if (seconds <= 5) return "coasting";
  if (seconds <= 10) return "old";
  return seconds <= 24 ? "dropped" : "gone";
}

/** Plans may graze the minimum separation: this much below it is no loss yet [m]. */
export const GRAZE = 20;

/** Shown for a while: so many seconds of flight, and two of the viewer at least. */
export function isRecent({ t, rate }: Moment, since: number | undefined, shown: number): boolean {
  return since !== undefined && t - since < shownFor(shown, rate);
}
const LEAST_SHOWN = 2;

function shownFor(shown: number, rate: number): number {
  return Math.max(shown, LEAST_SHOWN * rate);
}

/** News, such as a new mode, are boxed or said for so long [s, flight time]. */
export const NEWS = 10;

/** How long news stand where `rate` seconds of flight are shown in one [s, flight time]. */
export function newsFor(rate: number): number {
  return shownFor(NEWS, rate);
}

/** Speeds nearer to each other than this are one [m/s]. */
const ONE_SPEED = KT;

/**
 * Whether guidance commands the speed of a sample: where it closes on the slot and keeps the spacing,
 * and on the way there as soon as it asks for another speed than the crew's, at which plans are flown.
 */
export function commandsSpeed(sample: PairSample, plan: PlanChanged | null): boolean {
  const { mode, engagement, commanded_tas_mps: commanded } = sample;
  if (engagement !== "engaged" || mode === "heading") return false;
  if (mode === "capture" || mode === "follow") return true;
  if (plan === null) return false;
  const { length_m, time_to_converge_s } = plan.plan;
  return Math.abs(commanded - length_m / time_to_converge_s) > ONE_SPEED;
}

export interface Outlook {
  readonly state: Separation;
  /** Until the predicted loss [s]; 0 unless predicted. */
  readonly within: number;
}

/** Whether the minimum separation is kept now, and whether guidance expects it to be lost. */
export function separation(flight: Moment): Outlook {
  const now = flight.now;
  const minSeparation = flight.started?.min_separation_m;
  if (now === null || minSeparation === undefined) return { state: "kept", within: 0 };
  if (now.separation_m < minSeparation - GRAZE) return { state: "lost", within: 0 };
  const alert = flight.alerts.find(
    ({ subject, level, other }) =>
      subject === "separation" && level !== "advisory" && !isOnOther(flight, other),
  );
  if (alert === undefined) return { state: "kept", within: 0 };
  const within = Math.max(0, Math.round(alert.predicted_at_s - flight.t));
  return { state: "predicted", within };
}

/** The clock of what is shown: the flight's, or the page's own. */
export function clockShown({ source, clock }: Flight): Flight["clock"]["value"] {
  if (source.value.kind === "live") return clock.value;
  const { rate } = source.value;
  return { rate: rate === 0 ? 1 : rate, paused: rate === 0, ended: false };
}
