/** The keys of the page. A key typed into a field, or with Ctrl, Alt or Meta, is not ours. */

import { type Editor, halfExtent, pan, showAll, step, zoom } from "./map/editor";
import { set } from "./parts";
import { type Actions, type Session, stepRange } from "./session";
import { speedOf } from "./store/flight";

/** An arrow moves the clock so far, and with Shift [s]. */
const STEP = 1;
const LONG_STEP = 10;
/** An arrow moves the map by this part of what is seen. */
const PAN = 0.15;

function panBy(map: Editor, arrow: string): void {
  const step = 2 * PAN * halfExtent(map.range.value);
  const east = arrow === "ArrowRight" ? step : arrow === "ArrowLeft" ? -step : 0;
  const north = arrow === "ArrowUp" ? step : arrow === "ArrowDown" ? -step : 0;
  pan(map, east, north);
}

type Act = (() => void) | null;

/** What each key does; a letter is the same whatever its case. */
const KEYS: Record<string, (session: Session, actions: Actions) => Act> = {
  " ": ({ flight }, actions) => (speedOf(flight) === 0 ? actions.play : actions.pause),
  ",": (_, actions) => () => actions.toMark(-1),
  ".": (_, actions) => () => actions.toMark(1),
  "[": (_, actions) => () => actions.setLoop("from"),
  "]": (_, actions) => () => actions.setLoop("to"),
  l: (_, actions) => actions.live,
  r: ({ ndMode }) => set(ndMode, "ROSE"),
  a: ({ ndMode }) => set(ndMode, "ARC"),
  p: ({ ndMode }) => set(ndMode, "PLAN"),
  f: (session) => (isMap(session) ? () => showAll(session.map) : null),
  "+": (session) => () => changeRange(session, 1),
  "=": (session) => () => changeRange(session, 1),
  "-": (session) => () => changeRange(session, -1),
  "−": (session) => () => changeRange(session, -1),
  d: (_, actions) => () => actions.engage("designated"),
  c: (_, actions) => () => actions.engage("armed"),
  e: (_, actions) => () => actions.engage("engaged"),
  x: (_, actions) => () => actions.engage("off"),
  h:
    ({ hands }, actions) =>
    () =>
      actions.setAutopilot(hands.value !== null),
  b:
    ({ flight }, actions) =>
    () =>
      actions.setDirector(flight.moment.value.now?.director !== true),
  t: (session) => (isMap(session) ? null : () => chooseNext(session)),
  g: ({ chartsOpen }) => set(chartsOpen, !chartsOpen.value),
  i: ({ pfdOpen }) => set(pfdOpen, !pfdOpen.value),
  m: ({ sceneMaximised }) => set(sceneMaximised, !sceneMaximised.value),
  "?": ({ helpOpen }) => set(helpOpen, !helpOpen.value),
  Escape: ({ helpOpen, recordsOpen, exportOpen, sceneMaximised }) => {
    return () => {
      helpOpen.value = false;
      recordsOpen.value = false;
      exportOpen.value = false;
      sceneMaximised.value = false;
    };
  },
};

/** Shows the numbers of the next of the other aircraft, the most urgent first, and after the last of none. */
function chooseNext({ shown }: Session): void {
  const idents = shown.picture.value.traffic.map(({ ident }) => ident).reverse();
  const at = idents.indexOf(shown.chosen.value ?? "");
  shown.chosen.value = idents[at + 1] ?? null;
}

function isMap({ ndMode }: Session): boolean {
  return ndMode.value === "PLAN";
}

function changeRange(session: Session, step: 1 | -1): void {
  if (isMap(session)) {
    zoom(session.map, step);
    return;
  }
  session.ndAuto.value = false;
  session.ndRange.value = stepRange(session.ndRange.value, step);
}

/** What a key does, or null if it is not ours. */
export function keyAction(key: string, session: Session, actions: Actions, isShifted = false): Act {
  const isLetter = /^[a-z]$/i.test(key);
  if (!session.letterKeys.value && isLetter) return null;
  if (key.startsWith("Arrow")) {
    if (isMap(session)) return () => panBy(session.map, key);
    const way = key === "ArrowRight" ? 1 : key === "ArrowLeft" ? -1 : 0;
    return way === 0 ? null : () => actions.step(way * (isShifted ? LONG_STEP : STEP));
  }
  return KEYS[isLetter ? key.toLowerCase() : key]?.(session, actions) ?? null;
}

/** Ctrl-Z takes back what was done on the map; Ctrl-Shift-Z and Ctrl-Y do it again. A field has its own. */
export function stepAction(event: KeyboardEvent, session: Session): Act {
  if (!isMap(session) || event.altKey || !(event.ctrlKey || event.metaKey)) return null;
  const { target } = event;
  if (target instanceof HTMLElement && target.matches("input, select, textarea")) return null;
  const key = event.key.toLowerCase();
  if (key === "z") return () => step(session.map, event.shiftKey ? 1 : -1);
  return key === "y" && !event.shiftKey ? () => step(session.map, 1) : null;
}

/** Whether a key press belongs to what has the focus: typing in a field, or pressing a button. */
export function isTaken(event: KeyboardEvent): boolean {
  if (event.ctrlKey || event.altKey || event.metaKey) return true;
  const target = event.target;
  if (!(target instanceof HTMLElement)) return false;
  if (target.matches("input, select, textarea")) return event.key !== "Escape";
  return event.key === " " && target.matches("button, a, summary");
}
