/** What the timeline draws of a whole flight: the separation over time, what bounds it, and what happened. */

import { pathPointAt, windVector } from "../geometry";
import { forecastPoint } from "../store/forecast";
import type { History } from "../store/history";
import { messageOf } from "../store/reduce";
import type { Known, Message } from "../store/types";

/** A separation at a flight time: t [s], d [m]. */
export interface Apart {
  readonly t: number;
  readonly d: number;
}

/** A stretch of time in which a plan proves that the separation stays above some distance [s, m]. */
export interface Proved {
  readonly from: number;
  readonly to: number;
  readonly above: number;
}

/** What happened at one instant. */
export interface Mark {
  readonly t: number;
  readonly kind: Message["kind"] | "joined";
  readonly text: string;
}

export interface Outline {
  readonly first: number;
  readonly last: number;
  /** The last instant that is drawn: of the forecast, if it goes on [s]. */
  readonly end: number;
  readonly flown: readonly Apart[];
  /** What is expected from `last` on. */
  readonly ahead: readonly Apart[];
  readonly minSeparation: number;
  /** The largest separation that is drawn [m]: what is more is cut. */
  readonly most: number;
  readonly proved: readonly Proved[];
  /** In order of time. */
  readonly marks: readonly Mark[];
}

/** So many points are drawn at most: of each part the least separation is kept. */
const POINTS = 400;
/** What is farther than so many times D is drawn no higher: what matters is near d_min. */
const CUT = 2.5;
/** Between two points of what is expected [s]. */
const AHEAD_STEP = 5;

/** The outline of all that is known of a flight; null before its first sample. */
export function outlineOf(history: History): Outline | null {
  const { knots, events } = history;
  const known = history.knownAt(Number.POSITIVE_INFINITY);
  const { span } = knots;
  if (span === null || known.started === null) return null;
  const flown = thinned(knots.column("t_s"), knots.column("separation_m"));
  const ahead = known.result === null ? expectedAhead(known, span.last) : [];
  const proved = provedParts(history, span.last);
  const { min_separation_m: minSeparation, slot_distance_m } = known.started;
  const all = [...flown, ...ahead].map(({ d }) => d);
  const joinedAt = knots.joinedAt(span.last);
  const marks: Mark[] = events.map(messageOf).filter((each) => each !== null);
  if (Number.isFinite(joinedAt)) marks.push({ t: joinedAt, kind: "joined", text: "Joined." });
  return {
    first: span.first,
    last: span.last,
    end: Math.max(span.last, ahead.at(-1)?.t ?? span.last),
    flown,
    ahead,
    minSeparation,
    most: Math.min(Math.max(1.2 * minSeparation, ...all), CUT * slot_distance_m),
    proved,
    marks: marks.sort((a, b) => a.t - b.t),
  };
}

function thinned(times: Float64Array, apart: Float64Array): Apart[] {
  const size = Math.max(1, Math.ceil(times.length / POINTS));
  const points: Apart[] = [];
  for (let from = 0; from < times.length; from += size) {
    let at = from;
    for (let k = from; k < Math.min(from + size, times.length); k += 1)
      if ((apart[k] ?? 0) < (apart[at] ?? 0)) at = k;
    points.push({ t: times[at] ?? 0, d: apart[at] ?? 0 });
  }
  const end = times.length - 1;
  points.push({ t: times[end] ?? 0, d: apart[end] ?? 0 });
  return points;
}

/** The separation on the path that will be flown, the leader flying as expected. */
function expectedAhead({ forecast, route, started }: Known, from: number): Apart[] {
  const until = Math.min(forecast?.times_s.at(-1) ?? from, route?.segments.at(-1)?.end.t_s ?? from);
  if (forecast === null || route === null || started === null) return [];
  const wind = windVector(started.wind);
  const points: Apart[] = [];
  for (let t = from; t <= until; t += AHEAD_STEP) {
    const [own, leader] = [forecastPoint(forecast, t), pathPointAt(route.segments, t, wind)];
    if (leader !== null)
      points.push({ t, d: Math.hypot(own.x_m - leader.x_m, own.y_m - leader.y_m) });
  }
  return points;
}

/** From each plan that was flown until the next one, or until there was none. */
function provedParts({ events }: History, last: number): Proved[] {
  const parts: Proved[] = [];
  let plan: { from: number; above: number; ends: number } | null = null;
  const close = (t: number) => {
    if (plan === null) return;
    const to = Math.min(t, plan.ends);
    const before = parts.at(-1);
    if (before?.above === plan.above && before.to >= plan.from - 1)
      parts[parts.length - 1] = { ...before, to };
    else if (to > plan.from) parts.push({ from: plan.from, to, above: plan.above });
    plan = null;
  };
  for (const event of events) {
    if (event.kind === "plan_changed") {
      close(event.t_s);
      const { separation, time_to_converge_s } = event.plan;
      const ends = event.t_s + time_to_converge_s;
      plan = { from: event.t_s, above: separation.proved_above_m, ends };
    }
    if (event.kind === "plan_unavailable") close(event.t_s);
    if (event.kind === "engagement_changed" && event.engagement !== "engaged") close(event.t_s);
  }
  close(last);
  return parts;
}

/** The mark before or after an instant; null if there is none. */
export function nextMark(outline: Outline, t: number, way: 1 | -1): Mark | null {
  const slack = 0.05;
  if (way > 0) return outline.marks.find((each) => each.t > t + slack) ?? null;
  return outline.marks.findLast((each) => each.t < t - slack) ?? null;
}
