/** The strip on top: the picker handed in, simulated time and rate, the state of the connection. */

import type { ComponentChildren } from "preact";
import { Icon } from "../parts";
import type { Session } from "../session";
import { clockShown } from "../store/states";
import type { Connection } from "../store/types";
import { Toggle } from "../toggle";

const CONNECTION_TEXT: Record<Connection, string> = {
  connecting: "Connecting",
  live: "Live",
  stale: "Data old",
  lost: "Connection lost",
};

export function Header(props: { session: Session; children?: ComponentChildren }) {
  const { helpOpen, recordsOpen, sound } = props.session;
  return (
    <header class="top">
      <h1>
        <img src="./favicon.svg" alt="" width="26" height="26" />
        <span class="word">relguide</span>
      </h1>
      <div class="top-middle">{props.children}</div>
      <SimClock session={props.session} />
      <ConnectionState session={props.session} />
      <a href="atc" aria-label="ATC: the controller's page">
        ATC
      </a>
      <Toggle on={recordsOpen} opens>
        <Icon name="records" />
        <span class="word">Records</span>
      </Toggle>
      <Toggle on={sound}>
        <Icon name={sound.value ? "sound" : "silence"} />
        <span class="word">Sound</span>
      </Toggle>
      <Toggle on={helpOpen} opens>
        <Icon name="help" />
        <span class="word">Help</span>
      </Toggle>
    </header>
  );
}

function SimClock(props: { session: Session }) {
  const { flight, shown } = props.session;
  const { rate, paused, ended } = clockShown(flight);
  return (
    <p class="sim">
      <span class="sim-label">SIM</span>
      <span class="sim-time">{shown.numbers.value.clock}</span>
      <span class="sim-rate">×{Number.isInteger(rate) ? rate : rate.toFixed(1)}</span>
      <span class="sim-state">{ended ? "ENDED" : paused ? "PAUSED" : ""}</span>
    </p>
  );
}

function ConnectionState(props: { session: Session }) {
  const { connection, read, source } = props.session.flight;
  const state = connection.value;
  const { recording } = props.session;
  if (recording.value !== null) return <p class="connection">Recorded</p>;
  if (source.value.kind === "replay") return <p class="connection stale">Behind the flight</p>;
  // The map needs no flight.
  if (props.session.ndMode.value === "PLAN" && props.session.status.value === null)
    return <p class="connection">No flight</p>;
  // A flight that was removed is not a connection that was lost.
  if (props.session.outage.value?.kind === "flight_gone")
    return <p class="connection lost">Flight over</p>;
  const age = state === "stale" || state === "lost" ? ` ${Math.floor(read.value.dataAge)} s` : "";
  return (
    <p class={`connection ${state}`}>
      <span class="lamp" aria-hidden="true" />
      {CONNECTION_TEXT[state]}
      {age}
    </p>
  );
}
