/** Where two aircraft are a little later (or earlier) than a sample says: constant turn rate, constant wind. */

import { CALM, type Vector, velocity } from "../geometry";
import { DEG, wrap180, wrap360 } from "../units";
import type { AircraftSample, Bars, PathPoint } from "../wire";
import type { PairSample } from "./pair";

/** The wind an aircraft flies in [m/s]: its velocity over the ground less that through the air. */
export function windOf(aircraft: AircraftSample): Vector {
  const ground = velocity(aircraft.ground_speed_mps, aircraft.track_deg);
  const air = velocity(aircraft.tas_mps, aircraft.heading_deg);
  return { x: ground.x - air.x, y: ground.y - air.y };
}

/** One aircraft `dt` [s] later, turning on at its present rate. */
export function moveAircraft(aircraft: AircraftSample, dt: number): AircraftSample {
  const wind = windOf(aircraft);
  const rate = aircraft.turn_rate_degps * DEG;
  const heading = aircraft.heading_deg + aircraft.turn_rate_degps * dt;
  // The chord of the arc flown: mean heading, length V·dt·sin(h)/h with h half the turn.
  const half = (rate * dt) / 2;
  const shrink = Math.abs(half) < 1e-6 ? 1 : Math.sin(half) / half; // series error < 1e-12
  const chord = velocity(aircraft.tas_mps * dt * shrink, aircraft.heading_deg + half / DEG);
  const air = velocity(aircraft.tas_mps, heading);
  const ground = { x: air.x + wind.x, y: air.y + wind.y };
  return {
    ...aircraft,
    x_m: aircraft.x_m + chord.x + wind.x * dt,
    y_m: aircraft.y_m + chord.y + wind.y * dt,
    heading_deg: wrap360(heading),
    track_deg: wrap360(Math.atan2(ground.x, ground.y) / DEG),
    ground_speed_mps: Math.hypot(ground.x, ground.y),
  };
}

/** The slot `dt` [s] later: it moves as the leader would on its final leg. */
function moveSlot(slot: PathPoint, leader: AircraftSample, dt: number): PathPoint {
  const air = velocity(leader.tas_mps, slot.heading_deg);
  const wind = leader.ground_speed_mps > 0 ? windOf(leader) : CALM;
  return {
    t_s: slot.t_s + dt,
    x_m: slot.x_m + (air.x + wind.x) * dt,
    y_m: slot.y_m + (air.y + wind.y) * dt,
    heading_deg: slot.heading_deg,
  };
}

/** The whole sample `dt` [s] later: what moves is moved, what is decided stays as it was. */
export function moveSample(sample: PairSample, dt: number): PairSample {
  if (dt === 0) return sample;
  const pursuer = moveAircraft(sample.pursuer, dt);
  const leader = moveAircraft(sample.leader, dt);
  return {
    ...sample,
    t_s: sample.t_s + dt,
    pursuer,
    leader,
    others: sample.others.map((each) => moveAircraft(each, dt)),
    separation_m: Math.hypot(pursuer.x_m - leader.x_m, pursuer.y_m - leader.y_m),
    slot: moveSlot(sample.slot, sample.leader, dt),
    time_to_go_s: Math.max(0, sample.time_to_go_s - dt),
  };
}

/** The two between two samples, at flight time `t` [s]: what is decided is as in the first. */
export function interpolate(from: PairSample, to: PairSample, t: number): PairSample {
  const length = to.t_s - from.t_s;
  const part = (t - from.t_s) / length;
  const pursuer = meanwhile(from.pursuer, to.pursuer, part, length);
  const leader = meanwhile(from.leader, to.leader, part, length);
  const others = from.others.map((each) => {
    const later = to.others.find(({ ident }) => ident === each.ident);
    return later === undefined ? each : meanwhile(each, later, part, length);
  });
  const mixed = (name: Mixed) => mix(from[name], to[name], part);
  return {
    ...moveSample(from, t - from.t_s),
    pursuer,
    leader,
    others,
    separation_m: Math.hypot(pursuer.x_m - leader.x_m, pursuer.y_m - leader.y_m),
    closure_mps: mixed("closure_mps"),
    least_separation_m: mixed("least_separation_m"),
    spacing_error_m: mixed("spacing_error_m"),
    cross_track_m: mixed("cross_track_m"),
    commanded_tas_mps: mixed("commanded_tas_mps"),
    ...meanwhileBars(from.bars?.[0], to.bars?.[0], part),
  };
}

