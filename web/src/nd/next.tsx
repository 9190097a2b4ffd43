import { useComputed } from "@preact/signals";
import type { Colour } from "../store/colours";
import { Cell } from "./cell";
import type { LayerProps } from "./layer";
import { placeAt, READOUTS } from "./view";

/** What comes next on the plan: the turn with its bearing, distance and countdown, or the capture point. */
export function NextPoint({ shown: { numbers } }: LayerProps) {
  const next = useComputed(() => numbers.value.next);
  const name = useComputed(() => next.value?.name ?? "");
  const place = useComputed(() => next.value?.bearing ?? "");
  const degree = useComputed(() => (next.value === null ? "" : "°/"));
  const miles = useComputed(() => next.value?.miles ?? "");
  const unit = useComputed(() => (next.value === null ? "" : "NM"));
  const left = useComputed(() => next.value?.left ?? "");
  const urgent = useComputed<Colour>(() => (next.value?.isUrgent === true ? "managed" : "value"));
  const { x, y, width } = READOUTS.next;
  return (
    <g class="nd-next" transform={placeAt({ x, y })}>
      <Cell x={width} y={22} text={name} colour="label" anchor="end" />
      <Cell x={46} y={52} text={place} colour="value" anchor="end" />
      <Cell x={46} y={52} text={degree} colour="unit" />
      <Cell x={width - 32} y={52} text={miles} colour="value" anchor="end" />
      <Cell x={width} y={52} text={unit} colour="unit" size={18} anchor="end" />
      <Cell x={width} y={82} text={left} colour={urgent} anchor="end" />
    </g>
  );
}
