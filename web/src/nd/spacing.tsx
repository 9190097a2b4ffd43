import { useComputed } from "@preact/signals";
import { timeToJoin } from "../committed";
import { formatClock, formatMiles, formatSignedKnots } from "../units";
import { Cell } from "./cell";
import { formatSide } from "./crosstrack";
import { type LayerProps, shownReading } from "./picture";
import { placeAt, READOUTS } from "./view";

/** Spacing to the leader: D asked, d now, closure, offset from its final route, time to converge. */
export function Spacing({ flight }: LayerProps) {
  const now = useComputed(() => shownReading(flight)?.now ?? null);
  const shown = useComputed(() => now.value !== null);
  const asked = useComputed(() => formatMiles(flight.started.value?.slot_distance_m ?? 0));
  const separation = useComputed(() => formatMiles(now.value?.separation_m ?? 0));
  const closure = useComputed(() => formatSignedKnots(now.value?.closure_mps ?? 0));
  const offset = useComputed(() => formatSide(now.value?.cross_track_m ?? 0) || "0.0");
  const left = useComputed(() => {
    const time = timeToJoin(flight);
    return time === null ? "--:--" : formatClock(time);
  });
  if (!shown.value) return null;
  const { x, y, width, height } = READOUTS.spacing;
  const rows = [
    { label: "D", value: asked, unit: "NM", colour: "selected" },
    { label: "d", value: separation, unit: "NM", colour: "value" },
    { label: "CLS", value: closure, unit: "KT", colour: "value" },
    { label: "XTK", value: offset, unit: "NM", colour: "value" },
    { label: "CNV", value: left, unit: "", colour: "value" },
  ] as const;
  return (
    <g class="nd-spacing" transform={placeAt({ x, y })}>
      <rect class="nd-ground" x={-6} y={-2} width={width + 6} height={height} />
      {rows.map(({ label, value, unit, colour }, i) => (
        <g key={label}>
          <Cell x={0} y={22 + 27 * i} text={label} colour="label" size={20} />
          <Cell x={width - 32} y={22 + 27 * i} text={value} colour={colour} anchor="end" />
          <Cell x={width} y={22 + 27 * i} text={unit} colour="unit" size={18} anchor="end" />
        </g>
      ))}
    </g>
  );
}