/** The flight director's bars between two samples: from out of view they come at once. */
function meanwhileBars(from: Bars | undefined, to: Bars | undefined, part: number) {
  if (from === undefined || to === undefined) return {};
  const mixed = (name: keyof Bars) => mix(from[name], to[name], part);
  const bars = {
    roll_deg: mixed("roll_deg"),
    pitch_deg: mixed("pitch_deg"),
    commanded_bank_deg: mixed("commanded_bank_deg"),
    commanded_climb_mps: mixed("commanded_climb_mps"),
  };
  return { bars: [bars] };
}

type Mixed =
  | "closure_mps"
  | "least_separation_m"
  | "spacing_error_m"
  | "cross_track_m"
  | "commanded_tas_mps";

function mix(from: number, to: number, part: number): number {
  return from + (to - from) * part;
}

/** An aircraft between two samples `length` [s] apart: places and heading by Hermite's cubic. */
function meanwhile(
  from: AircraftSample,
  to: AircraftSample,
  part: number,
  length: number,
): AircraftSample {
  const [begins, ends] = [groundVelocity(from), groundVelocity(to)];
  const turned = wrap180(to.heading_deg - from.heading_deg);
  const drifted = wrap180(to.track_deg - from.track_deg);
  const heading = hermite(
    0,
    turned,
    from.turn_rate_degps * length,
    to.turn_rate_degps * length,
    part,
  );
  return {
    ...from,
    x_m: hermite(from.x_m, to.x_m, begins.x * length, ends.x * length, part),
    y_m: hermite(from.y_m, to.y_m, begins.y * length, ends.y * length, part),
    heading_deg: wrap360(from.heading_deg + heading),
    track_deg: wrap360(from.track_deg + drifted * part),
    bank_deg: mix(from.bank_deg, to.bank_deg, part),
    turn_rate_degps: mix(from.turn_rate_degps, to.turn_rate_degps, part),
    tas_mps: mix(from.tas_mps, to.tas_mps, part),
    ground_speed_mps: mix(from.ground_speed_mps, to.ground_speed_mps, part),
    altitude_m: mix(from.altitude_m, to.altitude_m, part),
  };
}

function groundVelocity({ ground_speed_mps, track_deg }: AircraftSample): Vector {
  return velocity(ground_speed_mps, track_deg);
}

/** Hermite's cubic from `a` to `b` with slopes `da` and `db` a unit, at `s` in [0, 1]. */
function hermite(a: number, b: number, da: number, db: number, s: number): number {
  const [s2, s3] = [s * s, s * s * s];
  return (
    a * (2 * s3 - 3 * s2 + 1) + da * (s3 - 2 * s2 + s) + b * (3 * s2 - 2 * s3) + db * (s3 - s2)
  );
}

/** A sample with the leader where it is expected, if nothing was heard of it since `heard`. */
export function expected(sample: PairSample, heard: PairSample | null): PairSample {
  if (sample.leader_age_s === 0 || heard === null) return sample;
  const straight = { ...heard.leader, bank_deg: 0, turn_rate_degps: 0 };
  const leader = moveAircraft(straight, sample.t_s - heard.t_s);
  const { pursuer } = sample;
  const separation = Math.hypot(pursuer.x_m - leader.x_m, pursuer.y_m - leader.y_m);
  return { ...sample, leader, separation_m: separation };
}

