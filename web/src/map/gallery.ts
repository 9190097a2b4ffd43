/** Twelve situations worth a look, as the map lays them out. */

import { KT, NM } from "../units";
import type { IntentPiece } from "../wire";
import { FIRST } from "./first";
import { type Situation, settle } from "./situation";

export interface Entry {
  readonly name: string;
  readonly title: string;
  /** What is to be seen in it. */
  readonly what: string;
  readonly situation: Situation;
  /** Flown as this scenario of the service, as long as it is not changed. */
  readonly scenario?: string;
  /** What the leader flies, where that is not what it declares. */
  readonly flies?: readonly IntentPiece[];
}

interface Lay {
  /** Own ship: NM east and north, heading, kt. */
  readonly own: readonly [number, number, number, number];
  /** The leader's, with what it declares. */
  readonly leader?: readonly [number, number, number, number];
  readonly intent?: readonly IntentPiece[];
  readonly bank?: number;
  readonly d?: number;
  readonly min?: number;
  readonly wind?: readonly [number, number];
}

function lay({
  own,
  leader = [0, 0, 90, 390],
  intent = [],
  bank = 25,
  d = 6,
  min = 5,
  wind = [0, 0],
}: Lay): Situation {
  return {
    pursuer: {
      x_m: own[0] * NM,
      y_m: own[1] * NM,
      heading_deg: own[2],
      tas_mps: own[3] * KT,
      max_bank_deg: bank,
    },
    leader: {
      x_m: leader[0] * NM,
      y_m: leader[1] * NM,
      heading_deg: leader[2],
      tas_mps: leader[3] * KT,
      intent: [...intent],
    },
    traffic: [],
    cells: [],
    slot_distance_m: d * NM,
    min_separation_m: min * NM,
    wind: { from_deg: wind[0], speed_mps: wind[1] * KT },
  };
}

function turnTo(heading: number, direction: "left" | "right", bank = 20): IntentPiece {
  return { turn_to_heading_deg: heading, direction, bank_deg: bank };
}

export const GALLERY: readonly Entry[] = [
  {
    name: "6a",
    title: "Fig. 6a",
    what: "The leader will turn, and has not said so.",
    situation: { ...FIRST, leader: { ...FIRST.leader, intent: [] } },
    scenario: "fig_6a",
  },
  {
    name: "6b",
    title: "Fig. 6b",
    what: "The same leader, and its turn is known.",
    situation: FIRST,
    scenario: "fig_6b",
  },
  {
    name: "limit",
    title: "A limit that binds",
    what: "The direct ways pass too close: this one touches MIN and goes on.",
    situation: lay({ own: [24, -14, 340, 465], d: 5.5 }),
  },
  {
    name: "head-on",
    title: "Head-on",
    what: "Own ship comes towards the leader and turns in behind it.",
    situation: lay({ own: [45, 8, 270, 450] }),
  },
  {
    name: "beside",
    title: "Beside",
    what: "Abreast at the same speed: the only way to fall behind is a longer path.",
    situation: lay({ own: [0, 12, 90, 420] }),
  },
  {
    name: "overtaking",
    title: "Overtaking",
    what: "Ahead of the slot already: round and back into it.",
    situation: lay({ own: [14, -7, 90, 465] }),
  },
  {
    name: "wind",
    title: "Wind",
    what: "80 knots from the north-west: turns become trochoids.",
    situation: lay({
      own: [-25, -20, 20, 450],
      intent: [{ straight_s: 200 }, turnTo(30, "left")],
      wind: [315, 80],
    }),
  },
  {
    name: "slow",
    title: "A slow leader",
    what: "Much faster than the leader, and nearly there: time has to be lost.",
    situation: lay({ own: [-7, 4, 60, 465], leader: [0, 0, 90, 290] }),
  },
  {
    name: "tight",
    title: "A tight corner",
    what: "The leader turns back on its way: the slot opens late.",
    situation: lay({
      own: [-10, 14, 110, 450],
      intent: [{ straight_s: 60 }, turnTo(270, "right", 25)],
    }),
  },
  {
    name: "breaks",
    title: "A broken word",
    what: "It declares a turn to the right, and two minutes on turns left.",
    situation: lay({
      own: [-30, 12, 90, 450],
      intent: [{ straight_s: 400 }, turnTo(150, "right")],
    }),
    flies: [{ straight_s: 120 }, turnTo(40, "left", 25)],
  },
  {
    name: "recorded",
    title: "A recorded leader",
    what: "As flown near Paris, turns and all; it declares nothing.",
    situation: {
      pursuer: {
        x_m: -105_487,
        y_m: -86_097,
        heading_deg: 19.9,
        tas_mps: 202.21,
        max_bank_deg: 25,
      },
      leader: { x_m: -76_480, y_m: -64_682, heading_deg: 19.9, tas_mps: 168.51, intent: [] },
      traffic: [],
      cells: [],
      slot_distance_m: 10_000,
      min_separation_m: 9260,
      wind: { from_deg: 0, speed_mps: 0 },
    },
    scenario: "recorded_leader",
  },
  {
    name: "none",
    title: "No way out",
    what: "Slower than the leader, and behind it: the slot runs away.",
    situation: lay({ own: [-20, 6, 90, 370], leader: [0, 0, 90, 430] }),
  },
];

/** The entry that a situation is, unchanged; null if it is none. */
export function entryOf(situation: Situation): Entry | null {
  const text = JSON.stringify(situation);
  return GALLERY.find((each) => JSON.stringify(settle(each.situation)) === text) ?? null;
}
