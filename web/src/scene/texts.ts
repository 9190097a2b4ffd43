/** What is written on the scene: the same words, numbers and colours as on the navigation display. */

import { samplePath, velocity } from "../geometry";
import { isRound } from "../nd/circle";
import { square } from "../nd/labelled";
import type { Label, Surroundings } from "../nd/labels";
import { relativeAltitude } from "../nd/leader";
import { SEPARATION } from "../nd/style";
import { isUrgent, TRAFFIC_COLOUR, trafficId } from "../nd/traffic";
import type { Box, Point } from "../nd/view";
import { WEATHER_COLOUR, weatherId } from "../nd/weather";
import type { Colour } from "../store/colours";
import { forecastIndex, pointsAfter } from "../store/forecast";
import type { Ghost } from "../store/ghost";
import type { Notice } from "../store/notices";
import type { PairSample } from "../store/pair";
import type { Picture } from "../store/picture";
import type { Shown } from "../store/shown";
import { formatLevel, formatMiles, NM } from "../units";
import type { AircraftSample } from "../wire";
import { type Camera, drawnLength, type High, see } from "./camera";
import { type Glass, glassOf, type Size } from "./glass";
import { gateEdges, LEVEL, leaderColour, levelsBelow, middleOf, raise, ring } from "./strokes";

/** Every text that can be written: those of the altitude scale last, as they are left out first. */
const LEVELS = [1, 2, 3, 4].map((k) => `level ${k}`);
export const TEXTS = [
  "own",
  "leader",
  "join",
  "slot",
  "closest",
  "min",
  "other",
  "other leader",
  ...LEVELS,
];

/** What the texts of other aircraft and of cells are called. */
export function textsAbout({ traffic, cells }: Picture): string[] {
  return [
    ...traffic.map(({ ident }) => trafficId(ident)).sort(),
    ...cells.map(({ ident }) => weatherId(ident)),
  ];
}

/** The texts of this moment, the most important first. */
export function textsOf(shown: Shown, camera: Camera, size: Size): Label[] {
  const [picture, numbers] = [shown.picture.peek(), shown.numbers.peek()];
  const { now, style, leader, join, closest, started } = picture;
  if (now === null) return [];
  const glass = glassOf(camera, middleOf(now), size);
  const [own, other] = [now.pursuer.altitude_m, now.leader.altitude_m];
  const text = (
    id: string,
    place: High | null,
    lines: readonly string[],
    colour: Colour,
    { side = 0, gap = 14, size: letters = 13, optional = false } = {},
  ): Label[] => {
    const at = place === null ? null : onGlass(glass, place);
    const written = lines.filter((line) => line !== "");
    if (at === null || written.length === 0) return [];
    const rows = written.map((line) => ({ text: line, colour }));
    return [{ id, at, lines: rows, side, gap, size: letters, optional }];
  };
  const beside = (aircraft: High) => ({ gap: 3 + reachOf(glass, aircraft, now) });
  const slotted = style !== null && style.slot !== "none";
  const look = SEPARATION[picture.separation.state];
  const isLost = picture.separation.state === "lost";
  return [
    ...text(
      "own",
      now.pursuer,
      [started?.pursuer.ident ?? "OWN", ownState(shown)],
      "ownship",
      beside(now.pursuer),
    ),
    ...(leader === null
      ? []
      : text("leader", leader, leaderLines(shown), leaderColour(picture), beside(leader))),
    ...text(
      "join",
      join === null ? null : { ...join, altitude_m: own },
      [numbers.toJoin === "" ? "" : `CNV ${numbers.toJoin}`],
      style?.pathColour ?? "plan",
      { side: 90 },
    ),
    ...text(
      "slot",
      slotted ? { ...now.slot, altitude_m: other } : null,
      [now.joined ? "SLOT · JOINED" : "SLOT"],
      style?.slotColour ?? "selected",
      { side: 180, gap: 3 + reachOf(glass, { ...now.slot, altitude_m: other }, now, GATE) },
    ),
    ...text(
      "closest",
      closest === null ? null : { ...closest.pursuer, altitude_m: own },
      [closest === null ? "" : `${formatMiles(closest.least)} NM ${numbers.least?.left ?? ""}`],
      closest?.isTooClose === true ? "caution" : "label",
      { side: -90 },
    ),
    ...text(
      "min",
      isRound(picture) && leader !== null ? rightmost(camera, now, picture.keepOut) : null,
      [`MIN ${numbers.minSeparation}`, isLost ? `d ${numbers.separation} NM` : ""],
      look.colour,
      { side: 90, gap: 8 },
    ),
    ...[...picture.traffic].reverse().flatMap((each) => {
      const { ident, aircraft, height, urgency } = each;
      const level = `${formatLevel(aircraft.altitude_m)} ${relativeAltitude(height)}`;
      return text(trafficId(ident), aircraft, [ident, level], TRAFFIC_COLOUR[urgency], {
        ...beside(aircraft),
        size: 11,
        optional: !isUrgent(each) && shown.chosen.peek() !== ident,
      });
    }),
    ...picture.cells.flatMap(({ ident, corners, urgency }) => {
      const [corner] = corners;
      const place = corner === undefined ? null : { x_m: corner.x, y_m: corner.y, altitude_m: own };
      const look = { size: 11, optional: urgency === "none" };
      return text(weatherId(ident), place, [ident], WEATHER_COLOUR[urgency], look);
    }),
    ...others(shown.ghost.peek()).flatMap(({ id, name, aircraft }) =>
      text(id, aircraft, [name], "superseded", beside(aircraft)),
    ),
    ...levels(glass, now.pursuer).flatMap(({ id, place }) =>
      text(id, place, [formatLevel(place.altitude_m)], "superseded", {
        side: 90,
        gap: 6,
        size: 11,
        optional: true,
      }),
    ),
  ];
}

