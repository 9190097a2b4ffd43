import { useComputed } from "@preact/signals";
import { formatHeading, formatKnots, KT, wrap360 } from "../units";
import { Cell } from "./cell";
import { type LayerProps, shownReading } from "./picture";
import { Stroke } from "./stroke";
import { placeAt, READOUTS } from "./view";

/** Calm below this: no arrow. */
const ARROW_FROM = 2 * KT;

/** Ground speed, true airspeed, wind. */
export function AirData({ flight, view }: LayerProps) {
  const own = useComputed(() => shownReading(flight)?.now.pursuer ?? null);
  const gs = useComputed(() => (own.value === null ? "---" : knots(own.value.ground_speed_mps)));
  const tas = useComputed(() => (own.value === null ? "---" : knots(own.value.tas_mps)));
  const wind = useComputed(() => (own.value === null ? null : flight.started.value?.wind) ?? null);
  const from = useComputed(() => {
    const value = wind.value;
    if (value === null) return "---";
    return value.speed_mps < ARROW_FROM / 2 ? "---" : formatHeading(value.from_deg);
  });
  const speed = useComputed(() => (wind.value === null ? "---" : windKnots(wind.value.speed_mps)));
  const arrow = useComputed(() => {
    const [value, pose] = [wind.value, view.pose.value];
    if (value === null || pose === null || value.speed_mps <= ARROW_FROM) return "";
    return placeAt({ x: 122, y: 46 }, wrap360(value.from_deg + 180 - pose.heading_deg));
  });
  const blowing = useComputed(() => arrow.value !== "");
  const { x, y } = READOUTS.air;
  return (
    <g class="nd-air" transform={placeAt({ x, y })}>
      <Cell x={0} y={22} text="GS" colour="label" size={18} />
      <Cell x={26} y={22} text={gs} colour="value" />
      <Cell x={82} y={22} text="TAS" colour="label" size={18} />
      <Cell x={121} y={22} text={tas} colour="value" />
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

function knots(speed: number): string {
  return formatKnots(speed).padStart(3, "0");
}

function windKnots(speed: number): string {
  return formatKnots(speed).padStart(2, "0");
}
