/**
 * One sample a second of flight, in columns: what scrubbing, charts and trails read. Between two of
 * them the aircraft are found by interpolation, to 2 mm; an hour takes a megabyte.
 */

import type { AircraftSample, Bars, PathPoint } from "../wire";
import { expected, interpolate, moveSample } from "./motion";
import type { PairSample } from "./pair";
import { GRAZE } from "./states";

const OF_AIRCRAFT = [
  "x_m",
  "y_m",
  "heading_deg",
  "track_deg",
  "bank_deg",
  "turn_rate_degps",
  "tas_mps",
  "ground_speed_mps",
  "altitude_m",
] as const;
const OF_SLOT = ["t_s", "x_m", "y_m", "heading_deg"] as const;
const OF_PAIR = [
  "t_s",
  "commanded_tas_mps",
  "separation_m",
  "closure_mps",
  "least_separation_m",
  "spacing_error_m",
  "cross_track_m",
  "time_to_go_s",
  "leader_age_s",
  "margin_m",
] as const;

const OF_BARS = ["roll_deg", "pitch_deg", "commanded_bank_deg", "commanded_climb_mps"] as const;

const PURSUER = OF_PAIR.length;
const LEADER = PURSUER + OF_AIRCRAFT.length;
const SLOT = LEADER + OF_AIRCRAFT.length;
const BARS = SLOT + OF_SLOT.length;
const REFERENCE = BARS + OF_BARS.length;
/** What follows from the samples before: since when joined, last below the minimum, last row with a leader heard. */
const JOINED = REFERENCE + 1;
const BELOW = JOINED + 1;
const HEARD = BELOW + 1;
const WIDTH = HEARD + 1;

/** What is decided, not measured: few different ones, each kept once. */
interface Decided
  extends Pick<
    PairSample,
    "mode" | "engagement" | "joined" | "alert" | "slot_open" | "autopilot" | "director"
  > {
  readonly pursuer: string;
  readonly leader: string;
  readonly others: readonly string[];
  readonly reference: PairSample["reference"]["kind"];
}

/** Samples farther apart than this are no neighbours: what lies between is not known [s]. */
const NEIGHBOURS = 10.5;
const SLACK = 1e-6;
/** Rates of climb are found over so long [s]. */
const CLIMB_OVER = 4;
const NO_CLIMBS: ReadonlyMap<string, number> = new Map();

/** A column of numbers that charts draw. */
export type Column =
  | (typeof OF_PAIR)[number]
  | `pursuer.${(typeof OF_AIRCRAFT)[number]}`
  | `leader.${(typeof OF_AIRCRAFT)[number]}`;

export interface Knots {
  readonly count: number;
  /** First and last flight time [s]; null before the first sample. */
  readonly span: { readonly first: number; readonly last: number } | null;
  /** Takes the next sample, if a second is over since the last one taken. */
  take(sample: PairSample, minSeparation: number): void;
  /** Takes samples of any time that are not there yet; d_min may be another at another flight time. */
  merge(samples: readonly PairSample[], minSeparationAt: (t: number) => number): void;
  /** The two at flight time `t` [s], held to the ends; null before the first sample. */
  sampleAt(t: number): PairSample | null;
  joinedAt(t: number): number;
  belowAt(t: number): number;
  /** How fast each aircraft climbs at flight time `t` [m/s], by ident: from the seconds before. */
  climbsAt(t: number): ReadonlyMap<string, number>;
  /** How long ago anything was known at flight time `t` [s]: 0 but in gaps. */
  ageAt(t: number): number;
  /** One column over all seconds. */
  column(name: Column): Float64Array;
}

