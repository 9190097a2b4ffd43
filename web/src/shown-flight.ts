/** Which flight is shown: a new one, one in the air, or a recording; and what is done when it cannot be. */

import { batch } from "@preact/signals";
import { type Answer, createFlight } from "./api";
import type { Recording, Session } from "./session";
import type { FlightStore } from "./store/flight";
import { OTHER_VERSION, openStream, type Stream } from "./stream";
import { inPageUnits } from "./units";
import { type FlightRequest, type FlightStatus, PROTOCOL } from "./wire";

/** What a page that is opened without a flight shows: the paper's figure, nobody designated yet. */
export const FIRST_SCENARIO = "fig_6b";
/** A server that does not answer is asked again this often [ms]. */
export const ASK_AGAIN = 3000;

/** What is said to who commands a flight that is no more. */
export const OVER = "This flight is over: start a new one.";

/** What reads recordings is fetched with the first one. */
export const reading = () => import("./timeline/opening");

/** What showing a flight is done by. */
interface Means {
  readonly session: Session;
  readonly store: Pick<FlightStore, "receive" | "link" | "load" | "end">;
  say(kind: "sending" | "done" | "refused", text: string): void;
  /** What was ordered of the flight before is forgotten. */
  forgetOrders(): void;
}

export function createShownFlight({ session, store, say, forgetOrders }: Means) {
  let stream: Stream | null = null;
  let again: ReturnType<typeof setTimeout> | null = null;
  let attempt: () => void = () => undefined;
  /** Whether the page began with the map alone, so that nothing flies yet. */
  let isGrounded = false;

  /** Starts a flight and shows it; `flies` is called once it flies. */
  async function begin(wanted: FlightRequest, flies = () => {}): Promise<void> {
    isGrounded = false;
    forgetOrders();
    if (again !== null) clearTimeout(again);
    say("sending", "Starting the flight…");
    const answer = await createFlight(wanted);
    if (answer.kind === "done") {
      show(answer.value);
      flies();
      const hint = wanted.paused === true ? " It waits for you." : "";
      say("done", `New flight: ${answer.value.title}.${hint}`);
    } else if (answer.retryAfter !== undefined) {
      session.outage.value = null;
      say("sending", `${answer.sentence} It will start by itself.`);
      again = setTimeout(() => void begin(wanted, flies), 1000 * answer.retryAfter);
    } else if (session.status.value === null && session.ndMode.value !== "PLAN") {
      fail(answer, () => void begin(wanted, flies));
    } else {
      say("refused", inPageUnits(answer.sentence));
    }
  }

  function show(status: FlightStatus): void {
    stream?.close();
    session.outage.value = null;
    session.recording.value = null;
    session.status.value = status;
    visit(status.id);
    stream = openStream(status.stream_url, PROTOCOL, {
      tick(tick) {
        if (session.outage.value !== null) session.outage.value = null;
        store.receive(tick, performance.now());
      },
      link: (state) => store.link(state),
      broken(wait) {
        session.outage.value = {
          kind: "no_answer",
          text: "The connection to the server is lost.",
          nextTry: performance.now() + wait,
        };
      },
      refused(code, sentence) {
        // What was flown stays on show, and can be looked at again.
        if (code !== OTHER_VERSION) store.end(performance.now());
        session.outage.value =
          code === OTHER_VERSION
            ? { kind: "other_version", text: sentence || "The server is of another version." }
            : {
                kind: "flight_gone",
                text: sentence || OVER,
                scenario: status.scenario || FIRST_SCENARIO,
              };
      },
    });
  }

  /** Nothing could be shown: says why, and tries again by itself if nobody answered. */
  function fail(answer: Answer<unknown> & { kind: "refused" }, next: () => void): void {
    session.feedback.value = { kind: "none" };
    attempt = next;
    if (answer.status === 0) {
      const nextTry = performance.now() + ASK_AGAIN;
      session.outage.value = { kind: "no_answer", text: answer.sentence, nextTry };
      again = setTimeout(next, ASK_AGAIN);
    } else {
      session.outage.value = { kind: "refused", text: answer.sentence };
    }
  }

  /** Shows a recording in place of the flight; what is wrong with it is said, and all stays as it was. */
  async function replay(file: Blob, about: Pick<Recording, "id" | "from">): Promise<boolean> {
    say("sending", "Reading the recording…");
    const { readFile, titleOf } = await reading();
    const read = await readFile(file);
    if (read.kind === "refused") {
      say("refused", read.sentence);
      return false;
    }
    stream?.close();
    stream = null;
    if (again !== null) clearTimeout(again);
    isGrounded = false;
    const title = titleOf(read.documents);
    batch(() => {
      session.outage.value = null;
      session.status.value = null;
      session.recording.value = { ...about, title };
      if (session.ndMode.value === "PLAN") session.ndMode.value = "ARC";
      store.link("open");
      store.load(about.id, read.documents, performance.now());
    });
    visit(about.from === "record" ? about.id : null);
    say("done", `Recorded: ${title}.`);
    return true;
  }

  /** Notes in the address which flight is shown: going back shows the one before. */
  function visit(id: string | null): void {
    const address = new URL(location.href);
    const before = address.searchParams.get("flight");
    if (id === before) return;
    if (id === null) address.searchParams.delete("flight");
    else address.searchParams.set("flight", id);
    address.searchParams.delete("t");
    if (before === null) history.replaceState(null, "", address);
    else history.pushState(null, "", address);
  }

  function retry(): void {
    if (stream !== null) {
      stream.retry();
      return;
    }
    if (again !== null) clearTimeout(again);
    attempt();
  }

  return {
    begin,
    show,
    fail,
    replay,
    retry,
    stream: () => stream,
    isGrounded: () => isGrounded,
    /** Notes whether the page begins with the map alone. */
    ground(isAlone: boolean): void {
      isGrounded = isAlone;
    },
  };
}
