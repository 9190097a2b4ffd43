/** Undo and redo of what is laid out: what one hand does in one go is one step. */

import { type Signal, signal } from "@preact/signals";
import type { Situation } from "./situation";

/** So many steps can be taken back. */
const MOST = 100;

export interface Steps {
  /** The situations before this one, and those that were taken back, the nearest last. */
  readonly past: Signal<readonly Situation[]>;
  readonly future: Signal<readonly Situation[]>;
  /** Whose step is being made: a drag, a field while it has the focus; null for nobody's. */
  hand: unknown;
}

export function createSteps(): Steps {
  return { past: signal([]), future: signal([]), hand: null };
}

/** Keeps what was laid out before a change; a hand that goes on makes no step of its own. */
export function keepStep(steps: Steps, before: Situation, hand: unknown): void {
  if (steps.hand === hand) return;
  steps.hand = hand;
  steps.past.value = [...steps.past.value, before].slice(-MOST);
  steps.future.value = [];
}

/** The situation one step back (−1) or on again (+1); null if there is none. */
export function takeStep(steps: Steps, now: Situation, way: -1 | 1): Situation | null {
  const [from, to] = way < 0 ? [steps.past, steps.future] : [steps.future, steps.past];
  const next = from.value.at(-1);
  if (next === undefined) return null;
  from.value = from.value.slice(0, -1);
  to.value = [...to.value, now];
  steps.hand = null;
  return next;
}
