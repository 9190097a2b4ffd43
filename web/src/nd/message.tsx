import { type ReadonlySignal, useComputed } from "@preact/signals";
import type { ComponentChildren } from "preact";
import type { Colour } from "../store/colours";
import { NOTICE_COLOUR } from "../store/notices";
import { Cell } from "./cell";
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
  const isUrgent = level.value === "warning" || level.value === "caution";
  const flashing = isUrgent ? " nd-flash" : "";
  return (
    <g class={`nd-message${flashing}`} key={level.value}>
      <MessageBox text={text} colour={NOTICE_COLOUR[level.value]}>
        {more.value && (
          <g transform={placeAt({ x: READOUTS.message.width - 18, y: 17 })}>
            <Stroke d="M0 -9V9M-6 3L0 9L6 3" line={{ colour: "value", width: 2.5, dash: "" }} />
          </g>
        )}
      </MessageBox>
    </g>
  );
}

/** A text in the frame that messages have, at the foot of the glass. */
export function MessageBox(props: {
  text: string | ReadonlySignal<string>;
  colour: Colour;
  children?: ComponentChildren;
}) {
  const { x, y, width, height } = READOUTS.message;
  const { text, colour } = props;
  return (
    <g transform={placeAt({ x, y })}>
      <rect class="nd-ground nd-frame" width={width} height={height} stroke={ink(colour)} />
      <Cell x={width / 2} y={25} text={text} colour={colour} anchor="middle" />
      {props.children}
    </g>
  );
}
