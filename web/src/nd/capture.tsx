import { useComputed } from "@preact/signals";
import type { Label } from "./labels";
import { type LayerProps, usePart } from "./layer";
import { ink } from "./style";
import { offNose, onMap, placeAt, project, toMap } from "./view";

/** Where and when own ship reaches the slot. */
export function CapturePoint({ shown, view }: LayerProps) {
  const colour = usePart(shown, ({ style }) => ink(style?.pathColour ?? "plan"));
  const join = usePart(shown, (picture) => picture.join);
  const isShown = useComputed(() => join.value !== null);
  const place = useComputed(() =>
    join.value === null ? "" : placeAt(toMap(view.layout.value, join.value)),
  );
  if (!isShown.value) return null;
  return (
    <g class="nd-capture" transform={place}>
      <circle class="nd-halo" r={8} stroke-width={6} />
      <circle class="nd-stroke" r={8} stroke={colour} stroke-width={2.5} />
      <circle class="nd-solid" r={3} fill={colour} />
    </g>
  );
}

/** "CNV mm:ss", the time still to fly. */
export function captureLabel({ shown, view }: LayerProps): Label | null {
  const [{ join, closestAtJoin, style }, { toJoin, least }] = [
    shown.picture.value,
    shown.numbers.value,
  ];
  const pose = view.pose.value;
  if (toJoin === "" || join === null || pose === null) return null;
  const at = project(view.layout.value, pose, join);
  if (!onMap(view.layout.value, at)) return null;
  const isClosest = closestAtJoin !== null && least !== null;
  return {
    id: "capture",
    at,
    lines: [
      { text: `CNV ${toJoin}`, colour: style?.pathColour ?? "plan" },
      ...(isClosest ? [{ text: `${least.miles} NM`, colour: "label" as const }] : []),
    ],
    side: offNose(pose, join.heading_deg + 90),
    gap: 16,
    size: 20,
    optional: false,
  };
}
