/** Seconds lost by flying over flight time; the worst stretches behind it, the instant shown as a line. */

import { formatClock } from "../units";
import type { Losses } from "./losses";
import type { Flown } from "./seconds";

/** The box that it is drawn in, and room for words at its left and below [px]. */
const WIDTH = 420;
const HEIGHT = 130;
const LEFT = 36;
const FOOT = 18;
const TOP = 10;
/** Between two lines of the time axis, and of the other [s]. */
const TIMES = [15, 30, 60, 120, 300, 600, 1800] as const;
const STEPS = [1, 2, 5, 10, 20, 50, 100, 200, 500] as const;
const MOST_LINES = 6;

export function LostChart({ flown, losses, t }: { flown: Flown; losses: Losses; t: number }) {
  const { points, worst } = losses;
  const { from, to } = flown;
  const all = points.flatMap(({ lost, inAll }) => [lost, inAll]);
  const [least, most] = [Math.min(0, ...all), Math.max(1, ...all)];
  const x = (time: number) => LEFT + ((WIDTH - LEFT - 8) * (time - from)) / Math.max(1, to - from);
  const y = (lost: number) => TOP + ((HEIGHT - TOP - FOOT) * (most - lost)) / (most - least);
  const every = TIMES.find((each) => (to - from) / each <= MOST_LINES) ?? 3600;
  const step = STEPS.find((each) => (most - least) / each <= MOST_LINES - 2) ?? 1000;
  const times = multiples(every, from, to);
  const line = (of: "lost" | "inAll") =>
    `M${points.map((each) => `${round(x(each.t))} ${round(y(each[of]))}`).join("L")}`;
  return (
    <svg
      class="debrief-chart"
      viewBox={`0 0 ${WIDTH} ${HEIGHT}`}
      role="img"
      aria-label={`Seconds lost, from ${formatClock(from)} to ${formatClock(to)}: ${Math.round(losses.flown)} s in all; the table says where`}
    >
      {worst.map((each, k) => (
        <g key={each.from} class="lost">
          <rect
            x={x(each.from)}
            width={Math.max(2, x(each.to) - x(each.from))}
            y={TOP}
            height={HEIGHT - FOOT - TOP}
          />
          <text x={x(each.from) + 3} y={TOP + 10}>
            {k + 1}
          </text>
        </g>
      ))}
      {multiples(step, least, most).map((lost) => (
        <g key={lost}>
          <line x1={LEFT} x2={WIDTH - 8} y1={y(lost)} y2={y(lost)} />
          <text x={LEFT - 5} y={y(lost) + 4} text-anchor="end">
            {lost === 0 ? "0 s" : `${String(lost).replace("-", "−")} s`}
          </text>
        </g>
      ))}
      {times.map((time) => (
        <text key={time} x={x(time)} y={HEIGHT - 4} text-anchor="middle">
          {formatClock(time)}
        </text>
      ))}
      {points.length > 1 && (
        <>
          <path class="leader" d={line("inAll")} />
          <path class="under" d={line("lost")} />
          <path class="own" d={line("lost")} />
        </>
      )}
      {t >= from && t <= to && (
        <line class="debrief-cursor" x1={x(t)} x2={x(t)} y1={TOP} y2={HEIGHT - FOOT} />
      )}
    </svg>
  );
}

function multiples(step: number, from: number, to: number): number[] {
  const first = Math.ceil(from / step);
  return Array.from({ length: Math.floor(to / step) - first + 1 }, (_, k) => step * (first + k));
}

function round(value: number): number {
  return Math.round(10 * value) / 10;
}
