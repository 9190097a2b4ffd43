/** Mouse, wheel and fingers on the map: the ground is moved, two fingers and the wheel zoom, a tap chooses. */

import { listen, spanOf } from "../../glass";
import type { Point } from "../../nd/view";
import { type MapView, pan, zoom } from "./view";

/** The wheel doubles the scale in so many of its units. */
const DOUBLE = 480;
/** A finger that moves less than this taps [px]. */
const TAP = 5;

/** Lets hands work on the glass; answers with what undoes that. `tap` is told where on the glass [px]. */
export function followGestures(
  glass: SVGSVGElement,
  view: MapView,
  tap: (at: Point) => void,
): () => void {
  const fingers = new Map<number, Point>();
  let moved = 0;

  const pointOf = (event: MouseEvent): Point => {
    const box = glass.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  };
  const middle = (): Point => {
    const all = [...fingers.values()];
    const mean = (part: (point: Point) => number) =>
      all.reduce((sum, each) => sum + part(each), 0) / Math.max(1, all.length);
    return { x: mean(({ x }) => x), y: mean(({ y }) => y) };
  };

  const down = (event: PointerEvent) => {
    if (event.button !== 0) return;
    fingers.set(event.pointerId, pointOf(event));
    glass.setPointerCapture(event.pointerId);
    moved = fingers.size === 1 ? 0 : TAP;
  };
  const move = (event: PointerEvent) => {
    const before = fingers.get(event.pointerId);
    if (before === undefined) return;
    const [apart, from] = [spanOf(fingers), middle()];
    const point = pointOf(event);
    fingers.set(event.pointerId, point);
    moved += Math.hypot(point.x - before.x, point.y - before.y);
    if (moved < TAP) return;
    const to = middle();
    pan(view, to.x - from.x, to.y - from.y);
    if (apart > 0) zoom(view, spanOf(fingers) / apart, to);
  };
  const up = (event: PointerEvent) => {
    if (fingers.delete(event.pointerId) && event.type === "pointerup" && moved < TAP)
      tap(pointOf(event));
  };
  const turn = (event: WheelEvent) => {
    event.preventDefault();
    zoom(view, 2 ** (-event.deltaY / DOUBLE), pointOf(event));
  };

  return listen(glass, {
    pointerdown: down,
    pointermove: move,
    pointerup: up,
    pointercancel: up,
    wheel: turn,
  });
}
