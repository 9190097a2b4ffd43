/** The state of the page around the instruments, and what its buttons do: signals and types, no network. */

import { type Signal, signal } from "@preact/signals";
import type { Readiness } from "./api";
import { type Comparison, createComparison } from "./compare/compared";
import type { HandFlying } from "./hands/hand-flying";
import { createEditor, type Editor } from "./map/editor";
import { createPlanners, type Planners } from "./planners";
import { createHistory, type History } from "./store/history";
import { createShown, type Shown } from "./store/shown";
import type { Flight } from "./store/types";
import type { Direction, Engagement, FlightStatus, ScenarioInfo } from "./wire";

/** PLAN is the map, where a situation is laid out before it is flown. */
export type NdMode = "ROSE" | "ARC" | "PLAN";
export const ND_RANGES = [10, 20, 40, 80, 160, 320] as const;
/** Range of the navigation display [NM]. */
type NdRange = (typeof ND_RANGES)[number];
/** Simulated seconds per wall-clock second, as offered. */
export const RATES = [1, 2, 5, 10, 20, 60] as const;

/** The same behind the newest, where the page's own clock runs. */
export const REPLAY_RATES = [0.25, 0.5, 1, 2, 5, 10, 20, 60] as const;

/** What became of the last command. */
export type Feedback =
  | { readonly kind: "none" }
  | { readonly kind: "sending"; readonly text: string }
  | { readonly kind: "done"; readonly text: string }
  | { readonly kind: "refused"; readonly text: string };

/** Why nothing flies on the screen, in a sentence, and what can be done. */
export type Outage =
  | { readonly kind: "no_answer"; readonly text: string; readonly nextTry: number }
  | { readonly kind: "flight_gone"; readonly text: string; readonly scenario: string }
  | { readonly kind: "refused"; readonly text: string }
  | { readonly kind: "other_version"; readonly text: string };

/** A recording on the screen: of which flight, and from where it came. */
export interface Recording {
  readonly id: string;
  readonly title: string;
  /** A flight on record of the service, a file of the user's own, or a scenario flown at once. */
  readonly from: "record" | "file" | "scenario";
}

export interface Session {
  readonly flight: Flight;
  /** All that the page knows of the flight: what is drawn over time reads it. */
  readonly history: () => History;
  /** What is shown in place of a flight that flies; null while one does. */
  readonly recording: Signal<Recording | null>;
  /** Whether what the address asks for is still on its way. */
  readonly isOpening: Signal<boolean>;
  /** How fast the page's own clock runs when it does [s of flight per s]. */
  readonly replayRate: Signal<number>;
  /** Why a typed time was not taken; "" if it was. */
  readonly timeRefusal: Signal<string>;
  /** Whether the list of flights on record is open, and what can be taken away. */
  readonly recordsOpen: Signal<boolean>;
  readonly exportOpen: Signal<boolean>;
  /** The picture of this instant, and its numbers: what every part of the page shows. */
  readonly shown: Shown;
  readonly scenarios: Signal<readonly ScenarioInfo[]>;
  readonly status: Signal<FlightStatus | null>;
  readonly feedback: Signal<Feedback>;
  readonly outage: Signal<Outage | null>;
  readonly ndMode: Signal<NdMode>;
  /** The range of the navigation display: what was selected, or fits. */
  readonly ndRange: Signal<NdRange>;
  /** Whether the range is the one that fits, until one is selected. */
  readonly ndAuto: Signal<boolean>;
  /** What is laid out on the map. */
  readonly map: Editor;
  /** The flight that is seen beside the shown one, if there is one. */
  readonly comparison: Comparison;
  /** Whether the flight is drawn over time in the scene's place. */
  readonly chartsOpen: Signal<boolean>;
  /** Whether it is told there how the flight went, and the stretches in which that says time was lost. */
  readonly debriefOpen: Signal<boolean>;
  readonly lost: Signal<readonly { readonly from: number; readonly to: number }[]>;
  /** Four planners side by side. */
  readonly planners: Planners;
  /** Whether the primary flight display was asked for; it is shown in any case while the crew flies. */
  readonly pfdOpen: Signal<boolean>;
  readonly sceneMaximised: Signal<boolean>;
  readonly helpOpen: Signal<boolean>;
  /** Whether single letters are keys. */
  readonly letterKeys: Signal<boolean>;
  /** Whether the colours are those that anybody can tell apart. */
  readonly distinctColours: Signal<boolean>;
  /** Whether the five captions of a first minute are shown. */
  readonly captions: Signal<boolean>;
  /** Whether alerts are heard. */
  readonly sound: Signal<boolean>;
  /** The stick, while this page flies own ship by hand. */
  readonly hands: Signal<HandFlying | null>;
  /** What a first start has yet to prepare; null when that is done. */
  readonly firstStart: Signal<Readiness | null>;
}

