/**
 * How far apart the two are, against what is to be kept: now, a minute on at the present closure, and at
 * the least on the way. The scale doubles from mark to mark.
 */

import { useMemo } from "preact/hooks";
import { Stroke } from "../nd/stroke";
import { ink, SEPARATION } from "../nd/style";
import type { Separation } from "../store/states";
import { formatMiles, formatSignedKnots } from "../units";
import type { Attitude } from "./attitude";
import { APART, across, apartMarks, apartOffset } from "./face";
import { type PartProps, Sheet, Still, useReading } from "./sheet";

/** The hollow pointer shows where this leads so soon [s]. */
const AHEAD = 60;

export interface Spacings {
  /** d_min and D [m]. */
  readonly minSeparation: number;
  readonly slotDistance: number;
  /** The least on the way [m]; null where no path says. */
  readonly least: number | null;
  readonly state: Separation;
  /** Whether it is known where the leader is. */
  readonly isKnown: boolean;
}

export function Apart(props: PartProps & Spacings) {
  const { gauge, minSeparation, slotDistance, least, state, isKnown } = props;
  const marks = apartMarks(minSeparation);
  const [first = 1] = marks;
  const at = (separation: number) => APART.x + apartOffset(separation, first);
  const now = useMemo(() => pointerAt(first, 0), [first]);
  const soon = useMemo(() => pointerAt(first, AHEAD), [first]);
  const miles = useReading(gauge, milesText, "");
  const closure = useReading(gauge, closureText, "");
  const { x, y, width } = APART;
  const look = SEPARATION[state];
  const limit = at(minSeparation);
  return (
    <>
      <Still name="pfd-apart">
        <text class="nd-text" x={x} y={y - 34} font-size={20} fill={ink("label")}>
          SEP
        </text>
        <text
          class="nd-text"
          x={x + 52}
          y={y - 34}
          font-size={24}
          fill={ink(state === "kept" ? "value" : look.colour)}
        >
          {isKnown ? miles : "---"}
          <tspan font-size={20} fill={ink("unit")}>
            {" NM"}
          </tspan>
        </text>
        <text class="nd-text" x={x + 210} y={y - 34} font-size={20} fill={ink("label")}>
          MIN <tspan fill={ink(look.colour)}>{formatMiles(minSeparation)}</tspan>
          {"  D "}
          <tspan fill={ink("selected")}>{formatMiles(slotDistance)}</tspan>
          {least === null ? "" : "  LEAST "}
          <tspan fill={ink("value")}>{least === null ? "" : formatMiles(least)}</tspan>
        </text>
        <text
          class="nd-text"
          x={x + width}
          y={y - 34}
          font-size={20}
          text-anchor="end"
          fill={ink("value")}
        >
          {isKnown ? closure : "CLS ---"}
          <tspan fill={ink("unit")}>{" KT"}</tspan>
        </text>
        <rect
          class={`pfd-below ${state}`}
          x={x}
          y={y - 9}
          width={limit - x}
          height={9}
          fill={ink(state === "kept" ? "caution" : look.colour)}
        />
        <Stroke
          d={`M${x} ${y}h${width}${marks.map((mark) => `M${at(mark * 1852)} ${y}v9`).join("")}`}
          line={{ colour: "scale", width: 2, dash: "" }}
        />
        {marks.map((mark) => (
          <text
            key={mark}
            class="nd-text"
            x={at(mark * 1852)}
            y={y + 29}
            font-size={20}
            text-anchor="middle"
            fill={ink("scale")}
          >
            {mark}
          </text>
        ))}
        <Stroke
          d={`M${limit} ${y - 16}V${y + 9}`}
          line={{ colour: look.colour === "label" ? "caution" : look.colour, width: 3, dash: "" }}
        />
        <path
          class="pfd-mark"
          d={`M${at(slotDistance)} ${y + 1}l-8 13h16Z`}
          stroke={ink("selected")}
        />
        {least !== null && (
          <path
            class="pfd-mark"
            d={`M${at(least)} ${y - 18}l7 8l-7 8l-7 -8Z`}
            stroke={ink("value")}
          />
        )}
      </Still>
      {isKnown && (
        <>
          <Sheet gauge={gauge} name="pfd-soon" move={soon}>
            <path class="pfd-mark" d={`M${x} ${y - 2}l-7 -14h14Z`} stroke={ink("label")} />
          </Sheet>
          <Sheet gauge={gauge} name="pfd-now" move={now}>
            <path
              class="pfd-solid"
              d={`M${x} ${y - 2}l-9 -18h18Z`}
              fill={ink(state === "kept" ? "value" : look.colour)}
            />
          </Sheet>
        </>
      )}
    </>
  );
}

/** Where a pointer stands that shows the separation `ahead` [s] from now. */
function pointerAt(first: number, ahead: number) {
  return ({ separation, closure }: Attitude) =>
    `translateX(${across(apartOffset(separation - closure * ahead, first))})`;
}

const milesText = ({ separation }: Attitude) => formatMiles(separation);
/** Positive while it shrinks. */
const closureText = ({ closure }: Attitude) => `CLS ${formatSignedKnots(closure)}`;
