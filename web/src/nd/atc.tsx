import { useComputed } from "@preact/signals";
import type { Colour } from "../store/colours";
import type { Picture } from "../store/picture";
import { Cell } from "./cell";
import { type LayerProps, usePart } from "./layer";
import { READOUTS } from "./view";

const COLOURS: Record<Picture["order"], Colour> = {
  "": "label",
  SENT: "label",
  ACCEPTED: "armed",
  REJECTED: "caution",
};

/** What became of the crew's last order, under the modes. */
export function OrderStatus({ shown }: LayerProps) {
  const order = usePart(shown, (picture) => picture.order);
  const colour = useComputed(() => COLOURS[order.value]);
  const { width } = READOUTS.fma;
  return (
    <g class="nd-atc">
      <Cell x={0.9 * width} y={48} text={order} colour={colour} anchor="middle" size={20} />
    </g>
  );
}
