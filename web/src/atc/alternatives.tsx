/** What would be acceptable instead: each can be shown on the map, and offered in words. */

import { formatMiles } from "../units";
import type { ClearanceCard } from "../wire";
import { offer, offerText, refusalOf } from "./answering";
import type { Station } from "./station";
import { timeText } from "./words";

const CHANGES = { later: "LATER", word: "OTHER WAY", spacing: "OTHER D", level: "OTHER LEVEL" };

export function Alternatives({ station, card }: { station: Station; card: ClearanceCard }) {
  const all = card.validation[0]?.alternatives ?? [];
  const { alternative } = station;
  if (all.length === 0) return null;
  const why = refusalOf(station, card, "unable");
  return (
    <>
      <h3>Acceptable instead</h3>
      <ul class="alternatives">
        {all.map((each) => {
          const isShown = alternative.value?.message === each.message;
          return (
            <li key={each.message}>
              <p>
                <b>{CHANGES[each.change]}</b> {each.message}{" "}
                <span class="unit">
                  {formatMiles(each.least_m)} NM from others, joins{" "}
                  {timeText(card.sky, each.joins_s)}
                </span>
              </p>
              <p class="offer">{offerText(card, each)}</p>
              <button
                type="button"
                aria-pressed={isShown}
                onClick={() => {
                  alternative.value = isShown ? null : each;
                }}
              >
                Show
              </button>
              <button type="button" disabled={why !== ""} onClick={() => void offer(station, each)}>
                Unable, and offer this
              </button>
            </li>
          );
        })}
      </ul>
    </>
  );
}
