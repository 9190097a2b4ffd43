import { useComputed } from "@preact/signals";
import { type LayerProps, usePart } from "./layer";
import { Stroke } from "./stroke";
import { LINES } from "./style";
import { offNose, placeAt, polar, round } from "./view";

/** Where the ground velocity points, on the tape. */
export function TrackDiamond({ shown, view }: LayerProps) {
  const place = useComputed(() => {
    const own = shown.picture.value.now?.pursuer;
    if (own === undefined) return null;
    const direction = offNose(own, own.track_deg);
    return placeAt(polar(view.layout.value, direction, view.layout.value.tape - 9), direction);
  });
  const isShown = usePart(shown, ({ now }) => now !== null);
  const at = useComputed(() => place.value ?? "");
  if (!isShown.value) return null;
  return (
    <g class="nd-track" transform={at}>
      <Stroke d="M0 -9L6 0L0 9L-6 0Z" line={{ ...LINES.track, width: 2.5 }} />
    </g>
  );
}

/** From the own ship to the tape along its track, while no path says where it goes. */
export function TrackLine({ shown, view }: LayerProps) {
  const d = useComputed(() => {
    const { now, style } = shown.picture.value;
    const own = now?.pursuer;
    if (own === undefined || style?.trackLine === false) return "";
    const { centre, tape } = view.layout.value;
    const end = polar(view.layout.value, offNose(own, own.track_deg), tape);
    return `M${centre.x} ${centre.y}L${round(end.x)} ${round(end.y)}`;
  });
  return (
    <g class="nd-trackline">
      <Stroke d={d} line={LINES.track} />
    </g>
  );
}
