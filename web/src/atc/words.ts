/** How clearances are said: words, and with each word a colour and a pattern that only repeat it. */

import type { Colour } from "../store/colours";
import { FT, formatClock, formatKnots, formatMiles } from "../units";
import type {
  ClearanceCard,
  ClearanceState,
  Deviation,
  PairCard,
  ReasonCode,
  TrafficCard,
  ValidationVerdict,
} from "../wire";

/** How a state is named, and how its route is drawn: the pattern carries the state. */
interface StateLook {
  readonly word: string;
  readonly colour: Colour;
  /** Dashes and gaps [px]; empty is solid. */
  readonly dash: string;
}

const PROPOSED = { colour: "proposed", dash: "15 12" } as const;
const ARMED = { colour: "armed", dash: "15 12" } as const;
const OVER = { colour: "superseded", dash: "2 11" } as const;

export const STATES: Record<ClearanceState, StateLook> = {
  requested: { word: "REQUESTED", ...PROPOSED },
  validating: { word: "REQUESTED", ...PROPOSED },
  standby: { word: "STANDBY", ...PROPOSED },
  accepted: { word: "ACCEPTED", ...ARMED },
  wilco: { word: "WILCO", ...ARMED },
  flying: { word: "FLYING", colour: "plan", dash: "" },
  deviated: { word: "DEVIATES", colour: "caution", dash: "20 4 4 4" },
  flown: { word: "FLOWN", ...OVER },
  unable: { word: "UNABLE", ...OVER },
  cancelled: { word: "CANCELLED", ...OVER },
  expired: { word: "EXPIRED", ...OVER },
  superseded: { word: "SUPERSEDED", ...OVER },
  terminated: { word: "TERMINATED", ...OVER },
};

export const VERDICTS: Record<ValidationVerdict, { word: string; tone: string }> = {
  acceptable: { word: "ACCEPTABLE", tone: "good" },
  unable: { word: "UNABLE", tone: "alert" },
  standby: { word: "STANDBY", tone: "caution" },
};

export const CERTAINTIES: Record<PairCard["certainty"], { word: string; tone: string }> = {
  certain: { word: "CERTAIN", tone: "alert" },
  possible: { word: "POSSIBLE", tone: "caution" },
  clear: { word: "CLEAR", tone: "good" },
};

/** Why a controller may be unable: what is sent, and how it is read. */
export const REASONS: readonly { readonly code: ReasonCode; readonly text: string }[] = [
  { code: "separation", text: "Due to traffic" },
  { code: "airspace", text: "Due to airspace restriction" },
  { code: "slot_taken", text: "The place is taken" },
  { code: "leader_disagrees", text: "The leader will fly otherwise" },
  { code: "traffic_without_intent", text: "Traffic whose intent is not known" },
  { code: "bank", text: "Due to aircraft performance" },
  { code: "controller", text: "Without another reason" },
];

/** A reason as it is read; nothing where there is none. */
export function reasonText(code: string | undefined): string {
  if (code === undefined || code === "") return "";
  return `${REASONS.find((each) => each.code === code)?.text ?? code.replaceAll("_", " ")}.`;
}

/** Behind whom, and how far. */
export function behindText(card: ClearanceCard): string {
  const spacing =
    card.spacing_type === "time"
      ? `${Math.round(card.spacing_time_s)} s`
      : `${formatMiles(card.slot_distance_m)} NM`;
  return `BEHIND ${card.traffic_id} ${spacing}`;
}

/** A time of a sky: UTC on the earth, else flight time [s]. */
export function timeText(sky: string, t: number): string {
  if (!Number.isFinite(t)) return "--:--:--";
  return sky === "" ? new Date(1000 * t).toISOString().slice(11, 19) : formatClock(t);
}

/** A pressure altitude as a flight level, e.g. FL310; `altitude` [m]. */
export function levelText(altitude: number | undefined): string {
  if (altitude === undefined) return "FL---";
  return `FL${String(Math.round(altitude / FT / 100)).padStart(3, "0")}`;
}

/** From so fast on, a climb is shown [m/s]: 500 ft/min. */
const CLIMBS = (500 * FT) / 60;

/** Level, climb or descent, and ground speed of an aircraft. */
export function flightText({ altitude_m, climb_mps = 0, ground_speed_mps }: TrafficCard): string {
  const way = climb_mps > CLIMBS ? "↑" : climb_mps < -CLIMBS ? "↓" : "";
  return `${levelText(altitude_m)}${way} ${formatKnots(ground_speed_mps)} kt`;
}

/** The nearest of the pairs of a validation: least NM and when. */
export function leastText(card: ClearanceCard): string {
  const [validation] = card.validation;
  const [pair] = validation?.pairs ?? [];
  if (validation === undefined) return "being validated";
  if (pair === undefined) return `clear of ${validation.aircraft}`;
  return `${formatMiles(pair.least_m)} NM @ ${timeText(card.sky, pair.at_s)}`;
}

/** How far it deviates, with its unit. */
export function amountText({ amount, unit, subject }: Deviation): string {
  if (unit === "s") return `${Math.round(amount)} s`;
  return subject === "level" ? `${Math.round(amount / FT)} ft` : `${formatMiles(amount, 2)} NM`;
}
