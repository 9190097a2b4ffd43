/** Points of a forecast: the closed loop flown ahead, as columns. */

import { between } from "../geometry";
import type { ForecastChanged, PathPoint } from "../wire";

/** Where a forecast has the aircraft at flight time `t` [s], held to its ends. */
export function forecastPoint(forecast: ForecastChanged, t: number): PathPoint {
  const k = Math.max(1, forecastIndex(forecast, t));
  return between(pointOf(forecast, k - 1), pointOf(forecast, k), t);
}

/** The first of a forecast's points that is still to come at flight time `t` [s]; the last if none is. */
export function forecastIndex(forecast: ForecastChanged, t: number): number {
  const next = forecast.times_s.findIndex((time) => time > t);
  return next < 0 ? forecast.times_s.length - 1 : next;
}

/** One point of a forecast's columns. */
export function pointOf(forecast: ForecastChanged, k: number): PathPoint {
  const at = Math.min(k, forecast.times_s.length - 1);
  return {
    t_s: forecast.times_s[at] ?? 0,
    x_m: forecast.x_m[at] ?? 0,
    y_m: forecast.y_m[at] ?? 0,
    heading_deg: forecast.heading_deg[at] ?? 0,
  };
}

/** The points of a forecast from one on, up to a flight time [s]. */
export function pointsAfter(forecast: ForecastChanged, index: number, until: number): PathPoint[] {
  const points = forecast.times_s
    .map((_, k) => pointOf(forecast, k))
    .filter(({ t_s }, k) => k >= index && t_s <= until);
  const last = forecast.times_s.at(-1) ?? until;
  if (points.length > 0 && until < last) points.push(forecastPoint(forecast, until));
  return points;
}
