/** What is flown, to begin it anew or end it; and what became of the last command. */

import { FIGURES } from "../compare/references";
import { Icon, Panel, set } from "../parts";
import { type Actions, type Feedback, isFlying, type Session } from "../session";

export function FlightControls(props: { session: Session; actions: Actions }) {
  const { session, actions } = props;
  const { scenarios, status, feedback } = session;
  const ended = !isFlying(session);
  const flown = status.value?.scenario || null; // empty for a situation of one's own
  const description =
    scenarios.value.find((scenario) => scenario.name === flown)?.description ?? "";
  return (
    <Panel name="controls" title="Flight">
      {description !== "" && (
        <p class="hint description" title={description}>
          {description}
        </p>
      )}
      <div class="row">
        <button
          type="button"
          class="grow"
          disabled={flown === null}
          onClick={() => flown !== null && actions.start(flown)}
        >
          <Icon name="restart" />
          Restart
        </button>
        <button type="button" disabled={ended || status.value === null} onClick={actions.end}>
          End
        </button>
      </div>
      <div class="row">
        <button
          type="button"
          class="grow"
          title="Both figures of the paper flown at once, one beside the other"
          onClick={() => actions.compare(...FIGURES)}
        >
          Fig. 6a beside 6b
        </button>
        <button type="button" onClick={set(session.debriefOpen, true)}>
          Debrief
        </button>
      </div>
      <FeedbackLine feedback={feedback.value} />
    </Panel>
  );
}

const FEEDBACK_SIGN: Record<Feedback["kind"], string> = {
  none: "",
  sending: "SENT",
  done: "DONE",
  refused: "REFUSED",
};

/** What became of the last command, said and shown. */
export function FeedbackLine(props: { feedback: Feedback }) {
  const { feedback } = props;
  return (
    <p class={`feedback ${feedback.kind}`} role="status">
      {feedback.kind !== "none" && (
        <>
          <b>{FEEDBACK_SIGN[feedback.kind]}</b> {feedback.text}
        </>
      )}
    </p>
  );
}
