/** What the map edits: a situation as it is sent, each member given, within the bounds of what is planned. */

import { KT, NM, wrap360 } from "../units";
import type { IntentPiece, LocalLeader, LocalPursuer, SituationBody, WindBody } from "../wire";

export interface Situation {
  readonly pursuer: LocalPursuer;
  readonly leader: Required<LocalLeader>;
  readonly slot_distance_m: number;
  readonly min_separation_m: number;
  readonly wind: WindBody;
}

/** The paper's Fig. 6b: what a map shows that was given nothing else. */
export const FIRST: Situation = {
  pursuer: { x_m: -40_000, y_m: 40_000, heading_deg: 90, tas_mps: 240, max_bank_deg: 25 },
  leader: {
    x_m: 0,
    y_m: 0,
    heading_deg: 90,
    tas_mps: 200,
    intent: [{ straight_s: 820 }, { turn_to_heading_deg: 135, direction: "right", bank_deg: 25 }],
  },
  slot_distance_m: 10_000,
  min_separation_m: 9260,
  wind: { from_deg: 0, speed_mps: 0 },
};

/** Accepted ranges: those of the planner, the speeds rounded inward to whole knots [m, m/s, °]. */
export const BOUNDS = {
  position: [-1_000_000, 1_000_000],
  tas: [59 * KT, 777 * KT],
  bank: [1, 60],
  distance: [0, 200_000],
  wind: [0, 150],
  piece: [0, 86_400],
} as const;
/** Most pieces an intent may have. */
export const MOST_PIECES = 20;

export function clamp(value: number, [low, high]: readonly [number, number]): number {
  return Math.min(high, Math.max(low, value));
}

/** The same within its bounds: angles in [0, 360), D no less than d_min, what is finer than a metre left out. */
export function settle(situation: Situation): Situation {
  const { pursuer, leader, wind } = situation;
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
    min_separation_m: fine(least),
    slot_distance_m: Math.max(fine(least), fine(clamp(situation.slot_distance_m, BOUNDS.distance))),
    wind: {
      from_deg: settleAngle(wind.from_deg),
      speed_mps: hundredth(clamp(wind.speed_mps, BOUNDS.wind)),
    },
  };
}

function settleAircraft<T extends Pick<LocalLeader, "x_m" | "y_m" | "heading_deg" | "tas_mps">>(
  aircraft: T,
): T {
  return {
    ...aircraft,
    x_m: fine(clamp(aircraft.x_m, BOUNDS.position)),
    y_m: fine(clamp(aircraft.y_m, BOUNDS.position)),
    heading_deg: settleAngle(aircraft.heading_deg),
    tas_mps: hundredth(clamp(aircraft.tas_mps, BOUNDS.tas)),
  };
}

function settlePiece(piece: IntentPiece): IntentPiece {
  if ("straight_s" in piece) return piece;
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
export function bodyOf({ leader: { intent, ...leader }, wind, ...rest }: Situation): SituationBody {
  return {
    ...rest,
    leader: intent.length > 0 ? { ...leader, intent: [...intent] } : leader,
    ...(wind.speed_mps > 0 && { wind }),
  };
}

/** The same as a program. */
export function pythonOf(situation: Situation): string {
  const { pursuer, leader, wind } = situation;
  const place = (
    name: string,
    { x_m, y_m, heading_deg, tas_mps }: typeof leader | typeof pursuer,
  ) => `${name}(\n    x=${x_m}, y=${y_m}, heading=radians(${heading_deg}), tas=${tas_mps}`;
  const pieces = leader.intent.map((piece) =>
    "straight_s" in piece
      ? `FlyStraight(duration=${piece.straight_s})`
      : `TurnTo(heading=radians(${piece.turn_to_heading_deg}), turn=${piece.direction.toUpperCase()}, ` +
        `bank=radians(${piece.bank_deg}))`,
  );
  const used = (names: Record<string, boolean>) => Object.keys(names).filter((each) => names[each]);
  const turns = leader.intent.flatMap((piece) => ("direction" in piece ? [piece.direction] : []));
  const names = used({
    LEFT: turns.includes("left"),
    RIGHT: turns.includes("right"),
    FlyStraight: leader.intent.some((piece) => "straight_s" in piece),
    Leader: true,
    Pursuer: true,
    Situation: true,
    TurnTo: turns.length > 0,
    plan: true,
    wind_from: wind.speed_mps > 0,
  });
  const intent =
    pieces.length > 0 ? `,\n    intent=(\n        ${pieces.join(",\n        ")},\n    )` : "";
  const air =
    wind.speed_mps > 0 ? `\n    wind=wind_from(radians(${wind.from_deg}), ${wind.speed_mps}),` : "";
  return `from math import radians

from relguide import ${names.join(", ")}

own = ${place("Pursuer", pursuer)}, max_bank=radians(${pursuer.max_bank_deg})
)
leader = ${place("Leader", leader)}${intent},
)
situation = Situation(
    pursuer=own,
    leader=leader,
    slot_distance=${situation.slot_distance_m},
    min_separation=${situation.min_separation_m},${air}
)
print(plan(situation))
`;
}

/** A distance in whole tenths of a mile, as a dial or a key steps it [m]. */
export function stepMiles(distance: number, miles: number): number {
  return (Math.round((distance / NM + miles) * 10) / 10) * NM;
}
