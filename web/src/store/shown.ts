/** What every part of the page shows of a flight: its picture and numbers, as signals. */

import { computed, type ReadonlySignal, type Signal, signal } from "@preact/signals";
import type { ComparedPlanner, PathSegment } from "../wire";
import { type Announcements, announcementsOf } from "./announcements";
import { describe } from "./description";
import type { Ghost } from "./ghost";
import { type Moved, movedBy, STILL } from "./motion";
import { type Numbers, numbersOf } from "./numbers";
import { type Picture, pictureOf } from "./picture";
import type { Flight } from "./types";

/** The path that one of several compared planners would fly, over the ground from its beginning. */
export interface Rival {
  readonly planner: ComparedPlanner;
  readonly segments: readonly PathSegment[];
  /** Whether it may be flown, and whether it is drawn strongest. */
  readonly isFlyable: boolean;
  readonly isChosen: boolean;
}

/** What is shown: the picture and its numbers, and how far all has moved since it was drawn. */
export interface Shown {
  readonly picture: ReadonlySignal<Picture>;
  /** Changes with each frame between two pictures. */
  readonly moved: ReadonlySignal<Moved>;
  readonly numbers: ReadonlySignal<Numbers>;
  /** The picture in words. */
  readonly words: ReadonlySignal<string>;
  /** What is spoken of it. */
  readonly spoken: ReadonlySignal<Announcements>;
  /** Another flight that is seen beside this one; null if there is none. */
  readonly ghost: ReadonlySignal<Ghost | null>;
  /** What planners that are compared would fly; none while that is closed. */
  readonly rivals: ReadonlySignal<readonly Rival[]>;
  /** Whether one instant stands on the page, so that nothing in its picture depends on what came before. */
  readonly stands: ReadonlySignal<boolean>;
  /** The ident of the other aircraft whose numbers are shown; null for none. */
  readonly chosen: Signal<string | null>;
}

const NO_GHOST: ReadonlySignal<Ghost | null> = signal(null);
const NO_RIVALS: ReadonlySignal<readonly Rival[]> = signal([]);

export function createShown(
  { moment, read, since, isSent, source }: Flight,
  ghost: Shown["ghost"] = NO_GHOST,
  rivals: Shown["rivals"] = NO_RIVALS,
): Shown {
  const numbers = computed(() => numbersOf(read.value));
  return {
    picture: computed(() => pictureOf({ ...moment.value, isSent: isSent.value })),
    moved: computed(() => {
      const { now } = moment.value;
      return now === null ? STILL : movedBy(now, since.value);
    }),
    numbers,
    words: computed(() => describe(read.value, numbers.value)),
    spoken: computed(() => announcementsOf(read.value)),
    ghost,
    rivals,
    stands: computed(() => source.value.kind === "replay" && source.value.rate === 0),
    chosen: signal(null),
  };
}
