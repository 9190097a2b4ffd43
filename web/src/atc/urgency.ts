/** Which clearance comes first: those that deviate, those to be answered, those that others act on. */

import type { ClearanceCard, ClearanceState } from "../wire";
import type { Sky } from "./sky";

/** What a controller has to do with a clearance, the most urgent first. */
const RANK = {
  deviated: 0,
  requested: 1,
  validating: 1,
  standby: 1,
  accepted: 2,
  wilco: 2,
  flying: 3,
  flown: 4,
  unable: 4,
  cancelled: 4,
  expired: 4,
  superseded: 4,
  terminated: 4,
} as const satisfies Record<ClearanceState, number>;

/** One that is over stays in the list for so long [s]. */
const STAYS = 60;

/** Whether a controller has to answer it. */
export function isWaiting({ state }: ClearanceCard): boolean {
  return RANK[state] === 1;
}

export function isOver({ state }: ClearanceCard): boolean {
  return RANK[state] === 4;
}

/** Until it expires [s]; null where nothing expires. */
export function timeLeft({ due_s }: ClearanceCard, t: number): number | null {
  return due_s === 0 ? null : Math.max(0, due_s - t);
}

/** When it came to its present state [s]. */
function changedAt({ history }: ClearanceCard): number {
  return history.at(-1)?.t_s ?? 0;
}

/** The request list: the most urgent first; what has been over for a minute only if `all` are wanted. */
export function requestsOf(sky: Sky, all: boolean): ClearanceCard[] {
  return [...sky.clearances.values()]
    .filter((each) => all || !isOver(each) || sky.t - changedAt(each) < STAYS)
    .sort((a, b) => RANK[a.state] - RANK[b.state] || within(a, b, sky.t));
}

/** Of one rank: the one that expires first, then the one that joins first; of those over, the newest. */
function within(a: ClearanceCard, b: ClearanceCard, t: number): number {
  if (isOver(a)) return changedAt(b) - changedAt(a);
  const [left, other] = [a, b].map((each) => timeLeft(each, t) ?? Number.MAX_VALUE);
  return (left ?? 0) - (other ?? 0) || a.joins_s - b.joins_s || (a.id < b.id ? -1 : 1);
}

/** How many wait for an answer. */
export function waitingIn(sky: Sky): number {
  return [...sky.clearances.values()].filter(isWaiting).length;
}
