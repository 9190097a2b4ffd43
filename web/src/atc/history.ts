/** All that was received, by sky: its state after each document, so that any instant is shown at once. */

import type { AtcDocument, ClearanceCard } from "../wire";
import { emptySky, fold, type Sky } from "./sky";

/** Documents that are kept of a sky: some two hours of one a second. */
export const MOST = 7200;
/** So many of the oldest are let go at once. */
const AT_ONCE = 600;

/** A sky's past. What it holds grows; what is in it never changes. */
interface SkyHistory {
  readonly id: string;
  /** The sky before the first document that is kept. */
  before: Sky;
  readonly documents: AtcDocument[];
  /** The sky after each document. */
  readonly states: Sky[];
}

export type Histories = Map<string, SkyHistory>;

/** Adds a document; answers with the sky that it is about, null where that is not known. */
export function append(histories: Histories, document: AtcDocument): SkyHistory | null {
  const id = skyOf(histories, document);
  if (id === null) return null;
  const history = histories.get(id) ?? { id, before: emptySky(id), documents: [], states: [] };
  histories.set(id, history);
  history.documents.push(document);
  history.states.push(fold(newest(history), document));
  if (history.documents.length > MOST) {
    history.before = history.states[AT_ONCE - 1] ?? history.before;
    history.documents.splice(0, AT_ONCE);
    history.states.splice(0, AT_ONCE);
  }
  return history;
}

/** The sky that a document is about: that of its clearance, where it does not name one. */
function skyOf(histories: Histories, document: AtcDocument): string | null {
  if (document.kind === "traffic") return document.sky.id;
  if (document.kind === "clearance_changed") return document.clearance.sky;
  for (const history of histories.values())
    if (newest(history).clearances.has(document.id)) return history.id;
  return null;
}

export function newest({ before, states }: SkyHistory): Sky {
  return states.at(-1) ?? before;
}

/** The sky as it was at a time [s]: after the last document until then, or the first one that is kept. */
export function skyAt(history: SkyHistory, t: number): Sky {
  return history.states[indexAt(history, t)] ?? history.states[0] ?? history.before;
}

/** Index of the last state until a time; −1 before the first. */
function indexAt({ states }: SkyHistory, t: number): number {
  let [low, high] = [0, states.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if ((states[middle]?.t ?? 0) <= t) low = middle + 1;
    else high = middle;
  }
  return low - 1;
}

/** States at every `step` [s] back from a time, `count` of them, newest first; none from before the first. */
export function past(history: SkyHistory, t: number, step: number, count: number): Sky[] {
  const found: Sky[] = [];
  for (let k = 1; k <= count; k += 1) {
    const state = history.states[indexAt(history, t - k * step)];
    if (state === undefined) break;
    found.push(state);
  }
  return found;
}

/** The times between which a sky can be shown [s]. */
export function spanOf(history: SkyHistory): readonly [number, number] {
  const [first, last] = [history.states[0], history.states.at(-1)];
  return first === undefined || last === undefined ? [0, 0] : [first.t, last.t];
}

/** An instant worth a mark on the timeline. */
export interface Mark {
  readonly t: number;
  readonly what: string;
  readonly isAlert: boolean;
}

/** When clearances changed their state, and when alerts began. */
export function marksOf({ before, documents, states }: SkyHistory): Mark[] {
  const marks: Mark[] = [];
  documents.forEach((document, k) => {
    const [was, is] = [states[k - 1] ?? before, states[k]];
    if (is === undefined || document.kind === "traffic") return;
    const id = document.kind === "clearance_changed" ? document.clearance.id : document.id;
    const [old, now] = [was.clearances.get(id), is.clearances.get(id)];
    if (now === undefined) return;
    if (old?.state !== now.state)
      marks.push({ t: is.t, what: `${now.aircraft} ${now.state}`, isAlert: false });
    if (alertsOf(now) > alertsOf(old))
      marks.push({ t: is.t, what: `${now.aircraft} deviates`, isAlert: true });
  });
  return marks;
}

function alertsOf(card: ClearanceCard | undefined): number {
  return card?.deviations.filter(({ level }) => level === "alert").length ?? 0;
}

/** What tells of a sky all that is kept of it, to somebody who knows nothing. */
export function documentsOf({ before, documents }: SkyHistory): AtcDocument[] {
  const known = [...before.clearances.values()].map((clearance): AtcDocument => {
    return { kind: "clearance_changed", t_s: before.t, clearance };
  });
  return [...known, ...documents];
}
