/** The demonstration: five flights on the earth, each of which asks to follow its leader. */

import { createFlight } from "../api";
import { KT, NM } from "../units";
import type { FlownSituationBody, GeodeticPursuer } from "../wire";
import { askClearance } from "./rest";

/** Where the demonstration is: north of the Alps. */
const PLACE = { lat: 48.0, lon: 9.0 } as const;
const LEVEL = 9449;

/** East and north of that place [NM], heading [deg], true airspeed [kt]. */
type Pose = readonly [number, number, number, number];

interface Pair {
  readonly pursuer: Pose;
  readonly leader: Pose;
  /** D [NM]. */
  readonly spacing: number;
  /** Pressure altitude [m]. */
  readonly level: number;
}

/** The second and the third cross; the fifth is above all others. */
const PAIRS: readonly Pair[] = [
  { pursuer: [-70, 22, 100, 450], leader: [-48, 10, 90, 400], spacing: 6, level: LEVEL },
  { pursuer: [-40, -40, 60, 455], leader: [-18, -30, 45, 405], spacing: 6, level: LEVEL },
  { pursuer: [40, -38, 320, 450], leader: [22, -24, 310, 400], spacing: 7, level: LEVEL },
  { pursuer: [30, 45, 200, 445], leader: [20, 25, 180, 395], spacing: 5.5, level: LEVEL },
  { pursuer: [62, 20, 280, 450], leader: [42, 30, 270, 400], spacing: 8, level: LEVEL + 610 },
];

function poseOf(
  [east, north, heading, tas]: Pose,
  level: number,
): Omit<GeodeticPursuer, "max_bank_deg"> {
  const lat = PLACE.lat + north / 60;
  return {
    lat_deg: lat,
    lon_deg: PLACE.lon + east / 60 / Math.cos((lat * Math.PI) / 180),
    heading_deg: heading,
    tas_mps: tas * KT,
    altitude_m: level,
  };
}

function situationOf({ pursuer, leader, spacing, level }: Pair): FlownSituationBody {
  return {
    pursuer: { ...poseOf(pursuer, level), max_bank_deg: 25 },
    leader: poseOf(leader, level),
    slot_distance_m: spacing * NM,
    min_separation_m: 5 * NM,
  };
}

/** Starts all five, one after the other; answers with what is to be said. */
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
  return `${PAIRS.length} flights ask for a clearance.`;
}
