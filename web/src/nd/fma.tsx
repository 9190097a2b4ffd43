import { useComputed } from "@preact/signals";
import type { Colour } from "../store/colours";
import { Cell } from "./cell";
import { type LayerProps, usePart } from "./layer";
import { trendSign } from "./leader";
import { ink } from "./style";
import { READOUTS } from "./view";

const COLUMN = READOUTS.fma.width / 5;
const LEVEL = { "": "ALT", "↑": "CLB", "↓": "DES" } as const;
const ROW = { now: 23, next: 48 } as const;

/** The mode strip: what is engaged (upper row, green) and what comes next (lower row, cyan). */
export function ModeStrip({ shown }: LayerProps) {
  const { numbers } = shown;
  const modes = usePart(shown, (picture) => picture.style);
  const lateral = useComputed(() => modes.value?.lateral.now ?? "");
  const lateralNext = useComputed(() => modes.value?.lateral.next ?? "");
  const commander = usePart(shown, (picture) => picture.speed);
  const speed = useComputed(() =>
    commander.value.now === "" ? "" : `${commander.value.now} ${numbers.value.commandedSpeed}`,
  );
  const speedNext = useComputed(() => commander.value.next);
  const climb = usePart(shown, (picture) => trendSign(picture.climb));
  const level = useComputed(() => (modes.value === null ? "" : LEVEL[climb.value]));
  const spacing = useComputed(() =>
    numbers.value.isSpacing ? `D ${numbers.value.slotDistance}` : "",
  );
  const speedColour = usePart(shown, ({ speed }): Colour => {
    return speed.isSelected ? "selected" : "value";
  });
  // the lower row shows what became of an order: the upper one then shows who flies
  const pilot = usePart(shown, ({ order, pilot: { now, next } }) =>
    order === "" ? now : `${now} ${next}`.trim(),
  );
  const pilotNext = usePart(shown, ({ order, pilot }) => (order === "" ? pilot.next : ""));
  const isNewPilot = usePart(shown, (picture) => picture.pilot.boxed);
  const isLost = usePart(shown, (picture) => picture.pilot.isLost);
  const isNewMode = usePart(shown, (picture) => picture.boxed);
  const isNewSpeed = usePart(shown, (picture) => picture.speed.boxed);
  const middle = (column: number) => COLUMN * (column + 0.5);
  const { height, width } = READOUTS.fma;
  return (
    <g class="nd-fma">
      <rect class="nd-ground" x={0} y={0} width={width} height={height} />
      <path
        class="nd-rule"
        d={`M0 ${height}H${width}${[1, 2, 3, 4].map((i) => `M${COLUMN * i} 4V${height - 6}`).join("")}`}
      />
      <Cell x={middle(0)} y={ROW.now} text={speed} colour={speedColour} anchor="middle" />
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
      {pilotNext.value !== "" && (
        <Cell
          x={middle(4)}
          y={ROW.next}
          text={pilotNext}
          colour="label"
          anchor="middle"
          size={20}
        />
      )}
      {isNewSpeed.value && <Box column={0} />}
      {isNewMode.value && <Box column={2} />}
      {isNewPilot.value && <Box column={4} isLost={isLost.value} />}
    </g>
  );
}

/** The frame round what is new: white, or amber where it was not asked for. */
function Box({ column, isLost = false }: { column: number; isLost?: boolean }) {
  return (
    <rect
      class="nd-box"
      x={COLUMN * column + 8}
      y={3}
      width={COLUMN - 16}
      height={26}
      {...(isLost && { style: `stroke:${ink("caution")}` })}
    />
  );
}
