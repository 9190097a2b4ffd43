/** The states of the picture: what guidance does, how old the data are, whether the separation holds. */

import type { Flight } from "./flight";

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

/** Plans may graze the minimum separation: this much below it is no loss yet [m]. */
export const GRAZE = 20;

export interface Outlook {
  readonly state: Separation;
  /** Until the predicted loss [s]; 0 unless predicted. */
  readonly within: number;
}

/** Whether the minimum separation is kept now, and whether guidance expects it to be lost. */
export function separation(flight: Flight): Outlook {
  const now = flight.now.value;
  const minSeparation = flight.started.value?.min_separation_m;
  if (now === null || minSeparation === undefined) return { state: "kept", within: 0 };
  if (now.separation_m < minSeparation - GRAZE) return { state: "lost", within: 0 };
  const alert = flight.alerts.value.find(
    ({ subject, level }) => subject === "separation" && level !== "advisory",
  );
  if (alert === undefined) return { state: "kept", within: 0 };
  const within = Math.max(0, Math.round(alert.predicted_at_s - flight.simTime.value));
  return { state: "predicted", within };
}
