/** What is flown, how fast, and what became of the last command; play and pause stand by the time. */

import { Choice, Icon, Panel } from "../parts";
import { type Actions, type Feedback, isFlying, RATES, type Session } from "../session";
import { clockShown } from "../store/states";

export function FlightControls(props: { session: Session; actions: Actions }) {
  const { session, actions } = props;
  const { scenarios, status, flight, feedback } = session;
  const { rate } = clockShown(flight);
  const ended = flight.clock.value.ended || !isFlying(session);
  const flown = status.value?.scenario || null; // empty for a situation of one's own
  const description =
    scenarios.value.find((scenario) => scenario.name === flown)?.description ?? "";
  return (
    <Panel name="controls" title="Flight">
      {description !== "" && <p class="hint">{description}</p>}
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
      <Choice
        label="Simulated seconds per second"
        options={RATES}
        chosen={RATES.find((offered) => offered === rate) ?? null}
        text={(offered) => `×${offered}`}
        choose={actions.setRate}
      />
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
function FeedbackLine(props: { feedback: Feedback }) {
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
