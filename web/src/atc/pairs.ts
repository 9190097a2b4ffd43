/** Pairs of a manoeuvre and another aircraft, as CARD plots them. */

import type { ClearanceCard, PairCard } from "../wire";
import type { Sky } from "./sky";
import { isOver } from "./urgency";

export interface Conflict {
  readonly card: ClearanceCard;
  readonly pair: PairCard;
  /** Until they come too close, or where they do not, until they are closest [s]; 0 while they are. */
  readonly after: number;
}

/** All pairs of what is asked for and flown: those too close first, the soonest first; none that is past. */
export function conflictsOf(sky: Sky): Conflict[] {
  return [...sky.clearances.values()]
    .filter((card) => !isOver(card))
    .flatMap((card) => pairsOf(card).map((pair) => ({ card, pair, after: afterOf(pair, sky.t) })))
    .filter(({ pair }) => pair.until_s >= sky.t)
    .sort((a, b) => ORDER[a.pair.certainty] - ORDER[b.pair.certainty] || a.after - b.after);
}

const ORDER = { certain: 0, possible: 1, clear: 2 } as const;

/** Those of the last validation. */
function pairsOf(card: ClearanceCard): readonly PairCard[] {
  return card.validation[0]?.pairs ?? [];
}

function afterOf(pair: PairCard, t: number): number {
  return Math.max(0, (pair.certainty === "clear" ? pair.at_s : pair.since_s) - t);
}

/** How soon a conflict is: yellow under eight minutes, red under five. */
type Soon = "later" | "8 min" | "5 min";

export function soonOf(after: number): Soon {
  return after < 300 ? "5 min" : after < 480 ? "8 min" : "later";
}

/** The pair that is looked at: the one that was chosen, else the one with the least margin. */
export function pairOf(card: ClearanceCard, ident: string | null): PairCard | null {
  const pairs = pairsOf(card);
  return pairs.find((each) => each.ident === ident) ?? pairs[0] ?? null;
}
