import { useComputed } from "@preact/signals";
import { type Closest, closestApproach, isClosestAtJoin } from "../committed";
import { formatClock, formatMiles } from "../units";
import type { Label } from "./labels";
import { line } from "./path";
import { type LayerProps, shownGuidance } from "./picture";
import { GRAZE } from "./states";
import { Stroke } from "./stroke";
import { LINES } from "./style";
import { offNose, onMap, placeAt, project, toMap } from "./view";

const GHOST = { pursuer: "M0 -9V10M-10 0H10M-4 8H4", leader: "M0 -10L8 9L0 4L-8 9Z" } as const;

/** Where both will be when they are closest, tied together. */
export function ClosestApproach({ flight, view }: LayerProps) {
  const pair = useComputed(() => closest(flight));
  const shown = useComputed(() => pair.value !== null);
  const tie = useComputed(() =>
    pair.value === null ? "" : line(view.layout.value, pair.value.pursuer, pair.value.leader),
  );
  if (!shown.value) return null;
  return (
    <g class="nd-closest">
      <Stroke d={tie} line={{ ...LINES.closest, colour: closestColour(flight) }} />
      <Ghost flight={flight} view={view} who="pursuer" />
      <Ghost flight={flight} view={view} who="leader" />
    </g>
  );
}

function Ghost({ flight, view, who }: LayerProps & { who: "pursuer" | "leader" }) {
  const place = useComputed(() => {
    const point = closest(flight)?.[who];
    return point === undefined ? "" : placeAt(toMap(view.layout.value, point), point.heading_deg);
  });
  return (
    <g transform={place}>
      <Stroke d={GHOST[who]} line={{ colour: closestColour(flight), width: 2, dash: "" }} />
    </g>
  );
}

function closestColour(flight: LayerProps["flight"]) {
  const least = closest(flight)?.least ?? Number.POSITIVE_INFINITY;
  const minSeparation = flight.started.value?.min_separation_m ?? 0;
  return least < minSeparation - GRAZE ? "caution" : "label";
}

/** The closest approach on the path flown, while it is still to come. At the join it is no pair of its own. */
function closest(flight: LayerProps["flight"]): Closest | null {
  if (shownGuidance(flight)?.look.path !== "committed") return null;
  const pair = closestApproach(flight);
  if (pair === null || flight.simTime.value >= pair.at || isClosestAtJoin(flight, pair))
    return null;
  return pair;
}

/** How close they come. */
export function closestText({ least }: Closest): string {
  return `${formatMiles(least)} NM`;
}

/** How close, and how long until then. */
export function closestLabel({ flight, view }: LayerProps): Label | null {
  const [pair, pose, reading] = [closest(flight), view.pose.value, flight.reading.value];
  if (pair === null || pose === null || reading === null) return null;
  const at = project(view.layout.value, pose, {
    x_m: (pair.pursuer.x_m + pair.leader.x_m) / 2,
    y_m: (pair.pursuer.y_m + pair.leader.y_m) / 2,
  });
  if (!onMap(view.layout.value, at)) return null;
  const left = Math.max(0, pair.at - reading.t_s);
  return {
    id: "closest",
    at,
    lines: [
      {
        text: `${closestText(pair)} ${formatClock(left)}`,
        colour: closestColour(flight),
      },
    ],
    side: offNose(pose, pair.leader.heading_deg - 90),
    gap: 10,
    size: 18,
    optional: false,
  };
}
