/** The texts on the scene's picture, moved with each picture and kept apart five times a second. */

import {
  computed,
  effect,
  type ReadonlySignal,
  type Signal,
  useComputed,
  useSignal,
} from "@preact/signals";
import { useEffect, useLayoutEffect, useMemo, useRef } from "preact/hooks";
import { LabelSheet } from "../nd/labelled";
import { type Label, type Placement, placeLabels } from "../nd/labels";
import { ink } from "../nd/style";
import { NOTICE_COLOUR } from "../store/notices";
import type { Shown } from "../store/shown";
import { ALTITUDE_SCALE, type Camera, enlargement } from "./camera";
import type { Size } from "./glass";
import { aroundTexts, northOf, TEXTS, textsAbout, textsOf, warningOf } from "./texts";

const NO_LABELS: ReadonlyMap<string, Label> = new Map();
const ARROW = "M0 12V-12M-5 -5L0 -13L5 -5";

interface Props {
  readonly shown: Shown;
  readonly camera: ReadonlySignal<Camera | null>;
  /** Of the glass: noted here. */
  readonly size: Signal<Size>;
}

export function Writing({ shown, camera, size }: Props) {
  const glass = useRef<HTMLDivElement>(null);
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
  const settled = useSettled(camera);
  const placements = useMemo(() => {
    let before: ReadonlyMap<string, Placement> = new Map();
    return computed(() => {
      void shown.numbers.value.readAt;
      void settled.value;
      const seen = camera.peek();
      if (seen === null) return before;
      const around = aroundTexts(shown, seen, size.value);
      before = placeLabels([...labels.peek().values()], around, before);
      return before;
    });
  }, [shown, camera, labels, size, settled]);
  const enlarged = useComputed(() => enlargement(shown.picture.value.now?.separation_m ?? 0));
  const about = useComputed(() => textsAbout(shown.picture.value).join("\n"));
  const hasNorth = useComputed(
    () => camera.value !== null && northOf(shown, camera.value, size.value) !== null,
  );
  return (
    <div ref={glass} class="nd nd-display scene-writing" aria-hidden="true">
      {[...TEXTS, ...about.value.split("\n").filter(Boolean)].map((id) => (
        <LabelSheet key={id} id={id} labels={labels} placements={placements} />
      ))}
      <Warning shown={shown} />
      {hasNorth.value && (
        <>
          <North shown={shown} camera={camera} size={size} />
          <p class="scene-caption">
            {`grid 5 NM · heights ×${ALTITUDE_SCALE} · aircraft ×${enlarged.value}`}
          </p>
        </>
      )}
    </div>
  );
}

/** A camera stands still for so long before the texts are placed anew, though no number has changed [ms]. */
const SETTLED = 120;

/** Counts how often a camera has come to rest. */
function useSettled(camera: ReadonlySignal<Camera | null>): ReadonlySignal<number> {
  const count = useSignal(0);
  useEffect(() => {
    let timer: ReturnType<typeof setTimeout> | undefined;
    const stop = effect(() => {
      void camera.value;
      clearTimeout(timer);
      timer = setTimeout(() => {
        count.value += 1;
      }, SETTLED);
    });
    return () => {
      clearTimeout(timer);
      stop();
    };
  }, [camera, count]);
  return count;
}

/** What must not be missed, over the picture. */
function Warning({ shown }: { shown: Shown }) {
  const notice = useComputed(() => warningOf(shown.picture.value));
  if (notice.value === null) return null;
  const { text, level } = notice.value;
  return (
    <p class="scene-warning" style={{ color: ink(NOTICE_COLOUR[level]) }}>
      {text}
    </p>
  );
}

/** Where north is in the picture, in its upper right corner. */
function North({ shown, camera, size }: Props) {
  const sheet = useRef<SVGSVGElement>(null);
  useLayoutEffect(() => {
    const { current } = sheet;
    if (current === null) return;
    return effect(() => {
      const angle = camera.value === null ? null : northOf(shown, camera.value, size.value);
      current.style.transform = `rotate(${Math.round(10 * (angle ?? 0)) / 10}deg)`;
    });
  }, [shown, camera, size]);
  return (
    <svg ref={sheet} class="scene-north" viewBox="-24 -26 48 52" aria-hidden="true">
      <path class="nd-stroke" d={ARROW} stroke="var(--scale)" stroke-width={1.75} />
      <text class="nd-text" y={-16} font-size={11} text-anchor="middle" fill="var(--scale)">
        N
      </text>
    </svg>
  );
}
