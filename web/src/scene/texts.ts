/** What is written on the scene: the same words, numbers and colours as on the navigation display. */

import { velocity } from "../geometry";
import { square } from "../nd/labelled";
import type { Label, Surroundings } from "../nd/labels";
import type { Box, Place, Point } from "../nd/view";
import type { Colour } from "../store/colours";
import { forecastIndex, pointsAfter } from "../store/forecast";
import type { PairSample } from "../store/pair";
import type { Shown } from "../store/picture";
import { formatLevel, formatMiles, NM } from "../units";
import type { AircraftSample } from "../wire";
import { type Camera, type High, see } from "./camera";

/** Width and height of the glass [px]. */
export interface Size {
  readonly width: number;
  readonly height: number;
}

/** Every text that can be written. */
export const TEXTS = ["own", "leader", "join", "slot", "closest", "min"] as const;

/** The middle of the two aircraft is the scene's. */
export function middleOf({ pursuer, leader }: PairSample): Place {
  return { x_m: (pursuer.x_m + leader.x_m) / 2, y_m: (pursuer.y_m + leader.y_m) / 2 };
}

/** The texts of this moment, the most important first. */
export function textsOf(shown: Shown, camera: Camera, size: Size): Label[] {
  const [picture, numbers] = [shown.picture.peek(), shown.numbers.peek()];
  const { now, style, leader } = picture;
  if (now === null) return [];
  const at = seenFrom(camera, middleOf(now), size);
  const own = now.pursuer.altitude_m;
  const other = now.leader.altitude_m;
  const text = (
    id: (typeof TEXTS)[number],
    place: High | null,
    lines: readonly string[],
    colour: Colour,
    side = 0,
    gap = 14,
  ): Label[] => {
    const point = place === null ? null : at(place);
    if (point === null || lines.every((line) => line === "")) return [];
    return [
      {
        id,
        at: point,
        lines: lines.map((line) => ({ text: line, colour })),
        side,
        gap,
        size: 13,
        optional: false,
      },
    ];
  };
  const { pursuer } = now;
  const { join, closest, started, ident } = picture;
  const slotted = style !== null && style.slot !== "none";
  return [
    ...text(
      "own",
      pursuer,
      [started?.pursuer.ident ?? "OWN", `${numbers.gs} kt ${formatLevel(own)}`],
      "ownship",
      0,
      2 + halfOf(at, pursuer),
    ),
    ...text(
      "leader",
      leader,
      [ident, `${numbers.leaderSpeed} kt ${formatLevel(other)}`],
      "leader",
      0,
      leader === null ? 14 : 2 + halfOf(at, leader),
    ),
    ...text(
      "join",
      join === null ? null : { ...join, altitude_m: own },
      [numbers.toJoin === "" ? "" : `CNV ${numbers.toJoin}`],
      style?.pathColour ?? "plan",
      90,
    ),
    ...text(
      "slot",
      slotted ? { ...now.slot, altitude_m: other } : null,
      [now.joined ? "SLOT · JOINED" : "SLOT"],
      style?.slotColour ?? "selected",
      180,
    ),
    ...text(
      "closest",
      closest === null ? null : { ...closest.pursuer, altitude_m: own },
      [closest === null ? "" : `${formatMiles(closest.least)} NM ${numbers.least?.left ?? ""}`],
      closest?.isTooClose === true ? "caution" : "label",
      -90,
    ),
    ...text(
      "min",
      picture.designated && leader !== null ? rightmost(camera, now, picture.keepOut) : null,
      [`MIN ${numbers.minSeparation}`],
      "label",
      90,
    ),
  ];
}