/** What the buttons do. Each ends in `session.feedback`. */
export interface Actions {
  /** Starts a new flight of a scenario and shows it. */
  start(scenario: string): void;
  /** Ends the flight, for all who watch it. */
  end(): void;
  /** Designates the leader, accepts what is proposed, engages it, or disconnects. */
  engage(engagement: Engagement): void;
  /** Selects a heading for own ship [deg], while guidance is not engaged. */
  ownHeading(heading: number): void;
  /**
   * Gives own ship to the autopilot, or takes control from it: this page then flies by hand, with the
   * bars or without; if that is left out, as they were switched in this flight.
   */
  setAutopilot(on: boolean, director?: boolean): void;
  /** Switches the flight director's bars. */
  setDirector(on: boolean): void;
  /** Selects the bank that plans turn with [deg]. */
  selectBank(bank: number): void;
  /** Selects own true airspeed [m/s]; null leaves it to guidance. */
  selectSpeed(tas: number | null): void;
  /** Changes D, d_min or both. */
  setSpacing(spacing: {
    readonly slot_distance_m?: number;
    readonly min_separation_m?: number;
  }): void;
  /** Lets the leader's reports be received, or not. */
  setLeaderData(received: boolean): void;
  play(): void;
  pause(): void;
  setRate(rate: number): void;
  /** Turns the leader to a heading [deg], by the shorter way if no side is given. */
  leaderHeading(heading: number, direction?: Direction): void;
  /** Changes the leader's true airspeed [m/s]. */
  leaderSpeed(tas: number): void;
  setIntentKnown(known: boolean): void;
  /** Tries the lost connection again, now. */
  retry(): void;
  /** Makes a flight of what is laid out on the map. */
  fly(): void;
  /** Lays out on the map where the flight's two aircraft are now. */
  mapFromFlight(): void;
  /** Loads the page anew. */
  reload(): void;
  /** Shows flight time `t` [s]: the page's own clock then runs as it did, or stands. */
  seek(t: number): void;
  /** Shows the instant so many seconds later, or earlier. */
  step(seconds: number): void;
  /** Shows the event before or after. */
  toMark(way: 1 | -1): void;
  /** Shows the newest again. */
  live(): void;
  /** Begins or ends showing the last half minute again and again; sets where that begins, or ends. */
  toggleLoop(): void;
  setLoop(end: "from" | "to"): void;
  /** Shows a flight on record, or a recording of the user's own. */
  openRecord(id: string): void;
  openFile(file: File): void;
  /** Shows two flights beside each other, each named as in the address. */
  compare(first: string, other: string): void;
  /** Shows another flight, or a recording of the user's own, beside the one that is shown. */
  compareWith(other: string | File): void;
  endComparison(): void;
}

export function createSession(
  flight: Flight,
  firstStart: Signal<Readiness | null> = signal(null),
  history: () => History = createHistory,
): Session {
  const comparison = createComparison(flight, history);
  const planners = createPlanners();
  return {
    flight,
    history,
    recording: signal(null),
    isOpening: signal(false),
    replayRate: signal(1),
    timeRefusal: signal(""),
    recordsOpen: signal(false),
    exportOpen: signal(false),
    shown: createShown(flight, comparison.ghost, planners.rivals),
    comparison,
    planners,
    chartsOpen: signal(false),
    debriefOpen: signal(false),
    lost: signal([]),
    scenarios: signal([]),
    status: signal(null),
    feedback: signal({ kind: "none" }),
    outage: signal(null),
    ndMode: signal("ARC"),
    ndRange: signal(40),
    ndAuto: signal(true),
    map: createEditor(comparison.ghost),
    pfdOpen: signal(false),
    sceneMaximised: signal(false),
    helpOpen: signal(false),
    letterKeys: signal(true),
    distinctColours: signal(false),
    captions: signal(true),
    sound: signal(true),
    hands: signal(null),
    firstStart,
  };
}

/** Whether there is a flight that takes commands. */
export function isFlying({ flight, outage }: Session): boolean {
  const isOver = flight.clock.value.ended || flight.read.value.result !== null;
  return !isOver && outage.value?.kind !== "flight_gone";
}

/** The next range outward (+1) or inward (−1), held to the ends of the selector. */
export function stepRange(range: NdRange, step: 1 | -1): NdRange {
  return ND_RANGES[ND_RANGES.indexOf(range) + step] ?? range;
}
