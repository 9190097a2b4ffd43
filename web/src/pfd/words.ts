/** What the instrument says to those who do not see it: how to follow the bars, and how own ship flies. */

import { formatBank, formatHeading, formatKnots, formatLevel } from "../units";
import type { Bars } from "../wire";
import type { Attitude } from "./attitude";

/** As near to the command it is followed [deg of bank, of path]. */
const FOLLOWED = { roll: 3, pull: 0.5 } as const;
/** So little bank is none [deg]. */
const LEVEL = 1.5;
/** What is said stands at least so long [ms]: no ear follows more. */
const STANDS = 4000;

/** How to follow the bars: "Fly right, 12° of bank." */
export function barWords({ roll_deg, pitch_deg, commanded_bank_deg: bank }: Bars): string {
  const said: string[] = [];
  if (Math.abs(roll_deg) > FOLLOWED.roll) {
    const side = bank > 0 ? "right" : "left";
    said.push(
      Math.abs(bank) < LEVEL
        ? "Wings level."
        : `Fly ${side}, ${Math.abs(Math.round(bank))}° of bank.`,
    );
  }
  if (Math.abs(pitch_deg) > FOLLOWED.pull) said.push(pitch_deg > 0 ? "Pull up." : "Push down.");
  return said.length === 0 ? "On the bars." : said.join(" ");
}

/** The instrument in words. */
export function attitudeWords(attitude: Attitude): string {
  const bank = formatBank(attitude.bank);
  const nose = Math.round(attitude.pitch);
  const [speed, level] = [formatKnots(attitude.tas), formatLevel(attitude.altitude)];
  return [
    `Primary flight display: bank ${bank === "0" ? "level" : bank.replace("R", "right").replace("L", "left")},`,
    `pitch ${nose} degrees, ${speed} knots, ${level}, heading ${formatHeading(attitude.heading)}.`,
  ].join(" ");
}

/** Says the newest of what it is given, none sooner than the ear has followed the one before. */
export function createSpeaker(): (words: string, wall: number) => string {
  let said = "";
  let saidAt = Number.NEGATIVE_INFINITY;
  return (words, wall) => {
    if (words !== said && wall - saidAt >= STANDS) {
      said = words;
      saidAt = wall;
    }
    return said;
  };
}
