/** What lies under the traffic: range rings round the middle, a scale, closed airspaces. */

import { ticksOf } from "../../charts/scale";
import { formatMiles, NM } from "../../units";
import type { Station } from "../station";
import { lineOf, toPoint } from "./view";

/** So many rings are about right, and the scale is about so long [px]. */
const RINGS = 4;
const SCALE = 110;

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
  const length = ticksOf(0, most, 1).at(-1) || most;
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
      {store.sky.value.airspaces.map(({ ident, x_m, y_m, text, closed }) => {
        const places = x_m.map((x, k) => ({ x_m: x, y_m: y_m[k] ?? 0 }));
        const count = Math.max(1, places.length);
        const { x, y } = toPoint(view, {
          x_m: x_m.reduce((sum, each) => sum + each, 0) / count,
          y_m: y_m.reduce((sum, each) => sum + each, 0) / count,
        });
        return (
          <g key={ident} class={closed ? "closed" : "open"}>
            <path d={`${lineOf(view, places)}Z`} />
            <text x={x} y={y}>
              <tspan x={x}>{closed ? `${ident} CLOSED` : ident}</tspan>
              <tspan x={x} dy="1.2em">
                {text}
              </tspan>
            </text>
          </g>
        );
      })}
    </g>
  );
}
