/** Where aircraft are expected to be: along a track of knots, or straight on. */

import type { ClearanceCard, PairCard, PlaceAt, TrackCard } from "../wire";
import { aircraftOf, type Sky } from "./sky";

/** A place over the ground [m]. */
export interface Place {
  readonly x_m: number;
  readonly y_m: number;
}

/** Where a track is at a time, before its first knot and past its last one straight on. */
export function placeOn({ t_s, x_m, y_m }: TrackCard, t: number): Place {
  let k = t_s.findIndex((each) => each >= t) - 1;
  if (k < 0) k = t <= (t_s[0] ?? 0) ? 0 : Math.max(0, t_s.length - 2);
  const [from, to] = [t_s[k] ?? 0, t_s[k + 1] ?? 0];
  const share = to > from ? (t - from) / (to - from) : 0;
  const between = (values: readonly number[]) => {
    const value = values[k] ?? 0;
    return value + share * ((values[k + 1] ?? value) - value);
  };
  return { x_m: between(x_m), y_m: between(y_m) };
}

/** The line along a track between two times. */
export function partOf(track: TrackCard, from: number, to: number): Place[] {
  const inner = track.t_s.flatMap((t, k) =>
    t > from && t < to ? [{ x_m: track.x_m[k] ?? 0, y_m: track.y_m[k] ?? 0 }] : [],
  );
  return [placeOn(track, from), ...inner, placeOn(track, to)];
}

/** What an aircraft is known to fly: its own clearance, or the route that a follower was planned on. */
function routeOf(sky: Sky, ident: string, first: ClearanceCard): TrackCard | null {
  const all = [first, ...sky.clearances.values()];
  const own = all.find((each) => each.aircraft === ident && FLOWN.has(each.state));
  return (own?.route ?? all.find((each) => each.traffic_id === ident)?.leader_route) || null;
}

const FLOWN: ReadonlySet<string> = new Set(["wilco", "flying", "deviated"]);

/**
 * The track of the other aircraft of a pair: through the place where validation had it at the closest
 * approach, whatever else is known of it.
 */
export function otherTrack(sky: Sky, card: ClearanceCard, pair: PairCard): TrackCard {
  const known = routeOf(sky, pair.ident, card);
  if (known !== null && apart(placeOn(known, pair.at_s), pair.other) < SAME) return known;
  const now = aircraftOf(sky, pair.ident);
  const begin: PlaceAt = now === null ? pair.other : { t_s: sky.t, x_m: now.x_m, y_m: now.y_m };
  return {
    t_s: [begin.t_s, pair.other.t_s],
    x_m: [begin.x_m, pair.other.x_m],
    y_m: [begin.y_m, pair.other.y_m],
  };
}

/** A route that passes so near to a place leads through it [m]. */
const SAME = 500;

export function apart(a: Place, b: Place): number {
  return Math.hypot(a.x_m - b.x_m, a.y_m - b.y_m);
}
