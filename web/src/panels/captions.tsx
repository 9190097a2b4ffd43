/** Five captions for a first minute: each says what is seen now and what can be done, until it is done. */

import { useSignal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { LessonCard, lessonShown } from "../lessons/card";
import { set } from "../parts";
import type { Actions, Session } from "../session";
import type { Guidance } from "../store/states";

const CAPTIONS = [
  "You are the yellow aircraft: join the white one in the least time, never closer than the minimum. Click it, or press D.",
  "Dashed yellow leads to its slot: CNV says in what time, the dotted circle how close you come. Accept it, or press C.",
  "Dashed cyan: accepted, and not flown yet. Engage it, or press E.",
  "Green will be flown. The gate with the pennant is the slot, D behind the leader. ×10 makes it faster.",
  "Now let the leader turn: type its heading, and the path is made anew. PLAN is a map for situations of your own.",
] as const;
/** In place of the last one, once the slot is reached. */
const DONE =
  "Done: you have joined, and guidance keeps the spacing. Try this: turn the leader, or lay out a situation of your own in PLAN.";
/** That one has been read by then [ms]. */
const READ_WITHIN = 60_000;

/** Which of them belongs to a state; those of flying are turned by hand. */
const AT: Record<Guidance, number> = {
  off: 0,
  designated: 1,
  proposed: 1,
  armed: 2,
  converge: 3,
  capture: 3,
  follow: 3,
  escape: 3,
  infeasible: 1,
  unable: 3,
  data_lost: 1,
};

/** What is said in its place where there is nothing of that kind to be seen. */
const INSTEAD: Partial<Record<Guidance, string>> = {
  designated: "A path to the leader's slot is looked for.",
  infeasible:
    "There is no path to the leader's slot: the panel says why. PLAN is a map, where you can move either of you.",
  unable: "There is no path to fly now, so the heading is held: the panel says why.",
  escape: "Own ship turns away to keep the minimum, and goes on to the slot when that is clear.",
  data_lost:
    "Nothing is heard of the leader, so the autopilot holds your heading. Let its reports be received again.",
};

const AGAIN =
  "The leader is heard again. Guidance was engaged before: accept what is proposed now, then engage it.";

/** The card of the lesson that is flown, or else the first steps. */
export function Captions(props: { session: Session; actions: Actions }) {
  const lesson = lessonShown(props.session);
  return lesson === null ? <FirstSteps {...props} /> : <LessonCard {...props} lesson={lesson} />;
}

function FirstSteps(props: { session: Session }) {
  const { captions, shown, flight } = props.session;
  const isTurned = useSignal(false);
  const { state, readAt, sample, alarm, droppedAt } = shown.numbers.value;
  const isShown = captions.value && readAt !== null && flight.source.value.kind === "live";
  const isDone = isShown && state === "follow" && sample?.joined === true;
  const isOver = flight.clock.value.ended;
  useEffect(() => {
    if (!isDone) return;
    const timer = setTimeout(set(captions, false), READ_WITHIN);
    return () => clearTimeout(timer);
  }, [isDone, captions]);
  // Nothing is explained over an alarm, nor of what is over.
  if (!isShown || isOver || alarm !== null) return null;
  const isAgain = state === "proposed" && droppedAt !== "";
  const instead = isAgain ? AGAIN : INSTEAD[state];
  const isFlying = AT[state] === 3 && instead === undefined;
  const number = isDone || (isFlying && isTurned.value) ? 4 : AT[state];
  const text = isDone ? DONE : (instead ?? CAPTIONS[number]);
  const close = set(captions, false);
  return (
    <aside class="first-minute" aria-label="First steps">
      <b>{number + 1} of 5</b>
      <p>{text}</p>
      {isFlying && !isDone && !isTurned.value && (
        <button type="button" onClick={set(isTurned, true)}>
          Next
        </button>
      )}
      {isDone ? (
        <button type="button" onClick={close}>
          Close
        </button>
      ) : (
        <button type="button" class="quiet" aria-label="Close the first steps" onClick={close}>
          ×
        </button>
      )}
    </aside>
  );
}
