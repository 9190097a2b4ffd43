import { useComputed } from "@preact/signals";
import { useLeaderPlace } from "./circle";
import type { LayerProps } from "./layer";
import { ink, LINES } from "./style";

/** Nearer to the minimum it would not be told from it [px]. */
const APART = 2;

/** What guidance keeps beside the minimum for what it is not certain of, round the leader. */
export function MarginCircle({ shown, view }: LayerProps) {
  const { picture } = shown;
  const place = useLeaderPlace({ shown, view });
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
