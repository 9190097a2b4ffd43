/** How own ship flies at an instant, and a little later: what the instrument moves with. */

import type { PairSample } from "../store/pair";
import { DEG, wrap180, wrap360 } from "../units";

/** The nose stands so far above the path: a nominal angle of attack, as none is measured [deg]. */
export const NOMINAL_ATTACK = 2.5;

export interface Attitude {
  /** Positive right wing down [deg]. */
  readonly bank: number;
  /** Of the nose above the horizon: the path's, and a nominal angle of attack [deg]. */
  readonly pitch: number;
  readonly heading: number;
  /** True airspeed [m/s]. */
  readonly tas: number;
  /** [m]. */
  readonly altitude: number;
  /** Rate of climb [m/s]. */
  readonly climb: number;
  /** From the leader [m], and how fast it shrinks [m/s]. */
  readonly separation: number;
  readonly closure: number;
  /** The bars: how far to bank to the right, and to pull up [deg]; 0 while they are out of view. */
  readonly roll: number;
  readonly pull: number;
}

export function attitudeOf(sample: PairSample, climb: number): Attitude {
  const { pursuer, separation_m, closure_mps } = sample;
  const [bars] = sample.bars ?? [];
  const path = Math.atan2(climb, Math.max(1, pursuer.tas_mps)) / DEG;
  return {
    bank: pursuer.bank_deg,
    pitch: path + NOMINAL_ATTACK,
    heading: pursuer.heading_deg,
    tas: pursuer.tas_mps,
    altitude: pursuer.altitude_m,
    climb,
    separation: separation_m,
    closure: closure_mps,
    roll: bars?.roll_deg ?? 0,
    pull: bars?.pitch_deg ?? 0,
  };
}

/** What goes on as it went between two samples; the rest moves too little to be seen to. */
const GOES_ON = ["bank", "pitch", "tas", "altitude", "separation", "roll", "pull"] as const;

/** An attitude `dt` [s] later, when it has changed as from the one `length` [s] before. */
export function carryOn(before: Attitude, now: Attitude, length: number, dt: number): Attitude {
  if (dt <= 0 || length <= 0) return now;
  const part = dt / length;
  const later = { ...now };
  for (const name of GOES_ON) later[name] = now[name] + (now[name] - before[name]) * part;
  later.heading = wrap360(now.heading + wrap180(now.heading - before.heading) * part);
  return later;
}

/** Time constant with which the picture goes to what is true: the jitter of a network is shorter [wall ms]. */
const SMOOTHING = 40;
/** A wider gap is no jitter but another place: the picture goes there at once [deg of bank]. */
const WIDEST = 20;

/** The picture `age` [wall ms] after `shown`, when `truth` holds. */
export function approach(shown: Attitude | null, truth: Attitude, age: number): Attitude {
  if (shown === null || Math.abs(truth.bank - shown.bank) > WIDEST) return truth;
  const part = 1 - Math.exp(-Math.max(0, age) / SMOOTHING);
  const next = { ...truth };
  for (const name of GOES_ON) next[name] = shown[name] + (truth[name] - shown[name]) * part;
  const turned = wrap180(truth.heading - shown.heading);
  next.heading = wrap360(shown.heading + turned * part);
  next.climb = shown.climb + (truth.climb - shown.climb) * part;
  return next;
}
