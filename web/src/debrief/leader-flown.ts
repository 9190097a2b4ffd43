/** What a leader flew, as an intent: found from its samples, for who would have known it all beforehand. */

import type { PairSample } from "../store/pair";
import { DEG, wrap180, wrap360 } from "../units";
import type { IntentPiece } from "../wire";

type Leader = Pick<PairSample["leader"], "heading_deg" | "turn_rate_degps" | "tas_mps">;

/** One second of a leader. */
export interface LeaderSecond {
  readonly t: number;
  readonly leader: Leader;
}

/** It turns faster than this [deg/s]; a turn is at least so large [deg]. */
const TURNING = 0.1;
const SMALLEST = 1;
/** Its speed is the same within so much [m/s]. */
const SAME_SPEED = 1;
const GRAVITY = 9.80665;

/**
 * Straights and turns at one bank each, from the first second on; what follows the last is straight.
 * Null where that cannot say what was flown: its speed changed.
 */
export function intentFlown(flown: readonly LeaderSecond[]): IntentPiece[] | null {
  const first = flown[0];
  if (first === undefined) return [];
  const tas = first.leader.tas_mps;
  if (flown.some(({ leader }) => Math.abs(leader.tas_mps - tas) > SAME_SPEED)) return null;
  const pieces: IntentPiece[] = [];
  let heading = first.leader.heading_deg;
  let at = first.t;
  for (const { from, to, fastest, after } of turnsIn(flown)) {
    const angle = wrap180(after - heading);
    if (Math.abs(angle) < SMALLEST) continue;
    // A turn at its full rate all the while is shorter than the one that rolls in and out of it.
    const lasts = Math.abs(angle / fastest);
    const begins = Math.max(at, (from + to - lasts) / 2);
    const bank = Math.atan((tas * Math.abs(fastest) * DEG) / GRAVITY) / DEG;
    pieces.push({ straight_s: rounded(begins - at) });
    pieces.push({
      turn_to_heading_deg: rounded(wrap360(after)),
      direction: fastest > 0 ? "right" : "left",
      bank_deg: rounded(bank),
    });
    at = begins + lasts;
    heading = after;
  }
  return pieces;
}

interface Turning {
  readonly from: number;
  readonly to: number;
  /** [deg/s], positive to the right. */
  readonly fastest: number;
  /** Heading after it, once that is steady [deg]. */
  readonly after: number;
}

function turnsIn(flown: readonly LeaderSecond[]): Turning[] {
  const turns: Turning[] = [];
  let side = 0;
  for (const { t, leader } of flown) {
    const rate = leader.turn_rate_degps;
    const now = Math.abs(rate) > TURNING ? Math.sign(rate) : 0;
    const turn = turns.at(-1);
    if (now !== 0 && now === side && turn !== undefined) {
      const fastest = Math.abs(rate) > Math.abs(turn.fastest) ? rate : turn.fastest;
      turns[turns.length - 1] = { ...turn, to: t, fastest, after: leader.heading_deg };
    } else if (now !== 0) {
      turns.push({ from: t, to: t, fastest: rate, after: leader.heading_deg });
    } else if (turn !== undefined) {
      turns[turns.length - 1] = { ...turn, after: leader.heading_deg };
    }
    side = now;
  }
  return turns;
}

function rounded(value: number): number {
  return Math.round(10 * value) / 10;
}
