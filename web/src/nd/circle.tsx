import { useComputed } from "@preact/signals";
import type { Picture } from "../store/picture";
import { DEG } from "../units";
import type { Label } from "./labels";
import { type LayerProps, usePart } from "./layer";
import { ink, SEPARATION } from "./style";
import { onMap, placeAt, project, toMap } from "./view";

/** The minimum separation, round the leader. */
export function SeparationCircle({ shown, view }: LayerProps) {
  const place = useLeaderPlace({ shown, view });
  const radius = useComputed(() => shown.picture.value.keepOut * view.layout.value.scale);
  const isShown = useComputed(() => place.value !== "" && radius.value > 0);
  const style = usePart(shown, ({ separation }) => SEPARATION[separation.state]);
  if (!isShown.value) return null;
  const { colour, width, dash } = style.value;
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

/** Where circles round the leader are put; "" while none is drawn. */
export function useLeaderPlace({ shown, view }: LayerProps) {
  return useComputed(() => {
    const { value: picture } = shown.picture;
    if (picture.leader === null || !isRound(picture)) return "";
    return placeAt(toMap(view.layout.value, picture.leader));
  });
}

/** Whether it is drawn: round a designated leader, and wherever the minimum is or will be lost. */
export function isRound({ designated, separation }: Picture): boolean {
  return designated || separation.state !== "kept";
}

/** The size of the circle, on its side away from the own ship. */
export function circleLabel({ shown, view }: LayerProps): Label | null {
  const { leader, started, separation } = shown.picture.value;
  const pose = view.pose.value;
  const minSeparation = started?.min_separation_m;
  if (leader === null || pose === null || minSeparation === undefined) return null;
  if (!isRound(shown.picture.value)) return null;
  const layout = view.layout.value;
  const centre = project(layout, pose, leader);
  const radius = shown.picture.value.keepOut * layout.scale;
  const { colour } = SEPARATION[separation.state];
  for (const turn of [0, 45, -45, 90, -90, 135, -135, 180]) {
    const side = away(layout.centre, centre) + turn;
    const at = {
      x: centre.x + radius * Math.sin(side * DEG),
      y: centre.y - radius * Math.cos(side * DEG),
    };
    if (!onMap(layout, at, 30)) continue;
    const lines = [{ text: `MIN ${shown.numbers.value.minSeparation}`, colour }];
    return { id: "circle", at, lines, side, gap: 6, size: 18, optional: false };
  }
  return null;
}

/** The direction from one point on the glass to another [deg right of up], to whole steps of 45°. */
function away(from: { x: number; y: number }, to: { x: number; y: number }): number {
  const direction = Math.atan2(to.x - from.x, from.y - to.y) / DEG;
  return Math.round(direction / 45) * 45;
}
