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
  const { messages } = props.session.flight.read.value;
  return (
    <Panel name="events" title="Events" scrolls>
      <ol class="log">
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

/** Mode changes, alerts and the loss of a plan, spoken without taking the focus. */
export function Announcer(props: { session: Session }) {
  const { engagement, mode, promise, unavailable, unable, alerts, lost } =
    props.session.flight.read.value;
  const { state } = props.session.shown.numbers.value;
  const polite: string[] = [];
  if (state !== "off") polite.push(`${STATE_NAMES[state]}.`);
  if (engagement !== null) polite.push(engagement.message);
  const urgent: string[] = [];
  if (mode !== null) polite.push(`Mode ${MODE_NAMES[mode.mode]}. ${mode.message}`);
  if (promise !== null) polite.push(promise.message);
  if (unavailable !== null) polite.push(`No plan. ${unavailable.answer.message}`);
  for (const alert of alerts) (alert.level === "advisory" ? polite : urgent).push(alert.message);
  if (unable !== null) urgent.push(`Unable. ${unable.message}`);
  if (state === "data_lost") urgent.push("Nothing is heard of the leader.");
  if (lost !== null) urgent.push(`Separation lost at ${formatClock(lost.t_s)}. ${lost.cause}`);
  return (
    <div class="visually-hidden">
      <p role="status" data-testid="announcer">
        {polite.join(" ")}
      </p>
      <p aria-live="assertive">{urgent.join(" ")}</p>
    </div>
  );
}
