/**
 * The projection: the only file that knows where things are in the 768 × 768 box [px].
 *
 * ROSE and ARC: the nose of the own ship points to the top of the glass. PLAN: north does, and any place
 * may be in the middle. World: x east, y north [m].
 * The *map* is the world north-up in pixels (y down), carried by one transform a frame.
 */

import { computed, type ReadonlySignal } from "@preact/signals";
import type { Shown } from "../store/shown";
import { DEG, NM, wrap180 } from "../units";

type Moved = Shown["moved"]["value"];

export const SIZE = 768;
export const RANGES = [10, 20, 40, 80, 160, 320] as const;

export type DisplayMode = "ROSE" | "ARC" | "PLAN";

export interface Point {
  readonly x: number;
  readonly y: number;
}

export interface Box extends Point {
  readonly width: number;
  readonly height: number;
}

/** A place over the ground [m]; samples and path points are places too. */
export interface Place {
  readonly x_m: number;
  readonly y_m: number;
}

export interface Pose extends Place {
  readonly heading_deg: number;
}

/** One range ring: its radius [px] and what it says [NM]. */
export interface Ring {
  readonly radius: number;
  readonly label: string;
}

/** Where everything is for one mode and range. */
export interface Layout {
  readonly mode: DisplayMode;
  /** As selected [NM]. */
  readonly range: number;
  readonly scale: number;
  /** The own ship, and the middle of tape and rings. */
  readonly centre: Point;
  /** Radius of the tape, which also bounds the map. */
  readonly tape: number;
  readonly rings: readonly Ring[];
  /** On which clock positions the rings are labelled [deg right of the nose]. */
  readonly ringLabels: readonly number[];
  /** What stands on the glass beside the map: labels keep clear of it. */
  readonly readouts: readonly Box[];
}

export interface View {
  readonly layout: ReadonlySignal<Layout>;
  /** What is in the middle, and up: the own ship, null while nothing is known of it; in PLAN any place. */
  readonly pose: ReadonlySignal<Pose | null>;
  /** Carries the map under the own ship. */
  readonly mapTransform: ReadonlySignal<string>;
  /** Turns what is drawn round north at the top. */
  readonly tapeTransform: ReadonlySignal<string>;
  /** Changes five times a second: what is read, not watched, follows it. */
  readonly beat: ReadonlySignal<string>;
}

/** 500 px for the selected range: in ARC ahead, in ROSE across (250 px each way); in PLAN twice the 250. */
const RANGE_PX = { ROSE: 500, ARC: 500, PLAN: 250 } as const;
const CENTRE = {
  ROSE: { x: 384, y: 384 },
  ARC: { x: 384, y: 620 },
  PLAN: { x: 384, y: 384 },
} as const;
/** In PLAN there is none: the map fills the glass to its corners. */
const TAPE = { ROSE: 250, ARC: 492, PLAN: 600 } as const;
/** At which parts of the range there are rings, and where they are labelled. */
const RINGS = { ROSE: [0.25], ARC: [0.75, 0.5, 0.25], PLAN: [1, 0.5] } as const;
const RING_LABELS = { ROSE: [-135], ARC: [-56, 56], PLAN: [-135] } as const;

/** The readouts round the map. Labels and edge symbols keep clear of them. */
export const READOUTS = {
  fma: { x: 0, y: 0, width: 768, height: 58 },
  air: { x: 10, y: 66, width: 212, height: 62 },
  next: { x: 596, y: 66, width: 164, height: 88 },
  spacing: { x: 10, y: 582, width: 150, height: 138 },
  timing: { x: 650, y: 580, width: 112, height: 146 },
  flag: { x: 234, y: 690, width: 300, height: 32 },
  message: { x: 184, y: 728, width: 400, height: 34 },
} as const satisfies Record<string, Box>;

/** In PLAN: the wind at the top, the message at the bottom. */
const PLAN_READOUTS: readonly Box[] = [
  { x: 0, y: 0, width: 150, height: 150 },
  { x: 184, y: 728, width: 400, height: 34 },
];

