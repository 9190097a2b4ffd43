/** All that is written on the map: no text over another, each tied to what it belongs to. */

import { useRef } from "preact/hooks";
import { type Label, LINE_HEIGHT, type Placement, placeLabels } from "../../nd/labels";
import { ink } from "../../nd/style";
import { type Point, within } from "../../nd/view";
import { straightOn } from "../closest";
import type { Station } from "../station";
import { aircraftLabels, VECTOR } from "./aircraft";
import { airspaceLabels } from "./ground";
import { pairLabel } from "./pair";
import { joinLabel, routePoints } from "./routes";
import { glassOf, toPoint, typeOf } from "./view";

/** Half of an aircraft's symbol [px]: no text over it. */
const SYMBOL = 9;

/** The buttons in the upper right corner of the map [px]. */
const BUTTONS = { width: 112, height: 44 } as const;

export function Labels({ station }: { station: Station }) {
  const before = useRef<Placed>({ key: "", places: new Map() });
  const { view, store } = station;
  const [chosen, ...others] = aircraftLabels(station);
  const labels = [chosen, pairLabel(station), joinLabel(station), ...others]
    .concat(airspaceLabels(station))
    .filter((each) => each !== null && each !== undefined);
  // where the ground is only moved, labels keep their places beside what they belong to
  const { scale, size } = view;
  const key = JSON.stringify([store.sky.value.t, scale.value, size.value, labels.map(textOf)]);
  if (key !== before.current.key)
    before.current = { key, places: placesOf(station, labels, before.current.places) };
  const placed = before.current.places;
  return (
    <g class="atc-labels" font-size={typeOf(view)}>
      {labels.map((label) => {
        const place = placed.get(label.id);
        return place === undefined ? null : <Written key={label.id} label={label} place={place} />;
      })}
    </g>
  );
}

interface Placed {
  readonly key: string;
  readonly places: ReadonlyMap<string, Placement>;
}

function textOf({ id, lines }: Label): string {
  return [id, ...lines.map(({ text }) => text)].join(" ");
}

function placesOf(
  station: Station,
  labels: readonly Label[],
  before: ReadonlyMap<string, Placement>,
): ReadonlyMap<string, Placement> {
  const { view, store } = station;
  const glass = glassOf(view);
  const { aircraft } = store.sky.value;
  const symbols = aircraft.map((each) => {
    const { x, y } = toPoint(view, each);
    return { x: x - SYMBOL, y: y - SYMBOL, width: 2 * SYMBOL, height: 2 * SYMBOL };
  });
  const vectors = aircraft.map((each) => toPoint(view, straightOn(each, VECTOR / 2)));
  const around = {
    isSeen: (point: Point) => within(glass, point),
    boxes: [...symbols, { x: glass.width - BUTTONS.width, y: 0, ...BUTTONS }],
    points: [...vectors, ...routePoints(station)],
  };
  return placeLabels(labels, around, before);
}

function Written({ label, place }: { label: Label; place: Placement }) {
  const { box } = place;
  const edge = {
    x: Math.min(Math.max(0, box.x), box.x + box.width),
    y: Math.min(Math.max(0, box.y), box.y + box.height),
  };
  return (
    <g transform={`translate(${label.at.x.toFixed(1)} ${label.at.y.toFixed(1)})`}>
      <path class="tie" d={`M0 0L${edge.x.toFixed(1)} ${edge.y.toFixed(1)}`} />
      <text data-label={label.id}>
        {label.lines.map(({ text, colour }, k) => (
          <tspan
            key={text}
            x={box.x.toFixed(1)}
            y={(box.y + (k + 0.82) * label.size * LINE_HEIGHT).toFixed(1)}
            fill={ink(colour)}
          >
            {text}
          </tspan>
        ))}
      </text>
    </g>
  );
}
