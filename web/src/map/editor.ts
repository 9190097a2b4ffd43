/** The map's state: the situation that is edited, what was answered to it, and what of it is in sight. */

import { batch, computed, type ReadonlySignal, type Signal, signal } from "@preact/signals";
import { emptyFlight } from "../store/flight";
import { createShown, type Shown } from "../store/shown";
import type { Flight } from "../store/types";
import { NM } from "../units";
import type { AreaAnswer } from "../wire";
import { FIRST } from "./first";
import type { Situation } from "./situation";
import { throttled } from "./throttle";
import type { Thumb } from "./thumbs";
import { createSteps, type Steps, takeStep } from "./undo";
import type { Answered } from "./what-if";

/** Ranges of the map [NM]: from its middle to its ring. */
const MAP_RANGES = [2, 3, 5, 7, 10, 15, 20, 30, 40, 60, 80, 120, 160, 240, 320] as const;
/** The ring's radius, and half of what is seen [px]. */
const RING = 250;
const HALF = 384;
/** What belongs in sight stays so far from the edge, as a part of half of what is seen. */
const ROOM = 0.8;

/** What is farther from both is not brought into sight with them [m]. */
const ABOUT = 60 * NM;

interface Place {
  readonly x_m: number;
  readonly y_m: number;
}

/** A convergence area, and the question that it answers. */
export interface Area {
  readonly asked: string;
  readonly answer: AreaAnswer;
}

export interface Editor {
  readonly situation: Signal<Situation>;
  /** The answer to it, or to what it was a moment ago; null while there is none. */
  readonly answered: Signal<Answered | null>;
  /** Whether what is shown answers an earlier situation, and the answer to this one is late. */
  readonly isLate: Signal<boolean>;
  /** What can be undone and done again. */
  readonly steps: Steps;
  /** Why the service plans nothing for it; empty if it does. */
  readonly refusal: Signal<string>;
  /** What is to be known of how the map began; empty if nothing. */
  readonly notice: Signal<string>;
  readonly area: Signal<Area | null>;
  /** What is in the middle of the map, and how far it is to the ring [NM]. */
  readonly centre: Signal<Place>;
  readonly range: Signal<number>;
  /** Whether all is brought into sight when the next answer comes. */
  readonly isToFit: Signal<boolean>;
  /** Whether regions of words and lines of equal time are shown. */
  readonly hasArea: Signal<boolean>;
  /** The gallery beside it. */
  readonly thumbs: Signal<readonly Thumb[]>;
  /** Whether a situation was ever put here. */
  readonly isBegun: Signal<boolean>;
  /** The situation as a flight at its first instant, and what is shown of it. */
  readonly flight: Flight;
  readonly shown: Shown;
  /** The same to be read, beside the map: it changes five times a second. */
  readonly reading: {
    /** All of it. */
    readonly whole: ReadonlySignal<{
      readonly situation: Situation;
      readonly answered: Answered | null;
    }>;
    readonly situation: ReadonlySignal<Situation>;
    readonly answered: ReadonlySignal<Answered | null>;
    readonly flight: Flight;
    readonly shown: Shown;
  };
}

export function createEditor(ghost?: Shown["ghost"]): Editor {
  const [flight, read] = [emptyFlight(), emptyFlight()];
  const situation = signal(FIRST);
  const answered = signal<Answered | null>(null);
  const slow = throttled(
    computed(() => ({ situation: situation.value, answered: answered.value })),
  );
  return {
    situation,
    answered,
    isLate: signal(false),
    steps: createSteps(),
    refusal: signal(""),
    notice: signal(""),
    area: signal(null),
    centre: signal({ x_m: 0, y_m: 0 }),
    range: signal(40),
    isToFit: signal(true),
    hasArea: signal(true),
    thumbs: signal([]),
    isBegun: signal(false),
    flight,
    shown: createShown(flight, ghost),
    reading: {
      whole: slow,
      situation: computed(() => slow.value.situation),
      answered: computed(() => slow.value.answered),
      flight: read,
      shown: createShown(read),
    },
  };
}

/** One step back (−1) or on again (+1); what is then out of sight is brought into it. */
export function step(editor: Editor, way: -1 | 1): void {
  const next = takeStep(editor.steps, editor.situation.value, way);
  if (next === null) return;
  editor.situation.value = next;
  const { x_m, y_m } = editor.centre.value;
  const half = halfExtent(editor.range.value);
  const isSeen = (place: Place) =>
    Math.abs(place.x_m - x_m) < half && Math.abs(place.y_m - y_m) < half;
  if (isSeen(next.pursuer) && isSeen(next.leader)) return;
  editor.isToFit.value = true;
  showAll(editor);
}

/** The smallest range, round the middle of them, that shows both aircraft, the slot and the path. */
export function showAll(editor: Editor): void {
  const { now, places } = editor.shown.picture.value;
  if (now === null) return;
  const { traffic, cells } = editor.situation.value;
  const about = [...traffic, ...cells].filter((each) =>
    [now.pursuer, now.leader].some(
      ({ x_m, y_m }) => Math.hypot(each.x_m - x_m, each.y_m - y_m) < ABOUT,
    ),
  );
  const { centre, range } = frameOf([now.pursuer, now.slot, ...places, ...about]);
  batch(() => {
    editor.centre.value = centre;
    editor.range.value = range;
  });
}

export function frameOf(places: readonly Place[]): { centre: Place; range: number } {
  const [x, y] = [places.map(({ x_m }) => x_m), places.map(({ y_m }) => y_m)];
  const middle = (values: number[]) => (Math.min(...values) + Math.max(...values)) / 2;
  const extent = Math.max(Math.max(...x) - Math.min(...x), Math.max(...y) - Math.min(...y)) / 2;
  const range =
    MAP_RANGES.find((each) => (each * NM * HALF * ROOM) / RING >= extent) ??
    MAP_RANGES[MAP_RANGES.length - 1] ??
    320;
  return { centre: { x_m: middle(x), y_m: middle(y) }, range };
}

/** The next range outward (+1) or inward (−1), about a place that stays where it is seen. */
export function zoom(editor: Editor, step: 1 | -1, about: Place = editor.centre.value): void {
  const before = editor.range.value;
  const range =
    step > 0
      ? MAP_RANGES.find((each) => each > before)
      : MAP_RANGES.findLast((each) => each < before);
  if (range === undefined) return;
  zoomTo(editor, range, about);
}

function zoomTo(editor: Editor, range: number, about: Place = editor.centre.value): void {
  const { centre } = editor;
  const ratio = range / editor.range.value;
  batch(() => {
    editor.range.value = range;
    centre.value = {
      x_m: about.x_m + (centre.value.x_m - about.x_m) * ratio,
      y_m: about.y_m + (centre.value.y_m - about.y_m) * ratio,
    };
  });
}

export function pan(editor: Editor, east: number, north: number): void {
  const { centre } = editor;
  centre.value = { x_m: centre.value.x_m + east, y_m: centre.value.y_m + north };
}

/** Half of what the map shows, east and north [m]. */
export function halfExtent(range: number): number {
  return (range * NM * HALF) / RING;
}
