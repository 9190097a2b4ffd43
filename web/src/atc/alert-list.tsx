/** Alerts of conformance: a banner for what is not silenced, and the list of all. */

import { formatClock } from "../units";
import { SILENCE } from "./alerts";
import { choose, openTab, type Station, silence } from "./station";
import { amountText, timeText } from "./words";

export function AlertBanner({ station }: { station: Station }) {
  const [first, ...more] = station.loud.value;
  return (
    <div role="alert" class="atc-banner-place">
      {first !== undefined && (
        <div class="atc-banner">
          <b>DEVIATION</b>
          <span>
            {first.deviation.message} {more.length > 0 && `And ${more.length} more.`}
          </span>
          <button
            type="button"
            onClick={() => {
              openTab(station, first.sky);
              choose(station, first.card.id);
            }}
          >
            Show
          </button>
          <button type="button" onClick={() => silence(station, first.key, SILENCE)}>
            <kbd>X</kbd>Silence 60 s
          </button>
        </div>
      )}
    </div>
  );
}

export function AlertList({ station }: { station: Station }) {
  const { alerts, silenced, wall } = station;
  if (alerts.value.length === 0) return null;
  return (
    <section class="atc-panel atc-alerts" aria-labelledby="alerts">
      <header>
        <h2 id="alerts">Conformance</h2>
      </header>
      <ul>
        {alerts.value.map(({ key, sky, card, deviation }) => {
          const left = ((silenced.value.get(key) ?? 0) - wall.value) / 1000;
          return (
            <li key={key} class={deviation.level}>
              <b>{deviation.level.toUpperCase()}</b>
              <button
                type="button"
                class="quiet"
                onClick={() => {
                  openTab(station, sky);
                  choose(station, card.id);
                }}
              >
                {card.aircraft}
              </button>
              <span>
                {deviation.subject} {amountText(deviation)} since {timeText(sky, deviation.since_s)}
              </span>
              {deviation.level === "alert" && (
                <button
                  type="button"
                  disabled={left > 0}
                  onClick={() => silence(station, key, SILENCE)}
                >
                  {left > 0 ? `Silent ${formatClock(left)}` : "Silence 60 s"}
                </button>
              )}
            </li>
          );
        })}
      </ul>
    </section>
  );
}
