/** What the page knows of all skies, and which instant of which sky it shows. */

import { batch, computed, type ReadonlySignal, type Signal, signal } from "@preact/signals";
import type { AtcDocument } from "../wire";
import {
  append,
  documentsOf,
  type Histories,
  type Mark,
  marksOf,
  newest,
  past,
  skyAt,
  spanOf,
} from "./history";
import { emptySky, type Sky } from "./sky";

/** The dots behind an aircraft: one in so long [s], so many. */
const DOT_EVERY = 10;
const DOTS = 12;

export interface AtcStore {
  /** The newest state of each sky: the earth first, flights in the order in which they came. */
  readonly skies: ReadonlySignal<readonly Sky[]>;
  /** Whose tab is open: the id of its sky. */
  readonly tab: Signal<string>;
  /** The instant that is shown, in the time of its sky [s]; null: the newest. */
  readonly instant: Signal<number | null>;
  /** The sky that is shown. */
  readonly sky: ReadonlySignal<Sky>;
  /** The same sky in the minutes before, newest first. */
  readonly trail: ReadonlySignal<readonly Sky[]>;
  /** From when until when it can be shown [s]. */
  readonly span: ReadonlySignal<readonly [number, number]>;
  readonly marks: ReadonlySignal<readonly Mark[]>;
  receive(documents: readonly AtcDocument[]): void;
  /** Forgets all that was received. */
  clear(): void;
  /** What tells of all skies all that is kept. */
  documents(): AtcDocument[];
}

export function createAtcStore(): AtcStore {
  const histories: Histories = new Map();
  const revision = signal(0);
  const tab = signal("");
  const instant = signal<number | null>(null);

  const history = computed(() => {
    revision.value;
    return histories.get(tab.value) ?? null;
  });
  const skies = computed(() => {
    revision.value;
    const all = [...histories.values()].map(newest);
    return [...all.filter(({ id }) => id === ""), ...all.filter(({ id }) => id !== "")];
  });
  const sky = computed(() => {
    revision.value;
    const shown = history.value;
    if (shown === null) return emptySky(tab.value);
    return instant.value === null ? newest(shown) : skyAt(shown, instant.value);
  });

  return {
    skies,
    tab,
    instant,
    sky,
    trail: computed(() => {
      const shown = history.value;
      return shown === null ? [] : past(shown, sky.value.t, DOT_EVERY, DOTS);
    }),
    span: computed(() => {
      revision.value;
      const shown = history.value;
      return shown === null ? [0, 0] : spanOf(shown);
    }),
    marks: computed(() => {
      revision.value;
      return history.value === null ? [] : marksOf(history.value);
    }),
    receive(documents) {
      batch(() => {
        for (const document of documents) append(histories, document);
        revision.value += 1;
        const [first] = histories.keys();
        if (!histories.has(tab.value) && first !== undefined) tab.value = first;
      });
    },
    clear() {
      batch(() => {
        histories.clear();
        instant.value = null;
        revision.value += 1;
      });
    },
    documents: () => [...histories.values()].flatMap(documentsOf),
  };
}
