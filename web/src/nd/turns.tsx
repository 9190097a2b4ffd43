import { type ReadonlySignal, useComputed } from "@preact/signals";
import type { Colour } from "../store/colours";
import type { PathPoint } from "../wire";
import type { Label } from "./labels";
import { type LayerProps, usePart } from "./layer";
import { Stroke } from "./stroke";
import { LINES } from "./style";
import { offNose, onMap, placeAt, project, toMap } from "./view";

/** Beyond these ranges the sizes of the turns, then their names, would only clutter [NM]. */
const SIZES_TO = 40;
const NAMES_TO = 80;

/** Where each turn begins and ends, as ticks across the path; chevrons where the next roll-in is due. */
export function TurnPoints({ shown, view }: LayerProps) {
  const names = usePart(shown, ({ turns }) => turns.map(({ name }) => name).join(" "));
  if (names.value === "") return null;
  return (
    <g class="nd-turns">
      {names.value.split(" ").map((name) => (
        <Turn key={name} shown={shown} view={view} name={name} />
      ))}
    </g>
  );
}

function Turn({ shown, view, name }: LayerProps & { name: string }) {
  const turn = usePart(shown, ({ turns }) => turns.find((each) => each.name === name) ?? null);
  const colour = usePart(shown, ({ style }) => style?.pathColour ?? "plan");
  const from = useComputed(() => turn.value?.from ?? null);
  const to = useComputed(() => turn.value?.to ?? null);
  const hasBegun = useComputed(() => turn.value?.hasBegun ?? true);
  const isRollIn = useComputed(() => turn.value?.isRollIn ?? false);
  return (
    <g>
      {!hasBegun.value && <Mark view={view} point={from} half={9} colour={colour.value} />}
      <Mark view={view} point={to} half={6} colour={colour.value} />
      {isRollIn.value && <RollIn view={view} point={from} />}
    </g>
  );
}

interface MarkProps {
  readonly view: LayerProps["view"];
  readonly point: ReadonlySignal<PathPoint | null>;
}

/** Where a mark stands, across the path that is drawn. */
function usePlace({ view, point }: MarkProps): ReadonlySignal<string> {
  return useComputed(() =>
    point.value === null
      ? ""
      : placeAt(toMap(view.layout.value, point.value), point.value.heading_deg),
  );
}

function Mark({ half, colour, ...mark }: MarkProps & { half: number; colour: Colour }) {
  return (
    <g transform={usePlace(mark)}>
      <Stroke d={`M${-half} 0H${half}`} line={{ ...LINES.mark, colour }} />
    </g>
  );
}

function RollIn(mark: MarkProps) {
  return (
    <g class="nd-rollin" transform={usePlace(mark)}>
      <Stroke d="M-9 -6L0 -14L9 -6M-9 -15L0 -23L9 -15" line={LINES.turn} />
    </g>
  );
}

/** The names of the turns to come, on their outer side. */
export function turnLabels({ shown, view }: LayerProps): Label[] {
  const pose = view.pose.value;
  const layout = view.layout.value;
  if (pose === null || layout.range > NAMES_TO) return [];
  const { style, turns } = shown.picture.value;
  return turns
    .filter(({ hasBegun }) => !hasBegun)
    .slice(0, 6)
    .map(({ name, size, from }) => ({
      id: name,
      at: project(layout, pose, from),
      lines: [
        {
          text: layout.range <= SIZES_TO ? `${name} ${size}` : name,
          colour: style?.pathColour ?? "plan",
        },
      ],
      side: offNose(pose, from.heading_deg + (size[0] === "R" ? -90 : 90)),
      gap: 13,
      size: 20,
      optional: true,
    }))
    .filter(({ at }) => onMap(layout, at));
}
