import type { ReadonlySignal } from "@preact/signals";
import { ink, type Line } from "./style";

/** A line with a dark one under it, so that it reads on anything it crosses. */
export function Stroke({ d, line }: { d: string | ReadonlySignal<string>; line: Line }) {
  return (
    <>
      <path class="nd-halo" d={d} stroke-width={line.width + 3} stroke-dasharray={line.dash} />
      <path
        class="nd-stroke"
        d={d}
        stroke={ink(line.colour)}
        stroke-width={line.width}
        stroke-dasharray={line.dash}
      />
    </>
  );
}
