/** The flight that the shown one is compared with, and which of their instants stand side by side. */

import { computed, type ReadonlySignal, type Signal, signal } from "@preact/signals";
import { type Ghost, ghostOf } from "../store/ghost";
import type { History } from "../store/history";
import type { PairCard } from "../store/pair";
import type { Flight } from "../store/types";
import { type Alignment, alignment } from "./alignment";

/** A flight that is seen beside the shown one. */
export interface Compared {
  /** As the address names it; null for a file, which no link can name. */
  readonly reference: string | null;
  readonly title: string;
  readonly history: History;
}

export interface Comparison {
  readonly other: Signal<Compared | null>;
  readonly how: Signal<Alignment>;
  /** By how much the other one's time is later [s]; null where `how` is not possible yet. */
  readonly offset: ReadonlySignal<number | null>;
  readonly ghost: ReadonlySignal<Ghost | null>;
}

/** Nothing is compared yet. */
export function createComparison(flight: Flight, history: () => History): Comparison {
  const other = signal<Compared | null>(null);
  const how = signal<Alignment>("engaged");
  const offset = computed(() => {
    void flight.read.value; // no more often than it is read
    return other.value === null ? null : alignment(history(), other.value.history, how.value);
  });
  const ghost = computed(() => {
    const [{ now, t }, compared] = [flight.moment.value, other.value];
    if (compared === null) return null;
    const name = shortName(compared.history.knownAt(Number.POSITIVE_INFINITY).started);
    const beside = { name, history: compared.history, t: t + (offset.value ?? 0) };
    return ghostOf(history(), now, beside);
  });
  return { other, how, offset, ghost };
}

/** What a flight is called where there is room for a word: its scenario, e.g. "FIG 6A". */
export function shortName(started: PairCard | null): string {
  const scenario = started?.scenario ?? "";
  return scenario === "" ? "OTHER" : scenario.replaceAll("_", " ").toUpperCase().slice(0, 14);
}
