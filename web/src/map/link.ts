/** A situation as a link: written into the address of the page, and read from it. */

import { formatMiles, KT, NM } from "../units";
import type { IntentPiece } from "../wire";
import { BOUNDS, MOST_PIECES, type Situation, settle } from "./situation";

/** Writes a situation into an address: numbers in the units of the wire, one name for each part. */
export function writeAddress(address: URL, situation: Situation): void {
  const { pursuer, leader, wind } = situation;
  const set = (name: string, numbers: readonly (number | string)[]) =>
    address.searchParams.set(name, numbers.join(" "));
  clearAddress(address);
  set("own", [
    pursuer.x_m,
    pursuer.y_m,
    pursuer.heading_deg,
    pursuer.tas_mps,
    pursuer.max_bank_deg,
  ]);
  set("leader", [leader.x_m, leader.y_m, leader.heading_deg, leader.tas_mps]);
  set("distances", [situation.slot_distance_m, situation.min_separation_m]);
  if (leader.intent.length > 0) set("intent", leader.intent.map(pieceText));
  if (wind.speed_mps > 0) set("wind", [wind.from_deg, wind.speed_mps]);
}

const NAMES = ["own", "leader", "distances", "intent", "wind"] as const;

export function clearAddress(address: URL): void {
  for (const name of NAMES) address.searchParams.delete(name);
}

/**
 * The situation of an address, or why it has none, in a sentence; null where it does not try. Nothing
 * is brought within bounds: what is wrong would become another situation.
 */
export function readAddress(parameters: URLSearchParams): Situation | string | null {
  if (!NAMES.some((name) => parameters.has(name))) return null;
  const faults: string[] = [];
  const numbers = (name: keyof typeof PARTS): readonly number[] => {
    const text = parameters.get(name);
    const { said, bounds } = PARTS[name];
    if (text === null) {
      if (name !== "wind") faults.push(`${said} ${name === "distances" ? "are" : "is"} missing.`);
      return bounds.map(() => 0);
    }
    const parts = text.trim().split(/\s+/);
    const values = parts.map(Number);
    if (parts.length !== bounds.length || !values.every(Number.isFinite)) {
      faults.push(`${said} is "${text}", and ${bounds.length} numbers are right.`);
      return bounds.map(() => 0);
    }
    values.forEach((value, i) => {
      const bound = bounds[i];
      if (bound !== undefined && outside(value, bound)) faults.push(`${said}: ${bound.say(value)}`);
    });
    return values;
  };
  const [x = 0, y = 0, heading = 0, tas = 0, bank = 0] = numbers("own");
  const [east = 0, north = 0, course = 0, speed = 0] = numbers("leader");
  const [slot = 0, least = 0] = numbers("distances");
  const [from = 0, wind = 0] = numbers("wind");
  const pieces = (parameters.get("intent") ?? "").split(/\s+/).filter((text) => text !== "");
  const intent = pieces.map(pieceOf);
  const wrong = pieces.find((_, i) => intent[i] === null);
  if (wrong !== undefined)
    faults.push(`The intent has "${wrong}", and pieces like 820s or 135R25 are right.`);
  if (pieces.length > MOST_PIECES)
    faults.push(`The intent has ${pieces.length} pieces, and at most ${MOST_PIECES} are right.`);
  if (slot < least)
    faults.push(
      `D is ${formatMiles(slot)} NM, and no less than MIN, ${formatMiles(least)} NM, is right.`,
    );
  if (faults.length > 0) return faults.join(" ");
  return settle({
    pursuer: { x_m: x, y_m: y, heading_deg: heading, tas_mps: tas, max_bank_deg: bank },
    leader: {
      x_m: east,
      y_m: north,
      heading_deg: course,
      tas_mps: speed,
      intent: intent.filter((piece) => piece !== null),
    },
    slot_distance_m: slot,
    min_separation_m: least,
    wind: { from_deg: from, speed_mps: wind },
  });
}

interface Bound {
  readonly range: readonly [number, number];
  /** What is wrong with a value outside, in a sentence. */
  readonly say: (value: number) => string;
}

function bound(range: readonly [number, number], what: string, unit: string, size: number): Bound {
  const text = (value: number) =>
    `${(value / size).toLocaleString("en", { maximumFractionDigits: 1 })}`;
  return {
    range,
    say: (value) =>
      `${what} ${text(value)} ${unit} is refused, ${text(range[0])} to ${text(range[1])} ${unit} is right.`,
  };
}

/** The roundings of what is written are no fault. */
function outside(value: number, { range: [least, most] }: Bound): boolean {
  return value < least - 0.01 || value > most + 0.01;
}

const EAST = bound(BOUNDS.position, "east", "km", 1000);
const NORTH = bound(BOUNDS.position, "north", "km", 1000);
const HEADING = bound([-360, 360], "heading", "°", 1);
const SPEED = bound(BOUNDS.tas, "airspeed", "kt", KT);
const AT_BANK = bound(BOUNDS.bank, "bank", "°", 1);
const LENGTH = [
  bound(BOUNDS.distance, "D", "NM", NM),
  bound(BOUNDS.distance, "MIN", "NM", NM),
] as const;
/** The numbers of an address, in their order. */
const PARTS = {
  own: { said: "Own ship", bounds: [EAST, NORTH, HEADING, SPEED, AT_BANK] },
  leader: { said: "The leader", bounds: [EAST, NORTH, HEADING, SPEED] },
  distances: { said: "The distances", bounds: LENGTH },
  wind: { said: "The wind", bounds: [HEADING, bound(BOUNDS.wind, "speed", "kt", KT)] },
} as const satisfies Record<string, { said: string; bounds: readonly Bound[] }>;

/** "820s": straight for so long; "135R25": a turn right to 135° at 25° of bank. */
function pieceText(piece: IntentPiece): string {
  if ("straight_s" in piece) return `${piece.straight_s}s`;
  const side = piece.direction === "right" ? "R" : "L";
  return `${piece.turn_to_heading_deg}${side}${piece.bank_deg}`;
}

function pieceOf(text: string): IntentPiece | null {
  const straight = text.match(/^(\d+(?:\.\d+)?)s$/);
  if (straight !== null) {
    const duration = Number(straight[1]);
    return duration <= BOUNDS.piece[1] ? { straight_s: duration } : null;
  }
  const turn = text.match(/^(\d+(?:\.\d+)?)([LR])(\d+(?:\.\d+)?)$/);
  const [heading, bank] = [Number(turn?.[1]), Number(turn?.[3])];
  const [least, most] = BOUNDS.bank;
  if (turn === null || heading > 360 || bank < least || bank > most) return null;
  return {
    turn_to_heading_deg: heading,
    direction: turn[2] === "R" ? "right" : "left",
    bank_deg: bank,
  };
}
