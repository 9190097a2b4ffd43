/** PLAN: the map, north up, where a situation is laid out and its plan follows the hand. */

import { computed, type ReadonlySignal, signal, useComputed } from "@preact/signals";
import { useEffect, useMemo, useRef } from "preact/hooks";
import { Labels } from "../nd/labelled";
import { MAP_LAYERS } from "../nd/nd";
import { createView, type DisplayMode, type Place, type Pose, SIZE, type View } from "../nd/view";
import { AreaLayer, areaLabels } from "./area";
import { Compass } from "./compass";
import type { Editor } from "./editor";
import { followGestures } from "./gestures";
import { Grips } from "./grips";
import { nearestLabels, OthersLayer } from "./others-layer";
import { AreaEnd, MapMessage, OwnShipThere, WindDial } from "./symbols";
import "./map.css";
import "./bench.css";

const PLAN = signal<DisplayMode>("PLAN");

/** The projection of a map: its centre in the middle, north up. */
export function mapView(
  map: Pick<Editor, "shown"> &
    Partial<Pick<Editor, "area" | "hasArea">> & {
      readonly range: ReadonlySignal<number>;
      readonly centre: ReadonlySignal<Place>;
    },
): View & { readonly pose: ReadonlySignal<Pose> } {
  const middle = computed(() => ({ ...map.centre.value, heading_deg: 0 }));
  // Labels find their places anew with each answer: there is no other pace on a map that stands still.
  let answers = 0;
  const beat = computed(() => {
    const { proposed, traffic, cells, state } = map.shown.picture.value;
    void [proposed, traffic.length, cells.length, state];
    void [map.range.value, map.area?.value, map.hasArea?.value];
    answers += 1;
    return String(answers);
  });
  return { ...createView(map.shown, PLAN, map.range, middle), pose: middle, beat };
}

export function PlanMap({ map }: { map: Editor }) {
  const view = useMemo(() => mapView(map), [map]);
  const label = useComputed(
    () => `Map, north up, ring at ${map.range.value} nautical miles. ${map.shown.words.value}`,
  );
  const more = useComputed(() => {
    const { labels, points } = areaLabels(map, view);
    return { points, labels: [...nearestLabels(map, view), ...labels] };
  });
  const glass = useRef<SVGSVGElement>(null);
  useEffect(() => {
    const { current } = glass;
    if (current !== null) return followGestures(current, map, view);
  }, [map, view]);
  return (
    <div class={`plan-glass ${map.isLate.value ? "is-late" : ""}`}>
      <svg
        class="nd plan-ground"
        viewBox={`0 0 ${SIZE} ${SIZE}`}
        aria-hidden="true"
        focusable="false"
      >
        <g class="nd-map" transform={view.mapTransform}>
          {map.hasArea.value && <AreaLayer map={map} view={view} />}
        </g>
      </svg>
      <svg
        ref={glass}
        class="nd plan-map"
        viewBox={`0 0 ${SIZE} ${SIZE}`}
        role="application"
        aria-label="Map: Tab to what can be moved, arrow keys move it"
      >
        <svg width={SIZE} height={SIZE} role="img" aria-label={label}>
          <Compass shown={map.shown} view={view} />
          <g class="nd-map" transform={view.mapTransform}>
            {MAP_LAYERS.map((Layer) => (
              <Layer key={Layer.name} shown={map.shown} view={view} />
            ))}
            <OthersLayer map={map} view={view} />
            <OwnShipThere shown={map.shown} view={view} />
          </g>
          <Labels shown={map.shown} view={view} more={more} />
          <WindDial map={map} />
          <AreaEnd map={map} />
          <MapMessage map={map} />
        </svg>
        <Grips map={map} view={view} />
      </svg>
    </div>
  );
}
