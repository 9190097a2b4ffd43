import { useComputed } from "@preact/signals";
import { type LayerProps, usePart } from "./layer";
import { Stroke } from "./stroke";
import { ink } from "./style";
import { placeAt } from "./view";

export const SHAPE = "M0 -20V22M-24 0H24M-9 18H9";

/** The own ship; a red circle when nothing is known of where its nose points. */
export function OwnShip({ shown, view }: LayerProps) {
  const valid = usePart(shown, ({ now }) => now !== null);
  const place = useComputed(() => placeAt(view.layout.value.centre));
  return (
    <g class="nd-ownship" transform={place}>
      {valid.value ? (
        <Stroke d={SHAPE} line={{ colour: "ownship", width: 5, dash: "" }} />
      ) : (
        <circle class="nd-stroke" r={9} stroke={ink("alert")} stroke-width={3} />
      )}
    </g>
  );
}
