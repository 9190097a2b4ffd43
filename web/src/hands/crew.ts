/** What the crew does beside engaging: takes control and gives it back, selects bank, speed and spacing. */

import { effect, untracked } from "@preact/signals";
import { tellControl } from "../clearance";
import { type Actions, isFlying, type Session } from "../session";
import type { Stream } from "../stream";
import { formatKnots, formatMiles, inPageUnits } from "../units";
import type { AssignmentChanged, Command, ControlAnswer, Engagement } from "../wire";
import { flyByHand } from "./hand-flying";

/** Nobody flies faster than this by hand [s of flight per s]. */
const MOST_RATE = 5;
const LOST = "The connection to the server is lost.";

export interface Crew
  extends Pick<
    Actions,
    "setAutopilot" | "setDirector" | "selectBank" | "selectSpeed" | "setSpacing"
  > {
  /** Guidance was brought so far: the controller is told. */
  tellControl(engagement: Engagement): void;
}

/** What has been selected, until the flight says what it makes of it. */
interface Selected {
  /** What it had said before. */
  readonly before: AssignmentChanged | null;
  isObeyed(by: AssignmentChanged): boolean;
}

/** What a crew acts by. */
export interface Means {
  readonly session: Session;
  /** Gives a command and says what became of it. */
  command(body: Command, doing: string, done: string): Promise<void>;
  say(kind: "sending" | "done" | "refused", text: string): void;
  /** Why nothing can be commanded now; null if it can. */
  refusal(): string | null;
  stream(): Stream | null;
}

export function createCrew({ session, command, say, refusal, stream }: Means): Crew {
  const { hands, flight } = session;
  /** Whether the bars are wanted when control is taken: in each flight, until they are switched off. */
  let withDirector = true;
  /** What the page has asked for and has not been answered yet. */
  let asked: "take" | "give" | null = null;

  let selected: Selected | null = null;

  /** What is taken now may be refused when its second of flight comes: the last word is the flight's. */
  async function select(
    body: Command,
    text: string,
    isObeyed: Selected["isObeyed"],
  ): Promise<void> {
    selected = null;
    const { assignment: before } = flight.read.value;
    await command(body, `${text}…`, `${text}.`);
    selected = { before, isObeyed };
    judge();
  }

  function judge(): void {
    const { assignment } = flight.read.value;
    if (flight.source.value.kind !== "live") return; // what is shown was before
    if (selected === null || assignment === null || assignment === selected.before) return;
    const isObeyed = selected.isObeyed(assignment);
    selected = null;
    untracked(() => say(isObeyed ? "done" : "refused", inPageUnits(assignment.message)));
  }

  function answered({ yours, message }: ControlAnswer, link: Stream): void {
    const wasAsked = asked;
    asked = null;
    if (yours && hands.value === null) {
      hands.value = flyByHand(session, link.send);
      session.debriefOpen.value = session.sceneMaximised.value = false; // the instrument needs the room
    } else if (!yours) endFlying();
    const isWanted = wasAsked === (yours ? "take" : "give");
    say(isWanted ? "done" : "refused", inPageUnits(message));
  }

  function endFlying(): void {
    hands.peek()?.end();
    hands.value = null;
  }

  async function take(): Promise<void> {
    const why = refusal() ?? (isFlying(session) ? null : "There is no flight to fly.");
    if (why !== null) {
      say("refused", why);
      return;
    }
    const { rate } = flight.clock.value;
    if (rate > MOST_RATE) {
      const slower = `Rate ×1 from ×${rate}: by hand ×${MOST_RATE} is the most.`;
      await command({ command: "set_rate", rate: 1 }, slower, slower);
    }
    const link = stream();
    if (link?.send({ kind: "take_control", director: withDirector }) !== true) {
      say("refused", `${LOST} Control can be taken when it is there again.`);
      return;
    }
    asked = "take";
    link.answered = (answer) => answered(answer, link);
    say("sending", "Taking control…");
  }

  function giveBack(): void {
    if (hands.value === null) {
      void command({ command: "set_autopilot", on: true }, "Autopilot on…", "The autopilot flies.");
      return;
    }
    asked = "give";
    stream()?.send({ kind: "give_back" });
    say("sending", "Giving control back…");
  }

  effect(() => {
    void flight.id.value;
    withDirector = true;
    selected = null;
  });
  effect(judge);
  // Control ends with its link, and with its flight.
  effect(() => {
    if (flight.connection.value !== "lost" || hands.peek() === null) return;
    // data that are old may come by a link that still stands: then the service has to be told
    if (stream()?.send({ kind: "give_back" }) === true) asked = "give";
    endFlying();
    say("refused", `${LOST} The autopilot flies.`);
  });
  effect(() => {
    const isOver = flight.clock.value.ended || flight.id.value !== session.status.value?.id;
    if (isOver) endFlying();
  });

  return {
    tellControl: (engagement) => void tellControl(session, engagement, say),
    setAutopilot(on, director = withDirector) {
      withDirector = director;
      if (on) giveBack();
      else void take();
    },
    setDirector(on) {
      withDirector = on;
      const text = `Flight director ${on ? "on" : "off"}`;
      void command({ command: "set_director", on }, `${text}…`, `${text}.`);
    },
    selectBank(bank) {
      const text = `Bank of ${bank}° selected`;
      const body = { command: "pursuer_bank", bank_deg: bank } as const;
      void select(body, text, ({ max_bank_deg }) => isNear(max_bank_deg, bank));
    },
    selectSpeed(tas) {
      const text = tas === null ? "Speed by guidance" : `Own speed ${formatKnots(tas)} kt selected`;
      const tas_mps = Number((tas ?? 0).toFixed(3));
      void select({ command: "pursuer_speed", tas_mps }, text, ({ selected_tas_mps: [now] }) =>
        tas === null ? now === undefined : isNear(now, tas_mps),
      );
    },
    setSpacing(spacing) {
      const { slot_distance_m: slot, min_separation_m: min } = spacing;
      const said = [
        ...(slot === undefined ? [] : [`D ${formatMiles(slot)} NM`]),
        ...(min === undefined ? [] : [`minimum ${formatMiles(min)} NM`]),
      ].join(", ");
      const text = said.charAt(0).toUpperCase() + said.slice(1);
      void select({ command: "set_spacing", ...spacing }, text, (now) => {
        const { slot_distance_m = now.slot_distance_m, min_separation_m = now.min_separation_m } =
          spacing;
        return (
          isNear(now.slot_distance_m, slot_distance_m) &&
          isNear(now.min_separation_m, min_separation_m)
        );
      });
    },
  };
}

/** Whether a number came back as it was sent: degrees, m/s and metres are rounded by less on the way. */
function isNear(now: number | undefined, asked: number): boolean {
  return now !== undefined && Math.abs(now - asked) < 0.01;
}