/** Where the large flags stand: that of the map over its middle, the leader's over the message line. */
export function flagPoint(layout: Layout, whole: boolean): Point {
  const { flag } = READOUTS;
  return whole
    ? polar(layout, 0, layout.tape * 0.45)
    : { x: flag.x + flag.width / 2, y: flag.y + 26 };
}

export function layoutOf(mode: DisplayMode, range: number): Layout {
  const scale = RANGE_PX[mode] / (range * NM);
  return {
    mode,
    range,
    scale,
    centre: CENTRE[mode],
    tape: TAPE[mode],
    rings: RINGS[mode].map((part) => ({
      radius: RANGE_PX[mode] * part,
      label: String(range * part),
    })),
    ringLabels: RING_LABELS[mode],
    readouts: mode === "PLAN" ? PLAN_READOUTS : Object.values(READOUTS),
  };
}

export function createView(
  shown: Shown,
  mode: ReadonlySignal<DisplayMode>,
  range: ReadonlySignal<number>,
  middle?: ReadonlySignal<Pose>,
): View {
  const layout = computed(() => layoutOf(mode.value, range.value));
  const pose = middle ?? computed(() => shown.picture.value.pose);
  return {
    layout,
    pose,
    mapTransform: computed(() =>
      pose.value === null ? "" : mapTransform(layout.value, pose.value),
    ),
    tapeTransform: computed(() => {
      const { centre } = layout.value;
      return `translate(${centre.x} ${centre.y}) rotate(${roundAngle(-(pose.value?.heading_deg ?? 0))})`;
    }),
    beat: computed(() => {
      const { readAt } = shown.numbers.value;
      return `${readAt} ${pose.value === null} ${mode.value} ${range.value}`;
    }),
  };
}

/** A place on the map [px], before the map is carried to the own ship. */
export function toMap({ scale }: Layout, { x_m, y_m }: Place): Point {
  return { x: x_m * scale, y: -y_m * scale };
}

export function mapTransform(layout: Layout, pose: Pose): string {
  const own = toMap(layout, pose);
  const { x, y } = layout.centre;
  return (
    `translate(${x} ${y}) rotate(${roundAngle(-pose.heading_deg)})` +
    ` translate(${roundPlace(-own.x)} ${roundPlace(-own.y)})`
  );
}

/** What a thing on the glass moves with: nothing, the tape, the ground, the leader, the slot, or another aircraft. */
export type Carrier = "glass" | "tape" | "map" | "leader" | "slot" | `other ${string}`;

/**
 * How a drawn picture is carried on to where all has moved since, as a CSS transform round the own ship;
 * lengths in parts of the glass.
 */
export function carry(layout: Layout, heading: number, moved: Moved, by: Carrier): string {
  const turn = by === "glass" ? 0 : roundAngle(-moved.turned);
  const { x, y } = carriedBy(moved, by);
  const sin = Math.sin(heading * DEG);
  const cos = Math.cos(heading * DEG);
  const part = (length: number) => roundPart((length * layout.scale) / SIZE);
  return `rotate(${turn}deg) translate(${part(x * cos - y * sin)}%, ${part(-x * sin - y * cos)}%)`;
}

/** How far something has moved, seen from own ship. World: x east, y north [m]. */
function carriedBy({ own, leader, slot, others }: Moved, by: Carrier): Point {
  if (by === "glass" || by === "tape") return { x: 0, y: 0 };
  const still = { x: 0, y: 0 };
  const thing =
    by === "map"
      ? still
      : by === "leader"
        ? leader
        : by === "slot"
          ? slot
          : (others.get(by.slice("other ".length)) ?? still);
  return { x: thing.x - own.x, y: thing.y - own.y };
}

/** A part of the glass in percent: a twentieth of a pixel. */
function roundPart(value: number): number {
  return Math.round(value * 100 * 150) / 150 + 0;
}

/** A place on the glass [px]. */
export function project(layout: Layout, pose: Pose, { x_m, y_m }: Place): Point {
  const east = (x_m - pose.x_m) * layout.scale;
  const north = (y_m - pose.y_m) * layout.scale;
  const sin = Math.sin(pose.heading_deg * DEG);
  const cos = Math.cos(pose.heading_deg * DEG);
  return {
    x: layout.centre.x + east * cos - north * sin,
    y: layout.centre.y - east * sin - north * cos,
  };
}

