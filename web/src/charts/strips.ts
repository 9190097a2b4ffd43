/**
 * What the charts draw: strips over one time, each a few lines on one axis, in the units of the page.
 * Of a flight the columns of its samples; dashed what was planned; faint what is forecast.
 */

import type { Colour } from "../store/colours";
import type { History } from "../store/history";
import type { Column } from "../store/knots";
import { formatHeading, KT, NM, wrap180 } from "../units";
import { type Ahead, plannedBank, plannedHeading } from "./ahead";

/** Values at the strip's times; null where there is none. */
type Values = readonly (number | null)[];

export interface Line {
  readonly label: string;
  readonly colour: Colour;
  /** Dashes and gaps [px]; "" is solid. Lines of a strip differ by it, the colour repeats it. */
  readonly dash: string;
  /** Whether it is of what has not been flown. */
  readonly isFaint: boolean;
  readonly values: Values;
}

/** A value that holds all the time. */
export interface Level {
  readonly label: string;
  readonly value: number;
  readonly colour: Colour;
}

export interface Strip {
  readonly name: string;
  readonly title: string;
  readonly unit: string;
  /** Flight times, ascending [s]. */
  readonly times: readonly number[];
  readonly lines: readonly Line[];
  readonly levels: readonly Level[];
  readonly format: (value: number) => string;
}

/** Another flight whose lines are drawn too; its time is later by `offset` [s]. */
export interface Other {
  readonly name: string;
  readonly history: History;
  readonly offset: number;
}

/** How lines are told apart: the flight itself, what was planned or commanded, what is forecast, others. */
const FLOWN = { dash: "", isFaint: false } as const;
const PLANNED = { dash: "8 5", isFaint: false } as const;
const FORECAST = { dash: "2 3", isFaint: true } as const;
const THIRD = { dash: "12 4 2 4", isFaint: false } as const;
const OTHER = { colour: "superseded", dash: "9 6", isFaint: false } as const;

/** The strips of a flight, with what is planned and forecast; none before its first sample. */
export function stripsOf(history: History, ahead: Ahead | null, other: Other | null): Strip[] {
  const { knots } = history;
  if (knots.span === null) return [];
  const flownTimes = Array.from(knots.column("t_s"));
  const times = withAhead(flownTimes, ahead);
  const of = (column: Column, unit: number) => padded(knots.column(column), unit, times.length);
  const others = (column: Column, unit: number): Line[] =>
    other === null
      ? []
      : [{ label: other.name, ...OTHER, values: resampled(other, column, unit, times) }];
  const at = (value: (t: number) => number | null): Values => times.map(value);
  const heading = unwrapped(Array.from(knots.column("pursuer.heading_deg")));
  const turned = (angle: number | null, t: number) =>
    near(angle, headingAt(flownTimes, heading, t));
  const strip = (
    name: string,
    title: string,
    unit: string,
    decimals: number,
    lines: readonly Line[],
    levels: readonly Level[] = [],
  ): Strip => ({ name, title, unit, times, lines, levels, format: fixed(decimals) });
  const forecast = (values: Values): Line[] =>
    ahead?.forecast == null ? [] : [{ label: "FORECAST", colour: "plan", ...FORECAST, values }];
  return [
    strip(
      "separation",
      "Separation",
      "NM",
      2,
      [
        { label: "d", colour: "ownship", ...FLOWN, values: of("separation_m", NM) },
        ...forecast(at((t) => ahead?.separation(t) ?? null)),
        ...others("separation_m", NM),
      ],
      levelsOf(history, ahead),
    ),
    strip("along", "Along error: behind the slot", "NM", 2, [
      { label: "ALONG", colour: "ownship", ...FLOWN, values: of("spacing_error_m", NM) },
      ...others("spacing_error_m", NM),
    ]),
    strip("across", "Across error: right of the leader's route", "NM", 2, [
      { label: "ACROSS", colour: "ownship", ...FLOWN, values: of("cross_track_m", NM) },
      ...others("cross_track_m", NM),
    ]),
    strip("bank", "Bank: right positive", "°", 1, [
      { label: "FLOWN", colour: "ownship", ...FLOWN, values: of("pursuer.bank_deg", 1) },
      { label: "PLAN", colour: "plan", ...PLANNED, values: at((t) => plannedBank(ahead, t)) },
      ...others("pursuer.bank_deg", 1),
    ]),
    {
      ...strip("heading", "Heading", "°", 0, [
        {
          label: "FLOWN",
          colour: "ownship",
          ...FLOWN,
          values: times.map((_, k) => heading[k] ?? null),
        },
        {
          label: "PLAN",
          colour: "plan",
          ...PLANNED,
          values: at((t) => turned(plannedHeading(ahead, t), t)),
        },
        ...forecast(at((t) => turned(ahead?.heading(t) ?? null, t))),
        ...others("pursuer.heading_deg", 1).map((line) => ({
          ...line,
          values: line.values.map((value, k) =>
            near(value, headingAt(flownTimes, heading, times[k] ?? 0)),
          ),
        })),
      ]),
      format: formatHeading,
    },
    strip("speed", "True airspeed", "kt", 0, [
      { label: "TAS", colour: "ownship", ...FLOWN, values: of("pursuer.tas_mps", KT) },
      { label: "COMMANDED", colour: "managed", ...PLANNED, values: of("commanded_tas_mps", KT) },
      { label: "LEADER", colour: "leader", ...THIRD, values: of("leader.tas_mps", KT) },
      ...others("pursuer.tas_mps", KT),
    ]),
    strip("closure", "Closure: positive when closing", "kt", 0, [
      { label: "CLS", colour: "ownship", ...FLOWN, values: of("closure_mps", KT) },
      ...others("closure_mps", KT),
    ]),
  ];
}

