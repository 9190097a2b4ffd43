import { useComputed } from "@preact/signals";
import { Cell } from "./cell";
import type { LayerProps } from "./layer";
import { placeAt, READOUTS } from "./view";

/** Spacing to the leader: D asked, d now, closure, offset from its final route, time to converge. */
export function Spacing({ shown: { numbers } }: LayerProps) {
  const isShown = useComputed(() => numbers.value.isSpacing);
  const asked = useComputed(() => numbers.value.slotDistance);
  const separation = useComputed(() => numbers.value.separation);
  const closure = useComputed(() => numbers.value.closure);
  const offset = useComputed(() => numbers.value.crossTrack || "0.0");
  const left = useComputed(() => numbers.value.toJoin || "--:--");
  if (!isShown.value) return null;
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
          <Cell x={width - 37} y={22 + 27 * i} text={value} colour={colour} anchor="end" />
          <Cell x={width} y={22 + 27 * i} text={unit} colour="unit" size={18} anchor="end" />
        </g>
      ))}
    </g>
  );
}
