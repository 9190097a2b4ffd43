/** Two flights in figures: when each joined, and what it took. */

import { useComputed } from "@preact/signals";
import { FeedbackLine } from "../panels/flight-controls";
import { Choice } from "../parts";
import type { Actions, Session } from "../session";
import { formatClock, formatMiles } from "../units";
import { ALIGNMENTS, type Alignment, alignment } from "./alignment";
import { shortName } from "./compared";
import { type Figures, figuresOf } from "./figures";
import "./compare.css";

const ALIGNED: Record<Alignment, string> = {
  clock: "clock",
  engaged: "engagement",
  slot: "join",
};

interface Row {
  readonly label: string;
  readonly unit: string;
  readonly value: (figures: Figures) => number | null;
  readonly text: (value: number) => string;
}

function whole(value: number): string {
  return value.toFixed(0);
}

const ROWS: readonly Row[] = [
  { label: "Joined at", unit: "min:s", value: ({ join }) => join, text: formatClock },
  { label: "Track miles", unit: "NM", value: ({ track }) => track, text: formatMiles },
  {
    label: "Least separation",
    unit: "NM",
    value: ({ least }) => least,
    text: (value) => formatMiles(value, 2),
  },
  { label: "Heading swing", unit: "°", value: ({ swing }) => swing, text: whole },
  { label: "Bank reversals", unit: "", value: ({ reversals }) => reversals, text: whole },
  { label: "Replans", unit: "", value: ({ replans }) => replans, text: whole },
];

export function ComparePanel({ session, actions }: { session: Session; actions: Actions }) {
  const { comparison, flight, history } = session;
  const { other, how, offset } = comparison;
  const own = useComputed(() => {
    void flight.read.value; // no more often than it is read
    return figuresOf(history());
  });
  const theirs = useComputed(() => (other.value === null ? null : figuresOf(other.value.history)));
  const compared = other.value;
  if (compared === null) return null;
  const startedOther = compared.history.knownAt(Number.POSITIVE_INFINITY).started;
  const started = flight.read.value.started;
  return (
    <section class="panel compare" aria-labelledby="panel-compare">
      <header>
        <h2 id="panel-compare">
          {shortName(started)} beside {shortName(startedOther)}
        </h2>
        <button type="button" class="quiet" onClick={actions.endComparison}>
          Close
        </button>
      </header>
      <div class="panel-body">
        <table>
          <caption class="visually-hidden">What differs between the two flights</caption>
          <thead>
            <tr>
              <th scope="col">
                <span class="visually-hidden">Figure</span>
              </th>
              <th scope="col" class="solid">
                {shortName(started)}
              </th>
              <th scope="col" class="dashed">
                {shortName(startedOther)}
              </th>
              <th scope="col">Difference</th>
            </tr>
          </thead>
          <tbody>
            {ROWS.map((row) => (
              <Line key={row.label} row={row} own={own.value} other={theirs.value} />
            ))}
          </tbody>
        </table>
        <dl>
          <dt class="solid">{shortName(started)}</dt>
          <dd>{started?.title ?? "The flight that is shown"}</dd>
          <dt class="dashed">{shortName(startedOther)}</dt>
          <dd>{compared.title}</dd>
        </dl>
        <p class="hint">Track, swing and reversals are counted until joined.</p>
        {own.value?.isFinal === false && (
          <p class="hint">This flight goes on: its figures so far.</p>
        )}
        <div class="row">
          <span class="aligned">Side by side by</span>
          <Choice
            label="Which instants stand side by side"
            kind="worded"
            options={ALIGNMENTS}
            chosen={how.value}
            text={(each) => ALIGNED[each]}
            choose={(each) => {
              how.value = each;
            }}
          />
        </div>
        <p class="hint" role="status">
          {offset.value === null
            ? `${missing(session, compared.history, how.value)} Until then the clocks are side by side.`
            : shift(offset.value, shortName(startedOther))}
        </p>
        <FeedbackLine feedback={session.feedback.value} />
      </div>
    </section>
  );
}

function Line(props: { row: Row; own: Figures | null; other: Figures | null }) {
  const { label, unit, value, text } = props.row;
  const [own, other] = [props.own, props.other].map((each) => (each === null ? null : value(each)));
  return (
    <tr>
      <th scope="row">
        {label}
        {unit !== "" && <span class="unit"> {unit}</span>}
      </th>
      <td>{own == null ? "–" : text(own)}</td>
      <td>{other == null ? "–" : text(other)}</td>
      <td>{own == null || other == null ? "–" : signed(other - own, text)}</td>
    </tr>
  );
}

function signed(difference: number, text: (value: number) => string): string {
  const size = text(Math.abs(difference));
  return size === text(0) ? "0" : `${difference < 0 ? "−" : "+"}${size}`;
}

function shift(offset: number, name: string): string {
  if (Math.abs(offset) < 0.5) return `${name} is shown at the same flight time.`;
  const size = formatClock(Math.abs(offset));
  return `${name} is shown ${size} ${offset > 0 ? "later" : "earlier"} in its own time.`;
}

/** Which of the two has not done yet what they are to be aligned by. */
function missing(session: Session, other: Parameters<typeof alignment>[1], how: Alignment): string {
  const isOwn = alignment(session.history(), session.history(), how) === null;
  const who = isOwn ? "This flight" : "The other flight";
  const both = isOwn && alignment(other, other, how) === null;
  const doing = how === "slot" ? "joined" : "engaged";
  return both ? `Neither flight has ${doing}.` : `${who} has not ${doing}.`;
}
