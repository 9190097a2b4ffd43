/** What the mode strip says in words: what became of an order, who commands the speed, who flies. */

import type { ClearanceStatus } from "../wire";
import { type GuidanceStyle, PILOT } from "./state-styles";
import { commandsSpeed, type Guidance, isRecent, NEWS, pilot, revertedAt } from "./states";
import type { Moment } from "./types";

/** What became of the crew's last order, or of the manoeuvre that was sent to air traffic control: a word first. */
export type Order = "" | `${OrderWord}${"" | ` ${string}`}`;
export type OrderWord =
  | "SENT"
  | "ACCEPTED"
  | "REJECTED"
  | "STANDBY"
  | "VALIDATED"
  | "UNABLE"
  | "WILCO"
  | "CLEARED"
  | "DEVIATING"
  | "ENDED";

/** Who commands the speed now, and who will; boxed for a while once that has changed. */
export interface SpeedWords {
  readonly now: string;
  readonly next: string;
  /** Whether the crew has selected it in place of guidance. */
  readonly isSelected: boolean;
  readonly boxed: boolean;
}

/** Who flies; boxed for a while once that has changed, in amber where the crew did not ask for it. */
export interface PilotWords {
  readonly now: string;
  readonly next: string;
  readonly boxed: boolean;
  readonly isLost: boolean;
}

export function speedOf(flight: Moment, style: GuidanceStyle | null): SpeedWords {
  const { sample, before, plan, assignment } = flight;
  if (style === null || sample === null)
    return { now: "", next: "", isSelected: false, boxed: false };
  const isSelected = (assignment?.selected_tas_mps.length ?? 0) > 0;
  const isCommanded = !isSelected && commandsSpeed(sample, plan);
  const wasCommanded = before !== null && commandsSpeed(before, plan);
  return {
    now: isCommanded ? "RG SPD" : "SPD",
    next: isCommanded || isSelected ? "" : style.speedNext,
    isSelected,
    boxed: isSelected
      ? isRecent(flight, assignment?.t_s, NEWS)
      : before !== null && isCommanded !== wasCommanded,
  };
}

export function pilotOf(flight: Moment, style: GuidanceStyle | null): PilotWords {
  const { sample, before } = flight;
  if (style === null || sample === null) return { now: "", next: "", boxed: false, isLost: false };
  const flies = pilot(sample);
  const isLost = flies === "director" && isRecent(flight, revertedAt(flight), NEWS);
  const boxed = isLost || (before !== null && pilot(before) !== flies);
  return { ...PILOT[flies], boxed, isLost };
}

export function orderOf(flight: Moment, state: Guidance): Order {
  if (flight.isSent) return "SENT";
  const answer = flight.engagement;
  const since = answer === null ? Number.POSITIVE_INFINITY : flight.t - answer.t_s;
  if (answer?.engagement === answer?.previous && since < NEWS) return "REJECTED";
  return clearanceText(flight, state) || (state === "armed" ? "ACCEPTED" : "");
}

const CLEARANCE: Record<ClearanceStatus, OrderWord> = {
  sent: "SENT",
  standby: "STANDBY",
  validated: "VALIDATED",
  unable: "UNABLE",
  wilco: "WILCO",
  flying: "CLEARED",
  deviating: "DEVIATING",
  over: "ENDED",
};

/** What air traffic control says; it is said while there is something to be flown, and what is over for a while. */
function clearanceText({ clearance, t }: Moment, state: Guidance): Order {
  if (clearance === null || state === "off") return "";
  if (clearance.clearance === "over" && t - clearance.t_s > NEWS) return "";
  const { automated, reason = "" } = clearance;
  const about = SHORT[reason] ?? (automated ? "AUTO" : reason.toUpperCase());
  const word = CLEARANCE[clearance.clearance];
  return about === "" ? word : `${word} ${about}`;
}

/** Reasons that are too long for the column, and those that say nothing new there. */
const SHORT: Readonly<Record<string, string>> = {
  separation: "TRAFFIC",
  traffic_without_intent: "TRAFFIC",
  stale_picture: "DATA",
  leader_disagrees: "LDR INTENT",
  slot_taken: "SLOT",
  horizon: "TIME",
  conformance: "",
  controller: "",
  crew: "",
};
