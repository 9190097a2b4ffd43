/** What lies under the traffic: range rings round the middle, a scale, closed airspaces. */

import { ticksOf } from "../../charts/scale";
import type { Label } from "../../nd/labels";
import { type Point, within } from "../../nd/view";
import { formatMiles, NM } from "../../units";
import type { AirspaceCard } from "../../wire";
import type { Station } from "../station";
import type { Place } from "../tracks";
import { glassOf, lineOf, toPoint, typeOf } from "./view";

/** So many rings are about right, and the scale is about so long [px]. */
const RINGS = 6;
const SCALE = 110;
/** Lengths of the scale [NM]. */
const LENGTHS = [0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500];

export function Rings({ station: { view } }: { station: Station }) {
  const { width, height } = view.size.value;
  const reach = Math.hypot(width, height) / 2 / view.scale.value / NM;
  const rings = ticksOf(0, reach, RINGS).filter((each) => each > 0);
  return (
    <g class="atc-rings">
      {rings.map((ring) => {
        const radius = ring * NM * view.scale.value;
        return (
          <g key={ring}>
            <circle cx={width / 2} cy={height / 2} r={radius} />
            {radius < height / 2 - 12 && (
              <text x={width / 2 + 4} y={height / 2 - radius - 3}>
                {ring} NM
              </text>
            )}
          </g>
        );
      })}
      <path d={`M${width / 2 - 6} ${height / 2}h12M${width / 2} ${height / 2 - 6}v12`} />
    </g>
  );
}

export function Scale({ station: { view } }: { station: Station }) {
  const { height } = view.size.value;
  const most = SCALE / view.scale.value / NM;
  const length = LENGTHS.findLast((each) => each <= most) ?? most;
  const px = length * NM * view.scale.value;
  return (
    <g class="atc-scale" transform={`translate(14 ${height - 14})`}>
      <path d={`M0 -5V0H${px.toFixed(1)}V-5`} />
      <text x={px + 6} y={1}>
        {formatMiles(length * NM, length < 1 ? 1 : 0)} NM
      </text>
    </g>
  );
}

export function Airspaces({ station: { view, store } }: { station: Station }) {
  return (
    <g class="atc-airspaces">
      {store.sky.value.airspaces.map((each) => (
        <path
          key={each.ident}
          class={each.closed ? "closed" : "open"}
          d={`${lineOf(view, cornersOf(each))}Z`}
        />
      ))}
    </g>
  );
}

function cornersOf({ x_m, y_m }: AirspaceCard): Place[] {
  return x_m.map((x, k) => ({ x_m: x, y_m: y_m[k] ?? 0 }));
}

/** What an airspace is called, and when and where it is closed. */
export function airspaceLabels({ view, store }: Station): Label[] {
  return store.sky.value.airspaces.flatMap((each) => {
    const points = cornersOf(each).map((place) => toPoint(view, place));
    const mean = (part: (point: Point) => number) =>
      points.reduce((sum, point) => sum + part(point), 0) / Math.max(1, points.length);
    const at = { x: mean(({ x }) => x), y: mean(({ y }) => y) };
    if (!within(glassOf(view), at)) return [];
    const name = each.closed ? `${each.ident} CLOSED` : each.ident;
    return {
      id: `airspace ${each.ident}`,
      at,
      lines: [
        { text: name, colour: each.closed ? "caution" : "superseded" },
        { text: each.text, colour: "label" },
      ],
      side: 180,
      gap: 0,
      size: typeOf(view) - 1,
      optional: false,
    };
  });
}
