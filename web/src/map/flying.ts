/** From the map into the air, and back: what is laid out becomes a flight, a flight is laid out. */

import { effect, untracked } from "@preact/signals";
import type { Session } from "../session";
import type { FlightRequest } from "../wire";
import { rememberMap } from "./address";
import { isSame, putSituation } from "./editing";
import { FIRST } from "./first";
import { situationOf } from "./from-flight";
import { entryOf } from "./gallery";
import { readAddress } from "./link";
import { bodyOf } from "./situation";

/** Starts a flight; `flies` is called once it does. */
type Begin = (wanted: FlightRequest, flies: () => void) => Promise<void>;

/** Puts the situation of an address on the map, and shows that; why it has none is said. */
export function layOut({ map, ndMode }: Session, address: URLSearchParams): void {
  const found = readAddress(address);
  const situation = found === null || typeof found === "string" ? FIRST : found;
  // Who comes back finds the map as it was.
  if (!map.isBegun.value || !isSame(situation, map.situation.value)) putSituation(map, situation);
  ndMode.value = "PLAN";
  if (typeof found === "string")
    map.notice.value = `This link is not laid out. ${found} Here is the paper's Fig. 6b.`;
}

/** Lays out where the two aircraft are now, the first time that the map is shown. */
export function followMode(session: Session): void {
  effect(() => {
    if (session.ndMode.value === "PLAN" && !session.map.isBegun.peek())
      untracked(() => mapFromFlight(session));
  });
}

export function mapFromFlight({ map, flight }: Session): void {
  putSituation(map, situationOf(flight) ?? FIRST);
}

/**
 * Makes a flight of what is laid out: its crew has the leader designated, and decides. It stands at its
 * first instant, with what is proposed, so that reading costs no time; Back leads to the map again.
 */
export function fly(session: Session, begin: Begin): void {
  const situation = session.map.situation.value;
  const { scenario, flies } = entryOf(situation) ?? {};
  const wanted = { rate: 1, engagement: "designated", paused: true } as const;
  // The map says of a leader that declares nothing that its intent is not known: so it is flown.
  const isKnown = situation.leader.intent.length > 0;
  const own = { ...wanted, situation: bodyOf(situation), intent_known: isKnown };
  const broken = flies === undefined ? own : { ...own, flown_intent: [...flies] };
  void begin(scenario === undefined ? broken : { ...wanted, scenario }, () => {
    rememberMap(situation);
    session.ndMode.value = "ARC";
  });
}
