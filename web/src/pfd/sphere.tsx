/** The attitude sphere: sky, ground, a rung each 2.5° of pitch; the bank scale, and own ship before it. */

import { Stroke } from "../nd/stroke";
import { ink } from "../nd/style";
import { DEG } from "../units";
import type { Attitude } from "./attitude";
import { ARC, BALL, down, LADDER, MIDDLE, PER } from "./face";
import { type PartProps, Sheet, Still, Window } from "./sheet";

/** The sphere is seen turned and moved: it is larger than its window. */
const FAR = 1400;
const RUNGS = Array.from({ length: 33 }, (_, k) => (k - 16) * 2.5).filter((pitch) => pitch !== 0);
/** Half as wide as a rung is [px]: each 10°, each 5°, and between. */
const HALF = { ten: 52, five: 27, between: 13 } as const;

const TICKS = [10, 20, 30, 45] as const;

export function Sphere({ gauge }: PartProps) {
  const { x, y } = MIDDLE;
  return (
    <>
      <Window box={BALL}>
        <Sheet gauge={gauge} name="pfd-ball" move={turned}>
          <rect class="pfd-sky" x={x - FAR} y={y - FAR} width={2 * FAR} height={FAR} />
          <rect class="pfd-earth" x={x - FAR} y={y} width={2 * FAR} height={FAR} />
          <Stroke d={`M${x - FAR} ${y}H${x + FAR}`} line={{ ...SCALE, width: 2.5 }} />
        </Sheet>
        <Sheet gauge={gauge} name="pfd-index" move={banked}>
          <path class="pfd-solid" d={`M${x} ${y - ARC + 2}l11 19h-22Z`} fill={ink("ownship")} />
        </Sheet>
      </Window>
      <Window box={LADDER}>
        <Sheet gauge={gauge} name="pfd-ladder" move={turned}>
          <Stroke d={rungs()} line={SCALE} />
          {RUNGS.filter((pitch) => pitch % 10 === 0).map((pitch) => (
            <g key={pitch}>
              <Rung pitch={pitch} side={-1} />
              <Rung pitch={pitch} side={1} />
            </g>
          ))}
        </Sheet>
      </Window>
    </>
  );
}

const SCALE = { colour: "scale", width: 2, dash: "" } as const;

function banked({ bank }: Attitude): string {
  return `rotate(${Math.round(-bank * 100) / 100 + 0}deg)`;
}

function turned(attitude: Attitude): string {
  return `${banked(attitude)} translateY(${down(attitude.pitch * PER.pitch)})`;
}

function Rung({ pitch, side }: { pitch: number; side: 1 | -1 }) {
  return (
    <text
      class="nd-text"
      x={MIDDLE.x + side * (HALF.ten + 8)}
      y={MIDDLE.y - pitch * PER.pitch + 7}
      font-size={20}
      text-anchor={side > 0 ? "start" : "end"}
      fill={ink("scale")}
    >
      {Math.abs(pitch)}
    </text>
  );
}

function rungs(): string {
  return RUNGS.map((pitch) => {
    const half = pitch % 10 === 0 ? HALF.ten : pitch % 5 === 0 ? HALF.five : HALF.between;
    return `M${MIDDLE.x - half} ${MIDDLE.y - pitch * PER.pitch}h${2 * half}`;
  }).join("");
}

interface Limits {
  /** What plans turn with [deg]; null while it is not known. */
  readonly planned: number | null;
  /** What the autopilot banks at most [deg]; null where it is not known. */
  readonly most: number | null;
}

/** The bank scale; on it what plans turn with, what the autopilot banks at most, and a hand. */
export function BankScale({ planned, most }: Limits) {
  return (
    <Still name="pfd-bank">
      <Stroke
        d={[0, ...TICKS.flatMap((each) => [each, -each])].map(tick).join("")}
        line={{ colour: "scale", width: 2.5, dash: "" }}
      />
      <path class="pfd-solid" d={`M${MIDDLE.x} ${MIDDLE.y - ARC}l-9 -16h18Z`} fill={ink("scale")} />
      <Stroke
        d={[45, -45].map((angle) => bar(angle, -2, 14)).join("")}
        line={{ colour: "caution", width: 4, dash: "" }}
      />
      {planned !== null && (
        <Stroke
          d={[planned, -planned].flatMap((each) => [bar(each - 1.2), bar(each + 1.2)]).join("")}
          line={{ colour: "plan", width: 3, dash: "" }}
        />
      )}
      {most !== null && (
        <Stroke
          d={[most, -most].map(capped).join("")}
          line={{ colour: "value", width: 3, dash: "" }}
        />
      )}
    </Still>
  );
}

function tick(angle: number): string {
  return bar(angle, 0, angle % 30 === 0 ? 20 : 13);
}

/** A stroke across the scale, from so far within to so far without [px]. */
function bar(angle: number, within = 0, without = 14): string {
  const [sin, cos] = [Math.sin(angle * DEG), -Math.cos(angle * DEG)];
  const [from, to] = [ARC + within, ARC + without];
  const at = (radius: number) =>
    `${round(MIDDLE.x + radius * sin)} ${round(MIDDLE.y + radius * cos)}`;
  return `M${at(from)}L${at(to)}`;
}

/** A stroke with a lid: a limit. */
function capped(angle: number): string {
  const [sin, cos] = [Math.sin(angle * DEG), Math.cos(angle * DEG)];
  const [x, y] = [MIDDLE.x + (ARC + 18) * sin, MIDDLE.y - (ARC + 18) * cos];
  const [east, south] = [7 * cos, 7 * sin];
  const lid = `M${round(x - east)} ${round(y - south)}L${round(x + east)} ${round(y + south)}`;
  return bar(angle, 0, 18) + lid;
}

function round(value: number): number {
  return Math.round(value * 50) / 50 + 0;
}

/** Own ship as it is always: two wings and the nose between them. */
export function Wings() {
  const { x, y } = MIDDLE;
  const wing = (side: 1 | -1) => {
    const out = (length: number) => x + side * length;
    return `M${out(138)} ${y - 4}H${out(72)}V${y + 18}H${out(80)}V${y + 4}H${out(138)}Z`;
  };
  return (
    <Still name="pfd-wings">
      <path class="pfd-symbol" d={`${wing(-1)}${wing(1)}M${x - 5} ${y - 5}h10v10h-10Z`} />
    </Still>
  );
}
