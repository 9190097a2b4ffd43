/** Fingers and what else listens on a drawing. */

import type { Point } from "./nd/view";

/** Lets a drawing be listened to; answers with what undoes that. A listener may keep the page from scrolling. */
export function listen(
  glass: SVGSVGElement,
  listeners: Readonly<Record<string, (event: never) => void>>,
): () => void {
  const all = Object.entries(listeners) as [string, EventListener][];
  for (const [name, listener] of all) glass.addEventListener(name, listener, { passive: false });
  return () => {
    for (const [name, listener] of all) glass.removeEventListener(name, listener);
  };
}

/** How far two fingers are apart; 0 for fewer [px]. */
export function spanOf(fingers: ReadonlyMap<number, Point>): number {
  const [a, b] = [...fingers.values()];
  return a === undefined || b === undefined ? 0 : Math.hypot(a.x - b.x, a.y - b.y);
}
