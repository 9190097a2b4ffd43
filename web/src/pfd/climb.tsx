/** Rate of climb: a scale that is finer near level flight, its pointer, and the number where it is worth one. */

import { Stroke } from "../nd/stroke";
import { ink } from "../nd/style";
import { FT } from "../units";
import type { Attitude } from "./attitude";
import { CLIMB, CLIMB_MARKS, climbOffset, down, MIDDLE } from "./face";
import { type PartProps, Sheet, Still, useReading, Window } from "./sheet";

/** Slower than this has no number [ft/min]. */
const SHOWN = 150;
const SCALE = { colour: "scale", width: 2, dash: "" } as const;

function feetPerMinute({ climb }: Attitude): number {
  return (60 * climb) / FT;
}

/** In hundreds of ft/min. */
function text(attitude: Attitude): string {
  const feet = feetPerMinute(attitude);
  return Math.abs(feet) < SHOWN ? "" : String(Math.round(Math.abs(feet) / 100));
}

const isUp = ({ climb }: Attitude) => climb > 0;
const move = ({ climb }: Attitude) => `translateY(${down(-climbOffset(climb))})`;

export function Climb({ gauge }: PartProps) {
  const number = useReading(gauge, text, "");
  const up = useReading(gauge, isUp, false);
  const offsets = CLIMB_MARKS.map((mark) => ({ mark, at: climbOffset((mark * FT) / 60) }));
  const ends = [1, -1].flatMap((side) =>
    offsets.map(({ mark, at }) => ({ mark, y: MIDDLE.y - side * at })),
  );
  const { x, y, width, height } = CLIMB;
  const numberAt = up.value ? y + 18 : y + height - 6;
  return (
    <>
      <Still>
        <rect class="pfd-tape" {...CLIMB} />
        <Stroke
          d={[`M${x + 2} ${MIDDLE.y}h20`, ...ends.map((end) => `M${x + 2} ${end.y}h10`)].join("")}
          line={SCALE}
        />
        {ends.map((end) => (
          <text
            key={end.y}
            class="nd-text"
            x={x + 16}
            y={end.y + 7}
            font-size={20}
            fill={ink("scale")}
          >
            {end.mark / 1000}
          </text>
        ))}
      </Still>
      <Window box={CLIMB}>
        <Sheet gauge={gauge} name="pfd-climb" move={move}>
          <path class="pfd-solid" d={`M${x + 30} ${MIDDLE.y}l26 -8v16Z`} fill={ink("value")} />
        </Sheet>
      </Window>
      <Still>
        <text
          class="nd-text"
          x={x + width - 4}
          y={numberAt}
          font-size={20}
          text-anchor="end"
          fill={ink("value")}
        >
          {number}
        </text>
        <text
          class="nd-text"
          x={x + width / 2}
          y={y + height + 22}
          font-size={20}
          text-anchor="middle"
          fill={ink("unit")}
        >
          V/S
        </text>
      </Still>
    </>
  );
}
