/**
 * All documents of a flight that the page has: from them follows what was known at any instant. Events
 * are folded anew from the last checkpoint before; samples are kept one a second.
 */

import type { Document } from "../wire";
import { createKnots, type Knots } from "./knots";
import { type PairSample, pairCard, pairSample } from "./pair";
import { NOTHING_KNOWN, reduce } from "./reduce";
import { newsFor } from "./states";
import { trailTimes } from "./trail";
import type { Known, Moment, Seen } from "./types";

/** So many events are folded at most to find what was known at some instant. */
const CHECKPOINT_EVERY = 256;

export interface History {
  readonly knots: Knots;
  /** All that `isEvent`, in order of time. */
  readonly events: readonly Document[];
  /** Takes documents that follow on those before. */
  take(documents: readonly Document[]): void;
  /** Takes documents of any time, as a late joiner gets them; those that are there stay as they are. */
  merge(documents: readonly Document[]): void;
  /** What was known at flight time `t` [s]; all that is known at +∞. */
  knownAt(t: number): Known;
  /** What the samples said up to flight time `t` [s]; what changed in the last `news` seconds is news. */
  seenAt(t: number, news: number): Seen;
}

export function createHistory(): History {
  const knots = createKnots();
  let events: Document[] = [];
  let checkpoints: Known[] = [NOTHING_KNOWN];
  let reached: { count: number; known: Known } = { count: 0, known: NOTHING_KNOWN };
  let trailed: { key: string; trail: Seen["trail"] } | null = null;

  function foldTo(count: number): Known {
    if (count < reached.count) {
      const at = Math.floor(count / CHECKPOINT_EVERY);
      reached = { count: at * CHECKPOINT_EVERY, known: checkpoints[at] ?? NOTHING_KNOWN };
    }
    let { known } = reached;
    for (let k = reached.count; k < count; k += 1) {
      const event = events[k];
      if (event !== undefined) known = reduce(known, event);
      if ((k + 1) % CHECKPOINT_EVERY === 0) checkpoints[(k + 1) / CHECKPOINT_EVERY] = known;
    }
    reached = { count, known };
    return known;
  }

  function knownAt(t: number): Known {
    let [low, high] = [0, events.length];
    while (low < high) {
      const middle = (low + high) >> 1;
      if ((events[middle]?.t_s ?? 0) <= t + 1e-6) low = middle + 1;
      else high = middle;
    }
    return foldTo(low);
  }

  /** The samples of the pair among documents. */
  function samplesOf(documents: readonly Document[]): PairSample[] {
    const started = events.find((each) => each.kind === "flight_started");
    const pair = started?.kind === "flight_started" ? pairCard(started) : null;
    if (pair === null) return [];
    return documents
      .map((each) => (each.kind === "sample" ? pairSample(each, pair) : null))
      .filter((each) => each !== null);
  }

  function minSeparationAt(t: number): number {
    return knownAt(t).started?.min_separation_m ?? 0;
  }

  function trailAt(t: number): Seen["trail"] {
    const span = knots.span;
    const key = `${knots.count} ${Math.floor(t / 10)}`;
    if (trailed?.key === key) return trailed.trail;
    const times = span === null ? [] : trailTimes(span.first, Math.min(t, span.last));
    const samples = times
      .filter((at) => knots.ageAt(at) === 0)
      .map((at) => knots.sampleAt(at))
      .filter((each) => each !== null);
    const place = (who: "pursuer" | "leader") => (each: PairSample) => ({
      t: each.t_s,
      x: each[who].x_m,
      y: each[who].y_m,
    });
    const trail = {
      pursuer: samples.map(place("pursuer")),
      leader: samples.filter(({ leader_age_s }) => leader_age_s === 0).map(place("leader")),
    };
    trailed = { key, trail };
    return trail;
  }

  return {
    knots,
    get events() {
      return events;
    },
    take(documents) {
      events.push(...documents.filter(isEvent));
      const ended = documents.some(({ kind }) => kind === "flight_ended");
      const samples = samplesOf(documents);
      for (const sample of samples) knots.take(sample, minSeparationAt(sample.t_s));
      const last = samples.at(-1);
      if (ended && last !== undefined) knots.merge([last], minSeparationAt);
    },
    merge(documents) {
      const come = documents.filter(isEvent);
      const known = new Set(come.map((each) => JSON.stringify(each)));
      events = inOrder([...come, ...events.filter((each) => !known.has(JSON.stringify(each)))]);
      checkpoints = [NOTHING_KNOWN];
      reached = { count: 0, known: NOTHING_KNOWN };
      knots.merge(samplesOf(documents), minSeparationAt);
      trailed = null;
    },
    knownAt,
    seenAt: (t, news) => {
      const seen = Math.min(t, knots.span?.last ?? 0); // the newest, at the edge of a flight in the air
      return {
        sample: knots.sampleAt(seen),
        before: knots.sampleAt(seen - news),
        joinedAt: knots.joinedAt(t),
        belowAt: knots.belowAt(t),
        climbs: knots.climbsAt(seen),
        trail: trailAt(t),
      };
    },
  };
}

/** Whether a document is news: samples are not, nor are orders, since what comes of each is said besides. */
export function isEvent({ kind }: Document): boolean {
  return kind !== "sample" && kind !== "command_given";
}

/** By time, each kind as it came; the first document of a flight comes first. */
function inOrder(documents: Document[]): Document[] {
  const rank = ({ kind, t_s }: Document) => (kind === "flight_started" ? -1 : t_s);
  return documents.sort((a, b) => rank(a) - rank(b));
}

/** How an instant of a flight is looked at. */
export interface Look {
  /** Seconds of flight in a second of the viewer. */
  readonly rate?: number;
}

/** A flight at time `t` [s], from its documents alone: what a recording shows. */
export function momentAt(history: History, t: number, { rate = 1 }: Look = {}): Moment {
  const seen = history.seenAt(t, newsFor(rate));
  const known = history.knownAt(t);
  return {
    ...known,
    ...seen,
    t,
    now: seen.sample,
    rate,
    dataAge: history.knots.ageAt(t),
    ended: known.result !== null,
    isSent: false,
  };
}
