/** What one document changes of what the display knows. */

import { inPageUnits } from "../units";
import type {
  Alert,
  Document,
  EngagementChanged,
  FlightStarted,
  PlanChanged,
  Unable,
} from "../wire";
import { moveAircraft } from "./motion";
import { isAbout, type PairSample, pairCard, pairResult, pairSample } from "./pair";
import { appendTrail } from "./trail";
import type { Flight, Message } from "./types";

/** The previous plan stays visible this long [ms]. */
const SUPERSEDED_SHOWN = 3000;
const MESSAGES_KEPT = 200;

/** How a document came. */
export interface Arrival {
  /** With all that a late joiner is given, so that it is no news. */
  readonly joining: boolean;
  /** When it came [ms]. */
  readonly wall: number;
  /** When it happened by the wall clock, going by the tick's rate [ms]. */
  readonly since: number;
}

/** Takes in one document. */
export function reduce(flight: Flight, document: Document, arrival: Arrival): void {
  if (document.kind === "flight_started") {
    begin(flight, document);
    return;
  }
  const pair = flight.started.value;
  if (pair === null || !isAbout(document, pair)) return;
  const t = document.t_s;
  switch (document.kind) {
    case "leader_route":
      flight.route.value = document;
      return;
    case "leader_changed":
      log(flight, { t, kind: "leader", text: document.message });
      return;
    case "plan_changed":
      reducePlan(flight, document, arrival);
      return;
    case "plan_unavailable":
      flight.unavailable.value = document;
      flight.proposal.value = null;
      log(flight, { t, kind: "no_plan", text: document.answer.message });
      return;
    case "plan_proposed":
      flight.proposal.value = document;
      flight.unavailable.value = null;
      flight.unable.value = null;
      return;
    case "engagement_changed":
      reduceEngagement(flight, document);
      return;
    case "plan_refused":
      log(flight, { t, kind: "refused", text: document.message });
      return;
    case "mode_changed":
      flight.mode.value = document;
      flight.modeSince.value = arrival.since;
      log(flight, { t, kind: "mode", text: document.message });
      return;
    case "promise_changed":
      flight.promise.value = document;
      log(flight, { t, kind: "plan", text: document.message });
      return;
    case "alert":
      reduceAlert(flight, document);
      return;
    case "unable":
      flight.unable.value = document;
      log(flight, { t, kind: "unable", text: sentenceOf(document) });
      return;
    case "separation_lost":
      flight.lost.value = document;
      flight.lostSince.value = arrival.since;
      log(flight, { t, kind: "lost", text: `Separation: ${startLower(document.cause)}` });
      return;
    case "forecast_changed":
      flight.forecast.value = document;
      return;
    case "sample": {
      const sample = pairSample(document, pair);
      if (sample !== null) reduceSample(flight, sample, arrival);
      return;
    }
    case "flight_ended": {
      const result = pairResult(document, pair);
      flight.ended.value = result;
      if (result !== null) log(flight, { t, kind: "end", text: document.message });
      return;
    }
  }
}

/** Also the first document for a late joiner or a reconnected page: what holds comes again. */
function begin(flight: Flight, started: FlightStarted): void {
  flight.started.value = pairCard(started);
  flight.forecast.value = null;
  flight.trail.pursuer.value = [];
  flight.trail.leader.value = [];
  flight.alerts.value = [];
  flight.unable.value = null;
  flight.promise.value = null;
  flight.ended.value = null;
}

function reducePlan(flight: Flight, changed: PlanChanged, { joining, wall, since }: Arrival): void {
  const previous = flight.plan.value;
  const isNews = changed.announced && !joining;
  if (previous !== null && isNews && flight.unavailable.value === null) {
    flight.superseded.value = { plan: previous, until: wall + SUPERSEDED_SHOWN };
  }
  flight.plan.value = changed;
  flight.planSince.value = since;
  flight.unavailable.value = null;
  flight.unable.value = null;
  flight.promise.value = null;
  if (changed.announced) log(flight, { t: changed.t_s, kind: "plan", text: changed.message });
}

function reduceEngagement(flight: Flight, changed: EngagementChanged): void {
  flight.engagement.value = changed;
  flight.isSent.value = false;
  const isRefused = changed.engagement === changed.previous;
  const kind = isRefused ? "refused" : "engagement";
  log(flight, { t: changed.t_s, kind, text: changed.message });
  if (isRefused) return;
  const steps = [changed.previous, changed.engagement];
  if (steps.includes("armed") && steps.includes("designated")) return; // the proposal stands
  flight.proposal.value = null;
  flight.unavailable.value = null;
  if (changed.previous !== "engaged") return;
  // What was flown is over, and what stood in its way with it.
  flight.plan.value = null;
  flight.superseded.value = null;
  if (flight.unable.value?.reason !== "data") flight.unable.value = null;
}

function reduceAlert(flight: Flight, alert: Alert): void {
  const others = flight.alerts.value.filter(
    (each) => each.subject !== alert.subject || each.other !== alert.other,
  );
  flight.alerts.value = alert.cleared ? others : [...others, alert];
  const kind = alert.cleared ? "clear" : alert.level;
  log(flight, { t: alert.t_s, kind, text: alert.message });
}

function reduceSample(flight: Flight, sample: PairSample, { since }: Arrival): void {
  const { pursuer, leader } = flight.trail;
  if (sample.joined && flight.sample.value?.joined !== true) flight.joinedSince.value = since;
  if (sample.leader_age_s === 0) flight.heard.value = sample;
  const known = expected(sample, flight.heard.value);
  flight.sample.value = known;
  pursuer.value = appendTrail(pursuer.value, sample.t_s, sample.pursuer);
  if (sample.leader_age_s === 0)
    leader.value = appendTrail(leader.value, sample.t_s, sample.leader);
}

/** A sample with the leader where it is expected, if nothing was heard of it since `heard`. */
function expected(sample: PairSample, heard: PairSample | null): PairSample {
  if (sample.leader_age_s === 0 || heard === null) return sample;
  const straight = { ...heard.leader, bank_deg: 0, turn_rate_degps: 0 };
  const leader = moveAircraft(straight, sample.t_s - heard.t_s);
  const { pursuer } = sample;
  const separation = Math.hypot(pursuer.x_m - leader.x_m, pursuer.y_m - leader.y_m);
  return { ...sample, leader, separation_m: separation };
}

/** Why guidance is unable, without the word that stands beside it. */
function sentenceOf({ message }: Unable): string {
  const sentence = message.replace(/^Unable: /, "");
  return sentence.charAt(0).toUpperCase() + sentence.slice(1);
}

function startLower(sentence: string): string {
  return sentence.charAt(0).toLowerCase() + sentence.slice(1);
}

function log(flight: Flight, { t, kind, text: said }: Message): void {
  const known = flight.messages.value;
  const message = { t, kind, text: inPageUnits(said) };
  // A reconnected page gets the last documents again.
  if (known.some((each) => each.t === message.t && each.text === message.text)) return;
  flight.messages.value = [message, ...known].slice(0, MESSAGES_KEPT);
}
