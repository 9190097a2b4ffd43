/** What happened, newest first, with flight time; and the same for those who listen. */

import type { Message } from "../flight";
import { Panel } from "../parts";
import { MODE_NAMES } from "../reading";
import type { Session } from "../session";
import { formatClock } from "../units";

const KIND_NAMES: Record<Message["kind"], string> = {
  plan: "PLAN",
  no_plan: "NO PLAN",
  refused: "REFUSED",
  leader: "LEADER",
  mode: "MODE",
  end: "END",
};

export function Events(props: { session: Session }) {
  const { messages } = props.session.flight;
  return (
    <Panel name="events" title="Events">
      <ol class="log">
        {messages.value.map((message) => (
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

/** Mode changes and the loss of a plan, spoken without taking the focus. */
export function Announcer(props: { session: Session }) {
  const { mode, unavailable } = props.session.flight;
  const changed = mode.value;
  const none = unavailable.value;
  return (
    <p class="visually-hidden" role="status" data-testid="announcer">
      {changed === null ? "" : `Mode ${MODE_NAMES[changed.mode]}. ${changed.message}`}
      {none === null ? "" : ` No plan. ${none.answer.message}`}
    </p>
  );
}
