/** Where an aircraft has been: one point per 10 s for the last ten minutes, one per minute before. */

/** A past position over the ground: t [s], x east, y north [m]. */
export interface TrailPoint {
  readonly t: number;
  readonly x: number;
  readonly y: number;
}

const PERIOD = 10;
const RECENT = 600;
const OLD_PERIOD = 60;

/** The flight times at which a trail has points, up to `t` [s], ascending. */
export function trailTimes(first: number, t: number): number[] {
  const times: number[] = [];
  for (let at = Math.ceil(first / PERIOD) * PERIOD; at <= t; at += PERIOD)
    if (t - at <= RECENT || at % OLD_PERIOD === 0) times.push(at);
  return times;
}
