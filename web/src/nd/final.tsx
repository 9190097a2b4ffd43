import { useComputed } from "@preact/signals";
import { joinPoint } from "../committed";
import { NM } from "../units";
import { line } from "./path";
import { type LayerProps, shownGuidance, slotTrack } from "./picture";
import { Stroke } from "./stroke";
import { LINES } from "./style";
import { onwards, type Place } from "./view";

/** The leader's final track where the plan meets it, when the leader is not yet on it there. */
export function FinalTrack({ flight, view }: LayerProps) {
  const d = useComputed(() => {
    const shown = shownGuidance(flight);
    const end = joinPoint(flight);
    if (shown?.look.points !== true || end === null) return "";
    const track = slotTrack(flight);
    const leg = finalLegStart(flight) ?? shown.now.leader;
    const along = (leg.x_m - end.x_m) * track.x + (leg.y_m - end.y_m) * track.y;
    // The lead-in shows the direction of the join even where the rest runs under the leader's own route.
    const lead = onwards(end, track, -0.15 * view.layout.value.range * NM);
    return line(view.layout.value, lead, onwards(end, track, Math.max(0, along)));
  });
  return <Stroke d={d} line={LINES.final} />;
}

/** Where the leader's last turn ends; null if it has none to come. */
function finalLegStart(flight: LayerProps["flight"]): Place | null {
  const segments = flight.route.value?.segments ?? [];
  return segments.length > 1 ? (segments.at(-1)?.start ?? null) : null;
}
