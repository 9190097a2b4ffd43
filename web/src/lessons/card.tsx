/** The card of a lesson, under the display: what to do, what is done, and how far off one is. */

import { useComputed, useSignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { flownOf } from "../debrief/seconds";
import type { Actions, Session } from "../session";
import { type Lesson, lessonOf } from "./lessons";
import { sayOff } from "./off";
import "./lessons.css";

/** How far off one is, is said aloud so often [ms]. */
const SAID_EVERY = 4000;

interface Props {
  readonly session: Session;
  readonly actions: Actions;
}

/** The lesson that is flown now; null while none is, or another instant is shown. */
export function lessonShown({ status, flight, recording }: Session): Lesson | null {
  const isThere = recording.value === null && flight.source.value.kind === "live";
  return isThere && !flight.clock.value.ended ? lessonOf(status.value?.scenario) : null;
}

export function LessonCard({ session, actions, lesson }: Props & { lesson: Lesson }) {
  const { flight, hands } = session;
  const flown = useComputed(() => {
    void flight.read.value; // no more often than it is read
    return flownOf(session.history());
  });
  const seen = flown.value;
  const history = session.history();
  const done = lesson.steps.map(({ isDone }) => seen !== null && isDone({ flown: seen, history }));
  const isBegun = seen?.byHand === true;
  const isOver = seen !== null && seen.joined !== null;
  const sample = flight.read.value.now;
  const isFlown = hands.value !== null && !isOver && sample !== null;
  const count = done.filter(Boolean).length;
  return (
    <aside class="lesson" aria-label={`Lesson: ${lesson.title}`}>
      <header>
        <h2>{lesson.title}</h2>
        {isFlown && <b class="lesson-off">{sayOff(sample)}</b>}
        {hands.value === null && !isOver && (
          <Begin session={session} actions={actions} lesson={lesson} isFirst={!isBegun} />
        )}
      </header>
      {isBegun ? (
        <ol>
          {lesson.steps.map(({ text }, k) => (
            <li key={text} class={done[k] === true ? "done" : ""}>
              <span aria-hidden="true">{done[k] === true ? "✓" : "○"}</span> {text}
              {done[k] === true && <span class="visually-hidden"> Done.</span>}
            </li>
          ))}
        </ol>
      ) : (
        <p>{lesson.card}</p>
      )}
      {isBegun && <Aloud session={session} steps={`${count} of ${done.length} steps done.`} />}
    </aside>
  );
}

/** Takes control and lets the flight go on; at first it has the focus, so that Enter begins. */
function Begin(props: Props & { lesson: Lesson; isFirst: boolean }) {
  const { session, actions, lesson, isFirst } = props;
  const button = useRef<HTMLButtonElement>(null);
  const isReady = session.flight.read.value.now !== null;
  useEffect(() => {
    if (isReady && isFirst) button.current?.focus();
  }, [isReady, isFirst]);
  return (
    <button
      ref={button}
      type="button"
      class="primary"
      disabled={!isReady}
      onClick={() => {
        button.current?.blur(); // the keys are the stick's from now on
        actions.setAutopilot(false, lesson.director);
        actions.play();
      }}
    >
      Take control
    </button>
  );
}

/** For those who listen: how far off one is, every few seconds, and each step as it is done. */
function Aloud({ session, steps }: { session: Session; steps: string }) {
  const off = useSignal("");
  useEffect(() => {
    const timer = setInterval(() => {
      const { now } = session.flight.read.peek();
      off.value = now === null || session.hands.peek() === null ? "" : sayOff(now);
    }, SAID_EVERY);
    return () => clearInterval(timer);
  }, [session, off]);
  return (
    <div class="visually-hidden">
      <p role="status">{steps}</p>
      <p role="status">{off.value}</p>
    </div>
  );
}
