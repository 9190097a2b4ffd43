import { useComputed } from "@preact/signals";
import type { PlanChanged } from "../wire";
import { PathAhead, WholePath } from "./ahead";
import { ForecastAhead } from "./committed";
import { type LayerProps, type TimedPath, usePart } from "./layer";
import { line } from "./path";
import { Stroke } from "./stroke";
import { LINES } from "./style";
import { onwards } from "./view";

/**
 * The path being flown, solid: the forecast, with the plan's ideal path as a thin line under it.
 * Before the first forecast: what is left of the plan, or the leader's route once behind it.
 */
export function ActivePath({ shown, view }: LayerProps) {
  const kind = usePart(shown, ({ style }) => style?.path ?? "none");
  const plan = usePart(shown, (picture) => picture.plan);
  const path = useComputed(() => timedPath(plan.value));
  const route = useComputed(() => {
    const { guided, started, slotTrack } = shown.picture.value;
    if (guided === null || started === null) return "";
    const end = onwards(guided.slot, slotTrack, started.slot_distance_m);
    return line(view.layout.value, guided.slot, end);
  });
  const forecast = usePart(shown, (picture) => picture.forecast);
  const isForecast = useComputed(() => forecast.value !== null);
  const isPlanned = usePart(shown, (picture) => picture.flown !== null);
  switch (kind.value) {
    case "none":
    case "proposed":
    case "armed":
      return null;
    case "old_plan":
      return (
        <g class="nd-old">
          <PathAhead shown={shown} view={view} path={path} line={LINES.superseded} />
        </g>
      );
    case "committed":
      return (
        <g class="nd-active">
          {isForecast.value && isPlanned.value && (
            <PathAhead shown={shown} view={view} path={path} line={LINES.ideal} />
          )}
          {isForecast.value ? (
            <ForecastAhead shown={shown} view={view} forecast={forecast} line={LINES.active} />
          ) : isPlanned.value ? (
            <PathAhead shown={shown} view={view} path={path} line={LINES.active} />
          ) : (
            <Stroke d={route} line={LINES.active} />
          )}
        </g>
      );
  }
}

/** The plan before, dotted and fading while the new one is taken in. */
export function SupersededPath({ shown, view }: LayerProps) {
  const plan = usePart(shown, (picture) => picture.superseded);
  const path = useComputed(() => timedPath(plan.value));
  // A plan that follows another at once begins to fade anew.
  const made = useComputed(() => path.value?.start ?? null);
  if (made.value === null) return null;
  return (
    <g class="nd-fading" key={made.value}>
      <WholePath shown={shown} view={view} path={path} line={LINES.superseded} />
    </g>
  );
}

function timedPath(plan: PlanChanged | null): TimedPath | null {
  return plan === null ? null : { segments: plan.plan.segments, start: plan.t_s };
}
