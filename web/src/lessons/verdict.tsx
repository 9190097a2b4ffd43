/** How a lesson went: a mark against the autopilot's time, the best so far, and what to fly next. */

import { useSignal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import type { Flown } from "../debrief/seconds";
import { set } from "../parts";
import type { Actions, Session } from "../session";
import { formatClock } from "../units";
import { autopilotJoins } from "./autopilot";
import { best, note } from "./best";
import { LESSONS, type Lesson, markOf, sayLate } from "./lessons";
import "./lessons.css";

interface Props {
  readonly session: Session;
  readonly actions: Actions;
  readonly lesson: Lesson;
  readonly flown: Flown;
  /** Whether the separation fell below the minimum. */
  readonly isLost: boolean;
}

export function Verdict({ session, actions, lesson, flown, isLost }: Props) {
  const autopilot = useSignal<number | null>(null);
  const isBest = useSignal(false);
  const { scenario, title } = lesson;
  const { joined, byHand } = flown;
  useEffect(() => {
    void autopilotJoins(scenario).then((joins) => {
      autopilot.value = joins;
      if (joins !== null && joined !== null && byHand && !isLost)
        isBest.value = note(scenario, joined - joins);
    });
  }, [scenario, joined, byHand, isLost, autopilot, isBest]);
  const late = joined === null || autopilot.value === null ? null : joined - autopilot.value;
  const mark = joined === null && !isLost ? null : markOf(late, isLost);
  const next = LESSONS[LESSONS.indexOf(lesson) + 1];
  const fly = (name: string) => () => {
    session.debriefOpen.value = false;
    session.sceneMaximised.value = false;
    actions.start(name);
  };
  const known = best.value[scenario];
  return (
    <section class="verdict" aria-label={`Lesson: ${title}`}>
      {mark !== null && (
        <b class={`mark-letter ${mark.letter === "F" ? "failed" : ""}`}>{mark.letter}</b>
      )}
      <p role="status">
        <strong>{title}.</strong>{" "}
        {joined === null
          ? "Not joined."
          : late === null
            ? `Joined at ${formatClock(joined)}.`
            : `Joined at ${formatClock(joined)}, ${sayLate(late)} (${formatClock(autopilot.value ?? 0)}).`}
        {mark !== null && ` Mark ${mark.letter}: ${mark.words}.`}
        {isBest.value && " Your best so far."}
        {!isBest.value && known !== undefined && ` Your best: ${sayLate(known)}.`}
      </p>
      <div class="row">
        <button type="button" onClick={fly(scenario)}>
          Fly it again
        </button>
        {next === undefined ? (
          <button type="button" onClick={set(session.helpOpen, true)}>
            All lessons
          </button>
        ) : (
          <button type="button" class="primary" onClick={fly(next.scenario)}>
            Next: {next.title}
          </button>
        )}
      </div>
    </section>
  );
}
