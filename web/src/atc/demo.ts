/** The demonstration: five flights on the earth, each of which asks to follow its leader. */

import { createFlight } from "../api";
import { DEG, KT, NM, wrap360 } from "../units";
import type { FlownSituationBody } from "../wire";
import { askClearance } from "./rest";

/** Where the demonstration is: north of the Alps. */
const PLACE = { lat: 48.0, lon: 9.0 } as const;
const LEVEL = 9449;

interface Pair {
  /** Callsigns of the pursuer and its leader. */
  readonly called: readonly [string, string];
  /** The leader: east and north of that place [NM], its heading [deg]. */
  readonly leader: readonly [number, number, number];
  /** The pursuer from there: behind, to the left [NM], and how far it heads to the right of it [deg]. */
  readonly pursuer: readonly [number, number, number];
  /** D [NM]. */
  readonly spacing: number;
  /** Pressure altitude [m]. */
  readonly level: number;
}

/** The second and the third cross; the fifth is above all others. */
const PAIRS: readonly Pair[] = [
  {
    called: ["DLH1AB", "AFR22"],
    leader: [-60, 45, 95],
    pursuer: [9, 8, 25],
    spacing: 6,
    level: LEVEL,
  },
  {
    called: ["BAW342", "KLM61"],
    leader: [-37, -28, 60],
    pursuer: [10, -7, -20],
    spacing: 6,
    level: LEVEL,
  },
  {
    called: ["SWR85", "AUA7"],
    leader: [2, -38, 330],
    pursuer: [9, 8, 25],
    spacing: 7,
    level: LEVEL,
  },
  {
    called: ["IBE3", "TAP418"],
    leader: [75, 62, 200],
    pursuer: [10, -8, -25],
    spacing: 6,
    level: LEVEL,
  },
  {
    called: ["SAS5", "FIN90"],
    leader: [88, -30, 290],
    pursuer: [9, 7, 20],
    spacing: 8,
    level: LEVEL + 610,
  },
];
/** True airspeeds of pursuers and leaders [kt]. */
const FAST = 450;
const SLOW = 400;

/** A place `east` and `north` of the demonstration's [NM]. */
function poseOf(east: number, north: number, heading: number, tas: number, level: number) {
  const lat = PLACE.lat + north / 60;
  return {
    lat_deg: lat,
    lon_deg: PLACE.lon + east / 60 / Math.cos(lat * DEG),
    heading_deg: wrap360(heading),
    tas_mps: tas * KT,
    altitude_m: level,
  };
}

function situationOf({ called, pursuer, leader, spacing, level }: Pair): FlownSituationBody {
  const [[east, north, heading], [behind, left, turned]] = [leader, pursuer];
  const [s, c] = [Math.sin(heading * DEG), Math.cos(heading * DEG)];
  const [x, y] = [east - behind * s - left * c, north - behind * c + left * s];
  return {
    pursuer_ident: called[0],
    leader_ident: called[1],
    pursuer: { ...poseOf(x, y, heading + turned, FAST, level), max_bank_deg: 25 },
    leader: poseOf(east, north, heading, SLOW, level),
    slot_distance_m: spacing * NM,
    min_separation_m: 5 * NM,
  };
}

/** Starts all five, one after the other; answers with why it could not, else with nothing. */
export async function startDemo(say: (sentence: string) => void): Promise<string> {
  for (const [k, pair] of PAIRS.entries()) {
    say(`Starting flight ${k + 1} of ${PAIRS.length} …`);
    const flight = await createFlight({
      situation: situationOf(pair),
      rate: 1,
      engagement: "armed",
    });
    if (flight.kind === "refused") return flight.sentence;
    const asked = await askClearance({ flight_id: flight.value.id });
    if (asked.kind === "refused") return asked.sentence;
  }
  return "";
}
