/** The gallery: twelve situations, each as the display draws it. */

import { computed } from "@preact/signals";
import { useMemo } from "preact/hooks";
import { MAP_LAYERS } from "../nd/nd";
import { Panel } from "../parts";
import type { Session } from "../session";
import { putSituation } from "./editing";
import { frameOf } from "./editor";
import { entryOf } from "./gallery";
import { mapView } from "./map";
import { OwnShipThere } from "./symbols";
import type { Thumb } from "./thumbs";

/** The part of the glass that a picture shows [px]: symbols are large in it. */
const SEEN = 300;
const CORNER = (768 - SEEN) / 2;

export function Gallery({ session }: { session: Session }) {
  const { map, scenarios } = session;
  const here = entryOf(map.reading.situation.value)?.name;
  return (
    <Panel name="gallery" title="Situations to begin with">
      <ul class="thumbs">
        {map.thumbs.value.map((thumb) => {
          const { name, title, what, situation, scenario } = thumb.entry;
          const info = scenarios.value.find((each) => each.name === scenario);
          return (
            <li key={name}>
              <button
                type="button"
                aria-pressed={here === name}
                title={info?.available === false ? `${what} ${info.message}` : what}
                onClick={() => putSituation(map, situation)}
              >
                <ThumbPicture thumb={thumb} />
                <span>{title}</span>
              </button>
            </li>
          );
        })}
      </ul>
    </Panel>
  );
}

function ThumbPicture({ thumb: { shown } }: { thumb: Thumb }) {
  const view = useMemo(() => {
    const frame = computed(() => {
      const { now, places } = shown.picture.value;
      const all = now === null ? [] : [now.pursuer, now.slot, ...places];
      return all.length === 0 ? { centre: { x_m: 0, y_m: 0 }, range: 40 } : frameOf(all);
    });
    const range = computed(() => (frame.value.range * 768) / SEEN);
    const centre = computed(() => frame.value.centre);
    return mapView({ shown, range, centre });
  }, [shown]);
  return (
    <svg
      class="nd"
      viewBox={`${CORNER} ${CORNER} ${SEEN} ${SEEN}`}
      aria-hidden="true"
      focusable="false"
    >
      <g class="nd-map" transform={view.mapTransform}>
        {MAP_LAYERS.map((Layer) => (
          <Layer key={Layer.name} shown={shown} view={view} />
        ))}
        <OwnShipThere shown={shown} view={view} />
      </g>
    </svg>
  );
}
