import { useComputed } from "@preact/signals";
import { DEG, formatHeading } from "../units";
import type { PathSegment, TurnSegment } from "../wire";
import { PathAhead } from "./ahead";
import type { Label } from "./labels";
import { type LayerProps, usePart } from "./layer";
import { ink, LINES } from "./style";
import { offNose, onMap, onwards, placeAt, project, toMap } from "./view";

/** How far ahead the path is shown when the intent is unknown [s]. */
const GUESS = 180;

/** The leader's declared intent (dash-dot, new legs marked), or straight on if it is unknown (dots). */
export function LeaderIntent({ shown, view }: LayerProps) {
  const route = usePart(shown, (picture) => picture.route);
  const path = useComputed(() =>
    route.value === null ? null : { segments: route.value.segments, start: 0 },
  );
  const known = useComputed(() => route.value?.intent_known ?? false);
  const legs = useComputed(() => (known.value ? (path.value?.segments ?? []).filter(isTurn) : []));
  if (!known.value) {
    return (
      <g class="nd-guess">
        <PathAhead
          shown={shown}
          view={view}
          path={path}
          line={LINES.extrapolated}
          horizon={GUESS}
        />
      </g>
    );
  }
  return (
    <g class="nd-intent">
      <PathAhead shown={shown} view={view} path={path} line={LINES.declared} />
      {legs.value.map((leg) => (
        <NewLeg key={leg.start.t_s} shown={shown} view={view} leg={leg} />
      ))}
    </g>
  );
}

function NewLeg({ shown, view, leg }: LayerProps & { leg: TurnSegment }) {
  const isToCome = usePart(shown, ({ t }) => t < leg.end.t_s);
  const place = useComputed(() => placeAt(toMap(view.layout.value, leg.end)));
  if (!isToCome.value) return null;
  return (
    <path
      class="nd-hollow"
      d="M0 -9L7 0L0 9L-7 0Z"
      stroke={ink("leader")}
      stroke-width={2}
      transform={place}
    />
  );
}

function isTurn(segment: PathSegment): segment is TurnSegment {
  return segment.kind === "turn";
}

/** The heading of each new leg, or that the intent is unknown. */
export function intentLabels({ shown, view }: LayerProps): Label[] {
  const [{ now, route, t }, pose] = [shown.picture.value, view.pose.value];
  if (now === null || pose === null || route === null) return [];
  const layout = view.layout.value;
  const base = { gap: 14, size: 18, optional: true };
  if (!route.intent_known) {
    const track = now.leader.track_deg * DEG;
    const direction = { x: Math.sin(track), y: Math.cos(track) };
    // Half-way along the dots, or nearer where that is off the map.
    const at = [0.5, 0.3, 0.15, 0]
      .map((part) => onwards(now.leader, direction, now.leader.ground_speed_mps * GUESS * part))
      .map((place) => project(layout, pose, place))
      .find((point) => onMap(layout, point));
    if (at === undefined) return [];
    const side = offNose(pose, now.leader.track_deg) - 90;
    const lines = [{ text: "NO INTENT", colour: "leader" as const }];
    return [{ ...base, id: "intent", at, lines, side, optional: false }];
  }
  return route.segments
    .filter(isTurn)
    .filter((leg) => t < leg.end.t_s)
    .slice(0, 3)
    .map((leg, i) => {
      const outside = leg.direction === "right" ? -90 : 90;
      return {
        ...base,
        id: `leg ${i}`,
        at: project(layout, pose, leg.end),
        lines: [{ text: `${formatHeading(leg.end.heading_deg)}°`, colour: "leader" as const }],
        side: offNose(pose, leg.end.heading_deg + outside),
      };
    })
    .filter(({ at }) => onMap(layout, at));
}
