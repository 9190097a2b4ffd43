/** What the buttons do: the one place where the page talks to the server. */

import { batch, effect, untracked } from "@preact/signals";
import {
  type Answer,
  commandFlight,
  createFlight,
  endFlight,
  listScenarios,
  readFlight,
  readRecord,
} from "./api";
import type { Comparing } from "./compare/comparing";
import { referencesIn } from "./compare/references";
import type { Crew } from "./hands/crew";
import type { Actions, Recording, Session } from "./session";
import type { FlightStore } from "./store/flight";
import type { Guidance } from "./store/states";
import { OTHER_VERSION, openStream, type Stream } from "./stream";
import { lookAs } from "./timeline/link";
import { createMoves } from "./timeline/moves";
import {
  formatClock,
  formatHeading,
  formatKnots,
  inPageUnits,
  readClockText,
  wrap360,
} from "./units";
import {
  type Command,
  type Direction,
  type Engagement,
  type FlightRequest,
  type FlightStatus,
  PROTOCOL,
} from "./wire";

/** What a page that is opened without a flight shows: the paper's figure, nobody designated yet. */
const FIRST_SCENARIO = "fig_6b";
/** A crew decides at the pace of life; who opens a flight that is engaged wants to see it join. */
const RATE = { off: 1, engaged: 10 } as const;
/** A flight that is younger was begun by this page [s]. */
const BEGUN = 2;
/** A server that does not answer is asked again this often [ms]. */
const ASK_AGAIN = 3000;

/** What is said when the crew engages further, or less far. */
const ENGAGING: Record<Engagement, { doing: string; done: string }> = {
  off: { doing: "Disconnecting…", done: "Relative guidance is off." },
  designated: { doing: "Designating the leader…", done: "The leader is designated." },
  armed: { doing: "Accepting…", done: "Accepted: engage when ready." },
  engaged: { doing: "Engaging…", done: "Relative guidance is engaged." },
};

/** A flight that stands so early waits for its crew's orders: each lets it go on [s]. */
const BEGINNING = 4;
/** A refusal that comes so much later is about what somebody else commanded [ms]. */
const LATEST = 3000;
/** What is said to who commands a flight that is no more. */
const OVER = "This flight is over: start a new one.";

/** Why nothing can be accepted or engaged yet, where the page knows it. */
const TOO_EARLY: Partial<Record<Guidance, string>> = {
  designated: "A path is being looked for: accept it when it is proposed.",
  infeasible: "There is no path to accept now: it is looked for again by itself.",
  data_lost: "Nothing is heard of the leader: a path is proposed when it is.",
};

/** What reads recordings is fetched with the first one. */
const reading = () => import("./timeline/opening");

/** A heading as it will be flown, and as it was given where that is beyond a full turn. */
function sayHeading(heading: number): string {
  const text = formatHeading(heading);
  return heading < 0 || heading > 360 ? `${text} (${heading}° is ${text}°)` : text;
}

