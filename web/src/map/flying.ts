/** From the map into the air, and back: what is laid out becomes a flight, a flight is laid out. */

import { effect, untracked } from "@preact/signals";
import type { Actions, Session } from "../session";
import type { FlightRequest } from "../wire";
import { putSituation } from "./editor";
import { situationOf } from "./from-flight";
import { entryOf, type Surprise } from "./gallery";
import { bodyOf, FIRST, readAddress } from "./situation";

/** Starts a flight; `flies` is called once it does. */
type Begin = (wanted: FlightRequest, flies: () => void) => Promise<void>;

/** Puts the situation of an address on the map, and shows that. */
export function layOut({ map, ndMode }: Session, address: URLSearchParams): void {
  const situation = readAddress(address);
  putSituation(map, situation ?? FIRST);
  ndMode.value = "PLAN";
  if (situation === null && address.has("own"))
    map.notice.value = "This link holds no whole situation: here is the paper's Fig. 6b.";
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

/** Makes a flight of what is laid out: its crew has the leader designated, and decides. */
export function fly(session: Session, begin: Begin, actions: Pick<Actions, "leaderHeading">): void {
  const situation = session.map.situation.value;
  const { scenario, surprise } = entryOf(situation) ?? {};
  const wanted = { rate: 1, engagement: "designated" } as const;
  void begin(
    scenario === undefined ? { ...wanted, situation: bodyOf(situation) } : { ...wanted, scenario },
    () => {
      session.ndMode.value = "ARC";
      if (surprise !== undefined) turnLater(session, surprise, actions);
    },
  );
}

/** What a leader of the gallery does without having said so. */
function turnLater(
  { flight, status }: Session,
  { at, heading, direction }: Surprise,
  actions: Pick<Actions, "leaderHeading">,
): void {
  const flown = status.value?.id;
  const stop = effect(() => {
    const isOver = status.value?.id !== flown;
    const isDue = flight.id.value === flown && flight.simTime.value >= at;
    if (!isOver && !isDue) return;
    queueMicrotask(() => {
      stop();
      if (isDue) actions.leaderHeading(heading, direction);
    });
  });
}