/** Both aircraft of the flight that this one is compared with. */
function others(ghost: Ghost | null): { id: string; name: string; aircraft: AircraftSample }[] {
  if (ghost === null) return [];
  const { name, pursuer, leader } = ghost;
  const own = { id: "other", name, aircraft: pursuer };
  return leader === null
    ? [own]
    : [own, { id: "other leader", name: `${name} LDR`, aircraft: leader }];
}

/** Own ship's speed and level, as far as they are known. */
function ownState({ picture, numbers }: Shown): string {
  const { now, guided } = picture.peek();
  const level = now === null ? "" : formatLevel(now.pursuer.altitude_m);
  return guided === null ? level : `${numbers.peek().gs} kt ${level}`;
}

/** The leader's name, its speed and level while they are known, and how old that is once it matters. */
function leaderLines({ picture, numbers }: Shown): string[] {
  const { ident, now, leaderAge, ageSeconds } = picture.peek();
  const speed = numbers.peek().leaderSpeed;
  const level = now === null ? "" : formatLevel(now.leader.altitude_m);
  const age = leaderAge.showsAge ? `${ageSeconds} S OLD` : "";
  return [ident, speed === "" ? "" : `${speed} kt ${level}`, age];
}

/** The marks of the altitude scale on own ship's line to the ground; none where they would be in a heap. */
function levels(glass: Glass, own: AircraftSample): { id: string; place: High }[] {
  const places = levelsBelow(own.altitude_m).map((altitude_m) => ({ ...own, altitude_m }));
  const [foot, first] = [
    glass.at({ ...own, altitude_m: 0 }),
    glass.at({ ...own, altitude_m: LEVEL }),
  ];
  if (foot === null || first === null || Math.hypot(foot.x - first.x, foot.y - first.y) < APART)
    return [];
  return places.slice(0, LEVELS.length).map((place, k) => ({ id: LEVELS[k] ?? "", place }));
}

/** Levels whose marks are nearer to each other have no names [px]. */
const APART = 14;

/** What the texts keep clear of: both aircraft, the gate, and all lines. */
export function aroundTexts(shown: Shown, camera: Camera, size: Size): Surroundings {
  const picture = shown.picture.peek();
  const { now, leader, style, join, closest } = picture;
  const inside = { x: 4, y: 4, width: size.width - 8, height: size.height - 26 };
  // North stands in the upper right corner.
  const isSeen = ({ x, y }: Point) =>
    x > inside.x &&
    x < inside.x + inside.width &&
    y > inside.y &&
    y < inside.y + inside.height &&
    (x < size.width - 48 || y > 52);
  if (now === null) return { isSeen, boxes: [], points: [] };
  const glass = glassOf(camera, middleOf(now), size);
  const { altitude_m } = now.pursuer;
  const box = (place: High, half: number): Box[] => {
    const point = onGlass(glass, place);
    return point === null ? [] : [square(point, half)];
  };
  const boxes = [
    ...(warningOf(picture) === null ? [] : [warningBox(size)]),
    ...box(now.pursuer, 0.8 * reachOf(glass, now.pursuer, now)),
    ...(leader === null ? [] : box(leader, 0.8 * reachOf(glass, leader, now))),
    ...picture.traffic.flatMap(({ aircraft }) =>
      box(aircraft, 0.7 * reachOf(glass, aircraft, now)),
    ),
    ...(join === null ? [] : box({ ...join, altitude_m }, 6)),
    ...(closest === null ? [] : box({ ...closest.pursuer, altitude_m }, 6)),
  ];
  const points = dense(glass, [
    ...pathsOf(picture, now),
    ...[now.pursuer, ...(leader === null ? [] : [leader])].map((each) => [
      each,
      { ...each, altitude_m: 0 },
    ]),
    ...(isRound(picture) && leader !== null ? [ring(leader, picture.keepOut)] : []),
    ...(style === null || style.slot === "none"
      ? []
      : gateEdges(now.slot, now.leader.altitude_m, drawnLength(now.separation_m), "open")),
  ]);
  return { isSeen, boxes, points };
}

