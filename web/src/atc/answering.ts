/** What may be answered, and answering: the stream confirms, a refusal is a sentence. */

import { formatMiles } from "../units";
import type {
  AlternativeManoeuvre,
  ClearanceAnswer,
  ClearanceCard,
  ClearanceState,
  ReasonCode,
} from "../wire";
import { answerClearance, tryClearance } from "./rest";
import type { Station } from "./station";
import { timeText } from "./words";

type Said = ClearanceAnswer["answer"];

/** What a controller may say in each state. */
export const ANSWERS: Record<ClearanceState, readonly Said[]> = {
  requested: ["cancelled"],
  validating: ["accepted", "unable", "standby", "cancelled"],
  standby: ["accepted", "unable", "cancelled"],
  accepted: ["unable", "cancelled"],
  wilco: ["cancelled"],
  flying: ["cancelled"],
  deviated: ["terminated", "cancelled"],
  unable: [],
  flown: [],
  cancelled: [],
  expired: [],
  superseded: [],
  terminated: [],
};

/** Why nothing can be answered to a clearance; empty where it can. */
export function hindrance(station: Station, id: string): string {
  return absence(station) || (station.forbidden.value.get(id) ?? "");
}

/** Why the page is not at the desk now; empty where it is. */
function absence({ file, store, link }: Station): string {
  if (file.value !== "") return "This is a recording: nothing can be answered.";
  if (store.instant.value !== null) return "The page shows the past: Live (L) leads back.";
  if (link.value !== "open") return "The stream is not connected: wait for it.";
  return "";
}

/** Why this cannot be said to a clearance now; empty where it can. */
export function refusalOf(station: Station, card: ClearanceCard, said: Said): string {
  const why = hindrance(station, card.id);
  if (why !== "") return why;
  const { sent } = station;
  if (sent.value?.id === card.id && sent.value.refusal === "")
    return "An answer is on its way: the stream will confirm it.";
  if (ANSWERS[card.state].includes(said)) return "";
  return `A clearance that is ${card.state} cannot be ${WORDS[said]}.`;
}

const WORDS: Record<Said, string> = {
  accepted: "accepted",
  unable: "refused",
  standby: "told to stand by",
  cancelled: "cancelled",
  terminated: "terminated",
};

/** Says it to the clearance that is chosen. */
export async function answer(
  station: Station,
  said: Said,
  reason?: ReasonCode,
  message?: string,
): Promise<void> {
  const card = station.card.value;
  if (card === null) return;
  const { id, state: before } = card;
  const why = refusalOf(station, card, said);
  if (why !== "") {
    station.sent.value = { id, answer: said, before, refusal: why };
    return;
  }
  station.unableOpen.value = false;
  station.sent.value = { id, answer: said, before, refusal: "" };
  const body = {
    answer: said,
    ...(reason !== undefined && { reason }),
    ...(message !== undefined && { message }),
  };
  const answered = await answerClearance(id, body);
  if (answered.kind === "done") return;
  const { status, sentence } = answered;
  if (status === 403) station.forbidden.value = new Map(station.forbidden.value).set(id, sentence);
  station.sent.value = status === 403 ? null : { id, answer: said, before, refusal: sentence };
}

/** Lets go of an answer that the stream has confirmed. */
export function confirm({ sent, store }: Station): void {
  const waiting = sent.value;
  if (waiting === null || waiting.refusal !== "") return;
  for (const sky of store.skies.value) {
    const card = sky.clearances.get(waiting.id);
    if (card !== undefined && card.state !== waiting.before) sent.value = null;
  }
}

/** Tries the clearance that is chosen again on the present picture. */
export async function probe(station: Station): Promise<void> {
  const card = station.card.value;
  if (card === null) return;
  const { id, flight_id: flight } = card;
  const say = (sentence: string) => {
    station.tried.value = { id, trial: null, sentence };
  };
  const why = absence(station);
  if (why !== "") say(why);
  else if (flight === undefined)
    say("Only what a flight of this service asks for can be tried: its plan is known here.");
  else {
    say("Trying …");
    const found = await tryClearance({ flight_id: flight, aircraft: card.aircraft });
    if (found.kind === "refused") say(found.sentence);
    else station.tried.value = { id, trial: found.value, sentence: "" };
  }
}

/** An alternative in the words of data link. */
export function offerText(card: ClearanceCard, other: AlternativeManoeuvre): string {
  const behind = `BEHIND ${card.traffic_id}`;
  const joins = `JOIN ${timeText(card.sky, other.joins_s)}`;
  const path = other.word === "" ? "" : ` VIA ${other.word}`;
  const spacing = `${formatMiles(other.spacing_m)} NM`;
  const when = other.begins_s > 0 ? `IN ${Math.round(other.begins_s)} S ` : "";
  return `EXPECT ${when}${behind} ${spacing}${path} ${joins}`;
}

/** Refuses what was asked for, and offers another in words. */
export function offer(station: Station, other: AlternativeManoeuvre): Promise<void> {
  const card = station.card.value;
  if (card === null) return Promise.resolve();
  return answer(station, "unable", reasonOf(card), offerText(card, other));
}

/** Why automation finds it not acceptable; else the controller's own reason. */
export function reasonOf(card: ClearanceCard): ReasonCode {
  return card.validation[0]?.findings[0]?.reason ?? "controller";
}
