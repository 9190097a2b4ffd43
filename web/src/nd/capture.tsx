import { useComputed } from "@preact/signals";
import { formatClock } from "../units";
import { closestAtEnd, closestText } from "./closest";
import type { Label } from "./labels";
import { type LayerProps, planTime, shownPlan } from "./picture";
import { ink } from "./style";
import { offNose, onMap, placeAt, project, toMap } from "./view";

/** Where and when own ship reaches the slot. */
export function CapturePoint({ flight, view }: LayerProps) {
  const place = useComputed(() => {
    const end = captureAt(flight);
    return end === null ? null : placeAt(toMap(view.layout.value, end));
  });
  const shown = useComputed(() => place.value !== null);
  const at = useComputed(() => place.value ?? "");
  if (!shown.value) return null;
  return (
    <g class="nd-capture" transform={at}>
      <circle class="nd-halo" r={8} stroke-width={6} />
      <circle class="nd-stroke" r={8} stroke={ink("plan")} stroke-width={2.5} />
      <circle class="nd-solid" r={3} fill={ink("plan")} />
    </g>
  );
}

function captureAt(flight: LayerProps["flight"]) {
  const plan = shownPlan(flight);
  const end = plan?.plan.segments.at(-1)?.end;
  return plan === null || end === undefined || planTime(flight, plan) > end.t_s ? null : end;
}

/** "CNV mm:ss", the time still to fly. */
export function captureLabel({ flight, view }: LayerProps): Label | null {
  const [plan, end, pose] = [shownPlan(flight), captureAt(flight), view.pose.value];
  if (plan === null || end === null || pose === null) return null;
  const at = project(view.layout.value, pose, end);
  if (!onMap(view.layout.value, at)) return null;
  const left = plan.plan.time_to_converge_s - planTime(flight, plan);
  return {
    id: "capture",
    at,
    lines: [
      { text: `CNV ${formatClock(Math.max(0, left))}`, colour: "plan" },
      ...(closestAtEnd(plan) ? [{ text: closestText(plan), colour: "label" as const }] : []),
    ],
    side: offNose(pose, end.heading_deg + 90),
    gap: 16,
    size: 20,
    optional: false,
  };
}
