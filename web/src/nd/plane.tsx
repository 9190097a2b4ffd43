import { effect } from "@preact/signals";
import type { ComponentChildren } from "preact";
import { useLayoutEffect, useRef } from "preact/hooks";
import type { LayerProps } from "./layer";
import { type Carrier, carry, SIZE } from "./view";

/**
 * One sheet of the glass. Between two pictures it is carried on as a whole, by a transform of the page:
 * inside a drawing each one would make the browser lay the drawing out anew.
 */
export function Plane({
  shown,
  view,
  by,
  children,
}: LayerProps & { by: Carrier; children: ComponentChildren }) {
  const sheet = useRef<SVGSVGElement>(null);
  // At once, with the picture that it carries: not after the next frame, as effects of components are.
  useLayoutEffect(() => {
    const { current } = sheet;
    if (by === "glass" || current === null) return;
    const { style } = current;
    return effect(() => {
      const { value: layout } = view.layout;
      const { x, y } = layout.centre;
      style.transformOrigin = `${(100 * x) / SIZE}% ${(100 * y) / SIZE}%`;
      style.transform = carry(layout, view.pose.value?.heading_deg ?? 0, shown.moved.value, by);
    });
  }, [shown, view, by]);
  return (
    <svg ref={sheet} class="nd-plane" viewBox={`0 0 ${SIZE} ${SIZE}`} aria-hidden="true">
      {children}
    </svg>
  );
}
