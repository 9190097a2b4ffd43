import { useComputed } from "@preact/signals";
import { formatMiles } from "../units";
import { type LayerProps, shownReading } from "./picture";
import { ink } from "./style";
import { placeAt } from "./view";

/** Offset from the leader's route, beside the own ship, once it is to be kept small. */
export function CrossTrack({ flight, view }: LayerProps) {
  const text = useComputed(() => {
    const shown = shownReading(flight);
    return shown?.look.crossTrack === true ? formatSide(shown.now.cross_track_m) : "";
  });
  const place = useComputed(() => {
    const { x, y } = view.layout.value.centre;
    return placeAt({ x: x + 32, y: y + 24 });
  });
  return (
    <text class="nd-text" fill={ink("value")} font-size={20} transform={place}>
      {text}
    </text>
  );
}

/** An offset with its side, e.g. "0.3R"; "" below 0.05 NM. */
export function formatSide(offset: number): string {
  const miles = formatMiles(Math.abs(offset));
  return miles === "0.0" ? "" : `${miles}${offset > 0 ? "R" : "L"}`;
}
