/**
 * Where time was lost. At each second guidance forecasts when it joins if the autopilot flies on:
 * J(t) = t + time to go. A crew that flies as the autopilot would keeps J; where J rises, time is lost.
 * What J changes while the leader turns, or changes its speed, is the leader's doing.
 */

import type { Second } from "./seconds";

/** Seconds lost since the beginning, by flight time; less than 0 where time was gained. */
export interface Point {
  readonly t: number;
  readonly lost: number;
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
  /** By flying, the leader's part left out. */
  readonly points: readonly Point[];
  /** In all, by flying [s]. */
  readonly flown: number;
  /** By what the leader did [s]; less than 0 where that was a gain. */
  readonly leader: number;
  /** The three that cost most, in order of time. */
  readonly worst: readonly Stretch[];
}

/** Rises so close to each other are one stretch, if their reason is the same [s]. */
const TOGETHER = 15;
/** A stretch costs so much at least [s]. */
const LEAST = 1;
const SHOWN = 3;
/** Plans follow a leader that has changed something within so long [s]. */
const FOLLOWS = 10;
/** A leader turns faster than this [deg/s], or changes its speed by more than this in a second [m/s]. */
const TURNING = 0.1;
const CHANGING = 0.2;

export function lossesOf(seconds: readonly Second[]): Losses {
  const points: Point[] = [];
  let stretches: Stretch[] = [];
  let [flown, leader, quietSince] = [0, 0, Number.NEGATIVE_INFINITY];
  let before: Second | null = null; // the last one with a forecast
  let last: Second | null = null;
  for (const now of seconds) {
    if (last !== null && isNews(last, now)) quietSince = now.t;
    last = now;
    if (now.joins === null) continue;
    const more = before?.joins == null ? 0 : now.joins - before.joins;
    if (now.t - quietSince <= FOLLOWS) leader += more;
    else {
      flown += more;
      if (more > 0 && before !== null)
        stretches = longer(stretches, { from: before.t, to: now.t, lost: more, how: howAt(now) });
    }
    points.push({ t: now.t, lost: flown });
    before = now;
  }
  const worst = stretches
    .filter(({ lost }) => lost >= LEAST)
    .sort((a, b) => b.lost - a.lost)
    .slice(0, SHOWN)
    .sort((a, b) => a.from - b.from);
  return { points, flown, leader, worst };
}

function longer(stretches: readonly Stretch[], next: Stretch): Stretch[] {
  const before = stretches.at(-1);
  if (before === undefined || before.how !== next.how || next.from - before.to > TOGETHER)
    return [...stretches, next];
  return [...stretches.slice(0, -1), { ...before, to: next.to, lost: before.lost + next.lost }];
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

/** What was wrong, in words. */
function howAt({ sample }: Second): string {
  const { reference, pursuer, mode, commanded_tas_mps } = sample;
  if (mode === "escape") return "away from the leader, to keep the minimum";
  if (pursuer.tas_mps < commanded_tas_mps - SLOW) return "slower than commanded";
  if (reference.kind === "turn_rate" && Math.abs(reference.turn_rate_degps) > ASKED) {
    const side = reference.turn_rate_degps > 0 ? 1 : -1;
    const short = side * (reference.turn_rate_degps - pursuer.turn_rate_degps);
    const turn = `the ${side > 0 ? "right" : "left"} turn`;
    if (short > OFF) return `wide of ${turn}`;
    if (short < -OFF) return `inside ${turn}`;
    return `in ${turn}`;
  }
  const off =
    reference.kind === "turn_rate"
      ? 0
      : ((pursuer.heading_deg - reference.heading_deg + 540) % 360) - 180;
  if (Math.abs(off) > WIDE) return `${off > 0 ? "right" : "left"} of the heading asked for`;
  if (Math.abs(pursuer.turn_rate_degps) > ASKED)
    return `turning ${pursuer.turn_rate_degps > 0 ? "right" : "left"} where the path is straight`;
  return "beside the path";
}
