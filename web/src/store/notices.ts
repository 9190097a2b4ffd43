/** What the message line says: warnings before cautions before advice, one at a time. */

import { formatClock, formatMiles } from "../units";
import type {
  Alert,
  AlertSubject,
  Mode,
  PlanReason,
  PromiseChanged,
  Reason,
  UnableReason,
} from "../wire";
import type { Colour } from "./colours";
import { AGE, GUIDANCE } from "./state-styles";
import {
  age,
  type Guidance,
  guidance,
  hasLapsed,
  isRecent,
  leaderAge,
  separation,
  wasDropped,
} from "./states";
import { isOnOther } from "./traffic";
import type { Moment } from "./types";

export interface Notice {
  readonly level: "warning" | "caution" | "prompt" | "advice";
  readonly text: string;
}

export const NOTICE_COLOUR: Record<Notice["level"], Colour> = {
  warning: "alert",
  caution: "caution",
  prompt: "selected",
  advice: "label",
};

/** Why guidance is unable, in the words of the panel. */
export const UNABLE: Record<Reason, string> = {
  slot_unreachable: "SPEED",
  separation_already_lost: "SEP",
  separation_unavoidable: "SEP",
  beyond_horizon: "TIME",
  deadline: "TIME",
  traffic: "TRAFFIC",
  level: "LEVEL",
};

/** … and in those of `Unable`. */
const UNABLE_TO: Record<UnableReason, string> = {
  separation: "SEP",
  speed: "SPEED",
  geometry: "PATH",
  envelope: "ENVELOPE",
  data: "DATA",
  traffic: "TRAFFIC",
};

/** What an alert is about; a loss of separation also says when. */
const ALERTED: Record<AlertSubject, string> = {
  separation: "SEP",
  spacing: "SPACING NOT KEPT",
  speed: "LDR SPEED",
  data: "LDR DATA LOST",
  geometry: "LDR PATH",
};

const ALERT_NOTICE: Record<Alert["level"], Notice["level"]> = {
  advisory: "advice",
  caution: "caution",
  warning: "warning",
};
/** The most urgent first. */
const URGENCY: readonly Notice["level"][] = ["warning", "caution", "prompt", "advice"];

const REPLANNED: Record<PlanReason, string> = {
  engaged: "CONV ACTIVE",
  resumed: "CONV RESUMED",
  better_plan: "SHORTER PATH",
  deviation: "OFF PATH – REPLAN",
  separation: "SEP – REPLAN",
  leader_turned: "LDR TURN – REPLAN",
  leader_changed_speed: "LDR SPEED – REPLAN",
  leader_elsewhere: "LDR OFF PATH – REPLAN",
  intent_received: "LDR INTENT – REPLAN",
  intent_withdrawn: "LDR INTENT LOST – REPLAN",
  braking: "WEAK BRAKING – REPLAN",
  traffic: "TRAFFIC – REPLAN",
  assignment_changed: "NEW TASK – REPLAN",
};

const ENTERED: Record<Mode, string> = {
  heading: "RG OFF – HDG",
  converge: "CONV ACTIVE",
  capture: "CAPTURE",
  follow: "FOLLOWING",
  escape: "RG ESCAPE",
};

/** Advice stands this long [s]. */
const SHOWN = 10;
/** A warning stays this long after its cause is gone, so that it does not blink on the edge [s]. */
const HELD = 3;

