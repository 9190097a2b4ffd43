/** The pair that is looked at: both routes to the closest approach, where they are too close, the minimum. */

import { formatClock, formatMiles } from "../../units";
import type { PairCard } from "../../wire";
import { pairOf, soonOf } from "../pairs";
import type { Station } from "../station";
import { otherTrack, partOf } from "../tracks";
import { CERTAINTIES, timeText } from "../words";
import { lineOf, toPoint } from "./view";

export function PairGeometry({ station }: { station: Station }) {
  const { view, store, selected, pair: chosen } = station;
  const sky = store.sky.value;
  const card = sky.clearances.get(selected.value ?? "");
  const pair = card === undefined ? null : pairOf(card, chosen.value);
  if (card === undefined || pair === null || pair.at_s < sky.t) return null;
  const other = otherTrack(sky, card, pair);
  const [own, there] = [toPoint(view, pair.own), toPoint(view, pair.other)];
  const from = Math.max(sky.t, pair.since_s);
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
              class={`conflicted ${soonOf(from - sky.t) === "5 min" ? "red" : soonOf(from - sky.t) === "8 min" ? "yellow" : "later"}`}
              d={lineOf(view, partOf(track, from, pair.until_s))}
            />
          )}
        </g>
      ))}
      <path class="apart" d={`M${own.x} ${own.y}L${there.x} ${there.y}`} />
      <rect class="marker" x={own.x - 5} y={own.y - 5} width={10} height={10} />
      <path class="marker" d={`M${there.x} ${there.y - 7}l7 7l-7 7l-7 -7Z`} />
      <Said station={station} pair={pair} at={{ x: (own.x + there.x) / 2, y: there.y }} />
    </g>
  );
}

function Said(props: { station: Station; pair: PairCard; at: { x: number; y: number } }) {
  const { station, pair, at } = props;
  const { id, t } = station.store.sky.value;
  const { word } = CERTAINTIES[pair.certainty];
  const { width, height } = station.view.size.value;
  const x = Math.min(Math.max(at.x + 14, 8), width - 170);
  const y = Math.min(Math.max(at.y - 26, 40), height - 40);
  return (
    <text class="said">
      <tspan x={x} y={y}>
        {`${word} ${pair.ident} ${formatMiles(pair.least_m)} NM`}
      </tspan>
      <tspan x={x} dy="1.15em">
        {`AT ${timeText(id, pair.at_s)} IN ${formatClock(pair.at_s - t)}`}
      </tspan>
      <tspan x={x} dy="1.15em">{`MIN ${formatMiles(pair.minimum_m)} NM`}</tspan>
    </text>
  );
}
