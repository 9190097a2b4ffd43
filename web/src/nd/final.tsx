import { useComputed } from "@preact/signals";
import { NM } from "../units";
import type { LeaderRoute } from "../wire";
import { type LayerProps, usePart } from "./layer";
import { line } from "./path";
import { Stroke } from "./stroke";
import { LINES } from "./style";
import { onwards, type Place } from "./view";

/** The leader's final track where the plan meets it, when the leader is not yet on it there. */
export function FinalTrack({ shown, view }: LayerProps) {
  const d = useComputed(() => {
    const { style, guided, join, route, slotTrack } = shown.picture.value;
    if (style?.points !== true || guided === null || join === null) return "";
    const leg = finalLegStart(route) ?? guided.leader;
    const along = (leg.x_m - join.x_m) * slotTrack.x + (leg.y_m - join.y_m) * slotTrack.y;
    // The lead-in shows the direction of the join even where the rest runs under the leader's own route.
    const lead = onwards(join, slotTrack, -0.15 * view.layout.value.range * NM);
    return line(view.layout.value, lead, onwards(join, slotTrack, Math.max(0, along)));
  });
  const colour = usePart(shown, ({ style }) => style?.pathColour ?? "plan");
  return (
    <g class="nd-final">
      <Stroke d={d} line={{ ...LINES.final, colour: colour.value }} />
    </g>
  );
}

/** Where the leader's last turn ends; null if it has none to come. */
function finalLegStart(route: LeaderRoute | null): Place | null {
  const segments = route?.segments ?? [];
  return segments.length > 1 ? (segments.at(-1)?.start ?? null) : null;
}
