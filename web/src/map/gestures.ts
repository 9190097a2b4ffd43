/** Fingers, mouse and wheel on the map: a handle is dragged, the ground is moved, two fingers zoom. */

import { listen, spanOf } from "../glass";
import type { Place, Point, View } from "../nd/view";
import { edit } from "./editing";
import { type Editor, pan, zoom } from "./editor";
import { dragHandle, type HandleName, handlePoint, handlesOf, keyHandle } from "./handles";
import { otherPart, removeOther } from "./other-handles";

/** Two fingers step to the next range when they have moved apart, or together, by so much. */
const PINCH = 1.3;
/** A handle is held from so far [px]. */
const REACH = 26;
/** Between two presses of a key that are two steps [ms]. */
const PAUSE = 1000;
/** So much of the wheel is one step. */
const NOTCH = 60;

interface Held {
  readonly name: HandleName | null;
  /** From the finger to what it holds [px]. */
  readonly offset: Point;
}

/** Lets hands work on the map's glass; answers with what undoes that. */
export function followGestures(glass: SVGSVGElement, map: Editor, view: View): () => void {
  const fingers = new Map<number, Point>();
  let held: Held | null = null;
  let apart = 0;
  let wheel = 0;
  /** Keys on one grip that follow each other at once are one step. */
  let pressed: { name: HandleName | null; at: number } = { name: null, at: 0 };

  const pointOf = (event: MouseEvent): Point => {
    const box = glass.getBoundingClientRect();
    const scale = 768 / box.width;
    return { x: (event.clientX - box.left) * scale, y: (event.clientY - box.top) * scale };
  };
  const middle = () => view.pose.peek() ?? { x_m: 0, y_m: 0, heading_deg: 0 };
  const placeOf = ({ x, y }: Point): Place => {
    const { centre, scale } = view.layout.peek();
    return {
      x_m: middle().x_m + (x - centre.x) / scale,
      y_m: middle().y_m - (y - centre.y) / scale,
    };
  };

  /** Of several handles under a finger, the one whose middle is nearest. */
  const nearest = (point: Point): HandleName | null => {
    const apart = (name: HandleName) => {
      const at = handlePoint(name, map.situation.peek(), view.layout.peek(), middle());
      return Math.hypot(at.x - point.x, at.y - point.y);
    };
    const [first] = [...handlesOf(map.situation.peek())].sort((a, b) => apart(a) - apart(b));
    return first !== undefined && apart(first) <= REACH ? first : null;
  };

  const down = (event: PointerEvent) => {
    if (event.button !== 0) return;
    const point = pointOf(event);
    fingers.set(event.pointerId, point);
    glass.setPointerCapture(event.pointerId);
    if (fingers.size === 2) {
      held = null;
      apart = spanOf(fingers);
      return;
    }
    const grip = nearest(point) ?? handleOf(event.target);
    if (grip === null) {
      held = { name: null, offset: { x: 0, y: 0 } };
      return;
    }
    const at = handlePoint(grip, map.situation.peek(), view.layout.peek(), middle());
    // The ring, or a cell's edge, is held where it is touched; all else keeps its distance from the finger.
    const isEdge = grip === "ring" || otherPart(grip)?.part === "cell-edge";
    const offset = isEdge ? { x: 0, y: 0 } : { x: at.x - point.x, y: at.y - point.y };
    held = { name: grip, offset };
    glass
      .querySelector<SVGGElement>(`.grip[data-handle="${grip}"]`)
      ?.focus({ preventScroll: true });
  };

  const move = (event: PointerEvent) => {
    const before = fingers.get(event.pointerId);
    if (before === undefined) return;
    const point = pointOf(event);
    fingers.set(event.pointerId, point);
    if (fingers.size === 2) {
      pinch();
      return;
    }
    if (held === null) return;
    const { name, offset } = held;
    if (name === null) {
      const { scale } = view.layout.peek();
      pan(map, (before.x - point.x) / scale, (point.y - before.y) / scale);
      return;
    }
    const to = { x: point.x + offset.x, y: point.y + offset.y };
    edit(map, (situation) => dragHandle(name, situation, placeOf(to), to), held);
  };

  const pinch = () => {
    const ratio = spanOf(fingers) / Math.max(1, apart);
    if (ratio < PINCH && ratio > 1 / PINCH) return;
    const [a, b] = [...fingers.values()];
    if (a === undefined || b === undefined) return;
    zoom(map, ratio > 1 ? -1 : 1, placeOf({ x: (a.x + b.x) / 2, y: (a.y + b.y) / 2 }));
    apart = spanOf(fingers);
  };

  const up = (event: PointerEvent) => {
    fingers.delete(event.pointerId);
    if (fingers.size === 0) held = null;
  };

  const turn = (event: WheelEvent) => {
    event.preventDefault();
    wheel += event.deltaY;
    if (Math.abs(wheel) < NOTCH) return;
    zoom(map, wheel > 0 ? 1 : -1, placeOf(pointOf(event)));
    wheel = 0;
  };

  const press = (event: KeyboardEvent) => {
    const grip = handleOf(event.target);
    if (grip === null || event.ctrlKey || event.altKey || event.metaKey) return;
    const other = otherPart(grip);
    const isRemoved = other !== null && (event.key === "Delete" || event.key === "Backspace");
    const next = isRemoved
      ? removeOther(other, map.situation.peek())
      : keyHandle(grip, map.situation.peek(), event.key, event.shiftKey);
    if (next === null) return;
    event.preventDefault();
    event.stopPropagation();
    if (pressed.name !== grip || event.timeStamp - pressed.at > PAUSE)
      pressed = { name: grip, at: 0 };
    pressed.at = event.timeStamp;
    edit(map, () => next, pressed);
  };

  return listen(glass, {
    pointerdown: down,
    pointermove: move,
    pointerup: up,
    pointercancel: up,
    wheel: turn,
    keydown: press,
  });
}

function handleOf(target: EventTarget | null): HandleName | null {
  if (!(target instanceof Element)) return null;
  const handle = target.closest("[data-handle]")?.getAttribute("data-handle") ?? null;
  return handle as HandleName | null;
}
