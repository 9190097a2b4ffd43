/** What the buttons do: orders to the flight, the flights that are shown, the map, and two flights compared. */

import { effect } from "@preact/signals";
import { readRecord } from "./api";
import type { Comparing } from "./compare/comparing";
import { createOpening } from "./opening";
import { createOrders } from "./orders";
import type { Actions, Session } from "./session";
import { createShownFlight, FIRST_SCENARIO } from "./shown-flight";
import type { FlightStore } from "./store/flight";
import { createMoves } from "./timeline/moves";

/** The actions of a page, and `open`, which begins: joins the flight of the address, or starts one. */
export function createActions(
  session: Session,
  store: Pick<FlightStore, "receive" | "link" | "load" | "merge" | "seek" | "follow" | "end">,
): Actions & { open(address: URLSearchParams): Promise<void> } {
  const own = createMoves(session, store);
  const { orders, forget } = createOrders({ session, own, say, stream: () => showing.stream() });
  const showing = createShownFlight({ session, store, say, forgetOrders: forget });
  const { seek } = own.moves;
  const { open, requestOf } = createOpening({ session, store, showing, seek, say, comparing });

  // What the map needs is fetched when it is first shown.
  effect(() => {
    if (session.ndMode.value === "PLAN")
      void import("./map/room").then((map) => map.openMap(session));
  });

  function say(kind: "sending" | "done" | "refused", text: string): void {
    session.feedback.value = { kind, text };
  }

  /** What shows two flights beside each other is fetched when it first does. */
  async function comparing(): Promise<Comparing> {
    const instead = () => showing.begin(requestOf(FIRST_SCENARIO));
    const { createComparing } = await import("./compare/comparing");
    return createComparing({ session, say, replay: showing.replay, seek, instead });
  }

  return {
    open,
    start: (scenario) => void showing.begin(requestOf(scenario)),
    ...orders,
    retry: showing.retry,
    fly: () => void import("./map/room").then((map) => map.fly(session, showing.begin)),
    mapFromFlight: () => void import("./map/room").then((map) => map.mapFromFlight(session)),
    reload: () => location.reload(),
    ...own.moves,
    openRecord(id) {
      void readRecord(id).then((answer) => {
        if (answer.kind === "done") void showing.replay(answer.value, { id, from: "record" });
        else say("refused", answer.sentence);
      });
    },
    openFile: (file) => void showing.replay(file, { id: file.name, from: "file" }),
    compare: (first, other) => void comparing().then((both) => both.compare(first, other, null)),
    compareWith: (other) => void comparing().then((both) => both.compareWith(other)),
    endComparison: () => void comparing().then((both) => both.endComparison()),
  };
}
