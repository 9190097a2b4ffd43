/** A situation as a link: written into the address of the page, and read from it. */

import { formatMiles, KT, NM } from "../units";
import type { IntentPiece } from "../wire";
import {
  BOUNDS,
  type MapCell,
  type MapTraffic,
  MOST_PIECES,
  type Situation,
  settle,
} from "./situation";

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
  if (pursuer.altitude_m != null || leader.altitude_m != null)
    set("levels", [pursuer.altitude_m ?? UNKNOWN, leader.altitude_m ?? UNKNOWN]);
  for (const each of situation.traffic) {
    const { x_m, y_m, heading_deg, tas_mps, altitude_m, min_separation_m, intent } = each;
    const numbers = [x_m, y_m, heading_deg, tas_mps];
    const open = [altitude_m ?? UNKNOWN, min_separation_m ?? UNKNOWN];
    const words = [nameText(each.ident), ...numbers, ...open, ...intent.map(pieceText)];
    address.searchParams.append("traffic", words.join(" "));
  }
  for (const { ident, x_m, y_m, radius_m, east_mps, north_mps, growth_mps } of situation.cells) {
    const numbers = [x_m, y_m, radius_m, east_mps, north_mps, growth_mps];
    address.searchParams.append("cell", [nameText(ident), ...numbers].join(" "));
  }
}

const NAMES = [
  "own",
  "leader",
  "distances",
  "intent",
  "wind",
  "levels",
  "traffic",
  "cell",
] as const;
/** Stands for a level that is not known, and for a minimum that is the situation's. */
const UNKNOWN = "-";

/** A name in one word, and back. */
function nameText(ident: string): string {
  return ident.replaceAll(" ", "_");
}

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
  const [ownLevel, leaderLevel] = (parameters.get("levels") ?? `${UNKNOWN} ${UNKNOWN}`)
    .trim()
    .split(/\s+/)
    .map((text) => levelOf(text, faults));
  const traffic = parameters.getAll("traffic").flatMap((text) => trafficOf(text, faults));
  const cells = parameters.getAll("cell").flatMap((text) => cellOf(text, faults));
  if (slot < least)
    faults.push(
      `D is ${formatMiles(slot)} NM, and no less than MIN, ${formatMiles(least)} NM, is right.`,
    );
  if (faults.length > 0) return faults.join(" ");
  return settle({
    pursuer: {
      x_m: x,
      y_m: y,
      heading_deg: heading,
      tas_mps: tas,
      max_bank_deg: bank,
      ...ownLevel,
    },
    leader: {
      x_m: east,
      y_m: north,
      heading_deg: course,
      tas_mps: speed,
      intent: intent.filter((piece) => piece !== null),
      ...leaderLevel,
    },
    traffic,
    cells,
    slot_distance_m: slot,
    min_separation_m: least,
    wind: { from_deg: from, speed_mps: wind },
  });
}

type Level = { readonly altitude_m?: number };

function levelOf(text: string, faults: string[]): Level {
  if (text === UNKNOWN) return {};
  const fault = faultOf(text, LEVEL);
  if (fault !== "") faults.push(`The levels: ${fault}`);
  return { altitude_m: Number(text) };
}

/** One other aircraft; none, with a fault noted, where it is not to be read. */
function trafficOf(text: string, faults: string[]): MapTraffic[] {
  const [name = "", ...words] = text.trim().split(/\s+/);
  const [x, y, heading, tas, level = "", least = "", ...pieces] = words;
  const bounds = [EAST, NORTH, HEADING, SPEED] as const;
  const found = [x, y, heading, tas].map((word, k) => faultOf(word, bounds[k] ?? EAST));
  if (level !== UNKNOWN) found.push(faultOf(level, LEVEL));
  if (least !== UNKNOWN) found.push(faultOf(least, LENGTH[1]));
  const intent = pieces.map(pieceOf);
  const wrong = pieces.find((_, k) => intent[k] === null);
  if (wrong !== undefined) found.push(`"${wrong}" is no piece like 820s or 135R25.`);
  const fault = found.find((each) => each !== "");
  if (fault !== undefined) faults.push(`Traffic ${name}: ${fault}`);
  if (fault !== undefined) return [];
  return [
    {
      ident: name.replaceAll("_", " "),
      x_m: Number(x),
      y_m: Number(y),
      heading_deg: Number(heading),
      tas_mps: Number(tas),
      intent: intent.filter((piece) => piece !== null),
      ...(level !== UNKNOWN && { altitude_m: Number(level) }),
      ...(least !== UNKNOWN && { min_separation_m: Number(least) }),
    },
  ];
}

function cellOf(text: string, faults: string[]): MapCell[] {
  const [name = "", ...words] = text.trim().split(/\s+/);
  const bounds = [EAST, NORTH, RADIUS, DRIFT, DRIFT, GROWTH] as const;
  const fault = bounds.map((each, k) => faultOf(words[k], each)).find((each) => each !== "");
  if (fault !== undefined || words.length !== bounds.length) {
    faults.push(`Cell ${name}: ${fault ?? `${bounds.length} numbers are right.`}`);
    return [];
  }
  const [x_m = 0, y_m = 0, radius_m = 0, east_mps = 0, north_mps = 0, growth_mps = 0] =
    words.map(Number);
  const ident = name.replaceAll("_", " ");
  return [{ ident, x_m, y_m, radius_m, east_mps, north_mps, growth_mps }];
}

/** What is wrong with a number of an address, in a sentence; empty if nothing is. */
function faultOf(word: string | undefined, bound: Bound): string {
  const value = Number(word);
  if (word === undefined || word === "") return "a number is missing.";
  if (!Number.isFinite(value)) return `"${word}" is no number.`;
  return outside(value, bound) ? bound.say(value) : "";
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
const LEVEL = bound(BOUNDS.altitude, "level", "m", 1);
const RADIUS = bound(BOUNDS.radius, "radius", "NM", NM);
const DRIFT = bound(BOUNDS.drift, "velocity", "m/s", 1);
const GROWTH = bound(BOUNDS.growth, "growth", "m/s", 1);
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

/**
 * "820s": straight for so long; "135R25": a turn right to 135° at 25° of bank; "9449m8cas": to a level at
 * so many metres a second, with what is held meanwhile where that is said.
 */
function pieceText(piece: IntentPiece): string {
  if ("straight_s" in piece) return `${piece.straight_s}s`;
  if ("level_change" in piece) {
    const { to_altitude_m, rate_mps, hold = "" } = piece.level_change;
    return `${to_altitude_m}m${rate_mps}${hold}`;
  }
  const side = piece.direction === "right" ? "R" : "L";
  return `${piece.turn_to_heading_deg}${side}${piece.bank_deg}`;
}

function pieceOf(text: string): IntentPiece | null {
  const straight = text.match(/^(\d+(?:\.\d+)?)s$/);
  if (straight !== null) {
    const duration = Number(straight[1]);
    return duration <= BOUNDS.piece[1] ? { straight_s: duration } : null;
  }
  const level = text.match(/^(-?\d+(?:\.\d+)?)m(\d+(?:\.\d+)?)(cas|mach|tas)?$/);
  if (level !== null) {
    const [to, rate] = [Number(level[1]), Number(level[2])];
    if (outside(to, LEVEL) || rate < BOUNDS.rate[0] || rate > BOUNDS.rate[1]) return null;
    const hold = level[3] as "cas" | "mach" | "tas" | undefined;
    return { level_change: { to_altitude_m: to, rate_mps: rate, ...(hold && { hold }) } };
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
