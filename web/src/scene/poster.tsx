/** The scene until its first picture is there: the same flight, seen by the page's own camera. */

import type { ReadonlySignal } from "@preact/signals";
import { useComputed } from "@preact/signals";
import { samplePath } from "../geometry";
import { ink, LINES, SEPARATION } from "../nd/style";
import { onwards, round } from "../nd/view";
import type { Colour } from "../store/colours";
import { forecastIndex, pointsAfter } from "../store/forecast";
import type { Picture, Shown } from "../store/picture";
import { DEG, NM } from "../units";
import type { AircraftSample } from "../wire";
import { type Camera, chaseCamera, type High, see } from "./camera";
import { middleOf, type Size } from "./texts";

/** Lines of the ground [m]: so far apart, and so far from the middle. */
const CELL = 5 * NM;
const CELLS = 12;
/** Nothing is drawn so far outside the picture: parts of half its sides. */
const OUTSIDE = 4;
/** Half of the gate's width and height [m], an aircraft's length, and half the cross at its foot [m]. */
const GATE = { across: 1800, up: 600 } as const;
const LENGTH = 4300;
const FOOT = 900;

interface Stroke {
  readonly name: string;
  readonly d: string;
  readonly colour: Colour | "edge";
  readonly width: number;
  readonly dash: string;
}

/** The camera of the poster; null before the first position. */
export function posterCamera({ now, keepOut }: Picture, { width, height }: Size): Camera | null {
  if (now === null || width === 0 || height === 0) return null;
  return chaseCamera(now.pursuer, now.leader, keepOut, width / height);
}

interface Props {
  readonly shown: Shown;
  readonly camera: ReadonlySignal<Camera | null>;
  readonly size: ReadonlySignal<Size>;
}

export function Poster({ shown, camera, size }: Props) {
  const strokes = useComputed(() =>
    camera.value === null ? [] : strokesOf(shown.picture.peek(), camera.value, size.value),
  );
  return (
    <svg class="poster nd" aria-hidden="true">
      {strokes.value.map(({ name, d, colour, width, dash }) => (
        <path
          key={name}
          class={`poster-${name}`}
          d={d}
          fill={name === "own" || name === "leader" ? ink(colour as Colour) : "none"}
          stroke={`var(--${colour})`}
          stroke-width={width}
          stroke-dasharray={dash}
        />
      ))}
    </svg>
  );
}

/** All lines of the picture, bottom to top. */
export function strokesOf(picture: Picture, camera: Camera, size: Size): Stroke[] {
  const { now, style, route, wind, t, proposed, forecast, until, keepOut, designated } = picture;
  if (now === null) return [];
  const middle = middleOf(now);
  const line = (points: readonly High[]) => lineOf(points.map((each) => at(each)));
  const at = (place: High) => {
    const seen = see(camera, middle, place);
    if (seen === null || Math.abs(seen.x) > OUTSIDE || Math.abs(seen.y) > OUTSIDE) return null;
    return { x: ((1 + seen.x) / 2) * size.width, y: ((1 - seen.y) / 2) * size.height };
  };
  const [own, other] = [now.pursuer.altitude_m, now.leader.altitude_m];
  const high = <P extends { x_m: number; y_m: number }>(points: readonly P[], altitude_m: number) =>
    points.map(({ x_m, y_m }) => ({ x_m, y_m, altitude_m }));
  const strokes: Stroke[] = [
    { name: "ground", d: ground(middle).map(line).join(""), colour: "edge", width: 1, dash: "" },
  ];
  const add = (name: string, d: string, style: Omit<Stroke, "name" | "d">) => {
    if (d !== "") strokes.push({ name, d, ...style });
  };
  for (const [name, each, colour] of [
    ["own-drop", now.pursuer, "ownship"],
    ["leader-drop", now.leader, "leader"],
  ] as const)
    add(name, drop(each).map(line).join(""), { colour, width: 1, dash: "" });
  if (route !== null)
    add("route", line(high(samplePath(route.segments, wind, t), other)), LINES.declared);
  if (proposed !== null) {
    const { segments } = proposed.plan;
    const dashed = style?.pathColour === "armed" ? LINES.armed : LINES.proposed;
    add("path", line(high(samplePath(segments, wind, t - proposed.t_s), own)), dashed);
  } else if (forecast !== null && style?.path === "committed") {
    const ahead = pointsAfter(forecast, forecastIndex(forecast, t), until);
    add("path", line(high([now.pursuer, ...ahead], own)), LINES.active);
  }
  if (designated) {
    const circle = Array.from({ length: 73 }, (_, k) => onwards(now.leader, unit(5 * k), keepOut));
    add("min", line(high(circle, other)), SEPARATION[picture.separation.state]);
  }
  if (style !== null && style.slot !== "none") {
    const side = unit(now.slot.heading_deg + 90);
    const corner = (across: number, up: number) => ({
      ...onwards(now.slot, side, across * GATE.across),
      altitude_m: other + up * GATE.up,
    });
    const frame = [corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1), corner(-1, -1)];
    add("slot", line(frame), { colour: style.slotColour, width: 2.5, dash: "" });
  }
  add("leader", `${line(shape(now.leader))}Z`, { colour: "leader", width: 1.5, dash: "" });
  add("own", `${line(shape(now.pursuer))}Z`, { colour: "ownship", width: 1.5, dash: "" });
  return strokes;
}

/** Straight pieces between points that are seen. */
function lineOf(points: readonly ({ x: number; y: number } | null)[]): string {
  let data = "";
  let isDown = false;
  for (const point of points) {
    if (point !== null) data += `${isDown ? "L" : "M"}${round(point.x)} ${round(point.y)}`;
    isDown = point !== null;
  }
  return data;
}

/** The lines of the ground round a place, in pieces of a cell: those behind the camera are left out. */
function ground(middle: { x_m: number; y_m: number }): High[][] {
  const [east, north] = [middle.x_m, middle.y_m].map((each) => Math.round(each / CELL) * CELL);
  const steps = Array.from({ length: 2 * CELLS + 1 }, (_, k) => (k - CELLS) * CELL);
  const place = (x: number, y: number) => ({
    x_m: (east ?? 0) + x,
    y_m: (north ?? 0) + y,
    altitude_m: 0,
  });
  return steps.flatMap((a) => [steps.map((b) => place(a, b)), steps.map((b) => place(b, a))]);
}

/** Down to the ground, and a cross there. */
function drop({ x_m, y_m, altitude_m }: AircraftSample): High[][] {
  const foot = (x: number, y: number) => ({ x_m: x_m + x, y_m: y_m + y, altitude_m: 0 });
  return [
    [{ x_m, y_m, altitude_m }, foot(0, 0)],
    [foot(-FOOT, 0), foot(FOOT, 0)],
    [foot(0, -FOOT), foot(0, FOOT)],
  ];
}

/** An arrowhead as long as the aircraft is drawn. */
function shape(aircraft: AircraftSample): High[] {
  const [ahead, side] = [unit(aircraft.heading_deg), unit(aircraft.heading_deg + 90)];
  return [
    [0.5, 0],
    [-0.5, 0.45],
    [-0.25, 0],
    [-0.5, -0.45],
  ].map(([along = 0, across = 0]) => ({
    ...onwards(onwards(aircraft, ahead, along * LENGTH), side, across * LENGTH),
    altitude_m: aircraft.altitude_m,
  }));
}

function unit(heading: number): { x: number; y: number } {
  return { x: Math.sin(heading * DEG), y: Math.cos(heading * DEG) };
}
