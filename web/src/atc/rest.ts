/** The service's clearances, as far as the page uses them. */

import { type Answer, request } from "../api";
import type { ClearanceCard, ReasonCode, TrackCard, ValidationCard } from "../wire";

/** What the controller says to a request, or does with a clearance. */
export interface ClearanceAnswer {
  readonly answer: "accepted" | "unable" | "standby" | "cancelled" | "terminated";
  readonly reason?: ReasonCode;
  /** In words; if left out, those of data link. */
  readonly message?: string;
}

/** What a request would be found to be. */
export interface ClearanceTrial {
  readonly text: string;
  readonly joins_s: number;
  readonly route: TrackCard;
  readonly leader_route: TrackCard;
  readonly validation: ValidationCard;
}

/** Who asks, of a flight of this service. */
export interface FlightAsks {
  readonly flight_id: string;
  /** If left out, the pursuer of its first link. */
  readonly aircraft?: string;
}

const CLEARANCES = "api/v1/clearances";

export function answerClearance(
  id: string,
  answer: ClearanceAnswer,
): Promise<Answer<ClearanceCard>> {
  return request("POST", `${CLEARANCES}/${encodeURIComponent(id)}/answers`, answer);
}

/** What would be found now; nothing is kept of it. */
export function tryClearance(asks: FlightAsks): Promise<Answer<ClearanceTrial>> {
  return request("POST", `${CLEARANCES}?dry_run=true`, asks);
}

export function askClearance(asks: FlightAsks): Promise<Answer<ClearanceCard>> {
  return request("POST", CLEARANCES, asks);
}
