import { useComputed } from "@preact/signals";
import { pathPointAt } from "../geometry";
import { PathAhead, WholePath } from "./ahead";
import { ForecastAhead } from "./committed";
import type { Label } from "./labels";
import { type LayerProps, usePart } from "./layer";
import { pathData } from "./path";
import { Stroke } from "./stroke";
import { LINES } from "./style";
import { offNose, onMap, type Point, project } from "./view";

/**
 * The path that could be flown, dashed: yellow while it is proposed, cyan once accepted. Where its
 * flight is known it is that, with the ideal path dotted under it.
 */
export function ProposedPath({ shown, view }: LayerProps) {
  const kind = usePart(shown, ({ style }) => style?.path ?? "none");
  const proposed = usePart(shown, (picture) => picture.proposed);
  const path = useComputed(() => {
    const { value } = proposed;
    return value === null ? null : { segments: value.plan.segments, start: value.t_s };
  });
  const flown = useComputed(() => proposed.value?.flown ?? null);
  const ideal = useComputed(() => {
    const plan = proposed.value?.ideal;
    return plan === undefined ? null : { segments: plan.segments, start: 0 };
  });
  const isFlown = useComputed(() => flown.value !== null);
  if (kind.value !== "proposed" && kind.value !== "armed") return null;
  const line = LINES[kind.value];
  return (
    <g class={`nd-${kind.value}`}>
      {isFlown.value ? (
        <>
          <WholePath shown={shown} view={view} path={ideal} line={LINES.idealProposed} />
          <ForecastAhead shown={shown} view={view} forecast={flown} line={line} />
        </>
      ) : (
        <PathAhead shown={shown} view={view} path={path} line={line} />
      )}
    </g>
  );
}

/** The other paths to the slot, thin, under what is proposed. */
export function OtherPaths({ shown, view }: LayerProps) {
  const isProposed = usePart(shown, ({ style }) => style?.path === "proposed");
  const proposed = usePart(shown, (picture) => picture.proposed);
  const wind = usePart(shown, (picture) => picture.wind);
  const d = useComputed(() =>
    (proposed.value?.others ?? [])
      .map(({ segments }) => pathData(view.layout.value, segments, wind.value))
      .join(""),
  );
  if (!isProposed.value) return null;
  return (
    <g class="nd-others">
      <Stroke d={d} line={LINES.ghost} />
    </g>
  );
}

/** How far along a path its name may stand, the best place first. */
const NAMED_AT = [0.35, 0.25, 0.45, 0.175, 0.55, 0.0875] as const;
/** So far from a turn's name it is not mistaken for part of it [px]. */
const CLEAR = 90;

/** "PROPOSED" or "ARMED", beside the path: where no turn is named, if there is such a place. */
export function proposalLabel({ shown, view }: LayerProps): Label | null {
  const [{ style, proposed, turns, wind }, pose] = [shown.picture.value, view.pose.value];
  if (proposed === null || pose === null || style === null) return null;
  const { segments, time_to_converge_s: duration } = proposed.plan;
  const layout = view.layout.value;
  const named = turns.map(({ from }) => project(layout, pose, from));
  const places = NAMED_AT.flatMap((part) => {
    const point = pathPointAt(segments, part * duration, wind);
    const at = point === null ? null : project(layout, pose, point);
    return point === null || at === null || !onMap(layout, at) ? [] : [{ point, at }];
  });
  const isClear = ({ at }: { at: Point }) =>
    named.every(({ x, y }) => Math.hypot(at.x - x, at.y - y) > CLEAR);
  const place = places.find(isClear) ?? places[0];
  if (place === undefined) return null;
  const text = style.path === "armed" ? "ARMED" : "PROPOSED";
  const lines = [{ text, colour: style.pathColour }];
  const side = offNose(pose, place.point.heading_deg + 90);
  return { id: "proposal", at: place.at, lines, side, gap: 12, size: 20, optional: false };
}
