/** The convergence area under the map: where each word is the answer, and lines of equal time. */

import { useComputed } from "@preact/signals";
import { type More, regionId } from "../nd/labelled";
import { LINE_HEIGHT } from "../nd/labels";
import { type Layout, onMap, type Point, project, round, toMap, type View } from "../nd/view";
import type { AreaAnswer, AreaRegion } from "../wire";
import type { Editor } from "./editor";
import { labelPlace } from "./label-place";

type Ring = readonly (readonly number[])[];

/** What a region is called on the map. */
const NAMES: Record<string, string> = { "": "NO PLAN", delay: "DELAY", constrained: "LIMIT" };
/** A name is written only where it fits [px]. */
const NAMED_FROM = 80;
const NAME_SIZE = 20;
/** Where along its line a number is tried, and how far it stays from the others [px]. */
const PARTS = [0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8] as const;
const APART = 48;
/** Lines shorter than this bear no number [points]. */
const NUMBERED_FROM = 12;

export function AreaLayer({ map, view }: { map: Editor; view: View }) {
  const regions = useComputed(() => regionsOf(view.layout.value, map.area.value?.answer ?? null));
  const lines = useComputed(() => linesOf(view.layout.value, map.area.value?.answer ?? null));
  return (
    <g class="nd-area">
      {regions.value.map(({ key, word, limited, d }) => (
        <path
          key={key}
          class={`area-region area-${word === "" ? "none" : word}${limited ? " area-limited" : ""}`}
          fill-rule="evenodd"
          d={d}
        />
      ))}
      {lines.value.map(({ key, d }) => (
        <path key={key} class="area-line" d={d} />
      ))}
      {lines.value.map(({ key, text, at }) =>
        at === null ? null : (
          <text key={key} class="nd-text area-minutes" x={round(at.x)} y={round(at.y + 7)}>
            {text}
          </text>
        ),
      )}
    </g>
  );
}

function regionsOf(layout: Layout, answer: AreaAnswer | null) {
  return (answer?.regions ?? []).map((region, i) => ({
    key: i,
    word: region.word,
    limited: region.limited,
    d: region.polygons
      .flatMap((polygon) => polygon.map((ring) => data(layout, ring, "Z")))
      .join(""),
  }));
}

/** The names of the regions, and where numbers stand on the lines, for the map's labels. */
export function areaLabels(map: Editor, view: View): More {
  const [answer, layout, pose] = [map.area.value?.answer, view.layout.value, view.pose.value];
  if (!map.hasArea.value || answer === undefined || pose === null)
    return { labels: [], points: [] };
  const labels = answer.regions.flatMap((region, i) => {
    const largest = labelPlace(region.polygons.map((polygon) => polygon.map(ringOf)));
    if (largest === null || largest.width * layout.scale < NAMED_FROM) return [];
    const at = project(layout, pose, largest);
    if (!onMap(layout, at)) return [];
    const lines = [{ text: nameOf(region), colour: "superseded" as const }];
    // in the middle of its region: the gap is measured from its edge
    const gap = (-NAME_SIZE * LINE_HEIGHT) / 2;
    return [{ id: regionId(i), at, lines, side: 0, gap, size: NAME_SIZE, optional: true }];
  });
  const origin = project(layout, pose, { x_m: 0, y_m: 0 });
  const points = linesOf(layout, answer).flatMap(({ at }) =>
    at === null ? [] : [{ x: at.x + origin.x, y: at.y + origin.y }],
  );
  return { labels, points };
}

function nameOf({ word, limited }: AreaRegion): string {
  return `${NAMES[word] ?? word}${limited ? " · MIN" : ""}`;
}

function ringOf(ring: Ring): { x_m: number; y_m: number }[] {
  return ring.map(([x = 0, y = 0]) => ({ x_m: x, y_m: y }));
}

function linesOf(layout: Layout, answer: AreaAnswer | null) {
  const placed: Point[] = [];
  return (answer?.contours ?? []).map(({ level_s, lines }) => {
    const longest = lines.reduce<Ring>((a, b) => (b.length > a.length ? b : a), []);
    const at = longest.length < NUMBERED_FROM ? null : freePoint(layout, longest, placed);
    if (at !== null) placed.push(at);
    return {
      key: level_s,
      d: lines.map((line) => data(layout, line, "")).join(""),
      text: minutes(level_s),
      at,
    };
  });
}

/** A point of a line that is clear of those placed before; null if there is none. */
function freePoint(layout: Layout, line: Ring, placed: readonly Point[]): Point | null {
  for (const part of PARTS) {
    const [x = 0, y = 0] = line[Math.floor(part * (line.length - 1))] ?? [];
    const at = toMap(layout, { x_m: x, y_m: y });
    if (placed.every((other) => Math.hypot(at.x - other.x, at.y - other.y) > APART)) return at;
  }
  return null;
}

function minutes(seconds: number): string {
  const whole = Math.floor(seconds / 60);
  const rest = Math.round(seconds - 60 * whole);
  return rest === 0 ? String(whole) : `${whole}:${String(rest).padStart(2, "0")}`;
}

function data(layout: Layout, line: Ring, end: "" | "Z"): string {
  if (line.length < 2) return "";
  const points = line.map(([x = 0, y = 0]) => {
    const point = toMap(layout, { x_m: x, y_m: y });
    return `${point.x.toFixed(1)} ${point.y.toFixed(1)}`;
  });
  return `M${points.join("L")}${end}`;
}
