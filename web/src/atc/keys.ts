/** The keys of the page. A key typed into a field, or with Ctrl, Alt or Meta, is not ours. */

import { SILENCE } from "./alerts";
import { answer, probe } from "./answering";
import { pan, showAll, zoom } from "./map/view";
import { type Conflict, conflictsOf } from "./pairs";
import { choose, chooseNext, openTab, type Station, silence } from "./station";
import { isWaiting, waitingIn } from "./urgency";
import { REASONS } from "./words";

type Act = (station: Station) => void;

/** A key moves the map so far [px]. */
const STEP = 80;

const LETTERS: Readonly<Record<string, Act>> = {
  a: (station) => void answer(station, "accepted"),
  u: (station) => {
    station.unableOpen.value = station.card.value !== null && !station.unableOpen.value;
  },
  s: (station) => void answer(station, "standby"),
  p: (station) => void probe(station),
  n: chooseWaiting,
  r: ({ pairToolOpen }) => {
    pairToolOpen.value = !pairToolOpen.value;
  },
  x: (station) => {
    for (const { key } of station.loud.value) silence(station, key, SILENCE);
  },
  l: ({ store }) => {
    store.instant.value = null;
  },
  f: ({ view, store }) => showAll(view, store.sky.value.aircraft),
};

const SIGNS: Readonly<Record<string, Act>> = {
  ArrowDown: (station) => chooseNext(station, 1),
  ArrowUp: (station) => chooseNext(station, -1),
  "]": (station) => choosePair(station, 1),
  "[": (station) => choosePair(station, -1),
  "+": ({ view }) => zoom(view, 1.5),
  "=": ({ view }) => zoom(view, 1.5),
  "-": ({ view }) => zoom(view, 1 / 1.5),
  "?": ({ helpOpen }) => {
    helpOpen.value = !helpOpen.value;
  },
  Escape: leave,
};

/** With Shift, arrows move the map. */
const PANS: Readonly<Record<string, readonly [number, number]>> = {
  ArrowLeft: [STEP, 0],
  ArrowRight: [-STEP, 0],
  ArrowUp: [0, STEP],
  ArrowDown: [0, -STEP],
};

/** What a key does, or null if it is not ours. */
export function keyAct(event: KeyboardEvent, station: Station): Act | null {
  const { key } = event;
  const way = event.shiftKey ? PANS[key] : undefined;
  if (way !== undefined) return ({ view }) => pan(view, ...way);
  if (station.unableOpen.value && /^[1-9]$/.test(key)) {
    const reason = REASONS[Number(key) - 1];
    return reason === undefined ? null : (it) => void answer(it, "unable", reason.code);
  }
  if (/^[a-z]$/i.test(key))
    return station.letterKeys.value ? (LETTERS[key.toLowerCase()] ?? null) : null;
  return SIGNS[key] ?? null;
}

/** Whether a key press belongs to what has the focus: typing in a field, or moving in a list. */
export function isTaken(event: KeyboardEvent): boolean {
  if (event.ctrlKey || event.altKey || event.metaKey) return true;
  const { target, key } = event;
  if (!(target instanceof HTMLElement)) return false;
  if (target.matches("input[type=range]")) return !/^([a-z]|Escape|\?)$/i.test(key);
  if (target.matches("select")) return key !== "Escape";
  return target.closest("[role=tablist]") !== null && key.startsWith("Arrow");
}

/** The next one that waits for an answer, after the one that is chosen. */
function chooseWaiting(station: Station): void {
  const all = station.requests.value;
  const at = all.findIndex(({ id }) => id === station.selected.value);
  const next = [...all.slice(at + 1), ...all.slice(0, at + 1)].find(isWaiting);
  if (next !== undefined) {
    choose(station, next.id);
    return;
  }
  const sky = station.store.skies.value.find((one) => waitingIn(one) > 0);
  if (sky === undefined) return;
  openTab(station, sky.id);
  const first = station.requests.value.find(isWaiting);
  if (first !== undefined) choose(station, first.id);
}

/** The next pair of CARD, or the one before. */
function choosePair(station: Station, way: 1 | -1): void {
  const all = conflictsOf(station.store.sky.value);
  const isChosen = ({ card, pair }: Conflict) =>
    card.id === station.selected.value && pair.ident === station.pair.value;
  const next = all[(all.findIndex(isChosen) + way + all.length) % Math.max(1, all.length)];
  if (next !== undefined) choose(station, next.card.id, next.pair.ident);
}

/** Closes what is open, the last first; then nothing is chosen. */
function leave(station: Station): void {
  const { helpOpen, unableOpen, alternative, pairToolOpen, picked } = station;
  if (helpOpen.value) helpOpen.value = false;
  else if (unableOpen.value) unableOpen.value = false;
  else if (alternative.value !== null) alternative.value = null;
  else if (pairToolOpen.value) {
    pairToolOpen.value = false;
    picked.value = [];
  } else choose(station, null);
}
