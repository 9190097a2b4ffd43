/** The picture in words, for those who do not see it: as often as numbers are read. */

import { formatHeading } from "../units";
import type { Numbers } from "./numbers";
import { AGE } from "./state-styles";
import { age, type Guidance, guidance, separation } from "./states";
import type { Moment } from "./types";

const STATE_WORDS: Partial<Record<Guidance, string>> = {
  designated: "Leader designated, a path is looked for.",
  proposed: "A path is proposed: accept it to arm it.",
  armed: "The path is accepted: engage it to fly it.",
  infeasible: "There is no path to propose.",
  unable: "No plan available.",
  data_lost: "The leader's data are lost.",
};

const MODE_WORDS = {
  heading: "holding heading",
  converge: "converging",
  capture: "capturing the leader's route",
  follow: "following the leader",
  escape: "turning away to keep the separation",
} as const;

export function describe(flight: Moment, numbers: Numbers): string {
  const seen = AGE[age(flight)];
  const now = flight.now;
  if (!seen.map || now === null) return "Map not available.";
  const leader = flight.started?.leader.ident ?? "the leader";
  const parts = [
    `Own ship ${MODE_WORDS[now.mode]}, heading ${formatHeading(now.pursuer.heading_deg)}.`,
  ];
  if (numbers.sample !== null)
    parts.push(
      `Leader ${leader} bearing ${numbers.leaderBearing}, ${numbers.separation} nautical miles.`,
    );
  if (numbers.toJoin !== "" && numbers.least !== null)
    parts.push(`Slot in ${numbers.toJoin}, least separation ${numbers.least.miles}.`);
  const state = STATE_WORDS[guidance(flight)];
  if (state !== undefined) parts.push(state);
  if (flight.route?.intent_known === false) parts.push("Leader's intent unknown.");
  if (now.joined) parts.push("Joined.");
  const outlook = separation(flight).state;
  if (outlook === "lost") parts.push("Warning: separation lost.");
  if (outlook === "predicted") parts.push("Caution: loss of separation predicted.");
  if (seen.flag !== "") parts.push("Caution: data old.");
  return parts.join(" ");
}
