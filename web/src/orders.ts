/** What the crew orders of the flight, and what is said of each order. */

import { effect, untracked } from "@preact/signals";
import { commandFlight, endFlight } from "./api";
import type { Crew } from "./hands/crew";
import type { Actions, Session } from "./session";
import { OVER } from "./shown-flight";
import type { Guidance } from "./store/states";
import type { Stream } from "./stream";
import type { createMoves } from "./timeline/moves";
import { formatHeading, formatKnots, inPageUnits, wrap360 } from "./units";
import type { Command, Direction, Engagement } from "./wire";

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
/** Why nothing can be accepted or engaged yet, where the page knows it. */
const TOO_EARLY: Partial<Record<Guidance, string>> = {
  designated: "A path is being looked for: accept it when it is proposed.",
  infeasible: "There is no path to accept now: it is looked for again by itself.",
  data_lost: "Nothing is heard of the leader: a path is proposed when it is.",
};

/** A heading as it will be flown, and as it was given where that is beyond a full turn. */
function sayHeading(heading: number): string {
  const text = formatHeading(heading);
  return heading < 0 || heading > 360 ? `${text} (${heading}° is ${text}°)` : text;
}

/** What ordering is done by. */
interface Means {
  readonly session: Session;
  /** The page's own clock: behind the newest nothing can be ordered. */
  readonly own: ReturnType<typeof createMoves>;
  say(kind: "sending" | "done" | "refused", text: string): void;
  stream(): Stream | null;
}

type Orders = Pick<
  Actions,
  | "end"
  | "engage"
  | "ownHeading"
  | "setAutopilot"
  | "setDirector"
  | "selectBank"
  | "selectSpeed"
  | "setSpacing"
  | "setLeaderData"
  | "play"
  | "pause"
  | "setRate"
  | "leaderHeading"
  | "leaderSpeed"
  | "setIntentKnown"
>;

/** The orders of a page, and `forget`, for when another flight begins. */
export function createOrders({ session, own, say, stream }: Means): {
  readonly orders: Orders;
  forget(): void;
} {
  let crew: Promise<Crew> | null = null;
  /** When this page last gave a command [ms]. */
  let commanded = Number.NEGATIVE_INFINITY;
  /** How far this page last ordered guidance to be engaged, until it is. */
  let ordered: Engagement | null = null;
  /** Whether a flight that went on for an acceptance stands again once that is taken, and waits until it is engaged. */
  let standsAgain = false;
  let waits = false;

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

  /** What only a crew does that flies by hand, or selects for itself, is fetched when it first does. */
  function byCrew(act: (crew: Crew) => void): void {
    const means = { session, command, say, refusal: own.refusal, stream };
    crew ??= import("./hands/crew").then(({ createCrew }) => createCrew(means));
    void crew.then(act);
  }

  const orders: Orders = {
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
  };

  function forget(): void {
    waits = standsAgain = false;
    ordered = null;
  }

  return { orders, forget };
}
