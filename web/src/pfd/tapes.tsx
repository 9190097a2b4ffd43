/** Speed, level and heading: tapes that run past a fixed mark. What lies far off is not drawn. */

import { useComputed } from "@preact/signals";
import type { JSX } from "preact";
import { useMemo } from "preact/hooks";
import { Stroke } from "../nd/stroke";
import { ink } from "../nd/style";
import type { Colour } from "../store/colours";
import { wrap180, wrap360 } from "../units";
import type { Attitude } from "./attitude";
import { across, BESIDE, down, feet, HEADING, knots, LEVEL, MIDDLE, PER, SPEED } from "./face";
import { type PartProps, Sheet, Still, useReading, Window } from "./sheet";

/** A value that is marked on a tape. */
export interface Bug {
  readonly value: number;
  readonly colour: Colour;
}

/** A tape is drawn anew when it has run so far, and reaches so far beyond its window. */
const SPEED_BLOCK = 20;
const LEVEL_BLOCK = 200;
const HEADING_BLOCK = 10;

const SCALE = { colour: "scale", width: 2, dash: "" } as const;

/** From `middle` so many `step`s each way. */
function marks(middle: number, step: number, reach: number): number[] {
  const count = Math.ceil(reach / step);
  return Array.from({ length: 2 * count + 1 }, (_, k) => middle + (k - count) * step);
}

function nearest(value: number, block: number): number {
  return Math.round(value / block) * block;
}

interface SpeedProps extends PartProps {
  readonly bug: Bug | null;
  /** The least speed [kt]; null where it is not known. */
  readonly least: number | null;
}

export function SpeedTape({ gauge, bug, least }: SpeedProps) {
  const block = useReading(gauge, blockOfSpeed, 0);
  const middle = block.value;
  const move = useMemo(
    () => (attitude: Attitude) =>
      `translateY(${down((knots(attitude) - blockOfSpeed(attitude)) * PER.knot)})`,
    [],
  );
  const right = SPEED.x + SPEED.width;
  const at = (speed: number) => MIDDLE.y - (speed - middle) * PER.knot;
  const all = marks(middle, 10, 80).filter((speed) => speed >= 0);
  return (
    <>
      <TapeGround box={SPEED} />
      <Window box={{ ...SPEED, width: SPEED.width + BESIDE }}>
        <Sheet gauge={gauge} name="pfd-speed" move={move}>
          <Stroke d={all.map((speed) => `M${right} ${at(speed)}h-12`).join("")} line={SCALE} />
          {all
            .filter((speed) => speed % 20 === 0)
            .map((speed) => (
              <Mark key={speed} x={right - 20} y={at(speed)} text={String(speed)} end />
            ))}
          {least !== null && <TooSlow x={right + 1} y={at(least)} />}
          {bug !== null && (
            <path
              class="pfd-solid"
              d={`M${right + 1} ${at(bug.value)}l14 -11v22Z`}
              fill={ink(bug.colour)}
            />
          )}
        </Sheet>
      </Window>
      {bug !== null && (
        <OffTape gauge={gauge} box={SPEED} read={knots} bug={bug} per={PER.knot} digits={3} />
      )}
      <Readout gauge={gauge} box={SPEED} read={speedText} label="KT TAS" />
    </>
  );
}

/** It reaches beyond the window wherever it begins in it [px]. */
const STRIP = { width: 9, length: 480, every: 10 } as const;

/** Speeds that cannot be flown: a hatched strip beside the tape, from the least speed down. */
function TooSlow({ x, y }: { readonly x: number; readonly y: number }) {
  const hatches = Array.from({ length: STRIP.length / STRIP.every }, (_, k) => {
    return `M${x} ${y + STRIP.every * (k + 1)}l${STRIP.width} ${-STRIP.every}`;
  });
  const edge = `M${x - 6} ${y}h${STRIP.width + 6}v${STRIP.length}`;
  return <Stroke d={edge + hatches.join("")} line={{ colour: "alert", width: 3, dash: "" }} />;
}

const blockOfSpeed = (attitude: Attitude) => nearest(knots(attitude), SPEED_BLOCK);
const speedText = (attitude: Attitude) => String(Math.round(knots(attitude)));

export function LevelTape({ gauge, bug }: PartProps & { readonly bug: Bug | null }) {
  const block = useReading(gauge, blockOfLevel, 0);
  const middle = block.value;
  const move = useMemo(
    () => (attitude: Attitude) =>
      `translateY(${down((feet(attitude) - blockOfLevel(attitude)) * PER.foot)})`,
    [],
  );
  const at = (level: number) => MIDDLE.y - (level - middle) * PER.foot;
  const all = marks(middle, 100, 900);
  return (
    <>
      <TapeGround box={LEVEL} />
      <Window box={{ ...LEVEL, x: LEVEL.x - BESIDE, width: LEVEL.width + BESIDE }}>
        <Sheet gauge={gauge} name="pfd-level" move={move}>
          <Stroke d={all.map((level) => `M${LEVEL.x} ${at(level)}h12`).join("")} line={SCALE} />
          {all
            .filter((level) => level % 200 === 0)
            .map((level) => (
              <Mark key={level} x={LEVEL.x + 20} y={at(level)} text={levelMark(level)} />
            ))}
          {bug !== null && (
            <path
              class="pfd-mark"
              d={`M${LEVEL.x - 2} ${at(bug.value) - 22}h-12v13l7 9l-7 9v13h12Z`}
              stroke={ink(bug.colour)}
            />
          )}
        </Sheet>
      </Window>
      {bug !== null && (
        <OffTape gauge={gauge} box={LEVEL} read={feet} bug={bug} per={PER.foot} digits={0} />
      )}
      <Readout gauge={gauge} box={LEVEL} read={levelText} label="FT" />
    </>
  );
}

