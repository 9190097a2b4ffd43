/** Three short flights to learn hand flying on: what each asks for, and how far one is. */

import type { Flown, Second } from "../debrief/seconds";
import type { History } from "../store/history";
import { formatClock, wrap180 } from "../units";

/** What is known of a lesson while it is flown. */
interface Seen {
  readonly flown: Flown;
  readonly history: History;
}

export interface Step {
  readonly text: string;
  readonly isDone: (seen: Seen) => boolean;
}

export interface Lesson {
  /** As the service names it. */
  readonly scenario: string;
  readonly title: string;
  /** What to do, at most 60 words. */
  readonly card: string;
  /** Whether the bars are shown. */
  readonly director: boolean;
  readonly steps: readonly Step[];
}

/** A step is done once it was held for so long [s]. */
const HELD = 10;
/** On the bar within so much [deg]; a turn is asked for above this. */
const ON_BAR = 2;
const BANKED = 4;
/** On the heading asked for within so much [deg]. */
const ON_HEADING = 5;

/** How many of the seconds by hand are so. */
function held({ flown }: Seen, isSo: (second: Second) => boolean): number {
  return flown.seconds.filter((each) => each.byHand && isSo(each)).length;
}

function isOnBar({ sample: { bars, pursuer } }: Second): boolean {
  const bar = bars?.[0];
  return bar !== undefined && Math.abs(bar.commanded_bank_deg - pursuer.bank_deg) <= ON_BAR;
}

function turnAsked({ sample: { bars } }: Second): boolean {
  return Math.abs(bars?.[0]?.commanded_bank_deg ?? 0) > BANKED;
}

function isOnHeading({ sample: { reference, pursuer } }: Second): boolean {
  if (reference.kind !== "hold_heading") return false;
  return Math.abs(wrap180(pursuer.heading_deg - reference.heading_deg)) <= ON_HEADING;
}

function leaderTurnsAt({ events }: History): number {
  const turn = events.find((each) => each.kind === "leader_changed" && each.change === "heading");
  return turn?.t_s ?? Number.POSITIVE_INFINITY;
}

const TAKE: Step = { text: "You have control.", isDone: (seen) => seen.flown.byHand };
const JOIN: Step = {
  text: "Join: reach the slot behind the leader.",
  isDone: ({ flown }) => flown.joined !== null,
};

export const LESSONS: readonly Lesson[] = [
  {
    scenario: "lesson_bar",
    title: "Follow the bar",
    card: "You fly; the upright bar of the flight director says how. It stands right of the middle: roll right, until it is back in the middle. Hold ← or →, or drag the stick, to roll; let go, and the bank stays. Speed and level are kept for you.",
    director: true,
    steps: [
      TAKE,
      {
        text: `The turn: ${HELD} s within ${ON_BAR}° of the bar.`,
        isDone: (seen) => held(seen, (each) => turnAsked(each) && isOnBar(each)) >= HELD,
      },
      {
        text: `Level again: ${HELD} s on the bar.`,
        isDone: (seen) => held(seen, (each) => !turnAsked(each) && isOnBar(each)) >= HELD,
      },
      JOIN,
    ],
  },
  {
    scenario: "lesson_raw",
    title: "Converge without it",
    card: "No bars. The green path on the display turns right, then leads straight to the slot. Roll right with →, roll out with ← as your heading meets the path, and keep the aircraft on it. Green numbers say when the next turn is due.",
    director: false,
    steps: [
      TAKE,
      {
        text: `On the straight: ${HELD} s within ${ON_HEADING}° of its heading.`,
        isDone: (seen) => held(seen, isOnHeading) >= HELD,
      },
      {
        text: `Kept there for a minute in all.`,
        isDone: (seen) => held(seen, isOnHeading) >= 60,
      },
      JOIN,
    ],
  },
  {
    scenario: "lesson_turn",
    title: "When the leader turns untold",
    card: "Follow the bar as before. After a minute or so the leader turns and tells no one: the path is made anew every second, and the bar moves with it. Roll at once; each second of waiting costs time at the slot.",
    director: true,
    steps: [
      TAKE,
      {
        text: "The leader has turned.",
        isDone: ({ history, flown }) => leaderTurnsAt(history) <= flown.to,
      },
      {
        text: `Onto the new path: ${HELD} s within ${ON_BAR}° of the bar.`,
        isDone: (seen) =>
          held(seen, (each) => each.t > leaderTurnsAt(seen.history) && isOnBar(each)) >= HELD,
      },
      JOIN,
    ],
  },
];

/** The lesson that a flight of a scenario is; null if it is none. */
export function lessonOf(scenario: string | undefined): Lesson | null {
  return LESSONS.find((each) => each.scenario === scenario) ?? null;
}

/** How late it joined, in words: "4 s after the autopilot". */
export function sayLate(late: number): string {
  const whole = Math.round(late);
  if (whole === 0) return "with the autopilot, to the second";
  const size =
    Math.abs(whole) < 60 ? `${Math.abs(whole)} s` : `${formatClock(Math.abs(whole))} min`;
  return `${size} ${whole > 0 ? "after" : "before"} the autopilot`;
}

/** Marks by how late it joined at most [s], and what they mean. */
const MARKS = [
  [3, "A", "as well as the autopilot"],
  [10, "B", "well flown"],
  [30, "C", "joined"],
  [Number.POSITIVE_INFINITY, "D", "joined late"],
] as const;

export interface Mark {
  readonly letter: string;
  readonly words: string;
}

/** Null if it has not joined; no mark but F with the minimum lost. */
export function markOf(late: number | null, isLost: boolean): Mark | null {
  if (isLost) return { letter: "F", words: "closer than the minimum" };
  if (late === null) return null;
  const [, letter, words] = MARKS.find(([most]) => Math.round(late) <= most) ?? MARKS[3];
  return { letter, words };
}