function levelsOf(history: History, ahead: Ahead | null): Level[] {
  const { started } = history.knownAt(Number.POSITIVE_INFINITY);
  const levels: Level[] = [];
  if (started !== null)
    levels.push({ label: "MIN", value: started.min_separation_m / NM, colour: "caution" });
  if (ahead !== null)
    levels.push({ label: "PROVED", value: ahead.provedAbove / NM, colour: "plan" });
  return levels;
}

/** Between two times that are still to come [s]. */
const STEP = 2;

/** The times of the samples, and those to come of what is ahead. */
function withAhead(flown: readonly number[], ahead: Ahead | null): number[] {
  const times = [...flown];
  const end = ahead?.end ?? 0;
  for (let t = (flown.at(-1) ?? 0) + STEP; t <= end; t += STEP) times.push(t);
  return times;
}

function padded(column: Float64Array, unit: number, length: number): Values {
  return Array.from({ length }, (_, k) => {
    const value = column[k];
    return value === undefined ? null : value / unit;
  });
}

/** A column of another flight at the times of this one; null before its beginning and after its end. */
function resampled(
  { history, offset }: Other,
  name: Column,
  unit: number,
  times: readonly number[],
) {
  const [at, values] = [history.knots.column("t_s"), history.knots.column(name)];
  const isAngle = name.endsWith("heading_deg");
  let k = 0;
  return times.map((time) => {
    const t = time + offset;
    while (k + 1 < at.length && (at[k + 1] ?? 0) <= t) k += 1;
    const [t0, t1] = [at[k] ?? Number.NaN, at[k + 1] ?? at[k] ?? Number.NaN];
    if (!(t >= t0 && t <= Math.max(t1, t0))) return null;
    const [a, b] = [values[k] ?? 0, values[k + 1] ?? values[k] ?? 0];
    const part = t1 > t0 ? (t - t0) / (t1 - t0) : 0;
    return (a + part * (isAngle ? wrap180(b - a) : b - a)) / unit;
  });
}

/** Headings without jumps at north [deg]. */
function unwrapped(headings: readonly number[]): number[] {
  const turned: number[] = [];
  for (const heading of headings) turned.push(near(heading, turned.at(-1) ?? heading) ?? heading);
  return turned;
}

/** The same direction as the nearest number to another [deg]. */
function near(angle: number | null, to: number): number | null {
  return angle === null ? null : to + wrap180(angle - to);
}

function headingAt(times: readonly number[], heading: readonly number[], t: number): number {
  return heading[Math.max(0, rowAt(times, t))] ?? 0;
}

function fixed(decimals: number): (value: number) => string {
  return (value) =>
    value
      .toFixed(decimals)
      .replace(/^-(?=0(\.0*)?$)/, "")
      .replace("-", "−");
}

/** First and last time of what is drawn [s]. */
export function spanOf(strips: readonly Strip[]): { from: number; to: number } {
  const times = strips[0]?.times ?? [];
  return { from: times[0] ?? 0, to: Math.max(times.at(-1) ?? 1, (times[0] ?? 0) + 1) };
}

/** The last of ascending times that is no later than `t`; −1 if all are. */
function rowAt(times: readonly number[], t: number): number {
  let [low, high] = [0, times.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if ((times[middle] ?? 0) <= t + 1e-6) low = middle + 1;
    else high = middle;
  }
  return low - 1;
}

/** A line's value at a time, between two of its values; null where it has none. */
export function valueAt(
  { times }: Pick<Strip, "times">,
  { values }: Pick<Line, "values">,
  t: number,
): number | null {
  const row = rowAt(times, t);
  const [before, after] = [values[row] ?? null, values[row + 1] ?? null];
  const [t0, t1] = [times[row] ?? t, times[row + 1] ?? t];
  if (before === null || after === null || t1 <= t0) return before;
  return before + ((after - before) * (t - t0)) / (t1 - t0);
}
