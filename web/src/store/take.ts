/** What one document changes of what the display knows. */

import { formatClock } from "../units";
import type { Alert, Document, FlightStarted, LinkResult, PlanChanged } from "../wire";
import type { Flight, Message } from "./flight";
import { isAbout, type PairSample, pairCard, pairResult, pairSample } from "./pair";
import { appendTrail } from "./trail";

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
export function take(flight: Flight, document: Document, arrival: Arrival): void {
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
      takePlan(flight, document, arrival);
      return;
    case "plan_unavailable":
      flight.unavailable.value = document;
      log(flight, { t, kind: "no_plan", text: document.answer.message });
      return;
    case "plan_refused":
      log(flight, { t, kind: "refused", text: document.message });
      return;
    case "mode_changed":
      flight.mode.value = document;
      flight.modeSince.value = arrival.since;
      log(flight, { t, kind: "mode", text: document.message });
      return;
    case "alert":
      takeAlert(flight, document);
      return;
    case "unable":
      flight.unable.value = document;
      log(flight, { t, kind: "unable", text: document.message });
      return;
    case "separation_lost":
      flight.lost.value = document;
      flight.lostSince.value = arrival.since;
      log(flight, { t, kind: "lost", text: document.cause });
      return;
    case "forecast_changed":
      flight.forecast.value = document;
      return;
    case "sample": {
      const sample = pairSample(document, pair);
      if (sample !== null) takeSample(flight, sample, arrival);
      return;
    }
    case "flight_ended": {
      const result = pairResult(document, pair);
      flight.ended.value = result;
      if (result !== null) log(flight, { t, kind: "end", text: endSentence(result) });
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
  flight.ended.value = null;
}

function takePlan(flight: Flight, changed: PlanChanged, { joining, wall, since }: Arrival): void {
  const previous = flight.plan.value;
  const isNews = changed.announced && !joining;
  if (previous !== null && isNews && flight.unavailable.value === null) {
    flight.superseded.value = { plan: previous, until: wall + SUPERSEDED_SHOWN };
  }
  flight.plan.value = changed;
  flight.planSince.value = since;
  flight.unavailable.value = null;
  flight.unable.value = null;
  if (changed.announced) log(flight, { t: changed.t_s, kind: "plan", text: changed.message });
}

function takeAlert(flight: Flight, alert: Alert): void {
  const others = flight.alerts.value.filter(
    (each) => each.subject !== alert.subject || each.other !== alert.other,
  );
  flight.alerts.value = alert.cleared ? others : [...others, alert];
  const kind = alert.cleared ? "clear" : alert.level;
  log(flight, { t: alert.t_s, kind, text: alert.message });
}

function takeSample(flight: Flight, sample: PairSample, { since }: Arrival): void {
  const { pursuer, leader } = flight.trail;
  if (sample.joined && flight.sample.value?.joined !== true) flight.joinedSince.value = since;
  flight.sample.value = sample;
  pursuer.value = appendTrail(pursuer.value, sample.t_s, sample.pursuer);
  leader.value = appendTrail(leader.value, sample.t_s, sample.leader);
}

function endSentence(result: LinkResult): string {
  return result.joined
    ? `Flight ended: joined at ${formatClock(result.join_time_s)}.`
    : "Flight ended without joining.";
}

function log(flight: Flight, message: Message): void {
  const known = flight.messages.value;
  // A reconnected page gets the last documents again.
  if (known.some((each) => each.t === message.t && each.text === message.text)) return;
  flight.messages.value = [message, ...known].slice(0, MESSAGES_KEPT);
}