/** The actions of a page, and `open`, which begins: joins the flight of the address, or starts one. */
export function createActions(
  session: Session,
  store: Pick<FlightStore, "receive" | "link" | "load" | "merge" | "seek" | "follow" | "end">,
): Actions & { open(address: URLSearchParams): Promise<void> } {
  const own = createMoves(session, store);
  let stream: Stream | null = null;
  let again: ReturnType<typeof setTimeout> | null = null;
  let attempt: () => void = () => undefined;

  let crew: Promise<Crew> | null = null;

  /** How far new flights are engaged: `engaged` in the address says so from the start. */
  let engagement: keyof typeof RATE = "off";
  /** When this page last gave a command [ms]. */
  let commanded = Number.NEGATIVE_INFINITY;
  /** How far this page last ordered guidance to be engaged, until it is. */
  let ordered: Engagement | null = null;
  /** Whether a flight that went on for an acceptance stands again once that is taken, and waits until it is engaged. */
  let standsAgain = false;
  let waits = false;
  /** How many addresses were opened: an answer to an earlier one comes too late. */
  let opened = 0;
  /** Whether the page began with the map alone, so that nothing flies yet. */
  let isGrounded = false;

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
      isGrounded = joined === null;
      if (isGrounded) return;
    }
    isGrounded = false;
    lookAs(session, address);
    const [first, other] = referencesIn(address);
    if (first !== undefined && other !== undefined) {
      await (await comparing()).compare(first, other, readClockText(address.get("t") ?? ""));
      return;
    }
    session.comparison.other.value = null;
    if (first !== undefined) void comparing().then((both) => both.compareWith(first));
    if (joined === null) {
      await begin(requestOf(address.get("scenario") ?? FIRST_SCENARIO));
      return;
    }
    if (stream !== null && joined === session.status.value?.id) {
      const t = readClockText(address.get("t") ?? "");
      if (t !== null) own.moves.seek(t);
      return;
    }
    const answer = await readFlight(joined);
    if (turn !== opened) return; // another address is shown by now
    if (answer.kind === "done") {
      show(answer.value);
      await lookBack(answer.value, readClockText(address.get("t") ?? ""));
    } else if (answer.status === 404) {
      await openFlown(joined, readClockText(address.get("t") ?? ""));
    } else {
      fail(answer, () => void open(address));
    }
  }

  /** A flight that is no longer in the air: from the records if it is there, else a new one is begun. */
  async function openFlown(id: string, t: number | null): Promise<void> {
    const turn = opened;
    const answer = await readRecord(id);
    if (turn !== opened) return;
    if (answer.kind === "done") {
      const isShown = await replay(answer.value, { id, from: "record" });
      if (isShown && t !== null) seekKnown(t);
      return;
    }
    await begin(requestOf(FIRST_SCENARIO));
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
    if (t >= first && t <= last) own.moves.seek(t);
    else
      say(
        "refused",
        `The link asks for ${formatClock(t)}. The flight is known from ${formatClock(first)} to ${formatClock(last)}.`,
      );
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

  // What is refused when its second comes was taken before: the last word is the service's.
  effect(() => {
    const last = session.flight.read.value.engagement;
    if (last === null || last.engagement !== last.previous) return;
    if (performance.now() - commanded < LATEST) untracked(() => say("refused", last.message));
  });
  // What the flight has obeyed is told to the controller.
  effect(() => {
    const engagement = session.flight.moment.value.engagement?.engagement;
    if (engagement === undefined || engagement !== ordered) return;
    ordered = null;
    untracked(() => byCrew((each) => each.tellControl(engagement)));
  });
  // What stands takes orders when it goes on: once a path is accepted it stands again, to be read.
  effect(() => {
    if (session.flight.moment.value.engagement?.engagement !== "armed" || !standsAgain) return;
    standsAgain = false;
    const { doing, done } = ENGAGING.armed;
    untracked(() => void command({ command: "pause" }, doing, done));
  });
  // What the map needs is fetched when it is first shown.
  effect(() => {
    if (session.ndMode.value === "PLAN")
      void import("./map/room").then((map) => map.openMap(session));
  });
  // Whoever leaves the map without a flight sees the one that a page begins with.
  effect(() => {
    if (session.ndMode.value === "PLAN" || !isGrounded) return;
    untracked(() => void begin(requestOf(FIRST_SCENARIO)));
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

  /** Starts a flight and shows it; `flies` is called once it flies. */
  async function begin(wanted: FlightRequest, flies = () => {}): Promise<void> {
    isGrounded = false;
    waits = standsAgain = false;
    ordered = null;
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

  function say(kind: "sending" | "done" | "refused", text: string): void {
    session.feedback.value = { kind, text };
  }

  function standsAtStart(): boolean {
    const { clock, moment } = session.flight;
    return clock.value.paused && moment.value.t < BEGINNING;
  }

  async function end(): Promise<void> {
    const status = session.status.value;
    if (status === null) return;
    say("sending", "Ending the flight…");
    const answer = await endFlight(status.id);
    if (answer.kind === "done") say("done", "The flight is ended.");
    else say("refused", answer.sentence);
  }

  async function command(body: Command, doing: string, done: string): Promise<void> {
    const behind = own.refusal();
    if (behind !== null) {
      say("refused", behind);
      return;
    }
    const status = session.status.value;
    if (status === null) {
      say("refused", "There is no flight to command.");
      return;
    }
    say("sending", doing);
    commanded = performance.now();
    const answer = await commandFlight(status.id, body);
    if (answer.kind === "done") say("done", done);
    else say("refused", answer.status === 404 ? OVER : inPageUnits(answer.sentence));
  }

  function leaderHeading(heading: number, direction?: Direction): void {
    const way = direction === undefined ? "" : ` by the ${direction}`;
    const text = `Leader to heading ${sayHeading(heading)}${way}`;
    const body = { command: "leader_heading", heading_deg: wrap360(heading) } as const;
    void command(direction === undefined ? body : { ...body, direction }, `${text}…`, `${text}.`);
  }

  /** What shows two flights beside each other is fetched when it first does. */
  async function comparing(): Promise<Comparing> {
    const instead = () => begin(requestOf(FIRST_SCENARIO));
    const { createComparing } = await import("./compare/comparing");
    return createComparing({ session, say, replay, seek: own.moves.seek, instead });
  }

  /** What only a crew does that flies by hand, or selects for itself, is fetched when it first does. */
  function byCrew(act: (crew: Crew) => void): void {
    const means = { session, command, say, refusal: own.refusal, stream: () => stream };
    crew ??= import("./hands/crew").then(({ createCrew }) => createCrew(means));
    void crew.then(act);
  }

  return {
    open,
    start: (scenario) => void begin(requestOf(scenario)),
    end: () => void end(),
    engage(engagement) {
      const behind = own.refusal();
      if (behind !== null) {
        say("refused", behind);
        return;
      }
      // A click on a leader that is designated already takes nothing back.
      if (engagement === "designated" && session.shown.numbers.value.state !== "off") return;
      const tooEarly = TOO_EARLY[session.shown.numbers.value.state];
      if (tooEarly !== undefined && (engagement === "armed" || engagement === "engaged")) {
        say("refused", tooEarly);
        return;
      }
      const { doing, done } = ENGAGING[engagement];
      session.flight.isSent.value = engagement === "armed";
      ordered = engagement;
      void command({ command: "set_engagement", engagement }, doing, done).then(() => {
        // what it refuses at once brings no document
        if (session.feedback.value.kind === "refused") session.flight.isSent.value = false;
        else if (standsAtStart() || waits) {
          // Whoever engages at once is not held up by the pause that reading was to have.
          waits = standsAgain = engagement === "armed";
          void command({ command: "play" }, doing, done);
        }
      });
    },
    ownHeading(heading) {
      const text = `Own heading ${sayHeading(heading)} selected`;
      const body = { command: "pursuer_heading", heading_deg: wrap360(heading) } as const;
      void command(body, `${text}…`, `${text}.`);
    },
    setAutopilot: (on, director) => byCrew((crew) => crew.setAutopilot(on, director)),
    setDirector: (on) => byCrew((crew) => crew.setDirector(on)),
    selectBank: (bank) => byCrew((crew) => crew.selectBank(bank)),
    selectSpeed: (tas) => byCrew((crew) => crew.selectSpeed(tas)),
    setSpacing: (spacing) => byCrew((crew) => crew.setSpacing(spacing)),
    setLeaderData(received) {
      const text = received ? "Leader's reports received" : "Leader's reports lost";
      void command({ command: "leader_data", received }, `${text}…`, `${text}.`);
    },
    play() {
      if (own.isOwn() || session.flight.clock.value.ended) own.play();
      else void command({ command: "play" }, "Playing…", "Playing.");
    },
    pause() {
      if (own.isOwn()) own.pause();
      else void command({ command: "pause" }, "Pausing…", "Paused.");
    },
    setRate(rate) {
      if (own.isOwn() || session.flight.clock.value.ended) own.setRate(rate);
      else void command({ command: "set_rate", rate }, `Rate ×${rate}…`, `Rate ×${rate}.`);
    },
    leaderHeading,
    leaderSpeed(tas) {
      const text = `Leader to ${formatKnots(tas)} kt`;
      void command(
        { command: "leader_speed", tas_mps: Number(tas.toFixed(3)) },
        `${text}…`,
        `${text}.`,
      );
    },
    setIntentKnown(known) {
      const text = known ? "Leader's intent received" : "Leader's intent withdrawn";
      void command({ command: "intent_known", known }, `${text}…`, `${text}.`);
    },
    retry() {
      if (stream !== null) {
        stream.retry();
        return;
      }
      if (again !== null) clearTimeout(again);
      attempt();
    },
    fly: () => void import("./map/room").then((map) => map.fly(session, begin)),
    mapFromFlight: () => void import("./map/room").then((map) => map.mapFromFlight(session)),
    reload: () => location.reload(),
    ...own.moves,
    openRecord(id) {
      void readRecord(id).then((answer) => {
        if (answer.kind === "done") void replay(answer.value, { id, from: "record" });
        else say("refused", answer.sentence);
      });
    },
    openFile: (file) => void replay(file, { id: file.name, from: "file" }),
    compare: (first, other) => void comparing().then((both) => both.compare(first, other, null)),
    compareWith: (other) => void comparing().then((both) => both.compareWith(other)),
    endComparison: () => void comparing().then((both) => both.endComparison()),
  };
}
