import { useComputed } from "@preact/signals";
import { type LayerProps, usePart } from "./layer";
import { Stroke } from "./stroke";
import { ink } from "./style";
import { placeAt, round, toMap } from "./view";

/** A gate shorter than this is found by a locator round it [px]. */
const SMALLEST = 8;
/** The locator's corners, and its pennant. */
const HALF = 15;
const CORNER = 7;
const PENNANT = "M0 0V-34L19 -27L0 -20";

/** The slot: a gate as wide and long as its tolerance, with a pennant; filled once own ship is in it. */
export function Slot({ shown, view }: LayerProps) {
  const guided = usePart(shown, (picture) => picture.guided);
  const gate = usePart(shown, (picture) => picture.gate);
  const place = useComputed(() => {
    const slot = guided.value?.slot;
    return slot === undefined ? "" : placeAt(toMap(view.layout.value, slot), slot.heading_deg);
  });
  const style = usePart(shown, (picture) => picture.style);
  const joined = useComputed(() => guided.value?.joined ?? false);
  const open = useComputed(() => guided.value?.slot_open ?? false);
  const half = useComputed(() => {
    const { scale } = view.layout.value;
    return { across: gate.value.across * scale, along: gate.value.along * scale };
  });
  if (style.value === null || style.value.slot === "none") return null;
  const { across, along } = half.value;
  const isSmall = 2 * along < SMALLEST;
  const colour = style.value.slotColour;
  // Until the leader is on its final leg the slot is only a place in the making: broken lines.
  const strokeLine = { colour, width: 2.5, dash: open.value ? "" : "5 4" };
  const fill = joined.value ? ink(colour) : "none";
  const side = isSmall ? HALF : across;
  const end = isSmall ? HALF : along;
  return (
    <g class="nd-slot" transform={place}>
      <path class="nd-gate" d={box(across, along)} fill={fill} fill-opacity={0.5} />
      <Stroke d={box(across, along)} line={{ ...strokeLine, width: isSmall ? 1.5 : 2.5 }} />
      {isSmall && <Stroke d={CORNERS} line={{ ...strokeLine, dash: open.value ? "" : "3 3" }} />}
      <g transform={placeAt({ x: round(side), y: round(-end) })}>
        <Stroke d={PENNANT} line={{ ...strokeLine, dash: "" }} />
        <path d={`${PENNANT}Z`} fill={fill} />
      </g>
      {style.value.slot === "crossed" && <Stroke d={CROSS} line={strokeLine} />}
    </g>
  );
}

const CROSS = `M${-HALF} ${-HALF}L${HALF} ${HALF}M${HALF} ${-HALF}L${-HALF} ${HALF}`;
const CORNERS = [
  [-1, -1],
  [1, -1],
  [1, 1],
  [-1, 1],
]
  .map(([x = 0, y = 0]) => {
    const inner = HALF - CORNER;
    return `M${x * inner} ${y * HALF}H${x * HALF}V${y * inner}`;
  })
  .join("");

function box(across: number, along: number): string {
  const [x, y] = [round(across), round(along)];
  return `M${-x} ${-y}H${x}V${y}H${-x}Z`;
}
