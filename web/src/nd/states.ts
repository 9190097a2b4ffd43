/** The states of the picture: what guidance does, how old the data are, whether the separation holds. */

import type { Flight } from "../flight";
import { pathPointAt, windVector } from "../geometry";
import { moveAircraft } from "../motion";
import { distance } from "./view";

/** off: holds its heading; unable: there is no plan; the others are the modes of guidance. */
export const GUIDANCES = ["off", "converge", "capture", "follow", "escape", "unable"] as const;
export type Guidance = (typeof GUIDANCES)[number];

/** fresh ≤ 2 s < coasting ≤ 5 s < old ≤ 10 s < dropped ≤ 24 s < gone; none: never any data. */
export const AGES = ["fresh", "coasting", "old", "dropped", "gone", "none"] as const;
export type Age = (typeof AGES)[number];

/** predicted: it will be lost within a minute; lost: it is lost now. */
export const SEPARATIONS = ["kept", "predicted", "lost"] as const;
export type Separation = (typeof SEPARATIONS)[number];

export function guidance(flight: Flight): Guidance {
  const mode = flight.sample.value?.mode ?? "heading";
  if (mode === "capture" || mode === "follow" || mode === "escape") return mode;
  if (flight.unavailable.value !== null) return "unable";
  return mode === "converge" ? "converge" : "off";
}

export function age(flight: Flight): Age {
  if (flight.now.value === null) return "none";
  if (flight.clock.value.ended) return "fresh"; // nothing moves any more, so no data grow old
  const seconds = flight.dataAge.value;
  if (seconds <= 2) return "fresh";
  if (seconds <= 5) return "coasting";
  if (seconds <= 10) return "old";
  return seconds <= 24 ? "dropped" : "gone";
}

/** How far ahead a loss of separation is looked for [s]. */
const LOOK_AHEAD = 60;
/** Plans may graze the minimum separation: this much below it is no loss yet [m]. */
export const GRAZE = 20;

export interface Outlook {
  readonly state: Separation;
  /** Until the predicted loss [s]; 0 unless predicted. */
  readonly within: number;
}

/** Whether the minimum separation is kept now and for the next minute, on the paths known for both. */
export function separation(flight: Flight): Outlook {
  const now = flight.now.value;
  const minSeparation = flight.started.value?.min_separation_m;
  if (now === null || minSeparation === undefined) return { state: "kept", within: 0 };
  if (now.separation_m < minSeparation - GRAZE) return { state: "lost", within: 0 };
  const state = guidance(flight);
  // From capture on guidance slows down as the spacing closes, so constant speed predicts nothing.
  if (state === "capture" || state === "follow") return { state: "kept", within: 0 };
  for (let ahead = 2; ahead <= LOOK_AHEAD; ahead += 2) {
    const own = state === "converge" ? ownAhead(flight, ahead) : moveAircraft(now.pursuer, ahead);
    if (own === null) break;
    if (distance(own, leaderAhead(flight, ahead) ?? now.leader) < minSeparation - GRAZE)
      return { state: "predicted", within: ahead };
  }
  return { state: "kept", within: 0 };
}

function ownAhead(flight: Flight, ahead: number) {
  const [plan, started] = [flight.plan.value, flight.started.value];
  if (plan === null || started === null) return null;
  const { segments } = plan.plan;
  const t = flight.simTime.value + ahead - plan.t_s;
  if (t > (segments.at(-1)?.end.t_s ?? 0)) return null;
  return pathPointAt(segments, t, windVector(started.wind));
}

function leaderAhead(flight: Flight, ahead: number) {
  const [now, route, started] = [flight.now.value, flight.route.value, flight.started.value];
  if (now === null) return null;
  if (route === null || started === null) return moveAircraft(now.leader, ahead);
  const end = route.segments.at(-1)?.end.t_s ?? 0;
  const t = flight.simTime.value + ahead;
  if (t > end) return moveAircraft(now.leader, ahead);
  return pathPointAt(route.segments, t, windVector(started.wind));
}

/** The wall clock [ms] at this frame; reading it subscribes to the frames. */
export function wallNow(flight: Flight): number {
  void flight.simTime.value;
  void flight.dataAge.value;
  return performance.now();
}
