/**
 * A flight on the page: ticks of a stream or the documents of a recording go in, the instant that is
 * shown comes out.
 *
 * No DOM and no clock of its own: every wall-clock instant [ms] is handed in.
 */

import { batch, signal } from "@preact/signals";
import type { Document, Tick } from "../wire";
import { type FlightClock, readClock, setClock } from "./clock";
import { createHistory, type History, momentAt } from "./history";
import { blend, expected, type Gap, gap, moveSample, NO_GAP } from "./motion";
import { type PairSample, pairSample } from "./pair";
import { NOTHING_KNOWN } from "./reduce";
import { newsFor } from "./states";
import type { Connection, Flight, Link, Moment } from "./types";

/** A flight's signals and what happens to them. */
export interface FlightStore {
  readonly flight: Flight;
  /** All that is known of it, for what is drawn over time. */
  readonly history: () => History;
  /** Takes in one tick that arrived at `wall` [ms]. */
  receive(tick: Tick, wall: number): void;
  /** Shows a recording in place of what was shown, standing at its beginning. */
  load(id: string, documents: readonly Document[], wall: number): void;
  /** Takes in what was on record of the flight before the page joined it. */
  merge(documents: readonly Document[], wall: number): void;
  /** Draws the picture of the instant `wall` [ms]. */
  advance(wall: number): void;
  /** Carries what moves on the picture that is drawn on to `wall` [ms], and changes nothing else. */
  glide(wall: number): void;
  /** Shows flight time `t` [s], going on from there at `rate` seconds a second; 0 to stand. */
  seek(t: number, rate: number, wall: number): void;
  /** Shows the newest there is, and what comes. */
  follow(wall: number): void;
  /** Stands at the newest: the flight is no more, though what is on its way may still arrive. */
  end(wall: number): void;
  /** Notes what became of the socket. */
  link(state: Link): void;
}

/** Numbers are read, not watched: they change five times a second, give or reduce half a frame [wall ms]. */
export const READING_PERIOD = 200;
const HALF_FRAME = 8;
/** The picture runs at most this far ahead of the newest sample [wall s]. */
const AHEAD_LIMIT = 2;
/** Data older than this is flagged [s]. */
export const STALE_AGE = 2;
/** Data older than this counts as lost [s]. */
const LOST_AGE = 5;

/** A flight of which nothing is known, at any instant. */
export const NO_MOMENT: Moment = {
  ...NOTHING_KNOWN,
  sample: null,
  before: null,
  joinedAt: Number.POSITIVE_INFINITY,
  belowAt: Number.NEGATIVE_INFINITY,
  climbs: new Map(),
  trail: { pursuer: [], leader: [] },
  t: 0,
  now: null,
  rate: 1,
  dataAge: 0,
  ended: false,
  isSent: false,
};

