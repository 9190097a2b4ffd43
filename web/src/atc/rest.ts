/** The service's clearances, as far as the page uses them. */

import { type Answer, request } from "../api";
import type {
  ClearanceAnswer,
  ClearanceCard,
  ClearanceTrial,
  FlightClearanceRequest,
} from "../wire";

const CLEARANCES = "api/v1/clearances";

export function answerClearance(
  id: string,
  answer: ClearanceAnswer,
): Promise<Answer<ClearanceCard>> {
  return request("POST", `${CLEARANCES}/${encodeURIComponent(id)}/answers`, answer);
}

/** What would be found now; nothing is kept of it. */
export function tryClearance(asks: FlightClearanceRequest): Promise<Answer<ClearanceTrial>> {
  return request("POST", `${CLEARANCES}?dry_run=true`, asks);
}

export function askClearance(asks: FlightClearanceRequest): Promise<Answer<ClearanceCard>> {
  return request("POST", CLEARANCES, asks);
}
