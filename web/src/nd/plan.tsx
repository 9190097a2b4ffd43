import { useComputed } from "@preact/signals";
import { PathAhead, WholePath } from "./ahead";
import { ForecastAhead } from "./committed";
import { line } from "./path";
import { type LayerProps, shownGuidance, shownPlan, slotTrack } from "./picture";
import { Stroke } from "./stroke";
import { LINES } from "./style";
import { onwards } from "./view";

/**
 * The path being flown, solid: the forecast, with the plan's ideal path as a thin line under it.
 * Before the first forecast: what is left of the plan, or the leader's route once behind it.
 */
export function ActivePath({ flight, view }: LayerProps) {
  const kind = useComputed(() => shownGuidance(flight)?.look.path ?? "none");
  const path = useComputed(() => {
    const plan = flight.plan.value;
    return plan === null ? null : { segments: plan.plan.segments, start: plan.t_s };
  });
  const route = useComputed(() => {
    const now = shownGuidance(flight)?.now;
    const length = flight.started.value?.slot_distance_m;
    if (now === undefined || length === undefined) return "";
    return line(view.layout.value, now.slot, onwards(now.slot, slotTrack(flight), length));
  });
  const isForecast = useComputed(() => flight.forecast.value !== null);
  const isPlanned = useComputed(() => shownPlan(flight) !== null);
  switch (kind.value) {
    case "none":
      return null;
    case "old_plan":
      return <PathAhead flight={flight} view={view} path={path} line={LINES.superseded} />;
    case "committed":
      if (!isForecast.value) {
        if (!isPlanned.value) return <Stroke d={route} line={LINES.active} />;
        return <PathAhead flight={flight} view={view} path={path} line={LINES.active} />;
      }
      return (
        <>
          {isPlanned.value && (
            <PathAhead flight={flight} view={view} path={path} line={LINES.ideal} />
          )}
          <ForecastAhead
            flight={flight}
            view={view}
            forecast={flight.forecast}
            line={LINES.active}
          />
        </>
      );
  }
}

/** The plan before, dotted and fading while the new one is taken in. */
export function SupersededPath({ flight, view }: LayerProps) {
  const path = useComputed(() => {
    const plan = flight.superseded.value?.plan;
    if (plan === undefined || shownGuidance(flight) === null) return null;
    return { segments: plan.plan.segments, start: plan.t_s };
  });
  // A plan that follows another at once begins to fade anew.
  const made = useComputed(() => path.value?.start ?? null);
  if (made.value === null) return null;
  return (
    <g class="nd-fading" key={made.value}>
      <WholePath flight={flight} view={view} path={path} line={LINES.superseded} />
    </g>
  );
}
