/** Where values stand: bounds of an axis, its ticks, and labels at the ends of lines, none over another. */

import type { Colour } from "../store/colours";
import { type Strip, valueAt } from "./strips";

/** The values a strip's axis reaches between two times, its levels in sight where lines come near. */
export function boundsOf(strip: Strip, from: number, to: number): [number, number] {
  let [low, high] = [Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY];
  strip.times.forEach((t, k) => {
    if (t < from || t > to) return;
    for (const { values } of strip.lines) {
      const value = values[k] ?? null;
      if (value === null) continue;
      low = Math.min(low, value);
      high = Math.max(high, value);
    }
  });
  if (!Number.isFinite(low)) [low, high] = [0, 1];
  for (const { value } of strip.levels) {
    low = Math.min(low, value);
    high = Math.max(high, value);
  }
  const room = Math.max(0.06 * (high - low), 1e-2 * Math.max(1, Math.abs(high)));
  return [low - room, high + room];
}

/** Round values within bounds, at most some `count`; in steps of 1, 2, 5 · 10ⁿ, or of those given. */
export function ticksOf(
  low: number,
  high: number,
  count: number,
  steps?: readonly number[],
): number[] {
  const least = (high - low) / count;
  const power = 10 ** Math.floor(Math.log10(least));
  const step =
    steps?.find((each) => each >= least) ??
    [1, 2, 5, 10].map((each) => each * power).find((each) => each >= least * (1 - 1e-9)) ??
    10 * power;
  const ticks: number[] = [];
  for (let k = Math.ceil(low / step); k * step <= high; k += 1) ticks.push(k * step + 0);
  return ticks;
}

/** Steps of a time axis [s], and how many of them there are about. */
const TIMES = [1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 900, 1800, 3600, 7200, 14_400];
const COUNT = 8;

/** Round times between two [s]. */
export function timesOf(from: number, to: number): number[] {
  return ticksOf(from, to, COUNT, TIMES);
}

interface EndLabel {
  readonly label: string;
  readonly colour: Colour;
  /** Where it stands [px]. */
  readonly at: number;
}

/** Labels of lines and levels where they end before time `to`, at least `apart` [px] from each other. */
export function apartLabels(
  strip: Strip,
  to: number,
  y: (value: number) => number,
  apart: number,
  top: number,
  bottom: number,
): EndLabel[] {
  const ends = strip.lines.flatMap((line) => {
    const last = line.values.findLastIndex(
      (value, k) => value !== null && (strip.times[k] ?? 0) <= to,
    );
    const value = last < 0 ? null : valueAt(strip, line, strip.times[last] ?? 0);
    return value === null ? [] : [{ label: line.label, colour: line.colour, at: y(value) }];
  });
  const levels = strip.levels.map(({ label, colour, value }) => ({ label, colour, at: y(value) }));
  const all = [...ends, ...levels].sort((a, b) => a.at - b.at);
  // Down from the top, then up from the bottom: none leaves the plot, none covers another.
  let free = top;
  const down = all.map((each) => {
    const at = Math.max(each.at, free);
    free = at + apart;
    return { ...each, at };
  });
  let limit = bottom;
  return down
    .reverse()
    .map((each) => {
      const at = Math.min(each.at, limit);
      limit = at - apart;
      return { ...each, at };
    })
    .reverse();
}
