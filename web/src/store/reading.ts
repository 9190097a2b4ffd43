/** The texts of the numbers beside the picture, from plan and sample: plain functions, no DOM. */

import { formatClock, formatHeading, formatKnots, formatMiles, NM } from "../units";
import type { Alternative, OptimalityCard, PlanCard, ReferenceCard, Unable } from "../wire";
import type { Guidance } from "./states";

export function countTurns(plan: PlanCard): number {
  return plan.segments.filter((segment) => segment.kind === "turn").length;
}

/** A path's word, letter by letter: "straight, right, straight, right". */
export function wordTitle(word: string): string {
  const letters: Readonly<Record<string, string>> = {
    S: "straight",
    L: "left",
    R: "right",
    B: "along the minimum",
  };
  return [...word].map((letter) => letters[letter] ?? letter).join(", ");
}

export const STATE_NAMES: Record<Guidance, string> = {
  off: "Off",
  designated: "Leader designated",
  proposed: "Proposed",
  armed: "Armed",
  converge: "Converge",
  capture: "Capture",
  follow: "Follow",
  escape: "Escape",
  infeasible: "Not feasible",
  unable: "Unable",
  data_lost: "Leader data lost",
};

const PLANNER_NAMES: Readonly<Record<string, string>> = {
  exact: "Exact",
  network: "Network",
  regular_dp: "Regular DP",
};

/** Who made a plan; a planner of somebody's own is shown by the name it gives itself. */
export function plannerName(planner: string): string {
  return PLANNER_NAMES[planner] ?? planner;
}

/** What is proved of the plan's time, in a sentence. */
export function proofSentence(optimality: OptimalityCard, time: number): string {
  switch (optimality.proof) {
    case "relaxation":
      return "Optimal: no path is faster, even without the minimum separation.";
    case "certified":
      return "Optimal: no path that keeps the minimum separation is faster by more than 0.1 s.";
    case "bound":
      return `At most ${formatClock(time - optimality.lower_bound_s)} above the optimum: no path is faster than ${formatClock(optimality.lower_bound_s)}.`;
    case "none":
      if (optimality.lower_bound_s < 1)
        return "The optimum is not proved; the plan keeps the minimum separation.";
      return `The optimum is not proved; no path is faster than ${formatClock(optimality.lower_bound_s)}.`;
  }
}

/** Why an alternative is not flown, short enough for one line of the list. */
export function alternativeSentence(alternative: Alternative, plan: PlanCard): string {
  switch (alternative.rejected) {
    case "separation": {
      const { least_separation_m, at_s, ident } = alternative;
      if (least_separation_m < 0 && ident !== undefined)
        return `${formatMiles(-least_separation_m)} NM inside ${ident} at ${formatClock(at_s)}`;
      const least = milesBelow(least_separation_m);
      return `only ${least} NM${ident === undefined ? "" : ` to ${ident}`} at ${formatClock(at_s)}`;
    }
    case "slower":
      return formatDelay(alternative.time_to_converge_s - plan.time_to_converge_s);
    case "not_open":
      return `slot opens ${formatClock(alternative.release_time_s)}`;
    case "no_root":
      return "no such path";
    case "as_fast":
    case "faster":
      return alternative.why;
  }
}

/** When an alternative would arrive; a dash for a word without a path to the slot. */
export function alternativeTime(alternative: Alternative): string {
  if (alternative.rejected === "no_root") return "–";
  return formatClock(alternative.time_to_converge_s);
}

/** A separation below the minimum, rounded down so that it never reads as the minimum [NM]. */
function milesBelow(distance: number): string {
  return (Math.floor((distance / NM) * 10) / 10).toFixed(1);
}

/** How much later: in seconds below two minutes, else as mm:ss. */
function formatDelay(time: number): string {
  if (time >= 120) return `+${formatClock(time)}`;
  return `+${time < 10 ? time.toFixed(1) : Math.round(time)} s`;
}

/** What guidance asks of the autopilot. */
export function referenceText(reference: ReferenceCard): string {
  if (reference.kind === "hold_heading") return `HDG ${formatHeading(reference.heading_deg)}`;
  const rate = reference.turn_rate_degps;
  if (Math.abs(rate) < 0.05) return "TURN 0.0°/s";
  return `TURN ${Math.abs(rate).toFixed(1)}°/s ${rate > 0 ? "R" : "L"}`;
}

/** Distance to the slot along the route, and whether it is still behind or ahead. `error` [m] */
export function spacingText(error: number): string {
  const miles = formatMiles(Math.abs(error), 2);
  return miles === "0.00" ? "0.00 NM" : `${miles} NM ${error > 0 ? "behind" : "ahead"}`;
}

/** Offset from the leader's route [m], positive to its right. */
export function crossTrackText(offset: number): string {
  const miles = formatMiles(Math.abs(offset), 2);
  return miles === "0.00" ? "0.00 NM" : `${miles} NM ${offset > 0 ? "R" : "L"}`;
}

/** How fast the separation shrinks or grows. `closure` [m/s], positive when it shrinks. */
export function closureText(closure: number): string {
  const knots = formatKnots(Math.abs(closure));
  if (knots === "0") return "steady";
  return `${closure > 0 ? "closing" : "opening"} ${knots} kt`;
}

/** Why guidance is unable, without the word that stands beside it. */
export function unableSentence({ message }: Pick<Unable, "message">): string {
  const sentence = message.replace(/^Unable: /, "");
  return sentence.charAt(0).toUpperCase() + sentence.slice(1);
}

/** A sentence that goes on another one; a name it begins with stays as it is. */
export function startLower(sentence: string): string {
  return sentence.replace(/^[A-Z](?=[a-z ])/, (first) => first.toLowerCase());
}
