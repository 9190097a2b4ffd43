import { type ReadonlySignal, signal } from "@preact/signals";
import type { ComponentChildren } from "preact";
import { useLayoutEffect, useMemo, useRef } from "preact/hooks";
import type { Attitude } from "./attitude";
import { across, down, FACE, MIDDLE } from "./face";
import type { Gauge } from "./gauge";

export interface PartProps {
  readonly gauge: Gauge;
}

interface Box {
  readonly x: number;
  readonly y: number;
  readonly width: number;
  readonly height: number;
}

interface SheetProps extends PartProps {
  /** The transform of the page that carries it in each frame; lengths in parts of the face. */
  readonly move: (attitude: Attitude) => string;
  readonly name?: string;
  readonly children: ComponentChildren;
}

/** One sheet of the face, carried as a whole: nothing in it is laid out anew. */
export function Sheet({ gauge, move, name = "", children }: SheetProps) {
  const sheet = useRef<SVGSVGElement>(null);
  useLayoutEffect(() => {
    const { current } = sheet;
    if (current === null) return;
    const { style } = current;
    style.transformOrigin = `${across(MIDDLE.x)} ${down(MIDDLE.y)}`;
    let last = "";
    return gauge.add((attitude) => {
      const next = move(attitude);
      if (next !== last) style.transform = next;
      last = next;
    });
  }, [gauge, move]);
  return (
    <svg
      ref={sheet}
      class={`pfd-sheet ${name}`}
      aria-hidden="true"
      viewBox={`0 0 ${FACE.width} ${FACE.height}`}
    >
      {children}
    </svg>
  );
}

/** What stands still on the face. */
export function Still(props: { readonly name?: string; readonly children: ComponentChildren }) {
  const { name = "", children } = props;
  return (
    <svg
      class={`pfd-sheet ${name}`}
      aria-hidden="true"
      viewBox={`0 0 ${FACE.width} ${FACE.height}`}
    >
      {children}
    </svg>
  );
}

/** What is seen of some sheets: they are cut to a box, whose corners may be round. */
export function Window(props: {
  readonly box: Box & { readonly round?: number };
  readonly children: ComponentChildren;
}) {
  const { x, y, width, height, round = 0 } = props.box;
  const [right, bottom] = [FACE.width - x - width, FACE.height - y - height];
  const corner = round === 0 ? "" : ` round ${across(round)} / ${down(round)}`;
  const cut = `inset(${down(y)} ${across(right)} ${down(bottom)} ${across(x)}${corner})`;
  return (
    <div class="pfd-sheet" style={{ clipPath: cut }}>
      {props.children}
    </div>
  );
}

/** A text or number that follows the attitude: what it is bound to changes only when it reads otherwise. */
export function useReading<T>(gauge: Gauge, read: (attitude: Attitude) => T, first: T) {
  const reading = useMemo(() => signal(first), []);
  useLayoutEffect(
    () =>
      gauge.add((attitude) => {
        reading.value = read(attitude);
      }),
    [gauge, read, reading],
  );
  return reading as ReadonlySignal<T>;
}
