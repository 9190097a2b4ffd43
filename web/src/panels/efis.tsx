/** The ND's own controls, as on an EFIS panel: mode and range. */

import { showAll, step, zoom } from "../map/editor";
import { Choice } from "../parts";
import { ND_RANGES, type Session } from "../session";

export function Efis(props: { session: Session }) {
  const { ndMode, ndRange, ndAuto } = props.session;
  return (
    <div class="efis">
      <span class="efis-label" aria-hidden="true">
        ND
      </span>
      <Choice
        label="Mode of the navigation display"
        options={["ROSE", "ARC", "PLAN"]}
        chosen={ndMode.value}
        choose={(mode) => {
          ndMode.value = mode;
        }}
      />
      <span class="efis-label efis-range" aria-hidden="true">
        RANGE
      </span>
      {ndMode.value === "PLAN" ? (
        <MapRange session={props.session} />
      ) : (
        <Choice
          kind="ranges"
          label="Range of the navigation display in nautical miles; AUTO fits it to the path"
          options={["AUTO", ...ND_RANGES]}
          chosen={ndAuto.value ? "AUTO" : ndRange.value}
          current={ndRange.value}
          choose={(choice) => {
            ndAuto.value = choice === "AUTO";
            if (choice !== "AUTO") ndRange.value = choice;
          }}
        />
      )}
      <span class="efis-unit" aria-hidden="true">
        NM
      </span>
    </div>
  );
}

/** The map's: how much of it is seen, and whether the area under it. */
function MapRange(props: { session: Session }) {
  const { map } = props.session;
  return (
    <div class="choice map-view">
      <button
        type="button"
        aria-pressed={map.hasArea.value}
        onClick={() => {
          map.hasArea.value = !map.hasArea.value;
        }}
      >
        AREA
      </button>
      <button type="button" onClick={() => showAll(map)}>
        FIT
      </button>
      <button type="button" aria-label="Range inward" onClick={() => zoom(map, -1)}>
        −
      </button>
      <output class="map-range">{map.range.value}</output>
      <button type="button" aria-label="Range outward" onClick={() => zoom(map, 1)}>
        +
      </button>
      <button
        type="button"
        aria-label="Undo"
        title="Undo (Ctrl-Z)"
        disabled={map.steps.past.value.length === 0}
        onClick={() => step(map, -1)}
      >
        ↶
      </button>
      <button
        type="button"
        aria-label="Redo"
        title="Redo (Ctrl-Shift-Z)"
        disabled={map.steps.future.value.length === 0}
        onClick={() => step(map, 1)}
      >
        ↷
      </button>
    </div>
  );
}
