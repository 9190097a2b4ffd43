/** What is done to the page's clock: it follows the flight, or shows any instant of what is known. */

import { batch } from "@preact/signals";
import { type Actions, REPLAY_RATES, type Session } from "../session";
import { type FlightStore, speedOf } from "../store/flight";
import { formatClock } from "../units";
import { nextMark, outlineOf } from "./outline";

export type Moves = Pick<Actions, "seek" | "step" | "toMark" | "live" | "toggleLoop" | "setLoop">;

/** A loop that is not set by hand is so long, and none is shorter [s]. */
const LOOP = 30;
const SHORTEST = 1;

/** What moves the clock; `play`, `pause` and `setRate` of the page's own clock among them. */
export function createMoves(session: Session, store: Pick<FlightStore, "seek" | "follow">) {
  const { flight } = session;

  function moveTo(t: number, rate: number): void {
    session.timeRefusal.value = "";
    store.seek(t, rate, performance.now());
  }

  const moves: Moves = {
    seek: (t) => moveTo(t, 0),
    step(seconds) {
      if (seconds > 0 && flight.source.value.kind === "live") return; // nothing is newer
      moveTo(flight.moment.value.t + flight.since.value + seconds, 0);
    },
    toMark(way) {
      const outline = outlineOf(session.history());
      if (outline === null) return;
      const mark = nextMark(outline, flight.moment.value.t, way);
      moveTo(mark?.t ?? (way > 0 ? outline.last : outline.first), 0);
    },
    live() {
      if (session.recording.value === null) store.follow(performance.now());
    },
    toggleLoop() {
      const { span, loop, moment } = flight;
      if (span.value === null) return;
      if (loop.value !== null) {
        loop.value = null;
        return;
      }
      const to = Math.max(moment.value.t, span.value.first + SHORTEST);
      loop.value = { from: Math.max(span.value.first, to - LOOP), to };
      moveTo(loop.value.from, session.replayRate.value);
    },
    setLoop(end) {
      const { span, loop, moment } = flight;
      if (span.value === null) return;
      const { first, last } = span.value;
      const { t } = moment.value;
      const { from, to } = loop.value ?? { from: first, to: last };
      loop.value =
        end === "from"
          ? { from: t, to: Math.max(to, t + SHORTEST) }
          : { from: Math.min(from, t - SHORTEST), to: t };
    },
  };

  return {
    moves,
    /** Whether the page's own clock is shown, and not the flight's. */
    isOwn: () => flight.source.value.kind === "replay",
    play() {
      const { span, moment, loop } = flight;
      const isAtEnd = span.value !== null && moment.value.t >= span.value.last - 0.01;
      const start = loop.value?.from ?? span.value?.first ?? 0;
      moveTo(isAtEnd ? start : moment.value.t, session.replayRate.value);
    },
    pause: () => moveTo(flight.moment.value.t + flight.since.value, 0),
    setRate(rate: number) {
      const isOffered = REPLAY_RATES.some((offered) => offered === rate);
      batch(() => {
        if (isOffered) session.replayRate.value = rate;
        if (speedOf(flight) > 0) moveTo(flight.moment.value.t + flight.since.value, rate);
      });
    },
    /** Why nothing can be commanded now; null while the newest is shown. */
    refusal(): string | null {
      const { recording } = session;
      if (recording.value !== null)
        return "This is a recording, which takes no commands: start a flight.";
      if (flight.source.value.kind === "live") return null;
      const behind = (flight.span.value?.last ?? 0) - flight.moment.value.t;
      return `You see ${formatClock(flight.moment.value.t)}, ${formatClock(behind)} behind the flight: go back to LIVE (L) to command it.`;
    },
  };
}