const blockOfLevel = (attitude: Attitude) => nearest(feet(attitude), LEVEL_BLOCK);
/** In steps of 20 ft, as they are read. */
const levelText = (attitude: Attitude) => String(Math.round(feet(attitude) / 20) * 20);
const levelMark = (level: number) => String(level / 100).padStart(3, "0");

export function HeadingTape(
  props: PartProps & { readonly bug: Bug | null; readonly track: number },
) {
  const { gauge, bug, track } = props;
  const block = useReading(gauge, blockOfHeading, 0);
  const middle = block.value;
  const move = useMemo(
    () => (attitude: Attitude) => {
      const past = wrap180(attitude.heading - blockOfHeading(attitude));
      return `translateX(${across(-past * PER.degree)})`;
    },
    [],
  );
  const { y } = HEADING;
  const at = (heading: number) => MIDDLE.x + wrap180(heading - middle) * PER.degree;
  const all = marks(middle, 5, 45);
  return (
    <>
      <TapeGround box={HEADING} />
      <Window box={HEADING}>
        <Sheet gauge={gauge} name="pfd-heading" move={move}>
          <Stroke
            d={all.map((heading) => `M${at(heading)} ${y}v${heading % 10 === 0 ? 13 : 8}`).join("")}
            line={SCALE}
          />
          {all
            .filter((heading) => heading % 10 === 0)
            .map((heading) => (
              <text
                key={heading}
                class="nd-text"
                x={at(heading)}
                y={y + (heading % 30 === 0 ? 37 : 35)}
                font-size={heading % 30 === 0 ? 24 : 20}
                text-anchor="middle"
                fill={ink("scale")}
              >
                {wrap360(heading) / 10}
              </text>
            ))}
          <path
            class="pfd-mark"
            d={`M${at(track)} ${y + 1}l6 9l-6 9l-6 -9Z`}
            stroke={ink("value")}
          />
          {bug !== null && (
            <path
              class="pfd-mark"
              d={`M${at(bug.value)} ${y + 2}l-11 16h22Z`}
              stroke={ink(bug.colour)}
            />
          )}
        </Sheet>
      </Window>
      <Still>
        <Stroke
          d={`M${MIDDLE.x} ${y - 9}V${y + 17}`}
          line={{ colour: "ownship", width: 4, dash: "" }}
        />
      </Still>
    </>
  );
}

const blockOfHeading = (attitude: Attitude) => nearest(attitude.heading, HEADING_BLOCK) % 360;

type Place = {
  readonly x: number;
  readonly y: number;
  readonly width: number;
  readonly height: number;
};

function TapeGround({ box }: { box: Place }): JSX.Element {
  return (
    <Still>
      <rect class="pfd-tape" {...box} />
    </Still>
  );
}

function Mark(props: { x: number; y: number; text: string; end?: boolean }) {
  const { x, y, text, end = false } = props;
  return (
    <text
      class="nd-text"
      x={x}
      y={y + 7}
      font-size={20}
      text-anchor={end ? "end" : "start"}
      fill={ink("scale")}
    >
      {text}
    </text>
  );
}

interface ReadoutProps extends PartProps {
  readonly box: Place;
  readonly read: (attitude: Attitude) => string;
  readonly label: string;
}

/** What the mark stands at, in large digits, and in what it is counted. */
function Readout({ gauge, box, read, label }: ReadoutProps) {
  const text = useReading(gauge, read, "");
  const { x, width } = box;
  return (
    <Still>
      <path
        class="pfd-window"
        d={`M${x} ${MIDDLE.y - 21}h${width}v42h${-width}Z`}
        stroke={ink("ownship")}
      />
      <text
        class="nd-text"
        x={x + width - 4}
        y={MIDDLE.y + 9}
        font-size={26}
        text-anchor="end"
        fill={ink("value")}
      >
        {text}
      </text>
      <text
        class="nd-text"
        x={x + width / 2}
        y={box.y + box.height + 22}
        font-size={20}
        text-anchor="middle"
        fill={ink("unit")}
      >
        {label}
      </text>
    </Still>
  );
}

interface OffTapeProps extends PartProps {
  readonly box: Place;
  readonly read: (attitude: Attitude) => number;
  readonly bug: Bug;
  readonly per: number;
  readonly digits: number;
}

/** What is marked beyond the tape's end is written there. */
function OffTape({ gauge, box, read, bug, per, digits }: OffTapeProps) {
  const way = useMemo(
    () => (attitude: Attitude) => {
      const off = (bug.value - read(attitude)) * per;
      return Math.abs(off) > box.height / 2 - 8 ? Math.sign(off) : 0;
    },
    [bug.value, read, per, box],
  );
  const side = useReading(gauge, way, 0);
  const y = useComputed(() => (side.value > 0 ? box.y + 20 : box.y + box.height - 8));
  if (side.value === 0) return null;
  const value = Math.round(bug.value);
  return (
    <Still>
      <rect class="pfd-tape" x={box.x} y={y.value - 20} width={box.width} height={26} />
      <text
        class="nd-text"
        x={box.x + box.width / 2}
        y={y}
        font-size={20}
        text-anchor="middle"
        fill={ink(bug.colour)}
      >
        {digits > 0 ? value : `FL${levelMark(Math.round(value / 100) * 100)}`}
      </text>
    </Still>
  );
}
