/** What one document changes of what is known: a fold over all documents but the samples. */

import { inPageUnits } from "../units";
import type {
  Alert,
  Document,
  EngagementChanged,
  FlightStarted,
  PlanChanged,
  Unable,
} from "../wire";
import { isAbout, pairCard, pairResult } from "./pair";
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
  superseded: null,
  unavailable: null,
  alerts: [],
  unable: null,
  lost: null,
  mode: null,
  engagement: null,
  result: null,
  messages: [],
};

/** What is known after one more document. */
export function reduce(known: Known, document: Document): Known {
  if (document.kind === "flight_started") return begin(document);
  const pair = known.started;
  if (pair === null || !isAbout(document, pair)) return known;
  const t = document.t_s;
  switch (document.kind) {
    case "leader_route":
      return { ...known, route: document };
    case "leader_changed":
      return log(known, { t, kind: "leader", text: document.message });
    case "plan_changed":
      return reducePlan(known, document);
    case "plan_unavailable":
      return log(
        { ...known, unavailable: document, proposal: null },
        { t, kind: "no_plan", text: document.answer.message },
      );
    case "plan_proposed":
      return { ...known, proposal: document, unavailable: null, unable: null };
    case "engagement_changed":
      return reduceEngagement(known, document);
    case "plan_refused":
      return log(known, { t, kind: "refused", text: document.message });
    case "mode_changed":
      return log({ ...known, mode: document }, { t, kind: "mode", text: document.message });
    case "promise_changed":
      return log({ ...known, promise: document }, { t, kind: "plan", text: document.message });
    case "alert":
      return reduceAlert(known, document);
    case "unable":
      return log({ ...known, unable: document }, { t, kind: "unable", text: sentenceOf(document) });
    case "separation_lost":
      return log(
        { ...known, lost: document },
        { t, kind: "lost", text: `Separation: ${startLower(document.cause)}` },
      );
    case "forecast_changed":
      return { ...known, forecast: document };
    case "sample":
      return known;
    case "flight_ended": {
      const result = pairResult(document, pair);
      if (result === null) return known;
      return log({ ...known, result }, { t, kind: "end", text: document.message });
    }
  }
}

function begin(started: FlightStarted): Known {
  return { ...NOTHING_KNOWN, started: pairCard(started) };
}

function reducePlan(known: Known, changed: PlanChanged): Known {
  const { plan: before, unavailable } = known;
  const isNews = changed.announced && before !== null && unavailable === null;
  const planned = {
    ...known,
    superseded: isNews ? { plan: before, at: changed.t_s } : known.superseded,
    plan: changed,
    unavailable: null,
    unable: null,
    promise: null,
  };
  if (!changed.announced) return planned;
  return log(planned, { t: changed.t_s, kind: "plan", text: changed.message });
}

function reduceEngagement(known: Known, changed: EngagementChanged): Known {
  const isRefused = changed.engagement === changed.previous;
  const kind = isRefused ? "refused" : "engagement";
  const said = log(
    { ...known, engagement: changed },
    { t: changed.t_s, kind, text: changed.message },
  );
  if (isRefused) return said;
  const steps = [changed.previous, changed.engagement];
  if (steps.includes("armed") && steps.includes("designated")) return said; // the proposal stands
  const cleared = { ...said, proposal: null, unavailable: null };
  if (changed.previous !== "engaged") return cleared;
  // What was flown is over, and what stood in its way with it.
  const unable = said.unable?.reason === "data" ? said.unable : null;
  return { ...cleared, plan: null, superseded: null, unable };
}

function reduceAlert(known: Known, alert: Alert): Known {
  const others = known.alerts.filter(
    (each) => each.subject !== alert.subject || each.other !== alert.other,
  );
  const alerts = alert.cleared ? others : [...others, alert];
  const kind = alert.cleared ? "clear" : alert.level;
  return log({ ...known, alerts }, { t: alert.t_s, kind, text: alert.message });
}

/** Why guidance is unable, without the word that stands beside it. */
function sentenceOf({ message }: Unable): string {
  const sentence = message.replace(/^Unable: /, "");
  return sentence.charAt(0).toUpperCase() + sentence.slice(1);
}

function startLower(sentence: string): string {
  return sentence.charAt(0).toLowerCase() + sentence.slice(1);
}

function log(known: Known, { t, kind, text: said }: Message): Known {
  const message = { t, kind, text: inPageUnits(said) };
  return { ...known, messages: [message, ...known.messages].slice(0, MESSAGES_KEPT) };
}
