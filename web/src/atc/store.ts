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
import { isOver } from "./urgency";

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
  /** Takes documents in, heard at a time of the wall clock [ms]. */
  receive(documents: readonly AtcDocument[], heard?: number): void;
  /** Takes in all that stands now: what else was known to live is over. The past is kept. */
  renew(documents: readonly AtcDocument[]): void;
  /** Forgets all that was received. */
  clear(): void;
  /** What tells of all skies all that is kept. */
  documents(): AtcDocument[];
}

const UNKNOWN = "The service does not know this clearance any more.";
/** A sky that was not heard of for so long, while others were, is gone [ms]. */
const GONE = 60_000;

/** Whether a flight has ended: the service then tells only its requests, all of which are over. */
function isEmpty({ id, aircraft, clearances }: Sky): boolean {
  if (id === "" || aircraft.length > 0 || clearances.size === 0) return false;
  return [...clearances.values()].every(isOver);
}

export function createAtcStore(): AtcStore {
  const histories: Histories = new Map();
  /** When each sky was heard of last, and when any was. */
  const heardOf = new Map<string, number>();
  let last = 0;
  const revision = signal(0);
  const tab = signal("");
  const instant = signal<number | null>(null);

  const history = computed(() => {
    revision.value;
    return histories.get(tab.value) ?? null;
  });
  const skies = computed(() => {
    revision.value;
    const isThere = ({ id }: Sky) => last - (heardOf.get(id) ?? last) < GONE;
    const all = [...histories.values()]
      .map(newest)
      .filter((each) => each.id === tab.value || (isThere(each) && !isEmpty(each)));
    return [...all.filter(({ id }) => id === ""), ...all.filter(({ id }) => id !== "")];
  });
  const sky = computed(() => {
    revision.value;
    const shown = history.value;
    if (shown === null) return emptySky(tab.value);
    return instant.value === null ? newest(shown) : skyAt(shown, instant.value);
  });

  const receive = (documents: readonly AtcDocument[], heard = Date.now()) =>
    batch(() => {
      last = heard;
      for (const document of documents) {
        const history = append(histories, document);
        if (history !== null) heardOf.set(history.id, heard);
      }
      revision.value += 1;
      const [first] = histories.keys();
      if (!histories.has(tab.value) && first !== undefined) tab.value = first;
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
    receive,
    renew(documents) {
      const living = new Set(
        documents.map((each) => each.kind === "clearance_changed" && each.clearance.id),
      );
      const over = [...histories.values()]
        .map(newest)
        .flatMap(({ t, clearances }) =>
          [...clearances.values()]
            .filter((card) => !isOver(card) && !living.has(card.id))
            .map(({ id }): AtcDocument => ({ kind: "expired", t_s: t, id, message: UNKNOWN })),
        );
      receive([...over, ...documents]);
    },
    clear() {
      batch(() => {
        histories.clear();
        heardOf.clear();
        instant.value = null;
        revision.value += 1;
      });
    },
    documents: () => [...histories.values()].flatMap(documentsOf),
  };
}
