import { useComputed } from "@preact/signals";
import { closestApproach, isClosestAtJoin, joinPoint, timeToJoin } from "../committed";
import { formatClock } from "../units";
import { closestText } from "./closest";
import type { Label } from "./labels";
import { type LayerProps, shownGuidance } from "./picture";
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
  return shownGuidance(flight)?.look.path === "committed" ? joinPoint(flight) : null;
}

/** "CNV mm:ss", the time still to fly. */
export function captureLabel({ flight, view }: LayerProps): Label | null {
  const [left, end, pose] = [timeToJoin(flight), captureAt(flight), view.pose.value];
  if (left === null || end === null || pose === null) return null;
  const at = project(view.layout.value, pose, end);
  if (!onMap(view.layout.value, at)) return null;
  const closest = closestApproach(flight);
  const isClosest = closest !== null && isClosestAtJoin(flight, closest);
  return {
    id: "capture",
    at,
    lines: [
      { text: `CNV ${formatClock(left)}`, colour: "plan" },
      ...(isClosest ? [{ text: closestText(closest), colour: "label" as const }] : []),
    ],
    side: offNose(pose, end.heading_deg + 90),
    gap: 16,
    size: 20,
    optional: false,
  };
}
