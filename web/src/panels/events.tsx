/** What happened, newest first, with flight time; and the same for those who listen. */

import { Panel } from "../parts";
import type { Session } from "../session";
import type { Message } from "../store/types";
import { formatClock } from "../units";

const KIND_NAMES: Record<Message["kind"], string> = {
  plan: "PLAN",
  no_plan: "NO PLAN",
  refused: "REFUSED",
  leader: "LEADER",
  mode: "MODE",
  engagement: "CREW",
  clearance: "ATC",
  advisory: "ADVICE",
  caution: "CAUTION",
  warning: "WARNING",
  clear: "CLEAR",
  unable: "UNABLE",
  lost: "LOST",
  end: "END",
};

export function Events(props: { session: Session }) {
  const { messages } = props.session.flight.read.value;
  return (
    <Panel name="events" title="Events">
      {/* biome-ignore lint/a11y/noNoninteractiveTabindex: what scrolls is reached by keyboard */}
      <ol class="log" tabIndex={0} aria-label="Events, the newest first">
        {messages.map((message) => (
          <li key={`${message.t} ${message.text}`} class={message.kind}>
            <time>{formatClock(message.t)}</time>
            <b>{KIND_NAMES[message.kind]}</b>
            <span>{message.text}</span>
          </li>
        ))}
      </ol>
    </Panel>
  );
}

/** What holds now, spoken without taking the focus. */
export function Announcer(props: { session: Session }) {
  const { polite, assertive } = props.session.shown.spoken.value;
  return (
    <div class="visually-hidden">
      <p role="status" data-testid="announcer">
        {polite}
      </p>
      <p aria-live="assertive" aria-atomic="true">
        {assertive}
      </p>
    </div>
  );
}
