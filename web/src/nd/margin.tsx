import { useComputed } from "@preact/signals";
import { isRound } from "./circle";
import type { LayerProps } from "./layer";
import { ink, LINES } from "./style";
import { placeAt, toMap } from "./view";

/** Nearer to the minimum it would not be told from it [px]. */
const APART = 2;

/** What guidance keeps beside the minimum for what it is not certain of, round the leader. */
export function MarginCircle({ shown, view }: LayerProps) {
  const { picture } = shown;
  const place = useComputed(() => {
    const { leader } = picture.value;
    return leader === null || !isRound(picture.value)
      ? ""
      : placeAt(toMap(view.layout.value, leader));
  });
  const margin = useComputed(() => (picture.value.now?.margin_m ?? 0) * view.layout.value.scale);
  const radius = useComputed(() => picture.value.keepOut * view.layout.value.scale + margin.value);
  const isShown = useComputed(() => place.value !== "" && margin.value >= APART);
  if (!isShown.value) return null;
  const { colour, width, dash } = LINES.margin;
  return (
    <g class="nd-margin" transform={place}>
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