/** What the texts keep clear of: both aircraft, the slot, and the path ahead. */
export function aroundTexts(shown: Shown, camera: Camera, size: Size): Surroundings {
  const { now, forecast, t, until } = shown.picture.peek();
  const inside = { x: 4, y: 4, width: size.width - 8, height: size.height - 26 };
  const isSeen = ({ x, y }: Point) =>
    x > inside.x && x < inside.x + inside.width && y > inside.y && y < inside.y + inside.height;
  if (now === null) return { isSeen, boxes: [], points: [] };
  const at = seenFrom(camera, middleOf(now), size);
  const { altitude_m } = now.pursuer;
  const places: High[] = [
    now.pursuer,
    now.leader,
    { ...now.slot, altitude_m: now.leader.altitude_m },
  ];
  const path = forecast === null ? [] : pointsAfter(forecast, forecastIndex(forecast, t), until);
  const boxes: Box[] = places.flatMap((place) => {
    const point = at(place);
    return point === null ? [] : [square(point, halfOf(at, place))];
  });
  const lines = [now.pursuer, now.leader].flatMap(alongTrack);
  const points = [...path.map((place) => ({ ...place, altitude_m })), ...lines].flatMap(
    (place) => at(place) ?? [],
  );
  return { isSeen, boxes, points };
}

/** Half of an aircraft's length and span as the scene draws them [m]: 54 m, 80 times as large. */
const HALF = 2160;
/** Smaller than this nothing is seen [px]. */
const SMALLEST = 12;

/** How far an aircraft there reaches on the glass [px]. */
function halfOf(at: (place: High) => Point | null, place: High): number {
  const middle = at(place);
  const ends = [
    { ...place, x_m: place.x_m + HALF },
    { ...place, y_m: place.y_m + HALF },
  ].map((end) => at(end));
  const reach = ends.map((end) =>
    middle === null || end === null ? 0 : Math.hypot(end.x - middle.x, end.y - middle.y),
  );
  return Math.max(SMALLEST, ...reach);
}

/** Where an aircraft was and will be, about: marks and routes lie there. */
function alongTrack(aircraft: AircraftSample): High[] {
  const ahead = velocity(NM, aircraft.track_deg);
  return Array.from({ length: 41 }, (_, k) => ({
    x_m: aircraft.x_m + (k - 20) * ahead.x,
    y_m: aircraft.y_m + (k - 20) * ahead.y,
    altitude_m: aircraft.altitude_m,
  }));
}

/** The direction of north on the glass [deg right of up]. */
export function northOf(shown: Shown, camera: Camera, size: Size): number | null {
  const { now } = shown.picture.peek();
  if (now === null) return null;
  const middle = middleOf(now);
  const at = seenFrom(camera, middle, size);
  const here = at({ ...middle, altitude_m: 0 });
  const there = at({ ...middle, y_m: middle.y_m + 1000, altitude_m: 0 });
  if (here === null || there === null) return null;
  return (Math.atan2(there.x - here.x, here.y - there.y) * 180) / Math.PI;
}

function seenFrom(camera: Camera, middle: Place, { width, height }: Size) {
  return (place: High): Point | null => {
    const seen = see(camera, middle, place);
    if (seen === null || Math.abs(seen.x) > 1 || Math.abs(seen.y) > 1) return null;
    return { x: ((1 + seen.x) / 2) * width, y: ((1 - seen.y) / 2) * height };
  };
}

/** The point of a circle round the leader that is seen furthest to the right. */
function rightmost(camera: Camera, now: PairSample, radius: number): High | null {
  const { leader } = now;
  const middle = middleOf(now);
  let best: { place: High; x: number } | null = null;
  for (let k = 0; k < 36; k += 1) {
    const angle = (k * Math.PI) / 18;
    const place = {
      x_m: leader.x_m + radius * Math.cos(angle),
      y_m: leader.y_m + radius * Math.sin(angle),
      altitude_m: leader.altitude_m,
    };
    const seen = see(camera, middle, place);
    if (seen !== null && (best === null || seen.x > best.x)) best = { place, x: seen.x };
  }
  return radius > 0 ? (best?.place ?? null) : null;
}
