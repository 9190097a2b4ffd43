/**
 * Where time was lost. At each second guidance forecasts when it joins if the autopilot flies on:
 * J(t) = t + time to go. A crew that flies as the autopilot would keeps J; where J rises, time is lost.
 * What J changes while the leader turns, or changes its speed, is the leader's doing.
 */

import { wrap180 } from "../units";
import type { Flown, Second } from "./seconds";

/** Seconds lost since the beginning, by flight time; less than 0 where time was gained. */
export interface Point {
  readonly t: number;
  readonly lost: number;
  /** With the leader's part. */
  readonly inAll: number;
}

/** A stretch of the flight in which time was lost, and how. */
export interface Stretch {
  readonly from: number;
  readonly to: number;
  /** Seconds lost. */
  readonly lost: number;
  readonly how: string;
}

export interface Losses {
  /** Of a flight by hand the leader's part is left out of what is lost. */
  readonly points: readonly Point[];
  /** By flying [s]; of the autopilot's flight all of it. */
  readonly flown: number;
  /** By what the leader did [s]; less than 0 where that was a gain. */
  readonly leader: number;
  /** The three that cost most, in order of time. */
  readonly worst: readonly Stretch[];
}

/** A stretch is no longer than this, and costs so much at least [s]. */
const LONGEST = 30;
const LEAST = 1;
const SHOWN = 3;
/** Plans follow a leader that has changed something within so long [s]. */
const FOLLOWS = 10;
/** A leader turns faster than this [deg/s], or changes its speed by more than this in a second [m/s]. */
const TURNING = 0.1;
const CHANGING = 0.2;

export function lossesOf({ seconds, byHand }: Pick<Flown, "seconds" | "byHand">): Losses {
  const points: Point[] = [];
  let [flown, leader, newsAt] = [0, 0, Number.NEGATIVE_INFINITY];
  let joined: number | null = null; // as it was forecast last
  let before: Second | null = null;
  for (const now of seconds) {
    if (before !== null && isNews(before, now)) newsAt = now.t;
    before = now;
    if (now.joins === null) continue;
    const more = now.joins - (joined ?? now.joins);
    if (byHand && now.t - newsAt <= FOLLOWS) leader += more;
    else flown += more;
    points.push({ t: now.t, lost: flown, inAll: flown + leader });
    joined = now.joins;
  }
  return { points, flown, leader, worst: worstOf(points, seconds) };
}

/** The stretches in which most was lost, one after the other taken out of what is left. */
function worstOf(points: readonly Point[], seconds: readonly Second[]): Stretch[] {
  const worst: Stretch[] = [];
  while (worst.length < SHOWN) {
    const found = steepest(points, worst);
    if (found === null) break;
    const { from, to, lost } = found;
    worst.push({ from: from.t, to: to.t, lost, how: howBetween(seconds, from.t, to.t) });
  }
  return worst.sort((a, b) => a.from - b.from);
}

/** Where most is lost within `LONGEST`, and that as short as it can be; null if it is no whole second. */
function steepest(points: readonly Point[], taken: readonly Stretch[]) {
  let best: { from: Point; to: Point; lost: number } | null = null;
  points.forEach((from, k) => {
    for (let n = k + 1; n < points.length; n += 1) {
      const to = points[n];
      if (to === undefined || to.t - from.t > LONGEST) break;
      if (taken.some((each) => from.t < each.to && to.t > each.from)) break;
      const lost = to.lost - from.lost;
      const more = lost - (best?.lost ?? LEAST - SLACK);
      const isShorter = best !== null && to.t - from.t < best.to.t - best.from.t;
      if (more > SLACK || (more > -SLACK && isShorter)) best = { from, to, lost };
    }
  });
  return best as { from: Point; to: Point; lost: number } | null;
}

const SLACK = 1e-6;

/** What was wrong for most of a stretch. */
function howBetween(seconds: readonly Second[], from: number, to: number): string {
  const votes = new Map<string, number>();
  for (const each of seconds) {
    const how = each.t >= from && each.t <= to ? howAt(each) : null;
    if (how !== null) votes.set(how, (votes.get(how) ?? 0) + 1);
  }
  const [most] = [...votes].sort((a, b) => b[1] - a[1]);
  return most?.[0] ?? "beside the path";
}

/** Whether the leader does something that plans have to follow. */
function isNews({ sample: before }: Second, { sample: now }: Second): boolean {
  const changed = Math.abs(now.leader.tas_mps - before.leader.tas_mps);
  return Math.abs(now.leader.turn_rate_degps) > TURNING || changed > CHANGING;
}

/** A turn is asked for above this, and flown too little or too much by this [deg/s]. */
const ASKED = 0.3;
const OFF = 0.2;
/** So far off the heading, or slower than commanded [deg, m/s]. */
const WIDE = 3;
const SLOW = 3;

/** What was wrong, in words; null for nothing that can be named. */
function howAt({ sample }: Second): string | null {
  const { reference, pursuer, mode, commanded_tas_mps } = sample;
  if (Math.abs(sample.leader.turn_rate_degps) > TURNING) return "the leader turned";
  if (mode === "escape") return "away from the leader, to keep the minimum";
  if (pursuer.tas_mps < commanded_tas_mps - SLOW) return "slower than commanded";
  if (reference.kind === "turn_rate" && Math.abs(reference.turn_rate_degps) > ASKED) {
    const side = reference.turn_rate_degps > 0 ? 1 : -1;
    const short = side * (reference.turn_rate_degps - pursuer.turn_rate_degps);
    const turn = `the ${side > 0 ? "right" : "left"} turn`;
    if (short > OFF) return `wide of ${turn}`;
    if (short < -OFF) return `inside ${turn}`;
    return null;
  }
  const off =
    reference.kind === "turn_rate" ? 0 : wrap180(pursuer.heading_deg - reference.heading_deg);
  if (Math.abs(off) > WIDE) return `${off > 0 ? "right" : "left"} of the heading asked for`;
  if (Math.abs(pursuer.turn_rate_degps) > ASKED)
    return `turning ${pursuer.turn_rate_degps > 0 ? "right" : "left"} where the path is straight`;
  return null;
}
