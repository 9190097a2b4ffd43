/** Which instants of two flights are shown together. */

import type { History } from "../store/history";
import { joinedAt } from "./figures";

/** engaged: since guidance was engaged; clock: the same flight time; slot: until both join. */
export const ALIGNMENTS = ["clock", "engaged", "slot"] as const;
export type Alignment = (typeof ALIGNMENTS)[number];

/**
 * By how much the other flight's time is later than the first one's when they are shown together [s];
 * null where one of them has not engaged, or not joined.
 */
export function alignment(first: History, other: History, how: Alignment): number | null {
  if (how === "clock") return 0;
  const when = how === "engaged" ? engagedAt : slotAt;
  const [a, b] = [when(first), when(other)];
  return a === null || b === null ? null : b - a;
}

/** When guidance was engaged first [s]. */
function engagedAt({ events }: History): number | null {
  const found = events.find(
    (each) =>
      (each.kind === "engagement_changed" && each.engagement === "engaged") ||
      (each.kind === "plan_changed" && each.reason === "engaged"),
  );
  return found?.t_s ?? null;
}

function slotAt({ knots, knownAt }: History): number | null {
  const { result } = knownAt(Number.POSITIVE_INFINITY);
  return result?.joined === true ? result.join_time_s : joinedAt(knots);
}
