/** How a flight was flown by hand, in figures: counted as the flight itself counts, once a second. */

import { samplePath, windVector } from "../geometry";
import type { History } from "../store/history";
import type { FlownByHand, PathPoint } from "../wire";
import { type Flown, plansOf } from "./seconds";

/** The bank is on the bar within so much [deg]: as a flight counts it. */
const WITHIN = 2;

/** What a flight says of itself when it is over; until then, what its samples say. */
export function byHandOf(history: History, flown: Flown): FlownByHand | null {
  if (!flown.byHand) return null;
  const said = history.knownAt(Number.POSITIVE_INFINITY).result?.by_hand?.[0];
  return said ?? countByHand(history, flown);
}

export function countByHand(history: History, { seconds }: Flown): FlownByHand {
  const hand = seconds.filter(({ byHand }) => byHand);
  const barred = hand.flatMap(({ sample }) =>
    (sample.bars ?? []).map((bars) => Math.abs(bars.commanded_bank_deg - sample.pursuer.bank_deg)),
  );
  return {
    time_s: hand.length,
    with_bars_s: barred.length,
    within_bar_s: barred.filter((off) => off <= WITHIN).length,
    tube_m: tubeOf(history, hand),
  };
}

/** Largest distance beside the path that was tracked [m]. */
function tubeOf(history: History, hand: Flown["seconds"]): number {
  const wind = windVector(
    history.knownAt(Number.POSITIVE_INFINITY).started?.wind ?? { from_deg: 0, speed_mps: 0 },
  );
  const paths = plansOf(history).map(({ t_s, plan }) => ({
    t_s,
    path: samplePath(plan.segments, wind),
  }));
  return hand
    .filter(({ sample }) => sample.mode === "converge")
    .map(({ t, sample }) => {
      const path = paths.findLast(({ t_s }) => t_s < t)?.path ?? [];
      return beside(path, sample.pursuer);
    })
    .reduce((most, each) => Math.max(most, each), 0);
}

type Place = Pick<PathPoint, "x_m" | "y_m">;

/** Distance of a place from a line of points [m]; 0 from none. */
export function beside(path: readonly Place[], { x_m, y_m }: Place): number {
  let nearest = Number.POSITIVE_INFINITY;
  for (let k = 1; k < path.length; k += 1) {
    const [a, b] = [path[k - 1], path[k]];
    if (a === undefined || b === undefined) continue;
    const [dx, dy] = [b.x_m - a.x_m, b.y_m - a.y_m];
    const size = dx * dx + dy * dy;
    const part = size === 0 ? 0 : ((x_m - a.x_m) * dx + (y_m - a.y_m) * dy) / size;
    const at = Math.max(0, Math.min(1, part));
    nearest = Math.min(nearest, Math.hypot(x_m - a.x_m - at * dx, y_m - a.y_m - at * dy));
  }
  return Number.isFinite(nearest) ? nearest : 0;
}
