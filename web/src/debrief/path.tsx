/** From above, north up: the path that was flown over the one to compare with, and where time was lost. */

import type { History } from "../store/history";
import { NM } from "../units";
import type { PathPoint } from "../wire";
import type { Stretch } from "./losses";
import type { Flown } from "./seconds";

/** The box that it is drawn in: so wide, at least and at most so high; and its edge [px]. */
const WIDTH = 420;
const LOWEST = 130;
const HIGHEST = 300;
const EDGE = 26;
/** The bar of the scale is one of these [NM]. */
const SCALES = [1, 2, 5, 10, 20, 50, 100] as const;

type Place = Pick<PathPoint, "x_m" | "y_m">;
type Pixel = (place: Place) => readonly [x: number, y: number];

interface Props {
  readonly history: History;
  readonly flown: Flown;
  readonly fastest: readonly PathPoint[];
  readonly worst: readonly Stretch[];
  /** Where own ship is at the instant that is shown. */
  readonly now: Place | null;
}

export function PathPicture({ history, flown, fastest, worst, now }: Props) {
  const own = flown.seconds.map(({ sample }) => sample.pursuer);
  const leader = flown.seconds.map(({ sample }) => sample.leader);
  const all: Place[] = [...own, ...leader, ...fastest];
  if (all.length === 0) return null;
  const { pixel, scale, height } = boxOf(all);
  const spot = ({ from, to }: Stretch) =>
    flown.seconds.filter(({ t }) => t >= from && t <= to).map(({ sample }) => sample.pursuer);
  const bar = SCALES.findLast((miles) => miles * NM * scale <= WIDTH / 3) ?? SCALES[0];
  const wide = Math.round(bar * NM * scale);
  const end = own.at(-1);
  const { started } = history.knownAt(Number.POSITIVE_INFINITY);
  return (
    <svg
      class="debrief-path"
      viewBox={`0 0 ${WIDTH} ${height}`}
      role="img"
      aria-label={`Seen from above, north up: the path of ${started?.pursuer.ident ?? "own ship"}, solid, over the one to compare with, dashed`}
    >
      <Trace name="leader" points={leader} pixel={pixel} />
      <Trace name="fastest" points={fastest} pixel={pixel} />
      <Trace name="own" points={own} pixel={pixel} />
      {worst.map((each, k) => (
        <g key={each.from}>
          <Trace name="lost" points={spot(each)} pixel={pixel} />
          <Word at={spot(each)[0]} pixel={pixel} text={String(k + 1)} name="lost" />
        </g>
      ))}
      <Word at={own[0]} pixel={pixel} text="YOU" name="own" />
      <Word at={leader[0]} pixel={pixel} text="LEADER" name="leader" />
      {flown.joined !== null && <Word at={end} pixel={pixel} text="JOINED" name="own" />}
      {now !== null && <circle class="debrief-now" {...centre(pixel(now))} r="4.5" />}
      <g class="debrief-scale" transform={`translate(${WIDTH - EDGE / 2 - wide} ${height - 8})`}>
        <path d={`M0-4v4h${wide}v-4`} />
        <text x={wide / 2} y="-6" text-anchor="middle">
          {bar} NM
        </text>
      </g>
    </svg>
  );
}

function centre([cx, cy]: readonly [number, number]) {
  return { cx, cy };
}

/** One line, with a dark one beneath. */
function Trace(props: { name: string; points: readonly Place[]; pixel: Pixel }) {
  if (props.points.length < 2) return null;
  const d = `M${props.points.map((each) => props.pixel(each).join(" ")).join("L")}`;
  return (
    <>
      <path class="under" d={d} />
      <path class={props.name} d={d} />
    </>
  );
}

function Word(props: { at: Place | undefined; pixel: Pixel; text: string; name: string }) {
  if (props.at === undefined) return null;
  const [x, y] = props.pixel(props.at);
  const isRight = x > WIDTH - 70;
  return (
    <text
      class={props.name}
      x={isRight ? x - 7 : x + 7}
      y={y - 7}
      text-anchor={isRight ? "end" : "start"}
    >
      {props.text}
    </text>
  );
}

/** All places in the box, the same scale both ways [px/m]. */
function boxOf(places: readonly Place[]): { pixel: Pixel; scale: number; height: number } {
  const least = (axis: keyof Place) =>
    places.reduce((m, each) => Math.min(m, each[axis]), Infinity);
  const most = (axis: keyof Place) =>
    places.reduce((m, each) => Math.max(m, each[axis]), -Infinity);
  const [west, east, south, north] = [least("x_m"), most("x_m"), least("y_m"), most("y_m")];
  const scale = Math.min(
    (WIDTH - 2 * EDGE) / Math.max(1, east - west),
    (HIGHEST - 2 * EDGE) / Math.max(1, north - south),
  );
  const [x0, y0] = [(west + east) / 2, (south + north) / 2];
  const rounded = (value: number) => Math.round(10 * value) / 10;
  const height = Math.max(LOWEST, Math.round(scale * (north - south)) + 2 * EDGE);
  return {
    scale,
    height,
    pixel: ({ x_m, y_m }) => [
      rounded(WIDTH / 2 + scale * (x_m - x0)),
      rounded(height / 2 - scale * (y_m - y0)),
    ],
  };
}
