/** Another flight beside the one that is shown: where its two aircraft are at one instant, and were. */

import type { AircraftSample, PathPoint } from "../wire";
import type { History } from "./history";
import type { PairSample } from "./pair";

type Place = Pick<PathPoint, "x_m" | "y_m">;

export interface Ghost {
  readonly name: string;
  readonly pursuer: AircraftSample;
  /** Null where it is where the shown flight's is. */
  readonly leader: AircraftSample | null;
  /** Whether its instant is before its beginning, or after its end. */
  readonly isOutside: boolean;
  /** Where its pursuer has been, and that of the shown flight. */
  readonly flown: readonly Place[];
  readonly own: readonly Place[];
}

/** A path has a point each so many seconds. */
const STEP = 5;
/** Leaders that are nearer to each other are drawn as one [m]. */
const SAME = 200;

/** The other flight, `name`, at its time `t` [s], beside a shown one that is at its time `now.t_s`. */
export function ghostOf(
  shown: History,
  now: PairSample | null,
  other: { readonly name: string; readonly history: History; readonly t: number },
): Ghost | null {
  const { name, history, t } = other;
  const { span } = history.knots;
  const sample = history.knots.sampleAt(t);
  if (sample === null || span === null || now === null) return null;
  const { pursuer, leader } = sample;
  const apart = Math.hypot(leader.x_m - now.leader.x_m, leader.y_m - now.leader.y_m);
  return {
    name,
    pursuer,
    leader: apart < SAME ? null : leader,
    isOutside: t < span.first || t > span.last,
    flown: [...flownUntil(history, t), pursuer],
    own: [...flownUntil(shown, now.t_s), now.pursuer],
  };
}

/** Where a flight's pursuer has been, up to flight time `t` [s]. */
function flownUntil(history: History, t: number): readonly Place[] {
  const path = pathOf(history);
  const next = path.findIndex((point) => point.t >= t);
  return next < 0 ? path : path.slice(0, next);
}

type Point = Place & { readonly t: number };
const paths = new WeakMap<History, { readonly count: number; readonly path: readonly Point[] }>();

/** All that a flight's pursuer has flown; made anew when more is known. */
function pathOf(history: History): readonly Point[] {
  const { knots } = history;
  const made = paths.get(history);
  if (made?.count === knots.count) return made.path;
  const [x, y] = [knots.column("pursuer.x_m"), knots.column("pursuer.y_m")];
  const path = Array.from(knots.column("t_s"), (t, k) => ({ t, x_m: x[k] ?? 0, y_m: y[k] ?? 0 }));
  const thin = path.filter((_, k) => k % STEP === 0);
  paths.set(history, { count: knots.count, path: thin });
  return thin;
}
