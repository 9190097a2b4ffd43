import { type ReadonlySignal, useComputed } from "@preact/signals";
import type { Colour } from "../store/colours";
import { ink } from "./style";

interface CellProps {
  readonly x: number;
  readonly y: number;
  readonly text: string | ReadonlySignal<string>;
  readonly colour: Colour | ReadonlySignal<Colour>;
  readonly size?: number | ReadonlySignal<number>;
  readonly anchor?: "start" | "middle" | "end";
}

/** One piece of text of a readout. */
export function Cell({ x, y, text, colour, size = 22, anchor = "start" }: CellProps) {
  const fill = useComputed(() => ink(typeof colour === "string" ? colour : colour.value));
  return (
    <text class="nd-text" x={x} y={y} font-size={size} text-anchor={anchor} fill={fill}>
      {text}
    </text>
  );
}
