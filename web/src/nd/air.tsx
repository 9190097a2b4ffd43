import { useComputed } from "@preact/signals";
import { wrap360 } from "../units";
import { Cell } from "./cell";
import type { LayerProps } from "./layer";
import { Stroke } from "./stroke";
import { placeAt, READOUTS } from "./view";

/** Ground speed, true airspeed, wind. */
export function AirData({ shown: { numbers }, view }: LayerProps) {
  const gs = useComputed(() => numbers.value.gs);
  const tas = useComputed(() => numbers.value.tas);
  const from = useComputed(() => numbers.value.windFrom);
  const speed = useComputed(() => numbers.value.windSpeed);
  const arrow = useComputed(() => {
    const [to, pose] = [numbers.value.windTo, view.pose.value];
    if (to === null || pose === null) return "";
    return placeAt({ x: 122, y: 46 }, wrap360(to - pose.heading_deg));
  });
  const blowing = useComputed(() => arrow.value !== "");
  const { x, y } = READOUTS.air;
  return (
    <g class="nd-air" transform={placeAt({ x, y })}>
      <Cell x={0} y={22} text="GS" colour="label" size={18} />
      <Cell x={30} y={22} text={gs} colour="value" />
      <Cell x={86} y={22} text="TAS" colour="label" size={18} />
      <Cell x={127} y={22} text={tas} colour="value" />
      <Cell x={0} y={54} text={from} colour="value" />
      <Cell x={43} y={54} text="/" colour="label" />
      <Cell x={58} y={54} text={speed} colour="value" />
      {blowing.value && (
        <g transform={arrow}>
          <Stroke d="M0 14V-14M-6 -6L0 -14L6 -6" line={{ colour: "value", width: 2.5, dash: "" }} />
        </g>
      )}
    </g>
  );
}
