/** What is under the pointer on the display, in the words of Help; a tap says it as well. */

import { useSignal } from "@preact/signals";
import type { ComponentChildren } from "preact";
import { useEffect, useRef } from "preact/hooks";
import type * as Words from "../words";

/** Thin lines are found so far beside the pointer [px]. */
const NEAR = [
  [0, 0],
  [5, 0],
  [-5, 0],
  [0, 5],
  [0, -5],
] as const;

interface Caption {
  readonly element: Words.Element;
  readonly x: number;
  readonly y: number;
}

export function Captioned(props: { children: ComponentChildren }) {
  const glass = useRef<HTMLDivElement>(null);
  const caption = useSignal<Caption | null>(null);
  useEffect(() => {
    const { current } = glass;
    if (current === null) return;
    const clear = () => {
      caption.value = null;
    };
    let words: typeof Words | null = null; // fetched when they are first wanted
    const say = (event: PointerEvent) => {
      if (words === null) {
        void import("../words").then((fetched) => {
          words = fetched;
        });
        return;
      }
      // What is dragged is known already.
      if (event.type === "pointermove" && event.buttons !== 0) {
        clear();
        return;
      }
      const box = current.getBoundingClientRect();
      const element = elementAt(words, event.clientX, event.clientY);
      const [x, y] = [event.clientX - box.left, event.clientY - box.top];
      caption.value =
        element === null
          ? null
          : { element, x: Math.min(x, box.width - 200), y: y > box.height - 90 ? y - 84 : y + 18 };
    };
    current.addEventListener("pointermove", say);
    current.addEventListener("pointerdown", say);
    current.addEventListener("pointerleave", clear);
    return () => {
      current.removeEventListener("pointermove", say);
      current.removeEventListener("pointerdown", say);
      current.removeEventListener("pointerleave", clear);
    };
  }, [caption]);
  const shown = caption.value;
  return (
    <div class="glass" ref={glass}>
      {props.children}
      {shown !== null && (
        <p class="caption-box" style={{ left: `${shown.x}px`, top: `${shown.y}px` }}>
          <b>{shown.element.title}</b> {shown.element.what}
        </p>
      )}
    </div>
  );
}

/** The element nearest to a point of the page: the one drawn on top, if several are near. */
function elementAt(
  { ELEMENTS, elementOf }: typeof Words,
  x: number,
  y: number,
): Words.Element | null {
  let best: Words.Element | null = null;
  for (const [dx, dy] of NEAR) {
    const mark = document.elementFromPoint(x + dx, y + dy);
    const found = mark === null ? null : elementOf(mark);
    if (found !== null && (best === null || ELEMENTS.indexOf(found) < ELEMENTS.indexOf(best)))
      best = found;
  }
  return best;
}
