/** When the stick is sent: as it moves, 20 times a second at most; while held, each 0.2 s; once at release. */

import { type Deflection, isNeutral, isSame, NEUTRAL } from "./stick";

/** At least so long between two frames, and at most while it is off neutral [ms]. */
export const SOONEST = 50;
const LATEST = 200;

/** Why a frame is to be sent now, if it is: the stick has moved, or is held. */
export type Due = "moved" | "held" | null;

export interface Frames {
  /** Whether the stick is to be sent at `now` [ms]; it then counts as sent. */
  due(stick: Deflection, now: number): Due;
}

export function createFrames(): Frames {
  let sent = NEUTRAL;
  let sentAt = Number.NEGATIVE_INFINITY;
  return {
    due(stick, now) {
      const due = !isSame(stick, sent) ? "moved" : isNeutral(stick) ? null : "held";
      if (due === null || now - sentAt < (due === "moved" ? SOONEST : LATEST)) return null;
      [sent, sentAt] = [stick, now];
      return due;
    },
  };
}
