import { type ReadonlySignal, useComputed } from "@preact/signals";
import type { Colour } from "../store/colours";
import type { Picture } from "../store/picture";
import type { PathPoint } from "../wire";
import type { Label } from "./labels";
import { type LayerProps, usePart } from "./layer";
import { line } from "./path";
import { Stroke } from "./stroke";
import { ink, LINES } from "./style";
import { offNose, onMap, placeAt, project, toMap } from "./view";

const GHOST = { pursuer: "M0 -9V10M-10 0H10M-4 8H4", leader: "M0 -10L8 9L0 4L-8 9Z" } as const;

/** Where both will be when they are closest, tied together, and the minimum round the leader then. */
export function ClosestApproach({ shown, view }: LayerProps) {
  const pair = usePart(shown, (picture) => picture.closest);
  const ring = usePart(shown, ({ closest, closestAtJoin }) => closest ?? closestAtJoin);
  const isShown = useComputed(() => ring.value !== null);
  const isTied = useComputed(() => pair.value !== null);
  const radius = useComputed(
    () => (shown.picture.value.started?.min_separation_m ?? 0) * view.layout.value.scale,
  );
  const ringPlace = useComputed(() =>
    ring.value === null ? "" : placeAt(toMap(view.layout.value, ring.value.leader)),
  );
  const colour = useComputed(() => closestColour(shown.picture.value));
  const tie = useComputed(() =>
    pair.value === null ? "" : line(view.layout.value, pair.value.pursuer, pair.value.leader),
  );
  const pursuer = useComputed(() => pair.value?.pursuer ?? null);
  const leader = useComputed(() => pair.value?.leader ?? null);
  if (!isShown.value) return null;
  return (
    <g class="nd-closest">
      <circle
        class="nd-stroke"
        r={radius}
        transform={ringPlace}
        stroke={ink(colour.value)}
        stroke-width={LINES.ghostRing.width}
        stroke-dasharray={LINES.ghostRing.dash}
      />
      {isTied.value && (
        <>
          <Stroke d={tie} line={{ ...LINES.closest, colour: colour.value }} />
          <Ghost view={view} point={pursuer} shape={GHOST.pursuer} colour={colour.value} />
          <Ghost view={view} point={leader} shape={GHOST.leader} colour={colour.value} />
        </>
      )}
    </g>
  );
}

interface GhostProps {
  readonly view: LayerProps["view"];
  readonly point: ReadonlySignal<PathPoint | null>;
  readonly shape: string;
  readonly colour: Colour;
}

function Ghost({ view, point, shape, colour }: GhostProps) {
  const place = useComputed(() =>
    point.value === null
      ? ""
      : placeAt(toMap(view.layout.value, point.value), point.value.heading_deg),
  );
  return (
    <g transform={place}>
      <Stroke d={shape} line={{ colour, width: 2, dash: "" }} />
    </g>
  );
}

function closestColour({ closest, closestAtJoin }: Picture): Colour {
  return (closest ?? closestAtJoin)?.isTooClose === true ? "caution" : "label";
}

/** How close, and how long until then. */
export function closestLabel({ shown, view }: LayerProps): Label | null {
  const [{ closest }, { least }, pose] = [
    shown.picture.value,
    shown.numbers.value,
    view.pose.value,
  ];
  if (closest === null || pose === null || least === null) return null;
  const at = project(view.layout.value, pose, {
    x_m: (closest.pursuer.x_m + closest.leader.x_m) / 2,
    y_m: (closest.pursuer.y_m + closest.leader.y_m) / 2,
  });
  if (!onMap(view.layout.value, at)) return null;
  const text = `${least.miles} NM ${least.left}`.trim();
  return {
    id: "closest",
    at,
    lines: [{ text, colour: closestColour(shown.picture.value) }],
    side: offNose(pose, closest.leader.heading_deg - 90),
    gap: 10,
    size: 18,
    optional: false,
  };
}
