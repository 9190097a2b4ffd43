/**
 * What is spoken of an instant, for those who do not see it: what holds then, in sentences that stay
 * the same for as long as it holds, since a live region speaks every change of its text.
 */

import { formatMiles, inPageUnits } from "../units";
import type { Alert } from "../wire";
import { closestApproach, timeToJoin } from "./committed";
import { startLower, unableSentence } from "./reading";
import { AGE, GUIDANCE } from "./state-styles";
import {
  age,
  type Guidance,
  guidance,
  isRecent,
  leaderAge,
  NEWS,
  revertedAt,
  separation,
  wasDropped,
} from "./states";
import { isOnOther } from "./traffic";
import type { Message, Moment } from "./types";

export interface Announcements {
  /** When nothing else is being said. */
  readonly polite: string;
  /** At once: what is wrong. */
  readonly assertive: string;
}

/** From this age of the leader's data on it is a caution, until they count as lost [s]. */
const OLD = 5;
/** A loss of separation is still said for so long [s]. */
const HELD = 3;

export function announcementsOf(flight: Moment): Announcements {
  if (flight.now === null) return { polite: "", assertive: "" };
  if (!AGE[age(flight)].guidance)
    return {
      polite: "",
      assertive: "The connection is lost: nothing on the display is up to date.",
    };
  return { polite: politeOf(flight), assertive: assertiveOf(flight) };
}

function politeOf(flight: Moment): string {
  const state = stateSentence(flight, guidance(flight));
  const advice = flight.alerts
    .filter(({ level }) => level === "advisory")
    .map((each) => alertSentence(flight, each));
  return [state, crewSentence(flight), clearanceSentence(flight, false), ...advice]
    .filter((each) => each !== "")
    .join(" ");
}

/** What became of the crew's last order on who flies, or on what guidance is to do. */
function crewSentence({ control, assignment }: Moment): string {
  const isAssigned = (assignment?.t_s ?? 0) > (control?.t_s ?? 0);
  return inPageUnits((isAssigned ? assignment : control)?.message ?? "");
}

/** What air traffic control says: at once where something is wrong. */
function clearanceSentence({ clearance }: Moment, isUrgent: boolean): string {
  if (clearance === null) return "";
  const isWrong = clearance.level === "caution" || clearance.level === "warning";
  return isWrong === isUrgent ? inPageUnits(clearance.message) : "";
}

/** What guidance does, or what the crew can do: of several sentences on one event, one. */
function stateSentence(flight: Moment, state: Guidance): string {
  const ident = flight.started?.leader.ident ?? "The leader";
  switch (state) {
    case "off":
      return flight.engagement?.engagement === "off" ? "Relative guidance is off." : "";
    case "designated":
      return `${ident} is designated: a path to its slot is looked for.`;
    case "proposed":
      return `${proposedSentence(flight)} ${wasDropped(flight) ? "Guidance was engaged: accept, then engage it again." : "Accept it to arm it."}`;
    case "armed":
      return "Accepted. Engage it to fly it.";
    case "converge":
    case "capture":
    case "follow":
      return newest(flight, flight.result === null ? ["plan", "mode", "leader"] : ["end"]);
    case "infeasible":
    case "escape":
    case "unable":
    case "data_lost":
      return "";
  }
}

/** In minutes, so that it does not change with each second in which nothing is accepted. */
function proposedSentence(flight: Moment): string {
  const [left, closest] = [timeToJoin(flight), closestApproach(flight)];
  if (left === null || closest === null) return "A path is proposed.";
  const minutes = Math.max(1, Math.round(left / 60));
  const time = minutes === 1 ? "a minute" : `${minutes} minutes`;
  const least = formatMiles(closest.least);
  return `A path is proposed: joins in about ${time}, least separation ${least} nautical miles.`;
}

function assertiveOf(flight: Moment): string {
  const state = guidance(flight);
  const isByHand = flight.sample?.autopilot === false;
  const sentences: string[] = [];
  const outlook = separation(flight).state;
  const minimum = `${formatMiles(flight.started?.min_separation_m ?? 0)} nautical miles`;
  const wasLost = [flight.belowAt, flight.lost?.t_s].some((t) => isRecent(flight, t, HELD));
  const isLost = outlook === "lost" || wasLost;
  const whose =
    flight.lost !== null && outlook !== "lost" ? otherOf(flight, flight.lost.other) : "";
  if (isLost && whose !== "")
    sentences.push(`Separation from ${whose}: closer than its minimum.${causeOf(flight)}`);
  else if (isLost) sentences.push(`Separation: closer than ${minimum}.${causeOf(flight)}`);
  for (const alert of flight.alerts)
    if (alert.level !== "advisory" && !(isLost && isOfLoss(alert)) && !isSaid(alert, state))
      sentences.push(alertSentence(flight, alert));
  if (clearanceSentence(flight, true) !== "") sentences.push(clearanceSentence(flight, true));
  const seconds = leaderAge(flight);
  if (state === "data_lost")
    sentences.push(
      `Leader data lost: guidance is off, and ${isByHand ? "you fly: hold the heading" : "the autopilot holds the selected heading"}.`,
    );
  else if (seconds > OLD && GUIDANCE[state].designated)
    sentences.push(`Leader data old: nothing heard for more than ${OLD} seconds.`);
  else if (isByHand && isRecent(flight, revertedAt(flight), NEWS))
    sentences.push("Guidance commands no more. You fly: hold the heading.");
  if (state === "escape") sentences.push(newest(flight, ["mode"]));
  const { unavailable, unable } = flight;
  const why = unable !== null ? unableSentence(unable) : unavailable?.answer.message;
  if (why !== undefined && state !== "off" && state !== "data_lost")
    sentences.push(`Unable: ${startLower(inPageUnits(why))}`);
  return sentences.join(" ");
}

/** Whether the state says it already. */
function isSaid({ subject }: Alert, state: Guidance): boolean {
  return subject === "data" && state === "data_lost";
}

/** Whether an alert says of a loss what is said already. */
function isOfLoss({ level, subject }: Alert): boolean {
  return level === "warning" && subject === "separation";
}

/** Why the separation was lost, if that was said of this loss. */
function causeOf({ lost, t }: Moment): string {
  const isThis = lost !== null && t - lost.t_s < OF_THIS_LOSS;
  return isThis ? ` ${inPageUnits(lost.cause)}` : "";
}
const OF_THIS_LOSS = 300;

/** The alert in words, which name whom it is about where that is not the leader. */
function alertSentence(flight: Moment, { message, other }: Alert): string {
  const said = inPageUnits(message);
  const whose = otherOf(flight, other);
  return whose === "" || said.includes(whose) ? said : `${whose}: ${said}`;
}

/** The ident of another aircraft or a cell; "" for the leader's. */
function otherOf(flight: Moment, ident: string): string {
  return isOnOther(flight, ident) ? ident : "";
}

/** The last message of some kinds. */
function newest({ messages }: Moment, kinds: readonly Message["kind"][]): string {
  return messages.find(({ kind }) => kinds.includes(kind))?.text ?? "";
}
