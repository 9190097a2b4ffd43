import { useComputed } from "@preact/signals";
import { DEG } from "../units";
import { type LayerProps, usePart } from "./layer";
import { Stroke } from "./stroke";
import { ink, LINES } from "./style";
import { offNose, placeAt, polar, round } from "./view";

/** The arrow shows the turn of the next so many seconds. */
const ARROW_TIME = 10;
/** Length of its head [px]. */
const HEAD = 14;

/** What the crew selected, a hollow bug, or what guidance asks for, a pip: at that heading of the tape. */
export function CommandedHeading({ shown, view }: LayerProps) {
  const guided = usePart(shown, (picture) => picture.guided);
  const pip = useComputed(() => {
    const now = guided.value;
    if (now?.reference.kind !== "hold_heading") return "";
    const direction = offNose(now.pursuer, now.reference.heading_deg);
    const { layout } = view;
    return placeAt(polar(layout.value, direction, layout.value.tape), direction);
  });
  const isFlown = usePart(shown, (picture) => picture.guided?.engagement === "engaged");
  const isShown = useComputed(() => pip.value !== "");
  if (!isShown.value) return null;
  return (
    <g class="nd-commanded">
      {isFlown.value ? (
        <path class="nd-solid" d="M0 2L-11 -16H11Z" fill={ink("managed")} transform={pip} />
      ) : (
        <g class="nd-bug" transform={pip}>
          <Stroke d="M0 2L-12 -18H12Z" line={LINES.bug} />
        </g>
      )}
    </g>
  );
}

/** The turn that guidance asks for: a curved arrow along the tape. */
export function CommandedTurn({ shown, view }: LayerProps) {
  const guided = usePart(shown, (picture) => picture.guided);
  const arrow = useComputed(() => {
    const now = guided.value;
    if (now?.reference.kind !== "turn_rate") return "";
    const layout = view.layout.value;
    const sweep = now.reference.turn_rate_degps * ARROW_TIME;
    if (Math.abs(sweep) < 1) return "";
    const radius = layout.tape - 26;
    const [from, to] = [polar(layout, 0, radius), polar(layout, sweep, radius)];
    const side = Math.sign(sweep);
    const [outer, inner] = [polar(layout, sweep, radius + 9), polar(layout, sweep, radius - 9)];
    const tip = polar(layout, sweep + (side * HEAD) / DEG / radius, radius);
    return (
      `M${round(from.x)} ${round(from.y)}` +
      `A${radius} ${radius} 0 0 ${side > 0 ? 1 : 0} ${round(to.x)} ${round(to.y)}` +
      `M${round(outer.x)} ${round(outer.y)}L${round(tip.x)} ${round(tip.y)}` +
      `L${round(inner.x)} ${round(inner.y)}Z`
    );
  });
  return (
    <g class="nd-commanded">
      <Stroke d={arrow} line={LINES.turn} />
    </g>
  );
}
