/** What happened, newest first, with flight time; and the same for those who listen. */

import { Panel } from "../parts";
import type { Session } from "../session";
import { MODE_NAMES, STATE_NAMES } from "../store/reading";
import type { Message } from "../store/types";
import { formatClock } from "../units";

const KIND_NAMES: Record<Message["kind"], string> = {
  plan: "PLAN",
  no_plan: "NO PLAN",
  refused: "REFUSED",
  leader: "LEADER",
  mode: "MODE",
  engagement: "CREW",
  advisory: "ADVICE",
  caution: "CAUTION",
  warning: "WARNING",
  clear: "CLEAR",
  unable: "UNABLE",
  lost: "LOST",
  end: "END",
};

export function Events(props: { session: Session }) {
  const { messages } = props.session.flight;
  return (
    <Panel name="events" title="Events" scrolls>
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

/** Mode changes, alerts and the loss of a plan, spoken without taking the focus. */
export function Announcer(props: { session: Session }) {
  const { engagement, mode, promise, unavailable, unable, alerts, lost } = props.session.flight;
  const { state } = props.session.shown.numbers.value;
  const polite: string[] = [];
  if (state !== "off") polite.push(`${STATE_NAMES[state]}.`);
  if (engagement.value !== null) polite.push(engagement.value.message);
  const urgent: string[] = [];
  if (mode.value !== null)
    polite.push(`Mode ${MODE_NAMES[mode.value.mode]}. ${mode.value.message}`);
  if (promise.value !== null) polite.push(promise.value.message);
  if (unavailable.value !== null) polite.push(`No plan. ${unavailable.value.answer.message}`);
  for (const alert of alerts.value)
    (alert.level === "advisory" ? polite : urgent).push(alert.message);
  if (unable.value !== null) urgent.push(`Unable. ${unable.value.message}`);
  if (state === "data_lost") urgent.push("Nothing is heard of the leader.");
  if (lost.value !== null)
    urgent.push(`Separation lost at ${formatClock(lost.value.t_s)}. ${lost.value.cause}`);
  return (
    <div class="visually-hidden">
      <p role="status" data-testid="announcer">
        {polite.join(" ")}
      </p>
      <p aria-live="assertive">{urgent.join(" ")}</p>
    </div>
  );
}
