import { useComputed } from "@preact/signals";
import { type LayerProps, usePart } from "./layer";
import { pathData } from "./path";
import { Stroke } from "./stroke";
import { LINES } from "./style";

/** What planners that are compared would fly: thin and dotted, the chosen one broad, one that may not be flown broken. */
export function Rivals({ shown, view }: LayerProps) {
  const wind = usePart(shown, (picture) => picture.wind);
  const drawn = useComputed(() =>
    shown.rivals.value.map(({ planner, segments, isFlyable, isChosen }) => {
      const { width, dash } = isChosen ? LINES.rival : LINES.ghost;
      return {
        planner,
        d: pathData(view.layout.value, segments, wind.value),
        line: { colour: isFlyable ? LINES.rival.colour : ("caution" as const), width, dash },
      };
    }),
  );
  if (drawn.value.length === 0) return null;
  return (
    <g class="nd-rivals">
      {drawn.value.map(({ planner, d, line }) => (
        <Stroke key={planner} d={d} line={line} />
      ))}
    </g>
  );
}