/** A point `radius` [px] from the own ship, `bearing` [deg] right of its nose. */
export function polar({ centre }: Layout, bearing: number, radius: number): Point {
  return {
    x: centre.x + radius * Math.sin(bearing * DEG),
    y: centre.y - radius * Math.cos(bearing * DEG),
  };
}

/** The direction from one place to another [deg clockwise from north]. */
export function bearing(from: Place, to: Place): number {
  return Math.atan2(to.x_m - from.x_m, to.y_m - from.y_m) / DEG;
}

export function distance(from: Place, to: Place): number {
  return Math.hypot(to.x_m - from.x_m, to.y_m - from.y_m);
}

/** The place `length` [m] from another, in the direction of a unit vector. */
export function onwards(from: Place, direction: Point, length: number): Place {
  return { x_m: from.x_m + direction.x * length, y_m: from.y_m + direction.y * length };
}

/** Whether a symbol at this point is seen whole: on the map and beside the readouts. */
export function onMap(layout: Layout, { x, y }: Point, margin = 18): boolean {
  const { centre, tape } = layout;
  if (layout.mode === "PLAN") {
    const inside = { x: margin, y: margin, width: SIZE - 2 * margin, height: SIZE - 2 * margin };
    return (
      within(inside, { x, y }) && !layout.readouts.some((box) => within(box, { x, y }, margin / 2))
    );
  }
  if (Math.hypot(x - centre.x, y - centre.y) > tape - margin) return false;
  if (x < margin || x > SIZE - margin || y > READOUTS.message.y - margin) return false;
  return !within(READOUTS.spacing, { x, y }, margin);
}

/** The last point on the map in a direction [deg right of the nose]: where an off-scale symbol sits. */
export function edge(layout: Layout, direction: number): Point {
  let radius = 0;
  while (onMap(layout, polar(layout, direction, radius + 1))) radius += 1;
  return polar(layout, direction, radius);
}

/** What to select to see a place that is off the map; null if nothing shows it. */
export function remedy(layout: Layout, pose: Pose, place: Place): string | null {
  for (const range of RANGES) {
    if (range < layout.range) continue;
    for (const mode of [layout.mode, "ROSE"] as const) {
      const other = layoutOf(mode, range);
      if (!onMap(other, project(other, pose, place))) continue;
      return range === layout.range ? "→ ROSE" : `→ RANGE ${range}`;
    }
  }
  return null;
}

export function within(box: Box, { x, y }: Point, margin = 0): boolean {
  return (
    x > box.x - margin &&
    x < box.x + box.width + margin &&
    y > box.y - margin &&
    y < box.y + box.height + margin
  );
}

export function overlap(a: Box, b: Box): number {
  const width = Math.min(a.x + a.width, b.x + b.width) - Math.max(a.x, b.x);
  const height = Math.min(a.y + a.height, b.y + b.height) - Math.max(a.y, b.y);
  return Math.max(0, width) * Math.max(0, height);
}

/** How far right of the nose a compass direction is [deg], in [−180, 180). */
export function offNose(pose: Pose, direction: number): number {
  return wrap180(direction - pose.heading_deg);
}

/** A number for an attribute: a fiftieth of a pixel is enough, and what has moved by less stands still. */
export function round(value: number): number {
  return Math.round(value * 50) / 50 + 0;
}

/** The same for what is carried as a whole: a twentieth. */
function roundPlace(value: number): number {
  return Math.round(value * 20) / 20 + 0;
}

/** An angle for an attribute: a hundredth of a degree is a tenth of a pixel at the rim. */
function roundAngle(value: number): number {
  return Math.round(value * 100) / 100 + 0;
}

/** Puts a symbol at a point, turned `angle` [deg] clockwise. */
export function placeAt({ x, y }: Point, angle = 0): string {
  const turn = angle === 0 ? "" : ` rotate(${roundAngle(angle)})`;
  return `translate(${roundPlace(x)} ${roundPlace(y)})${turn}`;
}
