import { useComputed } from "@preact/signals";
import { DEG, formatMiles } from "../units";
import type { Label } from "./labels";
import { type LayerProps, shownNow } from "./picture";
import { separation } from "./states";
import { ink, SEPARATION } from "./style";
import { onMap, placeAt, project, toMap } from "./view";

/** The minimum separation, round the leader. */
export function SeparationCircle({ flight, view }: LayerProps) {
  const place = useComputed(() => {
    const now = shownNow(flight);
    return now === null ? "" : placeAt(toMap(view.layout.value, now.leader));
  });
  const radius = useComputed(
    () => (flight.started.value?.min_separation_m ?? 0) * view.layout.value.scale,
  );
  const shown = useComputed(() => place.value !== "" && radius.value > 0);
  const look = useComputed(() => SEPARATION[separation(flight).state]);
  if (!shown.value) return null;
  const { colour, width, dash } = look.value;
  return (
    <g class={`nd-circle${colour === "alert" ? " nd-flash" : ""}`} transform={place}>
      <circle class="nd-halo" r={radius} stroke-width={width + 3} stroke-dasharray={dash} />
      <circle
        class="nd-stroke"
        r={radius}
        stroke={ink(colour)}
        stroke-width={width}
        stroke-dasharray={dash}
      />
    </g>
  );
}

/** The size of the circle, on its side away from the own ship. */
export function circleLabel({ flight, view }: LayerProps): Label | null {
  const [now, pose] = [shownNow(flight), view.pose.value];
  const minSeparation = flight.started.value?.min_separation_m;
  if (now === null || pose === null || minSeparation === undefined) return null;
  const layout = view.layout.value;
  const centre = project(layout, pose, now.leader);
  const radius = minSeparation * layout.scale;
  const { colour } = SEPARATION[separation(flight).state];
  for (const turn of [0, 45, -45, 90, -90, 135, -135, 180]) {
    const side = away(layout.centre, centre) + turn;
    const at = {
      x: centre.x + radius * Math.sin(side * DEG),
      y: centre.y - radius * Math.cos(side * DEG),
    };
    if (!onMap(layout, at, 30)) continue;
    const lines = [{ text: `MIN ${formatMiles(minSeparation)}`, colour }];
    return { id: "circle", at, lines, side, gap: 6, size: 18, optional: false };
  }
  return null;
}

/** The direction from one point on the glass to another [deg right of up], to whole steps of 45°. */
function away(from: { x: number; y: number }, to: { x: number; y: number }): number {
  const direction = Math.atan2(to.x - from.x, from.y - to.y) / DEG;
  return Math.round(direction / 45) * 45;
}
