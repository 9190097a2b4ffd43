/** From the stick to the picture: how long, as the page itself can measure it; and how often it is drawn. */

import type { Tick } from "../wire";
import { type Deflection, isSame, NEUTRAL } from "./stick";

/** So many of the last are kept. */
const KEPT = 200;
/** Frames are counted over so long [ms]. */
const WINDOW = 1000;

/** What is not heard of for so long was not flown [ms]. */
const LOST = 2000;

interface Move {
  readonly stick: Deflection;
  readonly movedAt: number;
}

/** What was measured so far. */
export interface Measure {
  /** Frames in the last second; 0 before there is one. */
  readonly framesPerSecond: number;
  /** From the move to the first frame drawn with it [ms]: of half of all, and of 95 %; null before any. */
  readonly half: number | null;
  readonly most: number | null;
}

export interface Latency {
  /** The stick is deflected like this at `now`: it may be some time before that is sent. */
  moved(stick: Deflection, now: number): void;
  /** That is sent now. */
  sent(): void;
  /** Whether a tick says that the flight has got what was sent. */
  heard(tick: Tick): boolean;
  /** What was heard is drawn now. */
  drawn(now: number): void;
  /** A frame is drawn. */
  frame(now: number): void;
  measure(): Measure;
}

export function createLatency(): Latency {
  let last: Move = { stick: NEUTRAL, movedAt: 0 };
  let isSent = true;
  let waiting: Move[] = [];
  let heard: number[] = [];
  let delays: number[] = [];
  let frames: number[] = [];
  return {
    moved(stick, now) {
      if (isSame(stick, last.stick)) return;
      // what has not been sent yet has waited since it first moved
      last = { stick, movedAt: isSent ? now : last.movedAt };
      isSent = false;
    },
    sent() {
      if (!isSent)
        waiting = [...waiting.filter(({ movedAt }) => last.movedAt - movedAt < LOST), last];
      isSent = true;
    },
    heard({ documents }) {
      for (const each of documents) {
        if (each.kind !== "command_given" || each.command.kind !== "stick") continue;
        const { roll, pitch } = each.command;
        const at = waiting.findIndex(({ stick }) => isSame(stick, { roll, pitch }));
        const found = waiting[at];
        if (found === undefined) continue;
        heard.push(found.movedAt);
        waiting = waiting.slice(at + 1);
      }
      return heard.length > 0;
    },
    drawn(now) {
      delays = [...delays, ...heard.map((movedAt) => now - movedAt)].slice(-KEPT);
      heard = [];
    },
    frame(now) {
      frames = [...frames.filter((at) => now - at < WINDOW), now];
    },
    measure() {
      const ordered = delays.toSorted((a, b) => a - b);
      const share = (part: number) => ordered[Math.ceil(part * ordered.length) - 1] ?? null;
      return { framesPerSecond: frames.length, half: share(0.5), most: share(0.95) };
    },
  };
}
