import { useComputed } from "@preact/signals";
import type { Colour } from "../store/colours";
import type { OrderWord } from "../store/mode-words";
import { Cell } from "./cell";
import { type LayerProps, usePart } from "./layer";
import { READOUTS } from "./view";

const COLOURS: Record<OrderWord, Colour> = {
  SENT: "label",
  ACCEPTED: "armed",
  REJECTED: "caution",
  STANDBY: "label",
  VALIDATED: "plan",
  UNABLE: "caution",
  WILCO: "armed",
  CLEARED: "plan",
  DEVIATING: "caution",
  ENDED: "label",
};

/** What became of the crew's last order, or what air traffic control answered, under the modes. */
export function OrderStatus({ shown }: LayerProps) {
  const order = usePart(shown, (picture) => picture.order);
  const colour = useComputed(() => COLOURS[order.value.split(" ")[0] as OrderWord] ?? "label");
  // up to nine letters in full size: UNABLE LDR INTENT fills the column in the small one
  const size = useComputed(() => (order.value.length > 9 ? 15 : 20));
  const { width } = READOUTS.fma;
  return (
    <g class="nd-atc">
      <Cell x={0.9 * width} y={48} text={order} colour={colour} anchor="middle" size={size} />
    </g>
  );
}
