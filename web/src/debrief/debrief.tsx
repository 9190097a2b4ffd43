/** How a flight went: its path over the fastest one, the seconds lost and where, and how it was flown by hand. */

import { useComputed, useSignal } from "@preact/signals";
import { useEffect, useMemo } from "preact/hooks";
import { lessonOf } from "../lessons/lessons";
import { Verdict } from "../lessons/verdict";
import { Maximise } from "../parts";
import type { Actions, Session } from "../session";
import { formatClock } from "../units";
import { byHandOf } from "./by-hand";
import { type Fastest, fastestOf } from "./fastest";
import { figuresOf } from "./figures";
import { type Losses, lossesOf } from "./losses";
import { LostChart } from "./lost-chart";
import { PathPicture } from "./path";
import { type Flown, flownOf } from "./seconds";
import "./debrief.css";

interface Props {
  readonly session: Session;
  readonly actions: Actions;
}

export function Debrief({ session, actions }: Props) {
  const { sceneMaximised, debriefOpen, flight } = session;
  const flown = useComputed(() => {
    void flight.revision.value;
    return flownOf(session.history());
  });
  const close = () => {
    debriefOpen.value = false;
    sceneMaximised.value = false;
  };
  const isLive = flight.source.value.kind === "live" && !flight.clock.value.ended;
  return (
    <section class="panel debrief" aria-labelledby="panel-debrief">
      <header>
        <h2 id="panel-debrief">
          Debrief{isLive && flown.value?.joined === null ? ": so far" : ""}
        </h2>
        <Maximise on={sceneMaximised} />
        <button type="button" class="quiet" onClick={close}>
          Close
        </button>
      </header>
      {flown.value === null ? (
        <p class="debrief-none" role="status">
          There is nothing to look back on before guidance is engaged.
        </p>
      ) : (
        <Told session={session} actions={actions} flown={flown.value} />
      )}
    </section>
  );
}

function Told({ session, actions, flown }: Props & { flown: Flown }) {
  const { flight, status, recording } = session;
  const history = session.history();
  const losses = useMemo(() => lossesOf(flown), [flown]);
  const hand = useMemo(() => byHandOf(history, flown), [history, flown]);
  const fastest = useFastest(session, flown);
  useEffect(() => {
    session.lost.value = losses.worst;
    return () => {
      session.lost.value = [];
    };
  }, [session, losses]);
  const figures = figuresOf(history, flown, losses, hand, fastest);
  const lesson = lessonOf(status.value?.scenario ?? "");
  const isLost = figures.some(({ tone }) => tone === "alert");
  const now = flight.read.value.now?.pursuer ?? null;
  return (
    // biome-ignore lint/a11y/noNoninteractiveTabindex: it scrolls
    <div class="debrief-body" tabIndex={0}>
      {lesson !== null && recording.value === null && (
        <Verdict
          session={session}
          actions={actions}
          lesson={lesson}
          flown={flown}
          isLost={isLost}
        />
      )}
      <div class="debrief-two">
        <figure>
          <PathPicture
            history={history}
            flown={flown}
            fastest={fastest.path}
            worst={losses.worst}
            now={now}
          />
          <figcaption class="hint">{fastest.sentence}</figcaption>
        </figure>
        <dl class="debrief-figures">
          {figures.map(({ label, value, note, tone }) => (
            <div key={label}>
              <dt>{label}</dt>
              <dd class={tone}>
                {value}
                {note !== "" && <span class="note"> {note}</span>}
              </dd>
            </div>
          ))}
        </dl>
      </div>
      <div class="debrief-two">
        <figure>
          <LostChart flown={flown} losses={losses} t={flight.read.value.t} />
          <figcaption class="hint">
            {flown.byHand
              ? "Seconds lost by hand: how much later it joins if the autopilot flies on from there."
              : "Seconds lost: how much later it joins than was forecast."}
            {Math.round(losses.leader) !== 0 && " Dotted: with what the leader did."}
          </figcaption>
        </figure>
        <Where losses={losses} seek={actions.seek} />
      </div>
    </div>
  );
}

/** Where time was lost: the table beside the chart; each line shows its instant. */
function Where({ losses, seek }: { losses: Losses; seek: Actions["seek"] }) {
  if (losses.worst.length === 0)
    return <p class="debrief-where">No stretch of it cost a whole second.</p>;
  return (
    <table class="debrief-where">
      <caption>Where time was lost</caption>
      <thead>
        <tr>
          <th scope="col">
            <span class="visually-hidden">Number</span>
          </th>
          <th scope="col">From – to</th>
          <th scope="col">Lost</th>
          <th scope="col">How</th>
        </tr>
      </thead>
      <tbody>
        {losses.worst.map(({ from, to, lost, how }, k) => (
          <tr key={from}>
            <th scope="row">{k + 1}</th>
            <td>
              <button
                type="button"
                class="link"
                aria-label={`Show ${formatClock(from)}`}
                onClick={() => seek(from)}
              >
                {formatClock(from)} – {formatClock(to)}
              </button>
            </td>
            <td>{Math.round(lost)} s</td>
            <td>{how}</td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}

const ASKING: Fastest = { path: [], joins: null, sentence: "The fastest path is looked for." };

/** Asked for once, when it is over; and again if more is known of where it began. */
function useFastest(session: Session, flown: Flown): Fastest {
  const fastest = useSignal(ASKING);
  const { from, joined } = flown;
  useEffect(() => {
    let isWanted = true;
    fastest.value = ASKING;
    void fastestOf(session.history(), flown).then((found) => {
      if (isWanted) fastest.value = found;
    });
    return () => {
      isWanted = false;
    };
  }, [session, session.flight.id.value, from, joined, fastest]);
  return fastest.value;
}
