import { type LayerProps, usePart } from "./layer";
import { Stroke } from "./stroke";
import { ink, LINES } from "./style";
import { type Layout, polar, round } from "./view";

/** The range rings and what they say. */
export function RangeRings({ shown, view }: LayerProps) {
  const valid = usePart(shown, ({ now }) => now !== null);
  const layout = view.layout.value;
  return (
    <g class="nd-rings">
      {layout.rings.map(({ radius, label }) => (
        <g key={radius}>
          <Stroke d={ring(layout, radius)} line={LINES.ring} />
          {valid.value &&
            ringLabelPoints(layout, radius).map(({ x, y }) => (
              <text
                key={x}
                class="nd-text"
                fill={ink("unit")}
                font-size={18}
                text-anchor="middle"
                x={round(x)}
                y={round(y + 6)}
              >
                {label}
              </text>
            ))}
        </g>
      ))}
      {valid.value && layout.mode === "ROSE" && (
        <text
          class="nd-text"
          fill={ink("unit")}
          font-size={18}
          text-anchor="middle"
          {...outerLabel(layout)}
        >
          {layout.range / 2}
        </text>
      )}
    </g>
  );
}

/** Where the rings are labelled, a little inside each so that the dashes stay whole. */
export function ringLabelPoints(layout: Layout, radius: number) {
  return layout.ringLabels.map((direction) => polar(layout, direction, radius - 14));
}

function outerLabel(layout: Layout) {
  const { x, y } = polar(layout, layout.ringLabels[0] ?? 0, layout.tape - 16);
  return { x: round(x), y: round(y + 6) };
}

/** ARC rings end abeam: behind, there is no room for them. */
function ring(layout: Layout, radius: number): string {
  const half = `A${radius} ${radius} 0 0 1`;
  const [left, right] = [polar(layout, -90, radius), polar(layout, 90, radius)];
  const ahead = `M${round(left.x)} ${round(left.y)}${half} ${round(right.x)} ${round(right.y)}`;
  return layout.mode === "ARC" ? ahead : `${ahead}${half} ${round(left.x)} ${round(left.y)}`;
}
