/**
 * What the display knows of a flight, as signals: the ticks of the stream go in, the picture reads out.
 *
 * No DOM and no clock of its own: every wall-clock instant [ms] is handed in.
 */

import { batch, signal } from "@preact/signals";
import type { Tick } from "../wire";
import { type FlightClock, readClock, setClock } from "./clock";
import { blend, type Gap, gap, moveSample, NO_GAP } from "./motion";
import type { PairSample } from "./pair";
import { reduce } from "./reduce";
import { separation } from "./states";
import type { Connection, Flight, Link } from "./types";

/** A flight's signals and the four things that happen to them. */
export interface FlightStore {
  readonly flight: Flight;
  /** Takes in one tick that arrived at `wall` [ms]. */
  receive(tick: Tick, wall: number): void;
  /** Draws the picture of the instant `wall` [ms]. */
  advance(wall: number): void;
  /** Carries what moves on the picture that is drawn on to `wall` [ms], and changes nothing else. */
  glide(wall: number): void;
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
export const LOST_AGE = 5;

export function createFlightStore(): FlightStore {
  const flight = emptyFlight();
  let clock: FlightClock | null = null;
  let fresh = -Infinity; // wall time at which the data were last known to be new [ms]
  let linked: Link = "connecting";
  let readAt = -Infinity;
  let offset: { gap: Gap; wall: number } = { gap: NO_GAP, wall: 0 };

  function receive(tick: Tick, wall: number): void {
    batch(() => {
      const joining =
        flight.id.value !== tick.flight_id ||
        tick.documents.some((document) => document.kind === "flight_started");
      if (flight.id.value !== tick.flight_id) {
        clear(flight);
        flight.id.value = tick.flight_id;
        clock = null;
      }
      const running = tick.paused || tick.ended ? 0 : tick.rate;
      clock = setClock(clock, { t: tick.t_s, rate: running, wall });
      flight.clock.value = { rate: tick.rate, paused: tick.paused, ended: tick.ended };
      const before = flight.sample.value;
      for (const document of tick.documents) {
        const since = wall - ((tick.t_s - document.t_s) / tick.rate) * 1000;
        reduce(flight, document, { joining, wall, since });
      }
      const newest = flight.sample.value;
      if (newest !== before || running === 0) fresh = wall;
      if (newest !== null && newest !== before) {
        const shown = flight.now.value;
        const predicted = moveSample(newest, (shown?.t_s ?? newest.t_s) - newest.t_s);
        offset = { gap: shown === null || joining ? NO_GAP : gap(shown, predicted), wall };
      }
    });
    advance(wall);
  }

  function advance(wall: number): void {
    batch(() => {
      flight.wall.value = wall;
      flight.dataAge.value = Number.isFinite(fresh) ? Math.max(0, (wall - fresh) / 1000) : 0;
      flight.connection.value = connection(flight, linked);
      const superseded = flight.superseded.value;
      if (superseded !== null && wall >= superseded.until) flight.superseded.value = null;
      const sample = flight.sample.value;
      if (sample === null || clock === null) return;
      const shown = flight.simTime.value + flight.since.value;
      const t = Math.max(shown, timeAt(clock, sample, wall));
      flight.simTime.value = t;
      flight.since.value = 0;
      const moved = moveSample(sample, t - sample.t_s);
      flight.now.value = blend(moved, offset.gap, wall - offset.wall);
      if (separation(flight).state === "lost") flight.belowSince.value = wall;
      if (flight.reading.value !== null && wall - readAt < READING_PERIOD - HALF_FRAME) return;
      readAt = wall;
      flight.reading.value = flight.now.value;
    });
  }

  function glide(wall: number): void {
    const sample = flight.sample.value;
    if (sample === null || clock === null) return;
    const since = timeAt(clock, sample, wall) - flight.simTime.value;
    flight.since.value = Math.max(flight.since.value, since);
  }

  /** Flight time on the screen [s]: at most so far ahead of the newest sample. */
  function timeAt(running: FlightClock, { t_s }: PairSample, wall: number): number {
    return Math.min(readClock(running, wall), t_s + AHEAD_LIMIT * flight.clock.value.rate);
  }

  function link(state: Link): void {
    linked = state;
    flight.connection.value = connection(flight, linked);
  }

  return { flight, receive, advance, glide, link };
}

/** A flight of which nothing is known. */
export function emptyFlight(): Flight {
  return {
    id: signal(null),
    started: signal(null),
    route: signal(null),
    plan: signal(null),
    proposal: signal(null),
    forecast: signal(null),
    superseded: signal(null),
    unavailable: signal(null),
    alerts: signal([]),
    unable: signal(null),
    promise: signal(null),
    lost: signal(null),
    mode: signal(null),
    modeSince: signal(-Infinity),
    planSince: signal(-Infinity),
    lostSince: signal(-Infinity),
    joinedSince: signal(-Infinity),
    belowSince: signal(-Infinity),
    engagement: signal(null),
    isSent: signal(false),
    heard: signal(null),
    sample: signal(null),
    now: signal(null),
    reading: signal(null),
    wall: signal(0),
    simTime: signal(0),
    since: signal(0),
    dataAge: signal(0),
    trail: { pursuer: signal([]), leader: signal([]) },
    ended: signal(null),
    clock: signal({ rate: 1, paused: false, ended: false }),
    connection: signal("connecting"),
    messages: signal([]),
  };
}

function clear(flight: Flight): void {
  const empty = emptyFlight();
  flight.started.value = null;
  flight.route.value = null;
  flight.plan.value = null;
  flight.proposal.value = null;
  flight.forecast.value = null;
  flight.superseded.value = null;
  flight.unavailable.value = null;
  flight.alerts.value = [];
  flight.unable.value = null;
  flight.lost.value = null;
  flight.mode.value = null;
  flight.modeSince.value = -Infinity;
  flight.planSince.value = -Infinity;
  flight.lostSince.value = -Infinity;
  flight.joinedSince.value = -Infinity;
  flight.belowSince.value = -Infinity;
  flight.engagement.value = null;
  flight.isSent.value = false;
  flight.heard.value = null;
  flight.sample.value = null;
  flight.now.value = null;
  flight.reading.value = null;
  flight.simTime.value = 0;
  flight.since.value = 0;
  flight.trail.pursuer.value = [];
  flight.trail.leader.value = [];
  flight.ended.value = null;
  flight.clock.value = empty.clock.value;
  flight.messages.value = [];
}

function connection(flight: Flight, linked: Link): Connection {
  const age = flight.dataAge.value;
  if (linked === "closed" || age > LOST_AGE) return "lost";
  if (flight.sample.value === null || linked === "connecting") return "connecting";
  return age > STALE_AGE ? "stale" : "live";
}
