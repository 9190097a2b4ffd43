/** The texts on the scene's picture, moved with each picture and kept apart five times a second. */

import { computed, type ReadonlySignal, type Signal, useComputed } from "@preact/signals";
import { useEffect, useMemo, useRef } from "preact/hooks";
import { LabelText } from "../nd/labelled";
import { type Label, type Placement, placeLabels } from "../nd/labels";
import { placeAt } from "../nd/view";
import type { Shown } from "../store/picture";
import type { Camera } from "./camera";
import { aroundTexts, northOf, type Size, TEXTS, textsOf } from "./texts";

const NO_LABELS: ReadonlyMap<string, Label> = new Map();
const ARROW = "M0 12V-12M-5 -5L0 -13L5 -5";
const CAPTION = "grid 5 NM · heights ×2 · aircraft ×80: not to scale";

interface Props {
  readonly shown: Shown;
  readonly camera: ReadonlySignal<Camera | null>;
  /** Of the glass: noted here. */
  readonly size: Signal<Size>;
}

export function Writing({ shown, camera, size }: Props) {
  const glass = useRef<SVGSVGElement>(null);
  useEffect(() => {
    const { current } = glass;
    if (current === null) return;
    const watch = new ResizeObserver(([entry]) => {
      if (entry !== undefined) size.value = entry.contentRect;
    });
    watch.observe(current);
    return () => watch.disconnect();
  }, [size]);
  const labels = useComputed(() => {
    if (camera.value === null) return NO_LABELS;
    const texts = textsOf(shown, camera.value, size.value);
    return new Map(texts.map((each) => [each.id, each] as const));
  });
  const placements = useMemo(() => {
    let before: ReadonlyMap<string, Placement> = new Map();
    return computed(() => {
      void shown.numbers.value.readAt;
      const seen = camera.peek();
      if (seen === null) return before;
      const around = aroundTexts(shown, seen, size.value);
      before = placeLabels([...labels.peek().values()], around, before);
      return before;
    });
  }, [shown, camera, labels, size]);
  const north = useComputed(() => {
    const angle = camera.value === null ? null : northOf(shown, camera.value, size.value);
    return angle === null ? "" : placeAt({ x: size.value.width - 24, y: 26 }, angle);
  });
  return (
    <svg ref={glass} class="nd scene-writing" aria-hidden="true">
      {TEXTS.map((id) => (
        <LabelText key={id} id={id} labels={labels} placements={placements} />
      ))}
      {north.value !== "" && (
        <>
          <g transform={north}>
            <path class="nd-stroke" d={ARROW} stroke="var(--scale)" stroke-width={1.75} />
            <text class="nd-text" y={-16} font-size={11} text-anchor="middle" fill="var(--scale)">
              N
            </text>
          </g>
          <text
            class="nd-text"
            x={8}
            y={size.value.height - 8}
            font-size={11}
            fill="var(--superseded)"
          >
            {CAPTION}
          </text>
        </>
      )}
    </svg>
  );
}
