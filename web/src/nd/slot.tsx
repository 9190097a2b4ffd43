import { useComputed } from "@preact/signals";
import { type LayerProps, usePart } from "./layer";
import { Stroke } from "./stroke";
import { ink } from "./style";
import { placeAt, toMap } from "./view";

/** The gate that own ship is to sit in: a little wider than its symbol. */
const GATE = "M-28 -15H28V15H-28Z";
const PENNANT = "M28 -15V-42L47 -35L28 -28";

/** The slot: a pennant over a gate across the leader's route; filled once own ship is in it. */
export function Slot({ shown, view }: LayerProps) {
  const guided = usePart(shown, (picture) => picture.guided);
  const place = useComputed(() => {
    const slot = guided.value?.slot;
    return slot === undefined ? "" : placeAt(toMap(view.layout.value, slot), slot.heading_deg);
  });
  const look = usePart(shown, (picture) => picture.look);
  const joined = useComputed(() => guided.value?.joined ?? false);
  const open = useComputed(() => guided.value?.slot_open ?? false);
  if (look.value === null) return null;
  if (look.value.slot === "none") return null;
  const colour = look.value.slotColour;
  // Until the leader is on its final leg the slot is only a place in the making: broken lines.
  const strokeLine = { colour, width: 2.5, dash: open.value ? "" : "5 4" };
  const fill = joined.value ? ink(colour) : "none";
  return (
    <g class="nd-slot" transform={place}>
      <path d={GATE} fill={fill} fill-opacity={0.5} />
      <Stroke d={GATE} line={strokeLine} />
      <Stroke d={PENNANT} line={strokeLine} />
      <path d={`${PENNANT}Z`} fill={fill} />
      {look.value.slot === "crossed" && (
        <Stroke d="M-28 -15L28 15M28 -15L-28 15" line={strokeLine} />
      )}
    </g>
  );
}
