/** The figures of a flight that are compared, counted from what is known of it as the flight itself counts. */

import type { History } from "../store/history";
import type { Knots } from "../store/knots";
import { wrap180 } from "../units";
import type { PlanChanged } from "../wire";

export interface Figures {
  /** Flight time of the join [s]; null if it has not joined. */
  readonly join: number | null;
  /** Flown over the ground until joined [m]. */
  readonly track: number;
  /** Least separation [m]. */
  readonly least: number;
  /** Total variation of the pursuer's heading until joined [deg]. */
  readonly swing: number;
  /** From a bank to one side to a bank to the other, until joined. */
  readonly reversals: number;
  /** Plans after the one at engagement, announced or not. */
  readonly replans: number;
  /** Whether it is over, so that these are its last. */
  readonly isFinal: boolean;
}

/** Less bank than this is a correction, not a turn [deg]. */
const BANKED = 3;

/** Null before the first sample. Of a flight that is over they are what it said of itself. */
export function figuresOf(history: History): Figures | null {
  const { knots } = history;
  if (knots.span === null) return null;
  const { result } = history.knownAt(Number.POSITIVE_INFINITY);
  if (result === null) return countFigures(history);
  return {
    join: result.joined ? result.join_time_s : null,
    track: result.track_m,
    least: result.least_separation_m,
    swing: result.heading_swing_deg,
    reversals: result.bank_reversals,
    replans: result.replans,
    isFinal: true,
  };
}

/** The same counted from samples one a second: what is flown within a second is taken as straight. */
export function countFigures({ knots, events }: History): Figures {
  const times = knots.column("t_s");
  const [x, y] = [knots.column("pursuer.x_m"), knots.column("pursuer.y_m")];
  const [heading, bank] = [knots.column("pursuer.heading_deg"), knots.column("pursuer.bank_deg")];
  const joined = joinedAt(knots);
  let [track, swing, reversals, side] = [0, 0, 0, 0];
  for (let k = 1; k < knots.count; k += 1) {
    const at = (column: Float64Array, row: number) => column[row] ?? 0;
    if (joined !== null && at(times, k) > joined) break;
    track += Math.hypot(at(x, k) - at(x, k - 1), at(y, k) - at(y, k - 1));
    swing += Math.abs(wrap180(at(heading, k) - at(heading, k - 1)));
    if (Math.abs(at(bank, k)) <= BANKED) continue;
    const now = Math.sign(at(bank, k));
    if (now * side < 0) reversals += 1;
    side = now;
  }
  const plans = events.filter((each): each is PlanChanged => each.kind === "plan_changed");
  return {
    join: joined,
    track,
    least: knots.column("least_separation_m").at(-1) ?? Number.NaN,
    swing,
    reversals,
    replans: plans.filter(({ reason }) => reason !== "engaged").length,
    isFinal: false,
  };
}

/** When it joined first [s]; null if it has not. */
export function joinedAt(knots: Knots): number | null {
  const since = Array.from(knots.column("t_s"), (t) => knots.joinedAt(t));
  return since.find((t) => Number.isFinite(t)) ?? null;
}
