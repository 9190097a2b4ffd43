import { useComputed } from "@preact/signals";
import { formatHeading, formatMiles } from "../units";
import type { Label } from "./labels";
import { BROKEN, leaderOnMap, RINGS } from "./leader";
import { type LayerProps, leaderIdent, shownNow } from "./picture";
import { age } from "./states";
import { AGE, ink } from "./style";
import { bearing, edge, offNose, placeAt, remedy } from "./view";

/** The leader off the map: half a symbol on the edge in its direction, pointing there. */
export function OffScaleLeader({ flight, view }: LayerProps) {
  const place = useComputed(() => {
    const direction = offScaleDirection({ flight, view });
    if (direction === null) return null;
    return placeAt(edge(view.layout.value, direction), direction);
  });
  const shown = useComputed(() => place.value !== null);
  const at = useComputed(() => place.value ?? "");
  const look = useComputed(() => AGE[age(flight)]);
  if (!shown.value) return null;
  const colour = ink(look.value.colour === "leader" ? "leader-ring" : look.value.colour);
  return (
    <g class="nd-offscale" transform={at}>
      {RINGS.map((radius) => (
        <path
          key={radius}
          class="nd-stroke"
          d={`M${-radius} 8A${radius} ${radius} 0 0 1 ${radius} 8`}
          stroke={colour}
          stroke-width={2}
          stroke-dasharray={look.value.ring === "broken" ? BROKEN : ""}
        />
      ))}
      <path class="nd-solid" d="M0 -8L11 8H-11Z" fill={ink(look.value.colour)} />
    </g>
  );
}

/** Right of the nose [deg], when the leader is off the map. */
export function offScaleDirection({ flight, view }: LayerProps): number | null {
  const [now, pose] = [shownNow(flight), view.pose.value];
  if (now === null || pose === null || leaderOnMap({ flight, view }) !== null) return null;
  return offNose(pose, bearing(pose, now.leader));
}

/** Who it is, its bearing and distance, and what to select to see it. */
export function offScaleTag({ flight, view }: LayerProps): Label | null {
  const [now, pose] = [flight.now.value, view.pose.value];
  const direction = offScaleDirection({ flight, view });
  if (direction === null || now === null || pose === null) return null;
  const layout = view.layout.value;
  const { colour } = AGE[age(flight)];
  const to = formatHeading(bearing(pose, now.leader));
  const hint = remedy(layout, pose, now.leader);
  return {
    id: "offscale",
    at: edge(layout, direction),
    lines: [
      { text: leaderIdent(flight), colour },
      { text: `${to}° ${formatMiles(now.separation_m)}`, colour },
      ...(hint === null ? [] : [{ text: hint, colour: "selected" as const }]),
    ],
    side: direction + 180,
    gap: 26,
    size: 20,
    optional: false,
  };
}
