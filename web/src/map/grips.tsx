/** The handles on the glass: what a finger or the keyboard takes hold of. */

import { useComputed } from "@preact/signals";
import type { LayerProps } from "../nd/layer";
import { ink } from "../nd/style";
import { type Point, placeAt, project, round } from "../nd/view";
import type { Colour } from "../store/colours";
import type { Editor } from "./editor";
import { type HandleName, handlePoint, handlesOf } from "./handles";
import { type OtherHandle, otherPart } from "./other-handles";
import { sayHandle } from "./say-handle";
import { firstTurn } from "./turn-handles";

/** What may be touched: 24 px of the page and more, however small the glass. */
const TOUCH = 26;
const KNOB = 9;

const COLOURS = {
  ring: "label",
  slot: "selected",
  leader: "leader",
  "leader-heading": "leader",
  turn: "leader",
  "turn-heading": "leader",
  own: "ownship",
  "own-heading": "ownship",
  wind: "value",
} as const satisfies Record<Exclude<HandleName, OtherHandle>, string>;

function colourOf(name: HandleName): Colour {
  if (name in COLOURS) return COLOURS[name as keyof typeof COLOURS];
  return "leader";
}

/** What the knob of a heading stands before. */
const OWNERS: Partial<Record<HandleName, HandleName>> = {
  "own-heading": "own",
  "leader-heading": "leader",
  "turn-heading": "turn",
};

function ownerOf(name: HandleName): HandleName | undefined {
  const other = otherPart(name);
  if (other?.part === "traffic-heading") return `traffic/${other.number}`;
  return OWNERS[name];
}

/** Those that are symbols already need no knob. */
const BARE: readonly HandleName[] = ["own", "leader", "slot"];

function isBare(name: HandleName): boolean {
  return BARE.includes(name) || otherPart(name)?.part === "traffic";
}

export function Grips({ map, view }: { map: Editor; view: LayerProps["view"] }) {
  const names = useComputed(() => handlesOf(map.situation.value));
  return (
    <g class="grips">
      <RingTouch map={map} view={view} />
      {names.value.map((name) => (
        <Grip key={name} map={map} view={view} name={name} />
      ))}
    </g>
  );
}

interface GripProps {
  readonly map: Editor;
  readonly view: LayerProps["view"];
  readonly name: HandleName;
}

function Grip({ map, view, name }: GripProps) {
  const point = useComputed<Point>(() => {
    const middle = view.pose.value ?? { x_m: 0, y_m: 0, heading_deg: 0 };
    return handlePoint(name, map.situation.value, view.layout.value, middle);
  });
  const place = useComputed(() => placeAt(point.value));
  const stick = useComputed(() => {
    const owner = ownerOf(name);
    if (owner === undefined) return "";
    const middle = view.pose.value ?? { x_m: 0, y_m: 0, heading_deg: 0 };
    const { value } = map.situation;
    const end = owner === "turn" ? firstTurn(value)?.ends : undefined;
    const from =
      end === undefined
        ? handlePoint(owner, value, view.layout.value, middle)
        : project(view.layout.value, middle, end);
    return `M0 0L${round(0.6 * (from.x - point.value.x))} ${round(0.6 * (from.y - point.value.y))}`;
  });
  const said = useComputed(() => sayHandle(name, map.situation.value));
  const { label, text, value, least, most } = said.value;
  const colour = ink(colourOf(name));
  return (
    <g
      class="grip"
      data-handle={name}
      transform={place}
      tabindex={0}
      role="slider"
      aria-label={label}
      aria-valuetext={text}
      aria-valuenow={value}
      aria-valuemin={least}
      aria-valuemax={most}
    >
      {stick.value !== "" && (
        <path
          class="nd-stroke"
          d={stick}
          stroke={colour}
          stroke-width={1.5}
          stroke-dasharray="3 4"
        />
      )}
      <circle class="grip-touch" r={name === "wind" ? KNOB + 6 : TOUCH} />
      {!isBare(name) && (
        <circle
          class="nd-hollow"
          r={name === "wind" ? 6 : KNOB}
          stroke={colour}
          stroke-width={2.5}
        />
      )}
    </g>
  );
}

/** The whole ring can be taken hold of, wherever the knob is. */
function RingTouch({ map, view }: Omit<GripProps, "name">) {
  const place = useComputed(() => {
    const middle = view.pose.value;
    return middle === null
      ? ""
      : placeAt(project(view.layout.value, middle, map.situation.value.leader));
  });
  const radius = useComputed(() =>
    round(map.situation.value.min_separation_m * view.layout.value.scale),
  );
  return <circle class="ring-touch" data-handle="ring" r={radius} transform={place} />;
}
