/** A small picture of each situation of the gallery: a flight at its first instant, with its plan. */

import { effect, type Signal, signal } from "@preact/signals";
import { emptyFlight } from "../store/flight";
import { createShown, type Shown } from "../store/shown";
import { type Entry, GALLERY } from "./gallery";
import { settle } from "./situation";
import { type Answered, showWhatIf } from "./what-if";

export interface Thumb {
  readonly entry: Entry;
  readonly answered: Signal<Answered | null>;
  readonly shown: Shown;
}

export function createThumbs(): readonly Thumb[] {
  return GALLERY.map((entry) => {
    const flight = emptyFlight();
    const answered = signal<Answered | null>(null);
    effect(() => showWhatIf(flight, settle(entry.situation), answered.value));
    return { entry, answered, shown: createShown(flight) };
  });
}
