/** The pair that is looked at: both routes to the closest approach, where they are too close, the minimum. */

import type { Label } from "../../nd/labels";
import { formatClock, formatMiles } from "../../units";
import { type Conflict, pairOf, soonOf } from "../pairs";
import type { Station } from "../station";
import { otherTrack, partOf } from "../tracks";
import { CERTAINTIES, timeText } from "../words";
import { lineOf, toPoint, typeOf } from "./view";

/** The pair of the clearance that is chosen, as long as it is to come. */
function shownPair({ store, card, pair }: Station): Omit<Conflict, "after"> | null {
  const chosen = card.value === null ? null : pairOf(card.value, pair.value);
  if (card.value === null || chosen === null || chosen.at_s < store.sky.value.t) return null;
  return { card: card.value, pair: chosen };
}

export function PairGeometry({ station }: { station: Station }) {
  const { view, store } = station;
  const sky = store.sky.value;
  const found = shownPair(station);
  if (found === null) return null;
  const { card, pair } = found;
  const other = otherTrack(sky, card, pair);
  const [own, there] = [toPoint(view, pair.own), toPoint(view, pair.other)];
  const from = Math.max(sky.t, pair.since_s);
  const soon = { "5 min": "red", "8 min": "yellow", later: "later" }[soonOf(from - sky.t)];
  return (
    <g class={`atc-pair ${pair.certainty}`}>
      <circle
        class="minimum"
        cx={own.x}
        cy={own.y}
        r={(pair.minimum_m * view.scale.value).toFixed(1)}
      />
      {[card.route, other].map((track, k) => (
        <g key={k === 0 ? "own" : "other"}>
          <path class="halo" d={lineOf(view, partOf(track, sky.t, pair.at_s))} />
          <path class="way" d={lineOf(view, partOf(track, sky.t, pair.at_s))} />
          {pair.until_s > pair.since_s && (
            <path
              class={`conflicted ${soon}`}
              d={lineOf(view, partOf(track, from, pair.until_s))}
            />
          )}
        </g>
      ))}
      <path class="apart" d={`M${own.x} ${own.y}L${there.x} ${there.y}`} />
      <rect class="marker" x={own.x - 5} y={own.y - 5} width={10} height={10} />
      <path class="marker" d={`M${there.x} ${there.y - 7}l7 7l-7 7l-7 -7Z`} />
    </g>
  );
}

/** Its label stands outside the circle of the minimum, but no further away than this [px]. */
const FAR = 60;

/** How close they come, when, and what is to be kept. */
export function pairLabel(station: Station): Label | null {
  const { view, store } = station;
  const found = shownPair(station);
  if (found === null) return null;
  const { pair } = found;
  const { id, t } = store.sky.value;
  const lines = [
    `${CERTAINTIES[pair.certainty].word} ${pair.ident} ${formatMiles(pair.least_m)} NM`,
    `AT ${timeText(id, pair.at_s)} IN ${formatClock(pair.at_s - t)}`,
    `MIN ${formatMiles(pair.minimum_m)} NM`,
  ];
  return {
    id: "pair",
    at: toPoint(view, pair.own),
    lines: lines.map((text) => ({ text, colour: "label" })),
    side: 60,
    gap: Math.min(FAR, pair.minimum_m * view.scale.value + 6),
    size: typeOf(view),
    optional: false,
  };
}
