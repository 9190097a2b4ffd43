/** What can be taken hold of of other aircraft and cells: place and heading, middle and edge. */

import {
  bearing,
  distance,
  type Layout,
  type Place,
  type Point,
  type Pose,
  project,
} from "../nd/view";
import { DEG, formatHeading, formatMiles, NM } from "../units";
import { BOUNDS, clamp, type Situation, stepMiles } from "./situation";

const PARTS = ["traffic", "traffic-heading", "cell", "cell-edge"] as const;
type Part = (typeof PARTS)[number];
/** Of the aircraft or cell of that number. */
export type OtherHandle = `${Part}/${number}`;

interface OtherPart {
  readonly part: Part;
  readonly number: number;
}

/** Those that a situation has. */
export function otherHandles({ traffic, cells }: Situation): OtherHandle[] {
  return [
    ...cells.flatMap((_, k) => [`cell-edge/${k}`, `cell/${k}`] as const),
    ...traffic.flatMap((_, k) => [`traffic/${k}`, `traffic-heading/${k}`] as const),
  ];
}

/** What a handle belongs to; null if that is neither an aircraft nor a cell beside the two. */
export function otherPart(name: string): OtherPart | null {
  const [part, number] = name.split("/");
  const found = PARTS.find((each) => each === part);
  return found === undefined || number === undefined
    ? null
    : { part: found, number: Number(number) };
}

/** The point so far from another, in a direction [deg right of up]. */
export function towards({ x, y }: Point, direction: number, length: number): Point {
  return { x: x + length * Math.sin(direction * DEG), y: y - length * Math.cos(direction * DEG) };
}

export function pointOfOther(
  { part, number }: OtherPart,
  { traffic, cells }: Situation,
  { layout, middle, stick }: { layout: Layout; middle: Pose; stick: number },
): Point {
  const aircraft = traffic[number];
  const cell = cells[number];
  const at = (place: Place) => project(layout, middle, place);
  switch (part) {
    case "traffic":
      return at(aircraft ?? middle);
    case "traffic-heading":
      return towards(at(aircraft ?? middle), aircraft?.heading_deg ?? 0, stick);
    case "cell":
      return at(cell ?? middle);
    case "cell-edge":
      return towards(at(cell ?? middle), 90, (cell?.radius_m ?? 0) * layout.scale);
  }
}

export function dragOther(
  { part, number }: OtherPart,
  situation: Situation,
  place: Place,
): Situation {
  const to = { x_m: place.x_m, y_m: place.y_m };
  switch (part) {
    case "traffic":
      return changeTraffic(situation, number, () => to);
    case "traffic-heading":
      return changeTraffic(situation, number, (each) => ({
        heading_deg: Math.round(bearing(each, place)),
      }));
    case "cell":
      return changeCell(situation, number, () => to);
    case "cell-edge":
      return changeCell(situation, number, (each) => ({
        radius_m: radiusOf(distance(each, place)),
      }));
  }
}

export function keyOther(
  { part, number }: OtherPart,
  situation: Situation,
  [right, up]: readonly [number, number],
  isFine: boolean,
): Situation {
  const step = (isFine ? 0.1 : 1) * NM;
  const moved = ({ x_m, y_m }: Place) => ({ x_m: x_m + right * step, y_m: y_m + up * step });
  switch (part) {
    case "traffic":
      return changeTraffic(situation, number, moved);
    case "traffic-heading":
      return changeTraffic(situation, number, ({ heading_deg }) => ({
        heading_deg: Math.round(heading_deg) + (right + up) * (isFine ? 1 : 5),
      }));
    case "cell":
      return changeCell(situation, number, moved);
    case "cell-edge":
      return changeCell(situation, number, ({ radius_m }) => ({
        radius_m: radiusOf(stepMiles(radius_m, (right + up) * (isFine ? 0.1 : 0.5))),
      }));
  }
}

/** The situation without the aircraft or cell that a handle belongs to. */
export function removeOther({ part, number }: OtherPart, situation: Situation): Situation {
  return part === "traffic" || part === "traffic-heading"
    ? { ...situation, traffic: situation.traffic.toSpliced(number, 1) }
    : { ...situation, cells: situation.cells.toSpliced(number, 1) };
}

/** The situation with something else of one other aircraft. */
export function changeTraffic(
  situation: Situation,
  number: number,
  change: (each: Situation["traffic"][number]) => Partial<Situation["traffic"][number]>,
): Situation {
  const traffic = situation.traffic.map((each, k) =>
    k === number ? { ...each, ...change(each) } : each,
  );
  return { ...situation, traffic };
}

export function changeCell(
  situation: Situation,
  number: number,
  change: (each: Situation["cells"][number]) => Partial<Situation["cells"][number]>,
): Situation {
  const cells = situation.cells.map((each, k) =>
    k === number ? { ...each, ...change(each) } : each,
  );
  return { ...situation, cells };
}

function radiusOf(length: number): number {
  return clamp(stepMiles(length, 0), BOUNDS.radius);
}

/** What a handle is and what it says now, for those who do not see it. */
export function sayOther({ part, number }: OtherPart, { traffic, cells }: Situation) {
  const aircraft = traffic[number];
  const cell = cells[number];
  const place = (label: string, { x_m, y_m }: Place) => ({
    label: `${label}: place; Delete removes it`,
    text: `${side(x_m, "east", "west")}, ${side(y_m, "north", "south")}`,
    value: Math.round(x_m / NM),
    least: -540,
    most: 540,
  });
  switch (part) {
    case "traffic":
      return place(aircraft?.ident ?? "", aircraft ?? { x_m: 0, y_m: 0 });
    case "traffic-heading":
      return {
        label: `${aircraft?.ident}: heading`,
        text: `${formatHeading(aircraft?.heading_deg ?? 0)} degrees`,
        value: Math.round(aircraft?.heading_deg ?? 0),
        least: 0,
        most: 360,
      };
    case "cell":
      return place(cell?.ident ?? "", cell ?? { x_m: 0, y_m: 0 });
    case "cell-edge":
      return {
        label: `${cell?.ident}: radius`,
        text: `${formatMiles(cell?.radius_m ?? 0)} nautical miles`,
        value: Number(((cell?.radius_m ?? 0) / NM).toFixed(1)),
        least: 0,
        most: Math.floor(BOUNDS.radius[1] / NM),
      };
  }
}

export function side(length: number, positive: string, negative: string): string {
  return `${formatMiles(Math.abs(length))} miles ${length < 0 ? negative : positive}`;
}
