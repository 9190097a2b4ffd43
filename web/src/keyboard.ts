/** The keys of the page. A key typed into a field, or with Ctrl, Alt or Meta, is not ours. */

import { type Editor, halfExtent, pan, showAll, zoom } from "./map/editor";
import { type Actions, type Session, stepRange } from "./session";

/** An arrow moves the map by this part of what is seen. */
const PAN = 0.15;

function panBy(map: Editor, arrow: string): void {
  const step = 2 * PAN * halfExtent(map.range.value);
  const east = arrow === "ArrowRight" ? step : arrow === "ArrowLeft" ? -step : 0;
  const north = arrow === "ArrowUp" ? step : arrow === "ArrowDown" ? -step : 0;
  pan(map, east, north);
}

/** What a key does, or null if it is not ours. */
export function keyAction(key: string, session: Session, actions: Actions): (() => void) | null {
  if (!session.letterKeys.value && /^[a-z]$/i.test(key)) return null;
  const { flight, ndMode, ndRange, map, sceneMaximised, helpOpen } = session;
  const isMap = ndMode.value === "PLAN";
  switch (key) {
    case " ":
      return () => (flight.clock.value.paused ? actions.play() : actions.pause());
    case "r":
    case "R":
      return () => {
        ndMode.value = "ROSE";
      };
    case "a":
    case "A":
      return () => {
        ndMode.value = "ARC";
      };
    case "p":
    case "P":
      return () => {
        ndMode.value = "PLAN";
      };
    case "f":
    case "F":
      return isMap ? () => showAll(map) : null;
    case "ArrowLeft":
    case "ArrowRight":
    case "ArrowUp":
    case "ArrowDown":
      return isMap ? () => panBy(map, key) : null;
    case "+":
    case "=":
      if (isMap) return () => zoom(map, 1);
      return () => {
        session.ndAuto.value = false;
        ndRange.value = stepRange(ndRange.value, 1);
      };
    case "-":
    case "−":
      if (isMap) return () => zoom(map, -1);
      return () => {
        session.ndAuto.value = false;
        ndRange.value = stepRange(ndRange.value, -1);
      };
    case "d":
    case "D":
      return () => actions.engage("designated");
    case "c":
    case "C":
      return () => actions.engage("armed");
    case "e":
    case "E":
      return () => actions.engage("engaged");
    case "x":
    case "X":
      return () => actions.engage("off");
    case "m":
    case "M":
      return () => {
        sceneMaximised.value = !sceneMaximised.value;
      };
    case "?":
      return () => {
        helpOpen.value = !helpOpen.value;
      };
    case "Escape":
      return () => {
        helpOpen.value = false;
        sceneMaximised.value = false;
      };
    default:
      return null;
  }
}

/** Whether a key press belongs to what has the focus: typing in a field, or pressing a button. */
export function isTaken(event: KeyboardEvent): boolean {
  if (event.ctrlKey || event.altKey || event.metaKey) return true;
  const target = event.target;
  if (!(target instanceof HTMLElement)) return false;
  if (target.matches("input, select, textarea")) return event.key !== "Escape";
  return event.key === " " && target.matches("button, a, summary");
}
