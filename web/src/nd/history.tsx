import { useComputed } from "@preact/signals";
import { type LayerProps, usePart } from "./layer";
import { ink } from "./style";
import { toMap } from "./view";

/** Dots are kept for five minutes, and are fainter by the minute. */
const MINUTES = 5;
/** Dots stand at least this far apart, so that they never look like a line, which would be the future [px]. */
const APART = 9;
/** One point of the trail each so many seconds. */
const PERIOD = 10;

/** Where the leader has been, one dot each 10 s: the path to follow. */
export function LeaderHistory({ shown, view }: LayerProps) {
  return (
    <g class="nd-history">
      {Array.from({ length: MINUTES }, (_, minute) => (
        <Minute key={minute} shown={shown} view={view} minute={minute} />
      ))}
    </g>
  );
}

function Minute({ shown, view, minute }: LayerProps & { minute: number }) {
  const points = usePart(shown, (picture) => picture.trail);
  // Whole knots: a stride that trembled would make the dots dance.
  const speed = usePart(shown, ({ now }) => Math.round(now?.leader.ground_speed_mps ?? 0));
  const d = useComputed(() => {
    const trail = points.value;
    const newest = trail.at(-1)?.t;
    if (newest === undefined) return "";
    const layout = view.layout.value;
    const stride = Math.ceil(APART / Math.max(1, speed.value * PERIOD * layout.scale));
    return trail
      .filter(({ t }) => t > newest - 60 * (minute + 1) && t <= newest - 60 * minute)
      .filter(({ t }) => Math.round(t / PERIOD) % stride === 0)
      .map(({ x, y }) => toMap(layout, { x_m: x, y_m: y }))
      .map(({ x, y }) => `M${x.toFixed(1)} ${y.toFixed(1)}h0`)
      .join("");
  });
  return (
    <path
      class="nd-stroke"
      d={d}
      opacity={1 - minute * 0.17}
      stroke={ink("leader")}
      stroke-linecap="round"
      stroke-width={3.5}
    />
  );
}
