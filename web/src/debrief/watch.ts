/** Opens the debrief when a flight by hand is over: joined, given up, or ended. */

import { effect, untracked } from "@preact/signals";
import { lessonOf } from "../lessons/lessons";
import type { Actions, Session } from "../session";

export function openDebriefs(
  session: Session,
  actions: Pick<Actions, "pause" | "setAutopilot">,
): void {
  const { flight, status, recording, debriefOpen, sceneMaximised, lost, hands } = session;
  /** The flight that is flown by hand, and the one whose debrief was opened. */
  let flown: string | null = null;
  let opened: string | null = null;
  /** Whether it was given up: it may be engaged again, and flown on. */
  let wasGivenUp = false;
  effect(() => {
    if (flight.id.value !== opened) lost.value = [];
  });
  effect(() => {
    const { now, ended, engagement } = flight.read.value;
    const id = flight.id.value;
    const isOff = engagement?.engagement === "off";
    if (id === opened && wasGivenUp && !isOff) opened = flown = null;
    if (id === null || id === opened || recording.value !== null || now === null) return;
    if (flight.source.value.kind !== "live") return;
    if (now.autopilot === false) flown = id;
    const isOver = ended || flight.clock.value.ended || now.joined || isOff;
    const isLesson = lessonOf(status.value?.scenario) !== null;
    // whoever still flies needs the instrument more; a lesson is over, and gives control back
    if (flown !== id || !isOver || (hands.value !== null && !isLesson)) return;
    opened = id;
    wasGivenUp = isOff;
    untracked(() => {
      debriefOpen.value = true;
      if (!isLesson) return;
      sceneMaximised.value = true;
      if (ended || flight.clock.value.ended) return;
      if (hands.value !== null) actions.setAutopilot(true);
      actions.pause();
    });
  });
}
