/** Time along the foot of the page: what was received can be looked at again; Live leads back. */

import { signal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import type { Station } from "./station";
import { timeText } from "./words";

/** So fast the past is shown again, and so often a second it moves. */
const RATES = [1, 4, 16] as const;
const BEATS = 4;

const rate = signal<number>(0);

export function Timeline({ station }: { station: Station }) {
  const { store, file } = station;
  const [from, to] = store.span.value;
  const shown = store.instant.value ?? to;
  const { id } = store.sky.value;
  const speed = rate.value;
  useEffect(() => {
    if (speed === 0) return;
    const timer = setInterval(() => {
      const { instant, span } = store;
      const next = (instant.value ?? span.value[0]) + speed / BEATS;
      if (next >= span.value[1]) rate.value = 0;
      instant.value = next >= span.value[1] ? null : next;
    }, 1000 / BEATS);
    return () => clearInterval(timer);
  }, [speed, store]);
  const live = () => {
    rate.value = 0;
    store.instant.value = null;
  };
  return (
    <footer class="atc-timeline">
      <span class="time">{timeText(id, shown)}</span>
      <div class="track">
        <Marks station={station} />
        <input
          type="range"
          aria-label="Instant that is shown"
          aria-valuetext={timeText(id, shown)}
          min={0}
          max={Math.ceil(to - from)}
          step={1}
          value={Math.ceil(shown - from)}
          disabled={to <= from}
          onInput={({ currentTarget }) => {
            store.instant.value = from + Number(currentTarget.value);
          }}
        />
      </div>
      <fieldset class="rates">
        <legend class="visually-hidden">Show the past again</legend>
        {RATES.map((each) => (
          <button
            key={each}
            type="button"
            aria-pressed={speed === each}
            aria-label={`Play ${each} times as fast`}
            disabled={to <= from}
            onClick={() => {
              if (store.instant.value === null) store.instant.value = from;
              rate.value = speed === each ? 0 : each;
            }}
          >
            ▶ ×{each}
          </button>
        ))}
      </fieldset>
      <button
        type="button"
        class={store.instant.value === null ? "edge live" : "edge behind"}
        onClick={live}
      >
        <kbd>L</kbd>
        {store.instant.value !== null ? "Back to the end" : file.value === "" ? "Live" : "The end"}
      </button>
    </footer>
  );
}

function Marks({ station: { store } }: { station: Station }) {
  const [from, to] = store.span.value;
  if (to <= from) return null;
  return (
    <svg viewBox="0 0 1000 10" preserveAspectRatio="none" aria-hidden="true">
      {store.marks.value.map(({ t, what, isAlert }, k) => (
        <rect
          key={`${t} ${what} ${k}`}
          class={isAlert ? "alert" : ""}
          x={(1000 * (t - from)) / (to - from) - 1}
          y={isAlert ? 0 : 4}
          width={2}
          height={isAlert ? 10 : 6}
        />
      ))}
    </svg>
  );
}
