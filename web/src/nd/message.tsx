import { useComputed } from "@preact/signals";
import { NOTICE_COLOUR } from "../store/notices";
import { type LayerProps, usePart } from "./layer";
import { Stroke } from "./stroke";
import { ink } from "./style";
import { placeAt, READOUTS } from "./view";

/** One line for the most urgent notice, an arrow when there are more. */
export function MessageLine({ shown }: LayerProps) {
  const notices = usePart(shown, (picture) => picture.notices);
  const first = useComputed(() => notices.value[0] ?? null);
  const text = useComputed(() => first.value?.text ?? "");
  const level = useComputed(() => first.value?.level ?? null);
  const more = useComputed(() => notices.value.length > 1);
  if (level.value === null) return null;
  const { x, y, width, height } = READOUTS.message;
  const isUrgent = level.value === "warning" || level.value === "caution";
  const flashing = isUrgent ? " nd-flash" : "";
  return (
    <g class={`nd-message${flashing}`} key={level.value} transform={placeAt({ x, y })}>
      <rect
        class="nd-ground nd-frame"
        width={width}
        height={height}
        stroke={ink(NOTICE_COLOUR[level.value])}
      />
      <text
        class="nd-text"
        x={width / 2}
        y={25}
        font-size={22}
        text-anchor="middle"
        fill={ink(NOTICE_COLOUR[level.value])}
      >
        {text}
      </text>
      {more.value && (
        <g transform={placeAt({ x: width - 18, y: 17 })}>
          <Stroke d="M0 -9V9M-6 3L0 9L6 3" line={{ colour: "value", width: 2.5, dash: "" }} />
        </g>
      )}
    </g>
  );
}
