/** What one document changes of what is known: a fold over all documents but the samples. */

import { inPageUnits } from "../units";
import type { Alert, Document, EngagementChanged, PlanChanged } from "../wire";
import { isAbout, type PairCard, pairCard, pairResult } from "./pair";
import { startLower, unableSentence } from "./reading";
import type { Known, Message } from "./types";

const MESSAGES_KEPT = 200;

/** Before the first document. */
export const NOTHING_KNOWN: Known = {
  started: null,
  route: null,
  plan: null,
  promise: null,
  proposal: null,
  forecast: null,
  fan: null,
  superseded: null,
  unavailable: null,
  alerts: [],
  unable: null,
  lost: null,
  mode: null,
  engagement: null,
  control: null,
  assignment: null,
  clearance: null,
  result: null,
  messages: [],
};

/** What is known after one more document. */
export function reduce(known: Known, document: Document): Known {
  if (document.kind === "flight_started") return { ...NOTHING_KNOWN, started: pairCard(document) };
  const pair = known.started;
  if (pair === null || !isAbout(document, pair)) return known;
  const after = take(known, document, pair);
  const message = messageOf(document);
  if (message === null) return after;
  return { ...after, messages: [message, ...after.messages].slice(0, MESSAGES_KEPT) };
}

function take(known: Known, document: Document, pair: PairCard): Known {
  switch (document.kind) {
    case "leader_route":
      return { ...known, route: document };
    case "plan_changed":
      return takePlan(known, document);
    case "plan_unavailable":
      return { ...known, unavailable: document, proposal: null };
    case "plan_proposed":
      return { ...known, proposal: document, unavailable: null, unable: null };
    case "engagement_changed":
      return takeEngagement(known, document);
    case "control_changed":
      return { ...known, control: document };
    case "assignment_changed": {
      const { slot_distance_m, min_separation_m } = document;
      const started = { ...pair, slot_distance_m, min_separation_m };
      return { ...known, started, assignment: document };
    }
    case "clearance_news":
      return { ...known, clearance: document };
    case "mode_changed":
      return { ...known, mode: document };
    case "promise_changed":
      return { ...known, promise: document };
    case "alert":
      return takeAlert(known, document);
    case "unable":
      return { ...known, unable: document };
    case "separation_lost":
      return { ...known, lost: document };
    case "forecast_changed":
      return { ...known, forecast: document };
    case "fan_changed":
      return { ...known, fan: document.joins.length > 0 ? document : null };
    case "flight_ended":
      return { ...known, result: pairResult(document, pair) };
    case "flight_started":
    case "leader_changed":
    case "plan_refused":
    case "command_given":
    case "sample":
      return known;
  }
}

/** The line of the log that a document makes; null if it makes none. */
export function messageOf(document: Document): Message | null {
  const t = document.t_s;
  const say = (kind: Message["kind"], said: string) => ({ t, kind, text: inPageUnits(said) });
  switch (document.kind) {
    case "leader_changed":
      return say("leader", document.message);
    case "plan_changed":
      return document.announced ? say("plan", document.message) : null;
    case "plan_unavailable":
      return say("no_plan", document.answer.message);
    case "engagement_changed": {
      const isRefused = document.engagement === document.previous;
      return say(isRefused ? "refused" : "engagement", document.message);
    }
    case "control_changed":
    case "assignment_changed":
      return say("engagement", document.message);
    case "clearance_news":
      return say("clearance", document.message);
    case "plan_refused":
      return say("refused", document.message);
    case "mode_changed":
      return say("mode", document.message);
    case "promise_changed":
      return say("plan", document.message);
    case "alert":
      return say(document.cleared ? "clear" : document.level, document.message);
    case "unable":
      return say("unable", unableSentence(document));
    case "separation_lost":
      return say("lost", `Separation: ${startLower(document.cause)}`);
    case "flight_ended":
      return say("end", document.message);
    case "flight_started":
    case "leader_route":
    case "plan_proposed":
    case "forecast_changed":
    case "fan_changed":
    case "command_given":
    case "sample":
      return null;
  }
}

function takePlan(known: Known, changed: PlanChanged): Known {
  const { plan: before, unavailable } = known;
  const isNews = changed.announced && before !== null && unavailable === null;
  return {
    ...known,
    superseded: isNews ? { plan: before, at: changed.t_s } : known.superseded,
    plan: changed,
    unavailable: null,
    unable: null,
    // what is not announced says nothing, so that what was said last still holds
    promise: changed.announced ? null : known.promise,
  };
}

function takeEngagement(known: Known, changed: EngagementChanged): Known {
  const said = { ...known, engagement: changed };
  if (changed.engagement === changed.previous) return said; // refused
  const steps = [changed.previous, changed.engagement];
  if (steps.includes("armed") && steps.includes("designated")) return said; // the proposal stands
  const cleared = { ...said, proposal: null, unavailable: null };
  if (changed.previous !== "engaged") return cleared;
  // What was flown is over, and what stood in its way with it.
  const unable = said.unable?.reason === "data" ? said.unable : null;
  return { ...cleared, plan: null, superseded: null, unable };
}

function takeAlert(known: Known, alert: Alert): Known {
  const others = known.alerts.filter(
    (each) => each.subject !== alert.subject || each.other !== alert.other,
  );
  return { ...known, alerts: alert.cleared ? others : [...others, alert] };
}
