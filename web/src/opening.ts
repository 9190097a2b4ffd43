/** What the page begins with: the flight of its address, on the map, beside another or from the records, or a new one. */

import { effect, untracked } from "@preact/signals";
import { listScenarios, readFlight, readRecord } from "./api";
import type { Comparing } from "./compare/comparing";
import { referencesIn } from "./compare/references";
import type { Actions, Session } from "./session";
import { ASK_AGAIN, type createShownFlight, FIRST_SCENARIO, reading } from "./shown-flight";
import type { FlightStore } from "./store/flight";
import { lookAs } from "./timeline/link";
import { formatClock, readClockText } from "./units";
import type { FlightRequest, FlightStatus } from "./wire";

/** A crew decides at the pace of life; who opens a flight that is engaged wants to see it join. */
const RATE = { off: 1, engaged: 10 } as const;
/** A flight that is younger was begun by this page [s]. */
const BEGUN = 2;

/** What opening is done by. */
interface Means {
  readonly session: Session;
  readonly store: Pick<FlightStore, "merge">;
  readonly showing: ReturnType<typeof createShownFlight>;
  readonly seek: Actions["seek"];
  say(kind: "sending" | "done" | "refused", text: string): void;
  comparing(): Promise<Comparing>;
}

/** Opens addresses, and says how a flight of a scenario is asked for. */
export function createOpening({ session, store, showing, seek, say, comparing }: Means) {
  /** How far new flights are engaged: `engaged` in the address says so from the start. */
  let engagement: keyof typeof RATE = "off";
  /** How many addresses were opened: an answer to an earlier one comes too late. */
  let opened = 0;

  async function open(address: URLSearchParams): Promise<void> {
    session.isOpening.value = true;
    await openAs(address);
    session.isOpening.value = false;
  }

  async function openAs(address: URLSearchParams): Promise<void> {
    engagement = address.has("engaged") ? "engaged" : "off";
    const joined = address.get("flight") || null; // an empty name is none
    const turn = ++opened;
    session.feedback.value = { kind: "none" }; // what was said was of the address before
    void loadScenarios();
    if (address.has("plan")) {
      (await import("./map/room")).layOut(session, address);
      showing.ground(joined === null);
      if (joined === null) return;
    }
    showing.ground(false);
    lookAs(session, address);
    const [first, other] = referencesIn(address);
    if (first !== undefined && other !== undefined) {
      await (await comparing()).compare(first, other, readClockText(address.get("t") ?? ""));
      return;
    }
    session.comparison.other.value = null;
    if (first !== undefined) void comparing().then((both) => both.compareWith(first));
    if (joined === null) {
      await showing.begin(requestOf(address.get("scenario") ?? FIRST_SCENARIO));
      return;
    }
    if (showing.stream() !== null && joined === session.status.value?.id) {
      const t = readClockText(address.get("t") ?? "");
      if (t !== null) seek(t);
      return;
    }
    const answer = await readFlight(joined);
    if (turn !== opened) return; // another address is shown by now
    if (answer.kind === "done") {
      showing.show(answer.value);
      await lookBack(answer.value, readClockText(address.get("t") ?? ""));
    } else if (answer.status === 404) {
      await openFlown(joined, readClockText(address.get("t") ?? ""));
    } else {
      showing.fail(answer, () => void open(address));
    }
  }

  /** A flight that is no longer in the air: from the records if it is there, else a new one is begun. */
  async function openFlown(id: string, t: number | null): Promise<void> {
    const turn = opened;
    const answer = await readRecord(id);
    if (turn !== opened) return;
    if (answer.kind === "done") {
      const isShown = await showing.replay(answer.value, { id, from: "record" });
      if (isShown && t !== null) seekKnown(t);
      return;
    }
    await showing.begin(requestOf(FIRST_SCENARIO));
    say("done", `Flight ${id} is neither flown here nor on record, so a new one was started.`);
  }

  /** What was flown before this page came, as far as it is on record; then shows flight time `t` [s]. */
  async function lookBack(status: FlightStatus, t: number | null): Promise<void> {
    if (status.t_s > BEGUN && status.recorded) {
      const answer = await readRecord(status.id);
      const read = answer.kind === "done" ? await (await reading()).readFile(answer.value) : null;
      await beginning(status.id);
      if (session.status.value?.id !== status.id) return; // another one is shown by now
      if (read?.kind === "read") store.merge(read.documents, performance.now());
    }
    if (t === null) return;
    await beginning(status.id);
    seekKnown(t);
  }

  /** When the first that is known of a flight is there, or another one is shown. */
  function beginning(id: string): Promise<void> {
    const { flight, status } = session;
    return new Promise((resolve) => {
      const stop = effect(() => {
        const isThere = flight.id.value === id && flight.span.value !== null;
        if (!isThere && status.value?.id === id) return;
        resolve();
        queueMicrotask(() => stop());
      });
    });
  }

  /** Shows the flight time of a link; one that is not known is refused, and all stays as it was. */
  function seekKnown(t: number): void {
    const { first, last } = session.flight.span.value ?? { first: 0, last: 0 };
    if (t >= first && t <= last) seek(t);
    else
      say(
        "refused",
        `The link asks for ${formatClock(t)}. The flight is known from ${formatClock(first)} to ${formatClock(last)}.`,
      );
  }

  // Whoever leaves the map without a flight sees the one that a page begins with.
  effect(() => {
    if (session.ndMode.value === "PLAN" || !showing.isGrounded()) return;
    untracked(() => void showing.begin(requestOf(FIRST_SCENARIO)));
  });

  function requestOf(scenario: string): FlightRequest {
    if (scenario.startsWith("lesson"))
      return { scenario, rate: 1, paused: true, engagement: "engaged" };
    return { scenario, rate: RATE[engagement], engagement };
  }

  async function loadScenarios(): Promise<void> {
    const answer = await listScenarios();
    if (answer.kind === "done") session.scenarios.value = answer.value;
    else if (answer.status === 0) setTimeout(() => void loadScenarios(), ASK_AGAIN);
  }

  return { open, requestOf };
}
