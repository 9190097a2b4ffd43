/** The strip of the clearance that is chosen: what is asked, what automation finds, what may be said. */

import { formatClock, formatMiles } from "../units";
import type { ClearanceCard, Finding } from "../wire";
import { Alternatives } from "./alternatives";
import { ANSWERS, answer, hindrance, probe, refusalOf } from "./answering";
import { choose, type Station } from "./station";
import { UnableReasons } from "./unable";
import { timeLeft } from "./urgency";
import { amountText, behindText, leastText, reasonText, STATES, timeText, VERDICTS } from "./words";

export function Strip({ station }: { station: Station }) {
  const card = station.card.value;
  return (
    <section class="atc-panel atc-strip" aria-labelledby="strip">
      <header>
        <h2 id="strip">Strip</h2>
        {card !== null && (
          <button type="button" class="quiet" onClick={() => choose(station, null)}>
            Close
          </button>
        )}
      </header>
      {card === null ? (
        <p class="hint">
          Choose a request: <kbd>↓</kbd> <kbd>↑</kbd>, or <kbd>N</kbd> for the next that waits.
        </p>
      ) : (
        <Content station={station} card={card} />
      )}
    </section>
  );
}

function Content({ station, card }: { station: Station; card: ClearanceCard }) {
  const left = timeLeft(card, station.store.sky.value.t);
  const { word } = STATES[card.state];
  return (
    // biome-ignore lint/a11y/noNoninteractiveTabindex: it scrolls, and is scrolled by keyboard
    <section class="atc-scroll" tabIndex={0} aria-label={`Strip of ${card.aircraft}`}>
      <p class="headline">
        <b>{card.aircraft}</b> {behindText(card)}
        <span class={`state ${card.state}`}>{word}</span>
        {left !== null && <span class="left">{formatClock(left)} left</span>}
        {card.auto_answer && <span class="auto">THE AUTOMATION ANSWERS</span>}
      </p>
      <p class="text">{card.text}</p>
      <Buttons station={station} card={card} />
      {station.unableOpen.value && <UnableReasons station={station} card={card} />}
      <Deviations card={card} />
      <Validation card={card} />
      <Tried station={station} card={card} />
      <Alternatives station={station} card={card} />
      <History card={card} />
    </section>
  );
}

function Buttons({ station, card }: { station: Station; card: ClearanceCard }) {
  const why = hindrance(station, card.id);
  const { sent, unableOpen } = station;
  const own = sent.value?.id === card.id ? sent.value : null;
  const isRefused = (said: (typeof ANSWERS)[ClearanceCard["state"]][number]) =>
    refusalOf(station, card, said) !== "";
  return (
    <>
      <div class="atc-answers">
        <button
          type="button"
          class="primary"
          disabled={isRefused("accepted")}
          onClick={() => void answer(station, "accepted")}
        >
          <kbd>A</kbd>Accept
        </button>
        <button
          type="button"
          disabled={isRefused("unable")}
          aria-expanded={unableOpen.value}
          onClick={() => {
            unableOpen.value = !unableOpen.value;
          }}
        >
          <kbd>U</kbd>Unable
        </button>
        <button
          type="button"
          disabled={isRefused("standby")}
          onClick={() => void answer(station, "standby")}
        >
          <kbd>S</kbd>Standby
        </button>
        <button type="button" onClick={() => void probe(station)}>
          <kbd>P</kbd>Probe
        </button>
        {ANSWERS[card.state].includes("cancelled") && (
          <button
            type="button"
            disabled={isRefused("cancelled")}
            onClick={() => void answer(station, "cancelled")}
          >
            Cancel
          </button>
        )}
        {ANSWERS[card.state].includes("terminated") && (
          <button
            type="button"
            disabled={isRefused("terminated")}
            onClick={() => void answer(station, "terminated", "conformance")}
          >
            Terminate
          </button>
        )}
      </div>
      {why !== "" && <p class="hint">{why}</p>}
      {own !== null && own.refusal === "" && (
        <p class="sent">{`${own.answer.toUpperCase()} sent: the stream will confirm it.`}</p>
      )}
      {own !== null && own.refusal !== "" && (
        <p class="refused" role="alert">
          {own.refusal}
        </p>
      )}
    </>
  );
}

function Deviations({ card }: { card: ClearanceCard }) {
  const standing = card.deviations.filter(({ level }) => level !== "none");
  if (standing.length === 0) return null;
  return (
    <>
      <h3>Deviations</h3>
      <ul class="deviations">
        {standing.map((each) => (
          <li key={each.subject} class={each.level}>
            <b>{each.level.toUpperCase()}</b> {each.subject}: {amountText(each)} since{" "}
            {timeText(card.sky, each.since_s)}. {each.message}
          </li>
        ))}
      </ul>
    </>
  );
}

function Validation({ card }: { card: ClearanceCard }) {
  const [found] = card.validation;
  if (found === undefined) return <p class="hint">Automation has not found anything yet.</p>;
  const { word, tone } = VERDICTS[found.verdict];
  return (
    <>
      <h3>Automation advises</h3>
      <p>
        <span class={`verdict ${tone}`}>{word}</span> {leastText(card)}, of {found.aircraft} other
        {found.aircraft === 1 ? "" : "s"}, computed {timeText(card.sky, found.computed_s)} on the
        picture of {timeText(card.sky, found.picture_as_of_s)}
      </p>
      <Findings findings={found.findings} />
    </>
  );
}

function Findings({ findings }: { findings: readonly Finding[] }) {
  if (findings.length === 0) return null;
  return (
    <ul class="findings">
      {findings.map((each) => (
        <li key={`${each.reason} ${each.message}`}>
          <b>{each.text}</b> {each.message}
        </li>
      ))}
    </ul>
  );
}

/** What a second look found. */
function Tried({ station, card }: { station: Station; card: ClearanceCard }) {
  const tried = station.tried.value;
  if (tried === null || tried.id !== card.id) return null;
  const found = tried.trial?.validation;
  const nearest = found?.pairs[0];
  return (
    <div role="status" class="tried">
      <h3>Probe</h3>
      {found === undefined ? (
        <p>{tried.sentence}</p>
      ) : (
        <>
          <p>
            <span class={`verdict ${VERDICTS[found.verdict].tone}`}>
              {VERDICTS[found.verdict].word}
            </span>{" "}
            at {timeText(card.sky, found.computed_s)}
            {nearest !== undefined && `, ${formatMiles(nearest.least_m)} NM of ${nearest.ident}`}
          </p>
          <Findings findings={found.findings} />
        </>
      )}
    </div>
  );
}

function History({ card }: { card: ClearanceCard }) {
  return (
    <>
      <h3>History</h3>
      <ol class="history">
        {card.history.map((each, k) => (
          <li key={`${each.state} ${k}`}>
            <span class="time">{timeText(card.sky, each.t_s)}</span>{" "}
            <b>{STATES[each.state].word}</b> <span class="unit">by {each.by}</span>{" "}
            {each.reason === each.by ? "" : reasonText(each.reason)} {each.message}
          </li>
        ))}
      </ol>
    </>
  );
}
