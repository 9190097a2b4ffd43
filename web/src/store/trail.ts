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
const SLACK = 0.001; // samples come every 0.05 s, so 9.999 s is 10 s

/** The trail with one more position, if it is time for one: the same array otherwise. */
export function appendTrail(
  trail: readonly TrailPoint[],
  t: number,
  position: { readonly x_m: number; readonly y_m: number },
): readonly TrailPoint[] {
  const last = trail.at(-1);
  if (last !== undefined && t - last.t < PERIOD - SLACK) return trail;
  const kept: TrailPoint[] = [];
  for (const point of trail) {
    const before = kept.at(-1);
    const recent = t - point.t <= RECENT;
    if (recent || before === undefined || point.t - before.t >= OLD_PERIOD - SLACK)
      kept.push(point);
  }
  kept.push({ t, x: position.x_m, y: position.y_m });
  return kept;
}
