import { Cell } from "./cell";
import { type LayerProps, usePart } from "./layer";
import { Stroke } from "./stroke";
import { LINES } from "./style";
import { type Layout, type Point, polar, round } from "./view";

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
              <RingLabel key={x} x={x} y={y} text={label} />
            ))}
        </g>
      ))}
      {valid.value && layout.mode === "ROSE" && (
        <RingLabel {...outerLabel(layout)} text={String(layout.range / 2)} />
      )}
    </g>
  );
}

/** Where the rings are labelled, a little inside each so that the dashes stay whole. */
export function ringLabelPoints(layout: Layout, radius: number) {
  return layout.ringLabels.map((direction) => polar(layout, direction, radius - 14));
}

/** The points of the compass on a map that has north up. */
export const LETTERS = { N: 0, E: 90, S: 180, W: 270 } as const;

/** Where such a letter stands, outside the outer ring. */
export function letterPoint(layout: Layout, direction: number): Point {
  return polar(layout, direction, (layout.rings[0]?.radius ?? 0) + 18);
}

function outerLabel(layout: Layout) {
  return polar(layout, layout.ringLabels[0] ?? 0, layout.tape - 16);
}

/** How far a ring is, its middle at a point. */
export function RingLabel({ x, y, text }: Point & { text: string }) {
  return <Cell x={round(x)} y={round(y + 6)} text={text} colour="unit" size={18} anchor="middle" />;
}

/** ARC rings end abeam: behind, there is no room for them. */
function ring(layout: Layout, radius: number): string {
  const half = `A${radius} ${radius} 0 0 1`;
  const [left, right] = [polar(layout, -90, radius), polar(layout, 90, radius)];
  const ahead = `M${round(left.x)} ${round(left.y)}${half} ${round(right.x)} ${round(right.y)}`;
  return layout.mode === "ARC" ? ahead : `${ahead}${half} ${round(left.x)} ${round(left.y)}`;
}
