/**
 * The instrument's clock: once a frame it finds how own ship flies, from the newest tick or from what is
 * on record, and moves all that hangs on it. Nothing is laid out anew.
 */

import { effect, type ReadonlySignal, signal } from "@preact/signals";
import type { Session } from "../session";
import { speedOf } from "../store/flight";
import { type PairSample, pairSample } from "../store/pair";
import { type Attitude, approach, attitudeOf, carryOn } from "./attitude";

/** A picture runs at most so far ahead of the newest tick [wall s]. */
const AHEAD = 0.25;
/** Rates of climb are found over so long at least [s, flight time]. */
const CLIMB_OVER = 0.4;
/** Samples that are kept to find them. */
const KEPT = 40;

type Mover = (attitude: Attitude) => void;

export interface Gauge {
  /** How own ship flies, for what is read: changes five times a second; null before the first sample. */
  readonly read: ReadonlySignal<Attitude | null>;
  /** Calls `move` in each frame in which something has changed; the answer ends that. */
  add(move: Mover): () => void;
  /** Begins to move; the answer ends that. */
  run(): () => void;
}

interface Heard {
  readonly sample: PairSample;
  readonly wall: number;
}

export function createGauge({ flight, history }: Session): Gauge {
  const movers = new Set<Mover>();
  const read = signal<Attitude | null>(null);
  let heard: Heard[] = [];
  let heardOf = "";
  let shown: Attitude | null = null;
  let shownAt = 0;
  let frame = 0;

  /** Takes the newest sample of a tick, as soon as it is there. */
  function hear(): void {
    const { value: news } = flight.heard;
    const { started } = flight.moment.peek();
    if (news === null || started === null) return;
    const last = news.tick.documents.findLast(({ kind }) => kind === "sample");
    const sample = last?.kind === "sample" ? pairSample(last, started) : null;
    if (sample === null) return;
    const isSame = news.tick.flight_id === heardOf;
    if (!isSame || sample.t_s <= (heard.at(-1)?.sample.t_s ?? 0)) heard = [];
    heardOf = news.tick.flight_id;
    heard = [...heard.slice(1 - KEPT), { sample, wall: news.wall }];
  }

  function climbAt(k: number): number {
    const to = heard[k]?.sample;
    if (to === undefined) return 0;
    const from = heard.findLast(({ sample }) => to.t_s - sample.t_s >= CLIMB_OVER)?.sample;
    if (from === undefined) return flight.moment.peek().climbs.get(to.pursuer.ident) ?? 0;
    return (to.pursuer.altitude_m - from.pursuer.altitude_m) / (to.t_s - from.t_s);
  }

  function liveAt(wall: number): Attitude | null {
    const [last, before] = [heard.at(-1), heard.at(-2)];
    const { now, climbs } = flight.moment.peek();
    if (last === undefined)
      return now === null ? null : attitudeOf(now, climbs.get(now.pursuer.ident) ?? 0);
    const newest = attitudeOf(last.sample, climbAt(heard.length - 1));
    if (before === undefined) return newest;
    const since = Math.min(AHEAD, (wall - last.wall) / 1000) * speedOf(flight);
    const length = last.sample.t_s - before.sample.t_s;
    const previous = attitudeOf(before.sample, climbAt(heard.length - 2));
    return carryOn(previous, newest, length, Math.min(since, 2 * length));
  }

  let base = { t: 0, wall: 0 };

  function recordedAt(wall: number): Attitude | null {
    const { knots } = history();
    const t = base.t + Math.max(0, (wall - base.wall) / 1000) * speedOf(flight);
    const sample = knots.sampleAt(t);
    if (sample === null) return null;
    const before = knots.sampleAt(t - 1);
    const past = before === null ? 0 : sample.t_s - before.t_s;
    const climb =
      before === null || past < CLIMB_OVER
        ? (flight.moment.peek().climbs.get(sample.pursuer.ident) ?? 0)
        : (sample.pursuer.altitude_m - before.pursuer.altitude_m) / past;
    return attitudeOf(sample, climb);
  }

  function draw(wall: number): void {
    const isLive = flight.source.peek().kind === "live";
    const truth = isLive ? liveAt(wall) : recordedAt(wall);
    if (truth === null) return;
    const stands = speedOf(flight) === 0;
    shown = stands ? truth : approach(shown, truth, wall - shownAt);
    shownAt = wall;
    for (const move of movers) move(shown);
  }

  function ask(): void {
    if (frame === 0) frame = requestAnimationFrame(next);
  }

  function next(wall: number): void {
    frame = 0;
    draw(wall);
    if (speedOf(flight) > 0) ask();
  }

  return {
    read,
    add(move) {
      movers.add(move);
      if (shown !== null) move(shown);
      ask();
      return () => movers.delete(move);
    },
    run() {
      const ends = [
        effect(hear),
        effect(() => {
          base = { t: flight.moment.value.t + flight.since.value, wall: performance.now() };
          ask();
        }),
        effect(() => {
          const isOld = flight.read.value.now === null;
          if (shown === null) draw(performance.now());
          read.value = isOld ? null : shown;
        }),
      ];
      return () => {
        for (const end of ends) end();
        cancelAnimationFrame(frame);
        frame = 0;
      };
    },
  };
}
