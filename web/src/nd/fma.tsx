import { useComputed } from "@preact/signals";
import { formatKnots, formatMiles } from "../units";
import { Cell } from "./cell";
import { type LayerProps, shownGuidance } from "./picture";
import { wallNow } from "./states";
import { GUIDANCE } from "./style";
import { READOUTS } from "./view";

/** A new mode is boxed this long [ms]. */
const BOXED = 10_000;
const COLUMN = READOUTS.fma.width / 5;
const ROW = { now: 23, next: 48 } as const;

/** The mode strip: what is engaged (upper row, green) and what comes next (lower row, cyan). */
export function ModeStrip({ flight }: LayerProps) {
  // What is engaged, whatever guidance is able to do: by the mode, not by the picture's state.
  const look = useComputed(() => {
    const shown = shownGuidance(flight);
    if (shown === null) return null;
    if (shown.now.mode !== "heading") return { ...GUIDANCE[shown.now.mode], now: shown.now };
    const unable = flight.unavailable.value !== null;
    return { ...GUIDANCE[unable ? "unable" : "off"], now: shown.now };
  });
  const lateral = useComputed(() => look.value?.lateral.now ?? "");
  const lateralNext = useComputed(() => look.value?.lateral.next ?? "");
  const speed = useComputed(() => {
    if (look.value === null) return "";
    return `${look.value.speed.now} ${formatKnots(look.value.now.commanded_tas_mps)}`;
  });
  const speedNext = useComputed(() => look.value?.speed.next ?? "");
  const level = useComputed(() => (look.value === null ? "" : "ALT"));
  const spacing = useComputed(() => {
    const distance = flight.started.value?.slot_distance_m;
    return look.value === null || distance === undefined ? "" : `D ${formatMiles(distance)}`;
  });
  const pilot = useComputed(() => (look.value === null ? "" : "AP1"));
  const boxed = useComputed(
    () => look.value !== null && wallNow(flight) - flight.modeSince.value < BOXED,
  );
  const middle = (column: number) => COLUMN * (column + 0.5);
  const { height, width } = READOUTS.fma;
  return (
    <g class="nd-fma">
      <rect class="nd-ground" x={0} y={0} width={width} height={height} />
      <path
        class="nd-rule"
        d={`M0 ${height}H${width}${[1, 2, 3, 4].map((i) => `M${COLUMN * i} 4V${height - 6}`).join("")}`}
      />
      <Cell x={middle(0)} y={ROW.now} text={speed} colour="value" anchor="middle" />
      <Cell x={middle(1)} y={ROW.now} text={level} colour="value" anchor="middle" />
      <Cell x={middle(2)} y={ROW.now} text={lateral} colour="value" anchor="middle" />
      <Cell x={middle(3)} y={ROW.now} text={spacing} colour="selected" anchor="middle" />
      <Cell x={middle(4)} y={ROW.now} text={pilot} colour="label" anchor="middle" />
      <Cell
        x={middle(0)}
        y={ROW.next}
        text={speedNext}
        colour="selected"
        anchor="middle"
        size={20}
      />
      <Cell
        x={middle(2)}
        y={ROW.next}
        text={lateralNext}
        colour="selected"
        anchor="middle"
        size={20}
      />
      {boxed.value && (
        <rect class="nd-box" x={COLUMN * 2 + 8} y={3} width={COLUMN - 16} height={26} />
      )}
    </g>
  );
}
