/** Charts as one drawing for papers: a pure function of the strips, on white, with every colour written out. */

import type { Colour } from "../store/colours";
import { formatClock } from "../units";
import { apartLabels, boundsOf, ticksOf, timesOf } from "./scale";
import type { Line, Strip } from "./strips";

/** What stands above and below the charts. */
export interface About {
  readonly title: string;
  /** Which flight, when, and by which version: one line. */
  readonly source: string;
  readonly from: number;
  readonly to: number;
  /** The instant that the page shows [s, flight time]. */
  readonly cursor: number;
}

/** Ink on white: each at least 4.5 to 1. */
const INK: Record<Colour, string> = {
  scale: "#40464d",
  ownship: "#7a5c00",
  plan: "#00703c",
  proposed: "#7a5c00",
  armed: "#00616e",
  selected: "#00616e",
  leader: "#40464d",
  "leader-ring": "#00616e",
  managed: "#8a3ba0",
  value: "#0b4f8a",
  label: "#40464d",
  unit: "#00616e",
  caution: "#9a4d00",
  alert: "#b3170e",
  superseded: "#6b6863",
};
/** All in px: the drawing is as wide, its plots so high, with such margins. */
const WIDTH = 1000;
const PLOT = 96;
const HEAD = 64;
const STRIP = PLOT + 30;
const LEFT = 72;
const RIGHT = 110;
/** More points than this on one line cannot be told apart. */
const POINTS = 1200;

export function chartSvg(strips: readonly Strip[], about: About): string {
  const height = HEAD + strips.length * STRIP + 34;
  const parts = strips.map((strip, k) => plot(strip, about, HEAD + k * STRIP + 22));
  const base = HEAD + strips.length * STRIP;
  const time = timesOf(about.from, about.to);
  const axis = time.map((t) => text(x(about, t), base + 10, formatClock(t), "middle"));
  const y0 = HEAD + 22;
  const cursor = `<path d="M${x(about, about.cursor)} ${y0}V${base - 8}" stroke="#000" stroke-width="1" stroke-dasharray="1 3"/>`;
  return [
    `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${WIDTH} ${height}" width="${WIDTH}" height="${height}" font-family="B612, sans-serif" font-size="12">`,
    `<title>${escaped(about.title)}</title>`,
    `<rect width="${WIDTH}" height="${height}" fill="#fff"/>`,
    text(LEFT, 24, about.title, "start", 'font-size="17" font-weight="bold" fill="#111"'),
    text(LEFT, 44, about.source, "start"),
    ...parts,
    cursor,
    ...axis,
    text(WIDTH - RIGHT, base + 28, "flight time [min:s]", "end"),
    "</svg>",
  ].join("\n");
}

function x({ from, to }: About, t: number): number {
  return round(LEFT + ((WIDTH - LEFT - RIGHT) * (t - from)) / (to - from));
}

function plot(strip: Strip, about: About, top: number): string {
  const [low, high] = boundsOf(strip, about.from, about.to);
  const y = (value: number) => round(top + (PLOT * (high - value)) / (high - low));
  const [left, right] = [LEFT, WIDTH - RIGHT];
  const grid = ticksOf(low, high, 4).map(
    (value) =>
      `<path d="M${left} ${y(value)}H${right}" stroke="#ddd"/>` +
      text(left - 6, y(value) + 4, strip.format(value), "end"),
  );
  const levels = strip.levels.map(
    ({ value, colour }) =>
      `<path d="M${left} ${y(value)}H${right}" stroke="${INK[colour]}" stroke-width="1" stroke-dasharray="4 3"/>`,
  );
  const lines = strip.lines.map(
    (line) =>
      `<path d="${path(strip, line, about, y)}" fill="none" stroke="${INK[line.colour]}" stroke-width="1.6" stroke-dasharray="${line.dash || "none"}"${line.isFaint ? ' opacity="0.65"' : ""}/>`,
  );
  const labels = apartLabels(strip, about.to, y, 12, top + 4, top + PLOT).map(
    ({ label, colour, at }) => text(right + 6, at + 4, label, "start", `fill="${INK[colour]}"`),
  );
  return [
    text(
      left,
      top - 7,
      `${strip.title} [${strip.unit}]`,
      "start",
      'font-weight="bold" fill="#111"',
    ),
    ...grid,
    `<rect x="${left}" y="${top}" width="${right - left}" height="${PLOT}" fill="none" stroke="#999"/>`,
    ...levels,
    ...lines,
    ...labels,
  ].join("\n");
}

function path(
  { times }: Strip,
  { values }: Line,
  about: About,
  y: (value: number) => number,
): string {
  const rows = times.flatMap((t, k) => (t >= about.from && t <= about.to ? [k] : []));
  const stride = Math.max(1, Math.ceil(rows.length / POINTS));
  let data = "";
  let isDown = false;
  rows.forEach((row, k) => {
    if (k % stride !== 0 && k !== rows.length - 1) return;
    const value = values[row] ?? null;
    if (value !== null) data += `${isDown ? "L" : "M"}${x(about, times[row] ?? 0)} ${y(value)}`;
    isDown = value !== null;
  });
  return data;
}

function text(
  at: number,
  y: number,
  words: string,
  anchor: string,
  more = 'fill="#40464d"',
): string {
  return `<text x="${at}" y="${y}" text-anchor="${anchor}" ${more}>${escaped(words)}</text>`;
}

function escaped(words: string): string {
  return words.replaceAll("&", "&amp;").replaceAll("<", "&lt;").replaceAll(">", "&gt;");
}

function round(value: number): number {
  return Math.round(value * 10) / 10 + 0;
}