/** How far all has moved since a sample. World: x east, y north [m]. */
export interface Moved {
  readonly own: Vector;
  /** How far own ship's nose has turned [deg clockwise]. */
  readonly turned: number;
  readonly leader: Vector;
  readonly slot: Vector;
  /** The other aircraft, by ident. */
  readonly others: ReadonlyMap<string, Vector>;
}

export const STILL: Moved = { own: CALM, turned: 0, leader: CALM, slot: CALM, others: new Map() };

/** What has moved by how much `dt` [s] later. */
export function movedBy(sample: PairSample, dt: number): Moved {
  if (dt === 0) return STILL;
  const later = moveSample(sample, dt);
  return {
    own: between(sample.pursuer, later.pursuer),
    turned: wrap180(later.pursuer.heading_deg - sample.pursuer.heading_deg),
    leader: between(sample.leader, later.leader),
    slot: between(sample.slot, later.slot),
    others: new Map(
      sample.others.map((each, k) => [each.ident, between(each, later.others[k] ?? each)]),
    ),
  };
}

type At = Pick<PathPoint, "x_m" | "y_m">;

function between(from: At, to: At): Vector {
  return { x: to.x_m - from.x_m, y: to.y_m - from.y_m };
}

/** How far the picture stood from what a new sample says: it is closed gently, not in one jump. */
export interface Gap {
  readonly pursuer: AircraftGap;
  readonly leader: AircraftGap;
  readonly others: ReadonlyMap<string, AircraftGap>;
}

interface AircraftGap {
  readonly x: number;
  readonly y: number;
  readonly heading: number;
}

const CLOSED: AircraftGap = { x: 0, y: 0, heading: 0 };
export const NO_GAP: Gap = { pursuer: CLOSED, leader: CLOSED, others: new Map() };

/** Time constant with which a gap closes [wall ms]: three ticks. */
const CLOSING = 150;
/** A gap wider than this is no prediction error but a new place: the picture goes there at once [m]. */
const WIDEST = 2000;

/** The gap between what is shown and what is true, both at the same flight time. */
export function gap(shown: PairSample, truth: PairSample): Gap {
  return {
    pursuer: aircraftGap(shown.pursuer, truth.pursuer),
    leader: aircraftGap(shown.leader, truth.leader),
    others: new Map(
      truth.others.map((each) => {
        const before = shown.others.find(({ ident }) => ident === each.ident);
        return [each.ident, before === undefined ? CLOSED : aircraftGap(before, each)];
      }),
    ),
  };
}

function aircraftGap(shown: AircraftSample, truth: AircraftSample): AircraftGap {
  const x = shown.x_m - truth.x_m;
  const y = shown.y_m - truth.y_m;
  if (Math.hypot(x, y) > WIDEST) return CLOSED;
  return { x, y, heading: wrap180(shown.heading_deg - truth.heading_deg) };
}

/** A sample with what is left of a gap `age` [ms] after it was found. */
export function blend(sample: PairSample, found: Gap, age: number): PairSample {
  const left = Math.exp(-Math.max(0, age) / CLOSING);
  if (found === NO_GAP || left < 1e-3) return sample;
  return {
    ...sample,
    pursuer: nudge(sample.pursuer, found.pursuer, left),
    leader: nudge(sample.leader, found.leader, left),
    others: sample.others.map((each) => nudge(each, found.others.get(each.ident) ?? CLOSED, left)),
  };
}

function nudge(aircraft: AircraftSample, found: AircraftGap, left: number): AircraftSample {
  return {
    ...aircraft,
    x_m: aircraft.x_m + found.x * left,
    y_m: aircraft.y_m + found.y * left,
    heading_deg: wrap360(aircraft.heading_deg + found.heading * left),
    track_deg: wrap360(aircraft.track_deg + found.heading * left),
  };
}
