/** What the map shows besides the display's own layers: own ship where it is, the wind, the message. */

import { useComputed } from "@preact/signals";
import { Cell } from "../nd/cell";
import { type LayerProps, usePart } from "../nd/layer";
import { MessageBox } from "../nd/message";
import { SHAPE } from "../nd/ownship";
import { Stroke } from "../nd/stroke";
import { ink } from "../nd/style";
import { placeAt, toMap } from "../nd/view";
import { UNABLE } from "../store/notices";
import { formatHeading, formatKnots, formatMiles } from "../units";
import { isAreaCut } from "./asking";
import type { Editor } from "./editor";
import { DIAL } from "./handles";
import { BOUNDS } from "./situation";

export function OwnShipThere({ shown, view }: LayerProps) {
  const own = usePart(shown, ({ now }) => now?.pursuer ?? null);
  const place = useComputed(() =>
    own.value === null ? "" : placeAt(toMap(view.layout.value, own.value), own.value.heading_deg),
  );
  return (
    <g class="nd-ownship" transform={place}>
      <Stroke d={SHAPE} line={{ colour: "ownship", width: 5, dash: "" }} />
    </g>
  );
}

/** The wind as a dial: where it comes from, its strength from the middle to the rim (100 kt). */
export function WindDial({ map }: { map: Editor }) {
  const { from_deg, speed_mps } = map.situation.value.wind;
  const length = (DIAL.radius * Math.min(speed_mps, DIAL.most)) / DIAL.most;
  const text = speed_mps > 0 ? `${formatHeading(from_deg)} / ${formatKnots(speed_mps)}` : "CALM";
  return (
    <g class="nd-air" transform={placeAt(DIAL)}>
      <rect class="nd-ground" x={-DIAL.x} y={-DIAL.y} width={150} height={156} />
      <circle class="nd-stroke" r={DIAL.radius} stroke={ink("scale")} stroke-width={1.5} />
      <circle class="nd-stroke" r={DIAL.radius / 2} stroke={ink("superseded")} stroke-width={1} />
      {speed_mps > 0 && (
        <g transform={`rotate(${from_deg})`}>
          <Stroke
            d={`M0 ${-length}V${DIAL.radius}M-7 ${DIAL.radius - 12}L0 ${DIAL.radius}L7 ${DIAL.radius - 12}`}
            line={{ colour: "value", width: 2.5, dash: "" }}
          />
        </g>
      )}
      <Cell x={0} y={DIAL.radius + 24} text={text} colour="value" size={20} anchor="middle" />
    </g>
  );
}

/** That the area under the map ends, where it does. */
export function AreaEnd({ map }: { map: Editor }) {
  if (!map.hasArea.value || !isAreaCut(map)) return null;
  return (
    <Cell
      x={384}
      y={752}
      text={`AREA WITHIN ${formatMiles(BOUNDS.position[1], 0)} NM OF THE ORIGIN`}
      colour="label"
      size={20}
      anchor="middle"
    />
  );
}

/** Why there is no path. */
export function MapMessage({ map }: { map: Editor }) {
  const answer = map.answered.value?.answer;
  const text =
    map.refusal.value !== ""
      ? "NOT PLANNED"
      : answer?.status === "no_plan"
        ? `NO PLAN: ${UNABLE[answer.reason]}`
        : "";
  if (text === "") return null;
  return (
    <g class="nd-message">
      <MessageBox text={text} colour="caution" />
    </g>
  );
}