/** All notices of this moment, the most urgent first. */
export function noticesOf(flight: Moment): readonly Notice[] {
  const notices: Notice[] = [];
  const seen = AGE[age(flight)];
  const isNews = (since: number | undefined) => isRecent(flight, since, SHOWN);
  const isLost = separation(flight).state === "lost" || isHeld(flight);
  if (seen.map && flight.now !== null && isLost)
    notices.push({ level: "warning", text: "SEPARATION" });
  else if (flight.lost !== null && isRecent(flight, flight.lost.t_s, HELD)) {
    const { other } = flight.lost;
    const text = isOnOther(flight, other) ? `SEPARATION ${other}` : "SEPARATION";
    notices.push({ level: "warning", text });
  }
  const seconds = leaderAge(flight);
  const state = guidance(flight);
  if (state === "data_lost") notices.push({ level: "caution", text: "LDR DATA LOST" });
  else if (seen.map && seconds > 5 && seconds <= 24 && GUIDANCE[state].designated)
    notices.push({ level: "caution", text: `LDR DATA ${Math.floor(seconds)} S` });
  if (!seen.guidance || flight.now === null) return notices;
  for (const alert of flight.alerts)
    if (alert.subject !== "data" || state !== "data_lost")
      notices.push({ level: ALERT_NOTICE[alert.level], text: alertText(flight, alert) });
  const { clearance } = flight;
  if (clearance !== null && (clearance.level === "caution" || clearance.level === "warning"))
    notices.push({ level: clearance.level, text: `ATC ${clearance.clearance.toUpperCase()}` });
  const prompt = promptOf(flight, state);
  if (prompt !== null) notices.push(prompt);
  const [unavailable, unable] = [flight.unavailable, flight.unable];
  const isAsked = state !== "off" && state !== "data_lost";
  if (isAsked && unable !== null)
    notices.push({ level: "caution", text: `RG UNABLE: ${UNABLE_TO[unable.reason]}` });
  else if (isAsked && unavailable !== null)
    notices.push({ level: "caution", text: `RG UNABLE: ${UNABLE[unavailable.answer.reason]}` });
  if (flight.sample?.joined === true) {
    const spacing = formatMiles(flight.started?.slot_distance_m ?? 0);
    const text = isNews(flight.joinedAt) ? "JOINED" : `SPACING ${spacing} NM`;
    notices.push({ level: "advice", text });
  }
  const plan = flight.plan;
  if (plan?.announced === true && unavailable === null && isNews(plan.t_s))
    notices.push({ level: "advice", text: REPLANNED[plan.reason] });
  const promise = flight.promise;
  if (promise !== null && unavailable === null && isNews(promise.t_s))
    notices.push({ level: "advice", text: joinText(promise) });
  const mode = flight.mode;
  const isNew = mode !== null && state !== "data_lost" && isNews(mode.t_s);
  if (isNew && !(mode.mode === "converge" && notices.length > 0))
    notices.push({ level: "advice", text: ENTERED[mode.mode] });
  return notices.sort((a, b) => URGENCY.indexOf(a.level) - URGENCY.indexOf(b.level));
}

/** What the crew can do next. */
function promptOf(flight: Moment, state: Guidance): Notice | null {
  switch (state) {
    case "designated": {
      const ident = flight.started?.leader.ident ?? "";
      const reading = flight.now;
      const apart = reading === null ? "" : formatMiles(reading.separation_m);
      return { level: "advice", text: `LDR ${ident} ${apart} NM` };
    }
    case "proposed":
      if (wasDropped(flight)) return { level: "prompt", text: "RG WAS ON – ACCEPT, ENGAGE" };
      if (hasLapsed(flight)) return { level: "prompt", text: "PATH CHANGED – ACCEPT AGAIN" };
      return { level: "prompt", text: "CONV PROPOSED – CONFIRM" };
    case "armed":
      return { level: "prompt", text: "CONV ACCEPTED – ENGAGE" };
    default:
      return null;
  }
}

/** The new time to the join, and what was said before: both as of that moment. */
function joinText({ promised_s, was_s = 0 }: PromiseChanged): string {
  const joins = `JOIN ${formatClock(promised_s)}`;
  return was_s > 0 ? `${joins} WAS ${formatClock(was_s)}` : joins;
}

/** Whether the separation was lost a moment ago. */
function isHeld(flight: Moment): boolean {
  return isRecent(flight, flight.belowAt, HELD);
}

function alertText(flight: Moment, alert: Alert): string {
  const other = isOnOther(flight, alert.other) ? alert.other : null;
  const about = other === null ? "" : `${other} `;
  if (alert.subject !== "separation")
    return other === null
      ? ALERTED[alert.subject]
      : about + ALERTED[alert.subject].replace("LDR ", "");
  const within = Math.max(0, Math.round(alert.predicted_at_s - flight.t));
  return `${ALERTED.separation} ${about}IN ${within} S`;
}
