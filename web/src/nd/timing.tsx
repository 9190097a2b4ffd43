import { useComputed } from "@preact/signals";
import { Cell } from "./cell";
import type { LayerProps } from "./layer";
import { Stroke } from "./stroke";
import { LINES } from "./style";
import { placeAt, READOUTS } from "./view";

/** Half its height, and that of the gate in its middle [px]: the scale ends at 2 NM, the gate at 0.2. */
const HALF = 52;
const GATE = HALF / 10;
const DOTS = [-1, -0.5, 0.5, 1].map((part) => `M-5 ${HALF * part}H5`).join("");

/** Early or late: the slot's index in the middle of a scale, own ship's pointer beside it. */
export function TimingScale({ shown: { numbers } }: LayerProps) {
  const isShown = useComputed(() => numbers.value.timing !== null);
  const text = useComputed(() => numbers.value.timing?.text ?? "");
  // What is late is behind, and behind is down.
  const pointer = useComputed(() =>
    placeAt({ x: 0, y: HALF * (numbers.value.timing?.offset ?? 0) }),
  );
  if (!isShown.value) return null;
  const { x, y, width, height } = READOUTS.timing;
  const middle = { x: width - 24, y: HALF + 10 };
  return (
    <g class="nd-timing" transform={placeAt({ x, y })}>
      <rect class="nd-ground" width={width} height={height} />
      <g transform={placeAt(middle)}>
        <Stroke d={`${DOTS}M0 ${-HALF}V${HALF}`} line={LINES.tape} />
        <Stroke d={`M-10 ${-GATE}H10V${GATE}H-10Z`} line={LINES.bug} />
        <g transform={pointer}>
          <Stroke d="M-14 0L-28 -7V7Z" line={LINES.mark} />
        </g>
      </g>
      <Cell x={width - 4} y={height - 6} text={text} colour="value" size={18} anchor="end" />
    </g>
  );
}
