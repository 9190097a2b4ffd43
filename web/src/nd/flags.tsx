import type { Colour } from "../store/colours";
import { Cell } from "./cell";
import { type LayerProps, usePart } from "./layer";
import { flagPoint } from "./view";

/** What is missing, in large letters over the map. */
export function Flags({ shown, view }: LayerProps) {
  const flag = usePart(shown, (picture) => picture.flag);
  const layout = view.layout.value;
  if (flag.value === "") return null;
  const map = flag.value === "MAP NOT AVAIL";
  const { x, y } = flagPoint(layout, map);
  const colour: Colour = map ? "alert" : "caution";
  return (
    <g class="nd-flag nd-flash" key={flag.value}>
      <Cell x={x} y={y} text={flag.value} colour={colour} size={30} anchor="middle" />
    </g>
  );
}
