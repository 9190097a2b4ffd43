import { useComputed } from "@preact/signals";
import type { Label } from "./labels";
import { type LayerProps, usePart } from "./layer";
import { BROKEN, leaderOnMap, RINGS } from "./leader";
import { ink } from "./style";
import { bearing, edge, offNose, placeAt, remedy } from "./view";

/** The leader off the map: half a symbol on the edge in its direction, pointing there. */
export function OffScaleLeader({ shown, view }: LayerProps) {
  const place = useComputed(() => {
    const direction = offScaleDirection({ shown, view });
    if (direction === null) return null;
    return placeAt(edge(view.layout.value, direction), direction);
  });
  const isShown = useComputed(() => place.value !== null);
  const at = useComputed(() => place.value ?? "");
  const style = usePart(shown, (picture) => picture.leaderAge);
  if (!isShown.value) return null;
  const colour = ink(style.value.colour === "leader" ? "leader-ring" : style.value.colour);
  return (
    <g class="nd-offscale" transform={at}>
      {RINGS.map((radius) => (
        <path
          key={radius}
          class="nd-stroke"
          d={`M${-radius} 8A${radius} ${radius} 0 0 1 ${radius} 8`}
          stroke={colour}
          stroke-width={2}
          stroke-dasharray={style.value.ring === "broken" ? BROKEN : ""}
        />
      ))}
      <path class="nd-solid" d="M0 -8L11 8H-11Z" fill={ink(style.value.colour)} />
    </g>
  );
}

/** Right of the nose [deg], when the leader is off the map. */
function offScaleDirection({ shown, view }: LayerProps): number | null {
  const [{ leader }, pose] = [shown.picture.value, view.pose.value];
  if (leader === null || pose === null || leaderOnMap({ shown, view }) !== null) return null;
  return offNose(pose, bearing(pose, leader));
}

/** Who it is, its bearing and distance, and what to select to see it. */
export function offScaleTag({ shown, view }: LayerProps): Label | null {
  const [{ now, leaderAge, ident }, pose] = [shown.picture.value, view.pose.value];
  const direction = offScaleDirection({ shown, view });
  if (direction === null || now === null || pose === null) return null;
  const layout = view.layout.value;
  const { colour } = leaderAge;
  const { leaderBearing, separation } = shown.numbers.value;
  const hint = remedy(layout, pose, now.leader);
  return {
    id: "offscale",
    at: edge(layout, direction),
    lines: [
      { text: ident, colour },
      { text: `${leaderBearing}° ${separation}`, colour },
      ...(hint === null ? [] : [{ text: hint, colour: "selected" as const }]),
    ],
    side: direction + 180,
    gap: 26,
    size: 20,
    optional: false,
  };
}