export function createFlightStore(): FlightStore {
  const flight = emptyFlight();
  let history = createHistory();
  let clock: FlightClock | null = null; // of the flight
  let own: FlightClock = { wall: 0, t: 0, rate: 0 }; // of the viewer, behind the newest
  let newest: PairSample | null = null;
  let heard: PairSample | null = null; // the newest sample that heard of the leader
  let fresh = Number.NEGATIVE_INFINITY; // wall time at which the data were last known to be new [ms]
  let drawn = { revision: -1, moment: NO_MOMENT }; // the last one replayed
  let linked: Link = "connecting";
  let isOver = false; // nothing comes any more but what is on its way
  let readAt = Number.NEGATIVE_INFINITY;
  let held = 0; // how much is known of the flight
  let offset: { gap: Gap; wall: number } = { gap: NO_GAP, wall: 0 };

  function clear(id: string): void {
    history = createHistory();
    clock = null;
    newest = null;
    heard = null;
    fresh = Number.NEGATIVE_INFINITY;
    readAt = Number.NEGATIVE_INFINITY;
    offset = { gap: NO_GAP, wall: 0 };
    isOver = false;
    flight.id.value = id;
    flight.source.value = { kind: "live" };
    flight.loop.value = null;
    flight.isSent.value = false;
    flight.span.value = null;
    flight.moment.value = NO_MOMENT;
    flight.read.value = NO_MOMENT;
    flight.since.value = 0;
  }

  function receive(tick: Tick, wall: number): void {
    batch(() => {
      if (flight.id.value !== tick.flight_id) clear(tick.flight_id);
      const joining = tick.documents.some(({ kind }) => kind === "flight_started");
      if (joining) history.merge(tick.documents);
      else history.take(tick.documents);
      if (tick.documents.some(({ kind }) => kind === "engagement_changed"))
        flight.isSent.value = false;
      const ended = tick.ended || isOver;
      const running = tick.paused || ended ? 0 : tick.rate;
      clock = setClock(clock, { t: tick.t_s, rate: running, wall });
      flight.clock.value = { rate: tick.rate, paused: tick.paused, ended };
      const sample = newestOf(tick.documents);
      if (sample !== null || running === 0) fresh = wall;
      if (sample !== null) {
        newest = sample;
        const shown = flight.moment.value.now;
        const isAtEdge = flight.source.value.kind === "live";
        const predicted = moveSample(sample, (shown?.t_s ?? sample.t_s) - sample.t_s);
        const isGliding = shown !== null && !joining && isAtEdge && running > 0;
        offset = { gap: isGliding ? gap(shown, predicted) : NO_GAP, wall };
      }
      setSpan();
    });
    advance(wall);
  }

  function newestOf(documents: readonly Document[]): PairSample | null {
    const pair = history.knownAt(Number.POSITIVE_INFINITY).started;
    const last = documents.findLast((each) => each.kind === "sample");
    if (pair === null || last?.kind !== "sample") return null;
    const sample = pairSample(last, pair);
    if (sample?.leader_age_s === 0) heard = sample;
    return sample === null ? null : expected(sample, heard);
  }

  function setSpan(): void {
    const span = history.knots.span;
    const first = span?.first ?? newest?.t_s;
    if (first === undefined) return;
    const last = Math.max(span?.last ?? first, newest?.t_s ?? first);
    const before = flight.span.value;
    if (before?.first !== first || before.last !== last) flight.span.value = { first, last };
    const size = history.knots.count + history.events.length;
    if (size !== held) flight.revision.value += 1;
    held = size;
  }

  function load(id: string, documents: readonly Document[], wall: number): void {
    batch(() => {
      clear(id);
      history.merge(documents);
      flight.clock.value = { rate: 1, paused: true, ended: true };
      setSpan();
      seek(flight.span.value?.first ?? 0, 0, wall);
    });
  }

  function merge(documents: readonly Document[], wall: number): void {
    batch(() => {
      history.merge(documents);
      setSpan();
      advance(wall);
    });
  }

  function advance(wall: number): void {
    batch(() => {
      const moment = flight.source.value.kind === "live" ? liveAt(wall) : replayAt(wall);
      flight.connection.value = connection(flight, moment.dataAge, linked);
      flight.moment.value = moment;
      flight.since.value = 0;
      const isRead = flight.read.value.now !== null;
      if (isRead && Math.abs(wall - readAt) < READING_PERIOD - HALF_FRAME) return;
      readAt = wall;
      flight.read.value = moment;
    });
  }

  /** The newest there is, carried on to this instant. */
  function liveAt(wall: number): Moment {
    const { rate, ended } = flight.clock.value;
    const ages = !ended && Number.isFinite(fresh); // of what is over, no newer data can come
    const dataAge = ages ? Math.max(0, (wall - fresh) / 1000) : 0;
    const known = history.knownAt(Number.POSITIVE_INFINITY);
    const seen = history.seenAt(Number.POSITIVE_INFINITY, newsFor(rate));
    const whole = { ...known, ...seen, rate, dataAge, ended, isSent: false };
    if (newest === null || clock === null) {
      // the end of a recording
      const t = history.knots.span?.last ?? 0;
      return { ...whole, t, now: seen.sample };
    }
    const shown = flight.moment.value.t + flight.since.value;
    const t = Math.max(shown, timeAt(clock, newest, wall));
    const moved = moveSample(newest, t - newest.t_s);
    const now = blend(moved, offset.gap, wall - offset.wall);
    return { ...whole, sample: newest, t, now };
  }

  /** What the viewer's own clock shows; at the end it stands, or goes on with a flight that flies. */
  function replayAt(wall: number): Moment {
    const { first, last } = flight.span.value ?? { first: 0, last: 0 };
    const loop = flight.loop.value;
    let t = readClock(own, wall);
    if (loop !== null && own.rate > 0 && t >= loop.to) {
      t = loop.from;
      own = { ...own, t, wall };
    }
    if (t >= last && own.rate > 0) {
      if (!flight.clock.value.ended) {
        flight.source.value = { kind: "live" };
        return liveAt(wall);
      }
      stand(last, wall);
      t = last;
    }
    const at = Math.max(first, Math.min(t, last));
    const isDrawn =
      drawn.revision === flight.revision.value && drawn.moment === flight.moment.value;
    if (own.rate === 0 && isDrawn && drawn.moment.t === at) return drawn.moment;
    const moment = momentAt(history, at, { rate: Math.max(1, own.rate) });
    drawn = { revision: flight.revision.value, moment };
    return moment;
  }

  function stand(t: number, wall: number): void {
    own = { wall, t, rate: 0 };
    flight.source.value = { kind: "replay", rate: 0 };
  }

  function seek(t: number, rate: number, wall: number): void {
    const span = flight.span.value;
    if (span === null) return;
    own = { wall, t: Math.max(span.first, Math.min(t, span.last)), rate };
    readAt = Number.NEGATIVE_INFINITY;
    batch(() => {
      flight.source.value = { kind: "replay", rate };
      advance(wall);
    });
  }

  function follow(wall: number): void {
    batch(() => {
      offset = { gap: NO_GAP, wall };
      readAt = Number.NEGATIVE_INFINITY;
      flight.source.value = { kind: "live" };
      flight.moment.value = { ...flight.moment.value, t: Number.NEGATIVE_INFINITY };
      flight.since.value = 0;
      advance(wall);
    });
  }

  function end(wall: number): void {
    isOver = true;
    batch(() => {
      flight.clock.value = { ...flight.clock.value, ended: true };
      if (newest !== null) clock = { t: newest.t_s, rate: 0, wall };
      if (flight.source.value.kind === "live") follow(wall);
    });
  }

  function glide(wall: number): void {
    const { moment, since, source } = flight;
    const behind = source.value.kind === "replay";
    if (!behind && (newest === null || clock === null)) return;
    const t =
      behind || newest === null || clock === null
        ? readClock(own, wall)
        : timeAt(clock, newest, wall);
    since.value = Math.max(since.value, t - moment.value.t);
  }

  /** Flight time on the screen [s]: at most so far ahead of the newest sample. */
  function timeAt(running: FlightClock, { t_s }: PairSample, wall: number): number {
    return Math.min(readClock(running, wall), t_s + AHEAD_LIMIT * flight.clock.value.rate);
  }

  function link(state: Link): void {
    linked = state;
    flight.connection.value = connection(flight, flight.moment.value.dataAge, linked);
  }

  return {
    flight,
    history: () => history,
    receive,
    load,
    merge,
    advance,
    glide,
    seek,
    follow,
    end,
    link,
  };
}

/** A flight of which nothing is known. */
export function emptyFlight(): Flight {
  return {
    id: signal(null),
    moment: signal(NO_MOMENT),
    heard: signal(null),
    read: signal(NO_MOMENT),
    since: signal(0),
    source: signal({ kind: "live" }),
    span: signal(null),
    revision: signal(0),
    loop: signal(null),
    clock: signal({ rate: 1, paused: false, ended: false }),
    connection: signal("connecting"),
    isSent: signal(false),
  };
}

/** How fast flight time goes on the screen [s of flight per s]. */
export function speedOf({ source, clock }: Flight): number {
  if (source.value.kind === "replay") return source.value.rate;
  const { rate, paused, ended } = clock.value;
  return paused || ended ? 0 : rate;
}

function connection(flight: Flight, age: number, linked: Link): Connection {
  if (linked === "closed" || age > LOST_AGE) return "lost";
  if (flight.span.value === null || linked === "connecting") return "connecting";
  return age > STALE_AGE ? "stale" : "live";
}
