/** What the map edits: a situation as it is sent, each member given, within the bounds of what is planned. */

import { KT, NM, wrap360 } from "../units";
import type { IntentPiece, LocalLeader, LocalPursuer, SituationBody, WindBody } from "../wire";
import { bodiesOf } from "./others";

/** An aircraft that says what it will fly; without a level it is at any. */
export interface Declared extends Omit<LocalLeader, "intent"> {
  readonly intent: readonly IntentPiece[];
}

/** One of the others; without a minimum of its own, that of the situation is kept to it. */
export interface MapTraffic extends Declared {
  readonly ident: string;
  readonly min_separation_m?: number | null;
}

/** A weather cell: a disc, at t = 0. */
export interface MapCell {
  readonly ident: string;
  readonly x_m: number;
  readonly y_m: number;
  readonly radius_m: number;
  /** How fast it moves over the ground, and how fast it grows. */
  readonly east_mps: number;
  readonly north_mps: number;
  readonly growth_mps: number;
}

export interface Situation {
  readonly pursuer: LocalPursuer;
  readonly leader: Declared;
  readonly traffic: readonly MapTraffic[];
  readonly cells: readonly MapCell[];
  readonly slot_distance_m: number;
  readonly min_separation_m: number;
  readonly wind: WindBody;
}

/** Accepted ranges: those of the planner, the speeds rounded inward to whole knots [m, m/s, °]. */
export const BOUNDS = {
  position: [-1_000_000, 1_000_000],
  tas: [59 * KT, 777 * KT],
  bank: [1, 60],
  distance: [0, 200_000],
  wind: [0, 150],
  piece: [0, 86_400],
  altitude: [-500, 20_000],
  rate: [0.5, 60],
  radius: [1, 500_000],
  growth: [0, 50],
  drift: [-150, 150],
} as const;
/** Most pieces an intent may have. */
export const MOST_PIECES = 20;
/** Most other aircraft and cells together. */
export const MOST_OTHERS = 100;

export function clamp(value: number, [low, high]: readonly [number, number]): number {
  return Math.min(high, Math.max(low, value));
}

/** The same within its bounds: angles in [0, 360), D no less than d_min, what is finer than a metre left out. */
export function settle(situation: Situation): Situation {
  const { pursuer, leader, traffic, cells, wind } = situation;
  const least = clamp(situation.min_separation_m, BOUNDS.distance);
  return {
    pursuer: {
      ...settleAircraft(pursuer),
      max_bank_deg: clamp(pursuer.max_bank_deg, BOUNDS.bank),
    },
    leader: {
      ...settleAircraft(leader),
      intent: leader.intent.slice(0, MOST_PIECES).map(settlePiece),
    },
    traffic: traffic.map((each) => {
      const { min_separation_m: own, ...rest } = settleAircraft(each);
      return {
        ...rest,
        intent: each.intent.slice(0, MOST_PIECES).map(settlePiece),
        ...(own != null && { min_separation_m: fine(clamp(own, BOUNDS.distance)) }),
      };
    }),
    cells: cells.map((each) => ({
      ident: each.ident,
      x_m: fine(clamp(each.x_m, BOUNDS.position)),
      y_m: fine(clamp(each.y_m, BOUNDS.position)),
      radius_m: Math.max(1, fine(clamp(each.radius_m, BOUNDS.radius))),
      east_mps: hundredth(clamp(each.east_mps, BOUNDS.drift)),
      north_mps: hundredth(clamp(each.north_mps, BOUNDS.drift)),
      growth_mps: hundredth(clamp(each.growth_mps, BOUNDS.growth)),
    })),
    min_separation_m: fine(least),
    slot_distance_m: Math.max(fine(least), fine(clamp(situation.slot_distance_m, BOUNDS.distance))),
    wind: {
      from_deg: settleAngle(wind.from_deg),
      speed_mps: hundredth(clamp(wind.speed_mps, BOUNDS.wind)),
    },
  };
}

function settleAircraft<T extends Omit<LocalLeader, "intent">>(aircraft: T): T {
  const { altitude_m, ...rest } = aircraft;
  return {
    ...(rest as T),
    ...(altitude_m != null && { altitude_m: fine(clamp(altitude_m, BOUNDS.altitude)) }),
    x_m: fine(clamp(aircraft.x_m, BOUNDS.position)),
    y_m: fine(clamp(aircraft.y_m, BOUNDS.position)),
    heading_deg: settleAngle(aircraft.heading_deg),
    tas_mps: hundredth(clamp(aircraft.tas_mps, BOUNDS.tas)),
  };
}

function settlePiece(piece: IntentPiece): IntentPiece {
  if ("straight_s" in piece) return piece;
  if ("level_change" in piece) {
    const { to_altitude_m, rate_mps, ...how } = piece.level_change;
    return {
      level_change: {
        to_altitude_m: fine(clamp(to_altitude_m, BOUNDS.altitude)),
        rate_mps: hundredth(clamp(rate_mps, BOUNDS.rate)),
        ...how,
      },
    };
  }
  return { ...piece, turn_to_heading_deg: settleAngle(piece.turn_to_heading_deg) };
}

/** In tenths of a degree, in [0, 360). */
function settleAngle(angle: number): number {
  return tenth(wrap360(angle)) % 360;
}

function fine(metres: number): number {
  return Math.round(metres) + 0;
}

function tenth(value: number): number {
  return Math.round(10 * value) / 10 + 0;
}

function hundredth(value: number): number {
  return Math.round(100 * value) / 100 + 0;
}

/** As `POST /plans` takes it: what is empty is left out. */
export function bodyOf(situation: Situation): SituationBody {
  const {
    leader: { intent, ...leader },
    wind,
    traffic,
    cells,
    ...rest
  } = situation;
  return {
    ...rest,
    ...bodiesOf({ traffic, cells }),
    leader: intent.length > 0 ? { ...leader, intent: [...intent] } : leader,
    ...(wind.speed_mps > 0 && { wind }),
  };
}

/** A distance in whole tenths of a mile, as a dial or a key steps it [m]. */
export function stepMiles(distance: number, miles: number): number {
  return (Math.round((distance / NM + miles) * 10) / 10) * NM;
}
