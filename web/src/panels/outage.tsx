/** Why nothing flies on the screen, and the button that helps. */

import type { Actions, Outage, Session } from "../session";

export function OutageNotice(props: { session: Session; actions: Actions }) {
  const outage = props.session.outage.value;
  return (
    <div role="alert" class="outage-place">
      {outage !== null && (
        <div class="outage">
          <p>{outage.text}</p>
          <Remedy outage={outage} actions={props.actions} />
        </div>
      )}
    </div>
  );
}

function Remedy(props: { outage: Outage; actions: Actions }) {
  const { outage, actions } = props;
  switch (outage.kind) {
    case "no_answer":
      return (
        <>
          <p>The page tries again by itself.</p>
          <button type="button" class="primary" onClick={actions.retry}>
            Try now
          </button>
        </>
      );
    case "flight_gone":
      return (
        <button type="button" class="primary" onClick={() => actions.start(outage.scenario)}>
          Start a new flight
        </button>
      );
    case "refused":
      return (
        <button type="button" class="primary" onClick={actions.retry}>
          Try again
        </button>
      );
    case "other_version":
      return (
        <button type="button" class="primary" onClick={actions.reload}>
          Reload the page
        </button>
      );
  }
}
