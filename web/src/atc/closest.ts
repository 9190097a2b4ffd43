/** Two aircraft as they fly now: how far apart, in which direction, and how close they come straight on. */

import { DEG, wrap360 } from "../units";
import type { TrafficCard } from "../wire";
import type { Place } from "./tracks";

export interface Closest {
  readonly range: number;
  /** From the first to the second, clockwise from north [deg]. */
  readonly bearing: number;
  /** Until they are closest, straight on; 0 where they only part [s]. */
  readonly after: number;
  /** How close they come [m]. */
  readonly least: number;
  /** Where they are then. */
  readonly places: readonly [Place, Place];
  /** Height between them now [m]; null where it is not known. */
  readonly vertical: number | null;
}

export function closestOf(a: TrafficCard, b: TrafficCard): Closest {
  const [from, to] = [velocityOf(a), velocityOf(b)];
  const [x, y] = [b.x_m - a.x_m, b.y_m - a.y_m];
  const [vx, vy] = [to.x - from.x, to.y - from.y];
  const closing = vx * vx + vy * vy;
  const after = closing === 0 ? 0 : Math.max(0, -(x * vx + y * vy) / closing);
  const places = [straightOn(a, after), straightOn(b, after)] as const;
  const known = a.altitude_m !== undefined && b.altitude_m !== undefined;
  return {
    range: Math.hypot(x, y),
    bearing: wrap360(Math.atan2(x, y) / DEG),
    after,
    least: Math.hypot(places[1].x_m - places[0].x_m, places[1].y_m - places[0].y_m),
    places,
    vertical: known ? Math.abs((a.altitude_m ?? 0) - (b.altitude_m ?? 0)) : null,
  };
}

/** Where an aircraft is after so long [s] along its present track. */
export function straightOn(card: TrafficCard, after: number): Place {
  const { x, y } = velocityOf(card);
  return { x_m: card.x_m + x * after, y_m: card.y_m + y * after };
}

/** Over the ground, east and north [m/s]. */
function velocityOf({ track_deg, ground_speed_mps }: TrafficCard): { x: number; y: number } {
  const track = track_deg * DEG;
  return { x: ground_speed_mps * Math.sin(track), y: ground_speed_mps * Math.cos(track) };
}
