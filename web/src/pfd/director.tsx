/** The flight director's bars: where they stand, the crew is to bring own ship. */

import { Stroke } from "../nd/stroke";
import { ink } from "../nd/style";
import { across, BALL, down, MIDDLE, pullOffset, rollOffset } from "./face";
import { type PartProps, Sheet, Still, Window } from "./sheet";

const LINE = { colour: "plan", width: 5, dash: "" } as const;
/** Half as long as a bar is [px]. */
const HALF = 92;

/** seen: the bars are in view; missing: it is on, and nothing is commanded; off. */
export type Director = "off" | "seen" | "missing";

interface Props extends PartProps {
  readonly director: Director;
  /** Whether guidance has just given up what it commanded: then they call for the crew. */
  readonly isReverted: boolean;
}

export function Bars({ gauge, director, isReverted }: Props) {
  if (director === "off") return null;
  const flash = isReverted ? " pfd-flash" : "";
  if (director === "missing")
    return (
      <Still name={`pfd-flag${flash}`}>
        <text
          class="nd-text"
          x={BALL.x + 20}
          y={BALL.y + BALL.height - 22}
          font-size={26}
          fill={ink("caution")}
        >
          FD
        </text>
      </Still>
    );
  const { x, y } = MIDDLE;
  return (
    <Window box={BALL}>
      <Sheet
        gauge={gauge}
        name={`pfd-roll${flash}`}
        move={({ roll }) => `translateX(${across(rollOffset(roll))})`}
      >
        <Stroke d={`M${x} ${y - HALF}V${y + HALF}`} line={LINE} />
      </Sheet>
      <Sheet
        gauge={gauge}
        name={`pfd-pull${flash}`}
        move={({ pull }) => `translateY(${down(-pullOffset(pull))})`}
      >
        <Stroke d={`M${x - HALF} ${y}H${x + HALF}`} line={LINE} />
      </Sheet>
    </Window>
  );
}
