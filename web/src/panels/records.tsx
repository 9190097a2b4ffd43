/** Flights that can be looked at again: those on record of the service, and files of one's own. */

import { useSignal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { listRecords, type RecordedFlight } from "../api";
import { set, useFocus } from "../parts";
import type { Actions, Session } from "../session";
import { formatClock, formatMiles } from "../units";
import "./dialogs.css";

const SHOWN = 100;

interface Props {
  readonly session: Session;
  readonly actions: Actions;
}

export function Records({ session, actions }: Props) {
  if (!session.recordsOpen.value) return null;
  return <RecordList session={session} actions={actions} />;
}

function RecordList({ session, actions }: Props) {
  const { recordsOpen } = session;
  const dialog = useFocus();
  const flights = useSignal<readonly RecordedFlight[] | null>(null);
  const refusal = useSignal("");
  const search = useSignal("");
  useEffect(() => {
    void listRecords(SHOWN).then((answer) => {
      if (answer.kind === "done") flights.value = answer.value.flights;
      else refusal.value = answer.sentence;
    });
  }, [flights, refusal]);
  const close = set(recordsOpen, false);
  const wanted = search.value.trim().toLowerCase();
  const found = flights.value?.filter((each) => textOf(each).includes(wanted)) ?? [];
  return (
    <div
      class="help records"
      role="dialog"
      aria-labelledby="records-title"
      tabIndex={-1}
      ref={dialog}
    >
      <h2 id="records-title">Look at a flight again</h2>
      <FileField
        label="Open a recording (.jsonl, .jsonl.gz), or drag it onto the page:"
        take={(file) => {
          close();
          actions.openFile(file);
        }}
      />
      <FileField
        label="Or show one beside the flight that is shown:"
        take={(file) => {
          close();
          actions.compareWith(file);
        }}
      />
      <label class="search">
        Search{" "}
        <input
          type="search"
          placeholder="title, outcome, date, id"
          value={search.value}
          onInput={(event) => {
            search.value = event.currentTarget.value;
          }}
        />
      </label>
      {refusal.value !== "" && <p role="alert">{refusal.value}</p>}
      {refusal.value === "" && flights.value === null && <p role="status">Asking the service…</p>}
      {flights.value !== null && found.length === 0 && (
        <p role="status">
          {flights.value.length === 0
            ? "No flight is on record yet."
            : "No flight fits the search."}
        </p>
      )}
      {found.length > 0 && (
        <table>
          <thead>
            <tr>
              <th scope="col">Flight</th>
              <th scope="col">Begun (UTC)</th>
              <th scope="col">Outcome</th>
              <th scope="col">Joined</th>
              <th scope="col">Least</th>
            </tr>
          </thead>
          <tbody>
            {found.map((flight) => (
              <Row key={flight.id} flight={flight} session={session} actions={actions} />
            ))}
          </tbody>
        </table>
      )}
      <button type="button" onClick={close}>
        Close
      </button>
    </div>
  );
}

function FileField({ label, take }: { label: string; take(file: File): void }) {
  return (
    <p>
      <label class="file">
        {label}{" "}
        <input
          type="file"
          accept=".jsonl,.gz,.json"
          onChange={(event) => {
            const file = event.currentTarget.files?.[0];
            if (file !== undefined) take(file);
          }}
        />
      </label>
    </p>
  );
}

function Row({ flight, session, actions }: Props & { flight: RecordedFlight }) {
  const { figures } = flight;
  const joined = figures.join_time_s;
  return (
    <tr>
      <td>
        <button
          type="button"
          class="link"
          onClick={() => {
            session.recordsOpen.value = false;
            actions.openRecord(flight.id);
          }}
        >
          {flight.title}
        </button>{" "}
        <button
          type="button"
          class="link"
          aria-label={`Beside the shown flight: ${flight.title}`}
          onClick={() => {
            session.recordsOpen.value = false;
            actions.compareWith(`record:${flight.id}`);
          }}
        >
          beside
        </button>
      </td>
      <td>
        <time dateTime={flight.started_at}>{flight.started_at.slice(0, 16).replace("T", " ")}</time>
      </td>
      <td>{flight.outcome.replaceAll("_", " ")}</td>
      <td>{joined === null ? "–" : formatClock(joined)}</td>
      <td>
        {figures.least_separation_m === null
          ? "–"
          : `${formatMiles(figures.least_separation_m)} NM`}
      </td>
    </tr>
  );
}

function textOf({ id, title, scenario, outcome, started_at }: RecordedFlight): string {
  return `${id} ${title} ${scenario} ${outcome} ${started_at}`.toLowerCase();
}
