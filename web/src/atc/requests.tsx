/** The request list: the most urgent first. Up and Down choose, wherever the focus is. */

import { useEffect, useRef } from "preact/hooks";
import { formatClock } from "../units";
import type { ClearanceCard } from "../wire";
import { choose, type Station } from "./station";
import { isOver, isWaiting, timeLeft } from "./urgency";
import { behindText, leastText, STATES, VERDICTS } from "./words";

/** An answer is urgent when so little time is left [s]. */
const URGENT = 15;

export function RequestList({ station }: { station: Station }) {
  const { requests, selected, all } = station;
  const list = useRef<HTMLDivElement>(null);
  const chosen = selected.value;
  useEffect(() => {
    if (chosen !== null)
      list.current?.querySelector("[aria-selected=true]")?.scrollIntoView({ block: "nearest" });
  }, [chosen]);
  const waiting = requests.value.filter(isWaiting).length;
  const ended = station.store.sky.value.clearances.size; // of an empty list
  const isListed = requests.value.some(({ id }) => id === chosen);
  return (
    <section class="atc-panel atc-requests" aria-labelledby="requests">
      <header>
        <h2 id="requests">Requests</h2>
        <span class="count">{waiting} waiting</span>
        <label title="Those, too, that ended more than a minute ago">
          <input
            type="checkbox"
            checked={all.value}
            onChange={() => {
              all.value = !all.value;
            }}
          />
          show ended
        </label>
      </header>
      {requests.value.length === 0 ? (
        <p class="hint">
          Nothing is asked for now.{" "}
          {ended === 0
            ? "A crew asks when it arms guidance."
            : `${ended} ended: tick “show ended” to see ${ended === 1 ? "it" : "them"}.`}
        </p>
      ) : (
        <div
          ref={list}
          role="listbox"
          aria-label="Requests, the most urgent first"
          aria-activedescendant={isListed ? `request-${chosen}` : undefined}
          tabIndex={0}
        >
          {requests.value.map((card) => (
            <Row key={card.id} station={station} card={card} isChosen={card.id === chosen} />
          ))}
        </div>
      )}
    </section>
  );
}

function Row(props: { station: Station; card: ClearanceCard; isChosen: boolean }) {
  const { station, card, isChosen } = props;
  const left = timeLeft(card, station.store.sky.value.t);
  const verdict = card.validation[0]?.verdict;
  const isUrgent = left !== null && left < URGENT && isWaiting(card);
  const alerts = card.deviations.filter(({ level }) => level === "alert").length;
  return (
    // biome-ignore lint/a11y/useFocusableInteractive: the list has the focus, and names the chosen row
    // biome-ignore lint/a11y/useKeyWithClickEvents: Up and Down choose, wherever the focus is
    <div
      id={`request-${card.id}`}
      class={`request${isOver(card) ? " over" : ""}`}
      role="option"
      aria-selected={isChosen}
      onClick={() => choose(station, card.id)}
    >
      <span class={`left${isUrgent ? " urgent" : ""}`}>
        {left === null || isOver(card) ? "–" : formatClock(left)}
      </span>
      <span class="behind">
        <b>{card.aircraft}</b> {behindText(card)}
      </span>
      <span class={`state ${card.state}`}>{STATES[card.state].word}</span>
      <span class={`verdict ${verdict === undefined ? "" : VERDICTS[verdict].tone}`}>
        {verdict === undefined ? "…" : VERDICTS[verdict].word}
      </span>
      <span class="least">{leastText(card)}</span>
      {alerts > 0 && <span class="deviates">DEVIATION ALERT</span>}
    </div>
  );
}