/** The most urgent warning or caution, in the words of the navigation display. */
export function warningOf({ notices: [first] }: Picture): Notice | null {
  return first?.level === "warning" || first?.level === "caution" ? first : null;
}

/** Where it stands: over the middle of the picture's upper edge. */
function warningBox({ width }: Size): Box {
  return { x: width / 2 - 100, y: 0, width: 200, height: 36 };
}

/** The path ahead, the leader's route, and where both have been. */
function pathsOf(picture: Picture, now: PairSample): High[][] {
  const { forecast, proposed, route, wind, t, until, trail, ownTrail } = picture;
  const [own, other] = [now.pursuer.altitude_m, now.leader.altitude_m];
  const ahead =
    proposed !== null
      ? samplePath(proposed.plan.segments, wind, t - proposed.t_s)
      : forecast === null
        ? []
        : pointsAfter(forecast, forecastIndex(forecast, t), until);
  const past = (points: typeof trail, altitude_m: number) =>
    points.slice(-30).map(({ x, y }) => ({ x_m: x, y_m: y, altitude_m }));
  return [
    raise(ahead, own),
    raise(route === null ? alongTrack(now.leader) : samplePath(route.segments, wind, t), other),
    past(ownTrail, own),
    past(trail, other),
  ];
}

/** Points of lines on the glass, so close that no line of text stands between two of them. */
function dense(glass: Glass, lines: readonly (readonly High[])[]): Point[] {
  const points: Point[] = [];
  for (const line of lines) {
    let before: Point | null = null;
    for (const place of line) {
      const point = glass.at(place);
      if (point !== null && before !== null) {
        const long = Math.hypot(point.x - before.x, point.y - before.y);
        const count = Math.min(80, Math.ceil(long / BESIDE));
        for (let k = 1; k <= count; k += 1)
          points.push({
            x: before.x + ((point.x - before.x) * k) / count,
            y: before.y + ((point.y - before.y) * k) / count,
          });
      }
      before = point;
    }
  }
  return points.filter(
    ({ x, y }) => x > 0 && y > 0 && x < glass.size.width && y < glass.size.height,
  );
}

/** Between two points of a line [px]. */
const BESIDE = 10;
/** Smaller than this nothing is seen [px]. */
const SMALLEST = 10;
/** How far the gate reaches, by half the length of an aircraft. */
const GATE = 1.6;

/** How far an aircraft there reaches on the glass, as it is drawn [px]. */
function reachOf(glass: Glass, place: High, now: PairSample, times = 1): number {
  return Math.max(SMALLEST, (times * drawnLength(now.separation_m) * glass.scale(place)) / 2);
}

/** Where an aircraft was and will be, about. */
function alongTrack(aircraft: AircraftSample): High[] {
  const ahead = velocity(NM, aircraft.track_deg);
  return [-20, 20].map((k) => ({
    x_m: aircraft.x_m + k * ahead.x,
    y_m: aircraft.y_m + k * ahead.y,
    altitude_m: aircraft.altitude_m,
  }));
}

/** The direction of north on the glass [deg right of up]. */
export function northOf(shown: Shown, camera: Camera, size: Size): number | null {
  const { now } = shown.picture.peek();
  if (now === null) return null;
  const middle = middleOf(now);
  const glass = glassOf(camera, middle, size);
  const here = glass.at({ ...middle, altitude_m: 0 });
  const there = glass.at({ ...middle, y_m: middle.y_m + 1000, altitude_m: 0 });
  if (here === null || there === null) return null;
  return (Math.atan2(there.x - here.x, here.y - there.y) * 180) / Math.PI;
}

/** A place that is in the window. */
function onGlass(glass: Glass, place: High): Point | null {
  const point = glass.at(place);
  if (point === null) return null;
  const { width, height } = glass.size;
  return point.x < 0 || point.y < 0 || point.x > width || point.y > height ? null : point;
}

/** The point of a circle round the leader that is seen furthest to the right. */
function rightmost(camera: Camera, now: PairSample, radius: number): High | null {
  if (radius <= 0) return null;
  const middle = middleOf(now);
  let best: { place: High; x: number } | null = null;
  for (const place of ring(now.leader, radius)) {
    const seen = see(camera, middle, place);
    if (seen !== null && (best === null || seen.x > best.x)) best = { place, x: seen.x };
  }
  return best?.place ?? null;
}
