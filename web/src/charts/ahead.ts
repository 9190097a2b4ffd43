/** What guidance intends at one instant, as functions of flight time: the plan, and the forecast along it. */

import { pathPointAt, windVector } from "../geometry";
import { type Planned, shownPlan } from "../store/committed";
import { forecastPoint } from "../store/forecast";
import type { Moment } from "../store/types";
import { NM } from "../units";
import type { ForecastChanged, PathSegment } from "../wire";

export interface Ahead {
  readonly plan: Planned;
  readonly forecast: ForecastChanged | null;
  /** The plan is proved to keep the two so far apart [m]. */
  readonly provedAbove: number;
  /** When what is known of the way ends [s, flight time]. */
  readonly end: number;
  /** Forecast separation [NM] and heading [deg] at flight time `t` [s]; null where nothing is forecast. */
  separation(t: number): number | null;
  heading(t: number): number | null;
}

/** Null while no plan is flown or proposed. */
export function aheadOf(moment: Moment): Ahead | null {
  const { forecast, route, started } = moment;
  const plan = shownPlan(moment);
  if (plan === null || started === null) return null;
  const wind = windVector(started.wind);
  const last = forecast?.times_s.at(-1) ?? Number.NEGATIVE_INFINITY;
  const isAhead = (t: number) => forecast !== null && t >= forecast.t_s && t <= last;
  const known = route?.segments.at(-1)?.end.t_s ?? Number.NEGATIVE_INFINITY;
  return {
    plan,
    forecast,
    provedAbove: plan.plan.separation.proved_above_m,
    end: Math.max(last, plan.t_s + plan.plan.time_to_converge_s),
    separation(t) {
      if (forecast === null || route === null || !isAhead(t) || t > known) return null;
      const [own, leader] = [forecastPoint(forecast, t), pathPointAt(route.segments, t, wind)];
      return leader === null ? null : Math.hypot(own.x_m - leader.x_m, own.y_m - leader.y_m) / NM;
    },
    heading: (t) =>
      forecast === null || !isAhead(t) ? null : forecastPoint(forecast, t).heading_deg,
  };
}

function segmentAt(ahead: Ahead | null, t: number): PathSegment | null {
  if (ahead === null) return null;
  const along = t - ahead.plan.t_s;
  const found = ahead.plan.plan.segments.find(
    ({ start, end }) => along >= start.t_s && along < end.t_s,
  );
  return found ?? null;
}

/** Bank that the plan asks for [deg, right positive]; null off it, and where it slides along d_min. */
export function plannedBank(ahead: Ahead | null, t: number): number | null {
  const segment = segmentAt(ahead, t);
  switch (segment?.kind) {
    case "turn":
      return segment.direction === "right" ? segment.bank_deg : -segment.bank_deg;
    case "straight":
      return 0;
    default:
      return null;
  }
}

/** Heading of the plan [deg]; null off it. */
export function plannedHeading(ahead: Ahead | null, t: number): number | null {
  if (ahead === null || segmentAt(ahead, t) === null) return null;
  return pathPointAt(ahead.plan.plan.segments, t - ahead.plan.t_s)?.heading_deg ?? null;
}
