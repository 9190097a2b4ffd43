/** The map's projection: north up, any place in the middle, any scale. */

import { type Signal, signal } from "@preact/signals";
import { type Box, type Point, within } from "../../nd/view";
import { NM } from "../../units";
import type { Place } from "../tracks";

export interface MapView {
  /** What stands in the middle [m]. */
  readonly centre: Signal<Place>;
  /** [px/m] */
  readonly scale: Signal<number>;
  /** Of the glass [px]. */
  readonly size: Signal<{ readonly width: number; readonly height: number }>;
  /** Whether it was moved by hand: until then, all aircraft are kept in sight. */
  readonly isHeld: Signal<boolean>;
}

/** From the middle to the nearer edge, at least and at most [m]. */
const NEAREST = 2 * NM;
const FURTHEST = 600 * NM;
/** How much of the glass is left free round what is shown whole. */
const ROOM = 0.14;

export function createView(): MapView {
  return {
    centre: signal({ x_m: 0, y_m: 0 }),
    scale: signal(300 / (60 * NM)),
    size: signal({ width: 800, height: 600 }),
    isHeld: signal(false),
  };
}

export function toPoint({ centre, scale, size }: MapView, { x_m, y_m }: Place): Point {
  const { width, height } = size.value;
  return {
    x: width / 2 + (x_m - centre.value.x_m) * scale.value,
    y: height / 2 - (y_m - centre.value.y_m) * scale.value,
  };
}

export function toPlace({ centre, scale, size }: MapView, { x, y }: Point): Place {
  const { width, height } = size.value;
  return {
    x_m: centre.value.x_m + (x - width / 2) / scale.value,
    y_m: centre.value.y_m - (y - height / 2) / scale.value,
  };
}

/** Moves the ground by so much [px]. */
export function pan(view: MapView, x: number, y: number): void {
  view.isHeld.value = true;
  move(view, x, y);
}

function move({ centre, scale }: MapView, x: number, y: number): void {
  const { x_m, y_m } = centre.value;
  centre.value = { x_m: x_m - x / scale.value, y_m: y_m + y / scale.value };
}

/** Makes all so many times as large; what is at a point, the middle if none is given, stays there. */
export function zoom(view: MapView, factor: number, at?: Point): void {
  view.isHeld.value = true;
  const { width, height } = view.size.value;
  const point = at ?? { x: width / 2, y: height / 2 };
  const before = toPlace(view, point);
  const half = Math.min(width, height) / 2;
  const wanted = view.scale.value * factor;
  view.scale.value = Math.min(half / NEAREST, Math.max(half / FURTHEST, wanted));
  const after = toPoint(view, before);
  move(view, point.x - after.x, point.y - after.y);
}

/** Shows all these places. */
export function showAll(view: MapView, places: readonly Place[]): void {
  if (places.length === 0) return;
  const [xs, ys] = [places.map(({ x_m }) => x_m), places.map(({ y_m }) => y_m)];
  const [west, east] = [Math.min(...xs), Math.max(...xs)];
  const [south, north] = [Math.min(...ys), Math.max(...ys)];
  view.centre.value = { x_m: (west + east) / 2, y_m: (south + north) / 2 };
  const { width, height } = view.size.value;
  const fits = Math.min(
    (width * (1 - 2 * ROOM)) / Math.max(east - west, NEAREST),
    (height * (1 - 2 * ROOM)) / Math.max(north - south, NEAREST),
  );
  view.scale.value = 1;
  zoom(view, fits);
  view.isHeld.value = false;
}

/** Shows all these places, if some are out of sight and the map was not moved by hand. */
export function keepInSight(view: MapView, places: readonly Place[]): void {
  const glass = glassOf(view);
  if (!view.isHeld.value && places.some((each) => !within(glass, toPoint(view, each))))
    showAll(view, places);
}

/** A line through places, for an SVG path. */
export function lineOf(view: MapView, places: readonly Place[]): string {
  return places
    .map((place, k) => {
      const { x, y } = toPoint(view, place);
      return `${k === 0 ? "M" : "L"}${x.toFixed(1)} ${y.toFixed(1)}`;
    })
    .join("");
}

export function glassOf({ size }: MapView): Box {
  return { x: 0, y: 0, ...size.value };
}

/** Size of the map's type [px]: smaller where there is little room. */
export function typeOf({ size }: MapView): number {
  return size.value.width < 500 ? 11 : 12.5;
}
