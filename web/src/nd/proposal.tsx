import { useComputed } from "@preact/signals";
import { pathPointAt } from "../geometry";
import { PathAhead } from "./ahead";
import type { Label } from "./labels";
import { type LayerProps, usePart } from "./layer";
import { pathData } from "./path";
import { Stroke } from "./stroke";
import { LINES } from "./style";
import { offNose, onMap, project } from "./view";

/** The path that could be flown, dashed: yellow while it is proposed, cyan once accepted. */
export function ProposedPath({ shown, view }: LayerProps) {
  const kind = usePart(shown, ({ look }) => look?.path ?? "none");
  const proposed = usePart(shown, (picture) => picture.proposed);
  const path = useComputed(() => {
    const { value } = proposed;
    return value === null ? null : { segments: value.plan.segments, start: value.t_s };
  });
  if (kind.value !== "proposed" && kind.value !== "armed") return null;
  return (
    <g class={`nd-${kind.value}`}>
      <PathAhead shown={shown} view={view} path={path} line={LINES[kind.value]} />
    </g>
  );
}

/** The other paths to the slot, thin, under what is proposed. */
export function OtherPaths({ shown, view }: LayerProps) {
  const isProposed = usePart(shown, ({ look }) => look?.path === "proposed");
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

/** How far along a path its name stands. */
const NAMED_AT = 0.35;

/** "PROPOSED" or "ARMED", beside the path. */
export function proposalLabel({ shown, view }: LayerProps): Label | null {
  const [{ look, proposed, wind }, pose] = [shown.picture.value, view.pose.value];
  if (proposed === null || pose === null || look === null) return null;
  const { segments, time_to_converge_s: duration } = proposed.plan;
  for (const part of [NAMED_AT, NAMED_AT / 2, NAMED_AT / 4]) {
    const point = pathPointAt(segments, part * duration, wind);
    if (point === null) return null;
    const at = project(view.layout.value, pose, point);
    if (!onMap(view.layout.value, at)) continue;
    const text = look.path === "armed" ? "ARMED" : "PROPOSED";
    const lines = [{ text, colour: look.pathColour }];
    const side = offNose(pose, point.heading_deg + 90);
    return { id: "proposal", at, lines, side, gap: 12, size: 20, optional: false };
  }
  return null;
}
