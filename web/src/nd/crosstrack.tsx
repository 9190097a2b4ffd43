import { useComputed } from "@preact/signals";
import type { LayerProps } from "./layer";
import { ink } from "./style";
import { placeAt } from "./view";

/** Offset from the leader's route, beside the own ship, once it is to be kept small. */
export function CrossTrack({ shown, view }: LayerProps) {
  const { picture, numbers } = shown;
  const text = useComputed(() =>
    picture.value.style?.crossTrack === true ? numbers.value.crossTrack : "",
  );
  const place = useComputed(() => {
    const { x, y } = view.layout.value.centre;
    return placeAt({ x: x + 32, y: y + 24 });
  });
  return (
    <text class="nd-text nd-crosstrack" fill={ink("value")} font-size={20} transform={place}>
      {text}
    </text>
  );
}
