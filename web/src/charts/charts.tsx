/** The flight over time: strips one above the other over one time, on the clock of the page. */

import { computed, useComputed, useSignal } from "@preact/signals";
import { useEffect, useMemo } from "preact/hooks";
import { shortName } from "../compare/compared";
import { Choice, Maximise, set } from "../parts";
import type { Actions, Session } from "../session";
import { type Planned, shownPlan } from "../store/committed";
import { formatClock } from "../units";
import { aheadOf } from "./ahead";
import { Exports } from "./exports";
import { type Costates, costatesOf, NO_PLAN } from "./optimality";
import { LEFT, RIGHT, type Window } from "./plot";
import { Strips } from "./plots";
import { timesOf } from "./scale";
import { type Strip, spanOf, stripsOf, valueAt } from "./strips";
import "./charts.css";

/** How much is seen: all of it, or so many seconds round the cursor. */
const SEEN = ["ALL", "10 MIN", "2 MIN"] as const;
type Seen = (typeof SEEN)[number];
const LENGTH: Record<Seen, number> = { ALL: Number.POSITIVE_INFINITY, "10 MIN": 600, "2 MIN": 120 };
/** The cursor stands at this part of what is seen, the rest is to come. */
const PAST = 0.6;
/** The service is asked for costates once a plan has been looked at for so long [ms]. */
const REST = 400;

export interface Props {
  readonly session: Session;
  readonly actions: Actions;
}

export function Charts({ session, actions }: Props) {
  const { sceneMaximised } = session;
  const seen = useSignal<Seen>("ALL");
  const model = useMemo(() => createModel(session), [session]);
  const costates = useCostates(session, model.plan.value);
  const strips = useComputed(() => [
    ...model.strips.value,
    ...(costates.value.kind === "known" ? costates.value.strips : []),
  ]);
  const window = useComputed(() => windowOf(model.strips.value, seen.value, session));
  return (
    <section class="panel charts" aria-labelledby="panel-charts">
      <header>
        <h2 id="panel-charts">Over time</h2>
        <Choice
          label="How much is seen"
          kind="worded"
          options={SEEN}
          chosen={seen.value}
          choose={(each) => {
            seen.value = each;
          }}
        />
        <Exports session={session} strips={strips} window={window} />
        <Maximise on={sceneMaximised} />
        <button type="button" class="quiet" onClick={set(session.chartsOpen, false)}>
          Close
        </button>
      </header>
      {strips.value.length === 0 ? (
        <p role="status">Nothing has been flown yet.</p>
      ) : (
        <>
          <TimeAxis session={session} actions={actions} window={window.value} />
          <div class="chart-scroll">
            <Strips session={session} actions={actions} strips={strips} window={window} />
            <p class="hint chart-note">{costates.value.sentence}</p>
            <Summary strips={strips.value} t={session.flight.read.value.t} />
          </div>
        </>
      )}
    </section>
  );
}

/** The strips of the flight, made anew when more is known, or another plan or forecast holds. */
function createModel({ flight, history, comparison }: Session) {
  const plan = computed(() => shownPlan(flight.read.value));
  const forecast = computed(() => flight.read.value.forecast);
  const route = computed(() => flight.read.value.route);
  // No more often than numbers are read, however fast it flies.
  const revision = computed(() => {
    void flight.read.value;
    return flight.revision.peek();
  });
  const strips = computed(() => {
    void [flight.id.value, revision.value, plan.value, forecast.value, route.value];
    const compared = comparison.other.value;
    const other =
      compared === null
        ? null
        : {
            name: shortName(compared.history.knownAt(Number.POSITIVE_INFINITY).started),
            history: compared.history,
            offset: comparison.offset.value ?? 0,
          };
    return stripsOf(history(), aheadOf(flight.read.peek()), other);
  });
  return { plan, strips };
}

/** Costates of a plan, once it has been looked at for a moment; each plan is asked for once. */
function useCostates({ history }: Session, plan: Planned | null) {
  const costates = useSignal<Costates>(NO_PLAN);
  const known = useMemo(() => new WeakMap<Planned, Costates>(), []);
  useEffect(() => {
    const before = plan === null ? NO_PLAN : known.get(plan);
    if (before !== undefined || plan === null) {
      costates.value = before ?? NO_PLAN;
      return;
    }
    let isWanted = true;
    const sentence = `The costates of the plan of ${formatClock(plan.t_s)} are on their way.`;
    costates.value = { kind: "missing", sentence };
    const timer = setTimeout(() => {
      void costatesOf(history(), plan).then((found) => {
        known.set(plan, found);
        if (isWanted) costates.value = found;
      });
    }, REST);
    return () => {
      isWanted = false;
      clearTimeout(timer);
    };
  }, [plan, history, costates, known]);
  return costates;
}

function windowOf(strips: readonly Strip[], seen: Seen, { flight }: Session): Window {
  const { from, to } = spanOf(strips);
  const length = LENGTH[seen];
  if (length >= to - from) return { from, to };
  const first = Math.max(from, Math.min(flight.read.value.t - PAST * length, to - length));
  return { from: first, to: first + length };
}

/** The time axis, over all strips: what stands on it stays in sight. */
function TimeAxis({ session, window }: Props & { window: Window }) {
  const ticks = timesOf(window.from, window.to);
  const share = (t: number) => (t - window.from) / (window.to - window.from);
  const { t } = session.flight.read.value;
  return (
    <div class="chart-axis" aria-hidden="true" style={{ marginLeft: LEFT, marginRight: RIGHT }}>
      {ticks.map((tick) => (
        <span key={tick} style={{ left: `${100 * share(tick)}%` }}>
          {formatClock(tick)}
        </span>
      ))}
      <b style={{ left: `${100 * Math.min(1, Math.max(0, share(t)))}%` }}>{formatClock(t)}</b>
    </div>
  );
}

/** All lines in figures: what the drawing says to those who do not see it. */
function Summary({ strips, t }: { strips: readonly Strip[]; t: number }) {
  return (
    <details class="chart-summary">
      <summary>The charts in figures at {formatClock(t)}</summary>
      <table>
        <thead>
          <tr>
            <th scope="col">Line</th>
            <th scope="col">Now</th>
            <th scope="col">Least</th>
            <th scope="col">Most</th>
          </tr>
        </thead>
        <tbody>
          {strips.flatMap((strip) =>
            strip.lines.map((line) => {
              const values = line.values.filter((value) => value !== null);
              const now = valueAt(strip, line, t);
              const text = (value: number | null) => (value === null ? "–" : strip.format(value));
              const least = values.length === 0 ? null : values.reduce((a, b) => Math.min(a, b));
              const most = values.length === 0 ? null : values.reduce((a, b) => Math.max(a, b));
              return (
                <tr key={`${strip.name} ${line.label}`}>
                  <th scope="row">
                    {strip.title}, {line.label} [{strip.unit}]
                  </th>
                  <td>{text(now)}</td>
                  <td>{text(least)}</td>
                  <td>{text(most)}</td>
                </tr>
              );
            }),
          )}
        </tbody>
      </table>
    </details>
  );
}