export function createKnots(): Knots {
  let rows = new Float64Array(WIDTH * 256);
  let decided: Decided[] = [];
  let beside: Float64Array[] = []; // of each row, all other aircraft
  let count = 0;
  const kept = new Map<string, Decided>();

  function cell(row: number, at: number): number {
    return rows[row * WIDTH + at] ?? Number.NaN;
  }

  function put(sample: PairSample, minSeparation: number): void {
    if (rows.length < (count + 1) * WIDTH) {
      const wider = new Float64Array(2 * rows.length);
      wider.set(rows);
      rows = wider;
    }
    const at = count * WIDTH;
    OF_PAIR.forEach((name, k) => {
      rows[at + k] = sample[name];
    });
    putAircraft(rows, at + PURSUER, sample.pursuer);
    putAircraft(rows, at + LEADER, sample.leader);
    OF_SLOT.forEach((name, k) => {
      rows[at + SLOT + k] = sample.slot[name];
    });
    OF_BARS.forEach((name, k) => {
      rows[at + BARS + k] = sample.bars?.[0]?.[name] ?? Number.NaN; // out of view
    });
    const { reference } = sample;
    rows[at + REFERENCE] =
      reference.kind === "hold_heading" ? reference.heading_deg : reference.turn_rate_degps;
    const before = count - 1;
    const since = before < 0 ? Number.POSITIVE_INFINITY : cell(before, JOINED);
    const joinedSince = Number.isFinite(since) ? since : sample.t_s;
    rows[at + JOINED] = sample.joined ? joinedSince : Number.POSITIVE_INFINITY;
    const isBelow = sample.leader_age_s === 0 && sample.separation_m < minSeparation - GRAZE;
    const below = before < 0 ? Number.NEGATIVE_INFINITY : cell(before, BELOW);
    rows[at + BELOW] = isBelow ? sample.t_s : below;
    rows[at + HEARD] = sample.leader_age_s === 0 ? count : before < 0 ? -1 : cell(before, HEARD);
    decided.push(intern(sample));
    const others = new Float64Array(sample.others.length * OF_AIRCRAFT.length);
    sample.others.forEach((each, k) => {
      putAircraft(others, k * OF_AIRCRAFT.length, each);
    });
    beside.push(others);
    count += 1;
  }

  function intern(sample: PairSample): Decided {
    const { mode, engagement, joined, alert, slot_open, autopilot, director } = sample;
    const hands = { ...(autopilot === false && { autopilot }), ...(director && { director }) };
    const [pursuer, leader, reference] = [
      sample.pursuer.ident,
      sample.leader.ident,
      sample.reference.kind,
    ];
    const others = sample.others.map(({ ident }) => ident);
    const state = { mode, engagement, joined, alert, slot_open, ...hands };
    const one = { ...state, pursuer, leader, others, reference };
    const key = JSON.stringify(one);
    const known = kept.get(key);
    if (known !== undefined) return known;
    kept.set(key, one);
    return one;
  }

  /** A row as the sample that it was made of. */
  function raw(row: number): PairSample {
    const how = decided[row];
    if (how === undefined) throw new RangeError(`There is no sample ${row}.`);
    const at = row * WIDTH;
    const numbers = Object.fromEntries(OF_PAIR.map((name, k) => [name, rows[at + k]]));
    const slot = Object.fromEntries(OF_SLOT.map((name, k) => [name, rows[at + SLOT + k]]));
    const bars = Object.fromEntries(OF_BARS.map((name, k) => [name, rows[at + BARS + k]]));
    const value = cell(row, REFERENCE);
    const { pursuer, leader, others, reference, ...rest } = how;
    const columns = beside[row] ?? new Float64Array();
    return {
      ...(numbers as unknown as Pick<PairSample, (typeof OF_PAIR)[number]>),
      ...rest,
      reference:
        reference === "hold_heading"
          ? { kind: reference, heading_deg: value }
          : { kind: reference, turn_rate_degps: value },
      slot: slot as unknown as PathPoint,
      ...(!Number.isNaN(cell(row, BARS)) && { bars: [bars as unknown as Bars] }),
      pursuer: getAircraft(rows, at + PURSUER, pursuer),
      leader: getAircraft(rows, at + LEADER, leader),
      others: others.map((ident, k) => getAircraft(columns, k * OF_AIRCRAFT.length, ident)),
    };
  }

  function sampleOf(row: number): PairSample {
    const heard = cell(row, HEARD);
    const sample = raw(row);
    return heard === row || heard < 0 ? sample : expected(sample, raw(heard));
  }

  /** The last row that is no later than `t`; −1 if all are. */
  function rowAt(t: number): number {
    let [low, high] = [0, count];
    while (low < high) {
      const middle = (low + high) >> 1;
      if (cell(middle, 0) <= t + SLACK) low = middle + 1;
      else high = middle;
    }
    return low - 1;
  }

  function sampleAt(t: number): PairSample | null {
    if (count === 0) return null;
    const row = Math.max(0, rowAt(t));
    const from = sampleOf(row);
    const dt = t - from.t_s;
    if (dt <= SLACK || row === count - 1) return from;
    if (cell(row + 1, 0) - from.t_s > NEIGHBOURS) return moveSample(from, dt);
    const to = raw(row + 1);
    if (from.leader_age_s === 0 && to.leader_age_s === 0) return interpolate(from, to, t);
    const heard = cell(row, HEARD);
    const between = interpolate(from, to, t);
    const age = from.leader_age_s + dt;
    return heard < 0 ? between : expected({ ...between, leader_age_s: age }, raw(heard));
  }

  return {
    get count() {
      return count;
    },
    get span() {
      return count === 0 ? null : { first: cell(0, 0), last: cell(count - 1, 0) };
    },
    take(sample, minSeparation) {
      const last = count === 0 ? Number.NEGATIVE_INFINITY : cell(count - 1, 0);
      if (sample.t_s > Math.floor(last + SLACK) + 1 - SLACK) put(sample, minSeparation);
    },
    merge(samples, minSeparationAt) {
      const rowsNow = Array.from({ length: count }, (_, row) => raw(row));
      const known = new Set(rowsNow.map(({ t_s }) => Math.round(t_s / SLACK)));
      rowsNow.push(...samples.filter(({ t_s }) => !known.has(Math.round(t_s / SLACK))));
      rowsNow.sort((a, b) => a.t_s - b.t_s);
      decided = [];
      beside = [];
      count = 0;
      for (const each of rowsNow) put(each, minSeparationAt(each.t_s));
    },
    sampleAt,
    joinedAt: (t) => (count === 0 ? Number.POSITIVE_INFINITY : cell(Math.max(0, rowAt(t)), JOINED)),
    belowAt: (t) => (count === 0 ? Number.NEGATIVE_INFINITY : cell(Math.max(0, rowAt(t)), BELOW)),
    climbsAt(t) {
      const row = rowAt(t);
      const first = rowAt(t - CLIMB_OVER);
      const [from, to] = [Math.max(0, first), Math.max(0, row)];
      if (count === 0 || from === to) return NO_CLIMBS;
      const [before, now] = [raw(from), raw(to)];
      const past = now.t_s - before.t_s;
      if (past > NEIGHBOURS) return NO_CLIMBS;
      const levels = new Map(all(before).map((each) => [each.ident, each.altitude_m]));
      return new Map(
        all(now).map(({ ident, altitude_m }) => [
          ident,
          (altitude_m - (levels.get(ident) ?? altitude_m)) / past,
        ]),
      );
    },
    ageAt(t) {
      const row = rowAt(t);
      if (row < 0 || row === count - 1) return 0;
      const [from, to] = [cell(row, 0), cell(row + 1, 0)];
      return to - from > NEIGHBOURS ? t - from : 0;
    },
    column(name) {
      const at = columnOf(name);
      return Float64Array.from({ length: count }, (_, row) => cell(row, at));
    },
  };
}

function columnOf(name: Column): number {
  const [whose, what] = name.split(".");
  if (what === undefined) return (OF_PAIR as readonly string[]).indexOf(name);
  const first = whose === "pursuer" ? PURSUER : LEADER;
  return first + (OF_AIRCRAFT as readonly string[]).indexOf(what);
}

function all({ pursuer, leader, others }: PairSample): AircraftSample[] {
  return [pursuer, leader, ...others];
}

function putAircraft(rows: Float64Array, at: number, aircraft: AircraftSample): void {
  OF_AIRCRAFT.forEach((name, k) => {
    rows[at + k] = aircraft[name];
  });
}

function getAircraft(rows: Float64Array, at: number, ident: string): AircraftSample {
  const numbers = OF_AIRCRAFT.map((name, k) => [name, rows[at + k]] as const);
  return { ident, ...Object.fromEntries(numbers) } as unknown as AircraftSample;
}
