/** The keys of the page. A key typed into a field, or with Ctrl, Alt or Meta, is not ours. */

import { type Actions, type Session, stepRange } from "./session";

/** What a key does, or null if it is not ours. */
export function keyAction(key: string, session: Session, actions: Actions): (() => void) | null {
  if (!session.letterKeys.value && /^[a-z]$/i.test(key)) return null;
  const { flight, ndMode, ndRange, sceneMaximised, helpOpen } = session;
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
    case "+":
    case "=":
      return () => {
        session.ndAuto.value = false;
        ndRange.value = stepRange(ndRange.value, 1);
      };
    case "-":
    case "−":
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
