/** All that the poster draws of a picture, bottom to top: ground, paths, circles, the gate, both aircraft. */

import { samplePath, velocity } from "../geometry";
import { isRound } from "../nd/circle";
import { LINES, SEPARATION } from "../nd/style";
import { TRAFFIC_COLOUR } from "../nd/traffic";
import { onwards, type Place } from "../nd/view";
import { WEATHER_COLOUR } from "../nd/weather";
import type { Colour } from "../store/colours";
import { forecastIndex, pointsAfter } from "../store/forecast";
import type { Ghost } from "../store/ghost";
import type { Picture } from "../store/picture";
import type { TrailPoint } from "../store/trail";
import { type Cell, edgeOf } from "../store/weather";
import { FT, NM } from "../units";
import type { AircraftSample, PathPoint } from "../wire";
import { airliner } from "./airliner";
import { type Camera, drawnLength, type High } from "./camera";
import { type Glass, glassOf, type Size } from "./glass";

export interface Stroke {
  readonly name: string;
  readonly d: string;
  readonly colour: Colour | "ground-line";
  /** Width [px]; 0 for what is filled. */
  readonly width: number;
  readonly dash: string;
  /** How much of the colour is seen, 0 to 1. */
  readonly opacity?: number;
  /** How much light falls on what is filled, 0 to 1. */
  readonly light?: number;
}

/** Lines of the ground [m]: so far apart, every so-manieth stronger; haze takes them away in three steps. */
const CELL = 5 * NM;
const STRONG = 4;
const HAZE = [
  { to: 70_000, opacity: 0.8 },
  { to: 150_000, opacity: 0.4 },
  { to: 300_000, opacity: 0.15 },
] as const;
/** Levels of the altitude scale are so far apart [m], and none is so near below the aircraft [levels]; half
 * the crosses at its foot and on it [m]. */
export const LEVEL = 10_000 * FT;
const HIDDEN = 0.3;
const FOOT = 900;
const TICK = 450;
/** Columns of weather reach so high [m], with chords of so much [deg]; levels this near are one [m]. */
const CELL_TOP = 13_000;
const CELL_STEP = 12;
const LEVEL_FROM = 150;
/** The gate by the length of an aircraft as it is drawn, and what is left of its edges when it holds one. */
const GATE = { long: 1.5, wide: 1.3, high: 0.5 } as const;
const HELD = 0.22;
/** The middles of the two aircraft when they are closest are ringed so far round [m]. */
const HALO = 1000;
/** Marks of the past are so long [m]. */
const MARK = 250;

/** The middle of the two aircraft is the scene's. */
export function middleOf(now: { readonly pursuer: Place; readonly leader: Place }): Place {
  const { pursuer, leader } = now;
  return { x_m: (pursuer.x_m + leader.x_m) / 2, y_m: (pursuer.y_m + leader.y_m) / 2 };
}

export function strokesOf(
  picture: Picture,
  camera: Camera,
  size: Size,
  ghost: Ghost | null = null,
): Stroke[] {
  const { now, style, route, wind, t, leader } = picture;
  if (now === null) return [];
  const glass = glassOf(camera, middleOf(now), size);
  const length = drawnLength(now.separation_m);
  const other = now.leader.altitude_m;
  const strokes: Stroke[] = groundLines(middleOf(now), glass);
  const add = (name: string, d: string, look: Omit<Stroke, "name" | "d">) => {
    // of an aircraft that is out of sight no corner is left
    if (d.startsWith("M")) strokes.push({ name, d, ...look });
  };
  const hue = leaderColour(picture);
  for (const cell of picture.cells) {
    const { colour, ...look } = cell.urgency === "none" ? LINES.hatch : LINES.cell;
    const hue = cell.urgency === "none" ? colour : WEATHER_COLOUR[cell.urgency];
    const { walls, rims } = column(cell, glass);
    add(`cell-${cell.ident}`, walls, { ...look, colour: hue, width: 0, opacity: 0.22 });
    add(`cell-rims-${cell.ident}`, rims, { ...look, colour: hue });
  }
  for (const { aircraft, ident, urgency } of picture.traffic) {
    const colour = TRAFFIC_COLOUR[urgency];
    add(`traffic-drop-${ident}`, dropLine(aircraft, glass), { colour, width: 0.8, dash: "" });
    add(`traffic-level-${ident}`, levelMark(aircraft, now.pursuer.altitude_m, glass), {
      colour: "ownship",
      width: 1,
      dash: "",
    });
  }
  add("own-drop", dropLine(now.pursuer, glass), { colour: "ownship", width: 1, dash: "" });
  if (leader !== null)
    add("leader-drop", dropLine(leader, glass), { colour: hue, width: 1, dash: "" });
  const past = { width: 2, dash: "", opacity: 0.7 };
  add("own-past", marks(picture.ownTrail, now.pursuer, glass), { colour: "ownship", ...past });
  add("leader-past", marks(picture.trail, now.leader, glass), { colour: "leader", ...past });
  if (ghost !== null) {
    const { pursuer, flown } = ghost;
    add("other-drop", dropLine(pursuer, glass), { ...LINES.other, width: 1 });
    add("other-path", glass.line(raise(flown, pursuer.altitude_m)), LINES.other);
  }
  if (route !== null) {
    const look = route.intent_known ? LINES.declared : LINES.extrapolated;
    add("route", glass.line(raise(samplePath(route.segments, wind, t), other)), look);
  }
  if (picture.proposed !== null)
    add(
      "path",
      pathLine(picture, glass),
      style?.pathColour === "armed" ? LINES.armed : LINES.proposed,
    );
  else {
    const shadow = { colour: "plan", width: 1.2, dash: "", opacity: 0.35 } as const;
    add("path-shadow", pathLine(picture, glass, 0), shadow);
    add("path", pathLine(picture, glass), LINES.active);
  }
  const { closest } = picture;
  if (closest !== null) {
    const [mine, its] = [
      { ...closest.pursuer, altitude_m: now.pursuer.altitude_m },
      { ...closest.leader, altitude_m: other },
    ];
    const pair = [ring(mine, HALO), ring(its, HALO), [mine, its]].map((each) => glass.line(each));
    add("closest", pair.join(""), LINES.closest);
    add("closest-min", glass.line(ring(its, picture.keepOut)), LINES.ghostRing);
  }
  if (isRound(picture) && leader !== null && picture.keepOut > 0) {
    add("min", glass.line(ring(leader, picture.keepOut)), SEPARATION[picture.separation.state]);
    if (now.margin_m > 0)
      add("margin", glass.line(ring(leader, picture.keepOut + now.margin_m)), LINES.margin);
  }
  if (style !== null && style.slot !== "none") {
    const look = style.slot === "crossed" ? "crossed" : now.joined ? "held" : "open";
    const edges = gateEdges(now.slot, other, length, look).map((each) => glass.line(each));
    const foot = glass.line([
      { ...now.slot, altitude_m: other },
      { ...now.slot, altitude_m: 0 },
    ]);
    add("slot-drop", foot, { colour: style.slotColour, width: 0.8, dash: "" });
    add("slot", edges.join(""), { colour: style.slotColour, width: 1.6, dash: "" });
  }
  if (ghost !== null) {
    add("own-flown", glass.line(raise(ghost.own, now.pursuer.altitude_m)), LINES.beside);
    add("other-flown", glass.line(raise(ghost.flown, ghost.pursuer.altitude_m)), LINES.other);
    for (const [name, aircraft] of [
      ["other", ghost.pursuer],
      ["other-leader", ghost.leader],
    ] as const)
      for (const facet of aircraft === null ? [] : airliner(aircraft, length, glass))
        add(`${name}-${facet.name}`, facet.d, {
          colour: "superseded",
          width: 0,
          dash: "",
          light: 0.7 * facet.light,
        });
  }
  const both = [
    { name: "own", aircraft: now.pursuer, colour: "ownship" as const },
    ...(leader === null ? [] : [{ name: "leader", aircraft: leader, colour: hue }]),
    ...picture.traffic.map(({ ident, aircraft, urgency }) => ({
      name: `traffic-${ident}`,
      aircraft,
      colour: TRAFFIC_COLOUR[urgency],
    })),
    ...(ghost === null
      ? []
      : [{ name: "other", aircraft: ghost.pursuer, colour: LINES.other.colour }]),
  ];
  for (const { name, aircraft, colour } of both.sort((a, b) => far(b.aircraft) - far(a.aircraft)))
    for (const facet of airliner(aircraft, length, glass))
      add(`${name}-${facet.name}`, facet.d, { colour, width: 0, dash: "", light: facet.light });
  return strokes;

  function far(aircraft: AircraftSample): number {
    return glass.depth(aircraft);
  }
}

/** Red where the minimum is lost; amber where the leader's reports are old. */
export function leaderColour({ separation, leaderAge }: Picture): Colour {
  return separation.state === "lost" ? "alert" : leaderAge.colour;
}

/** The path ahead: proposed, accepted or flown. `altitude` [m], or that of own ship */
function pathLine(picture: Picture, glass: Glass, altitude?: number): string {
  const { now, style, proposed, forecast, wind, t, until } = picture;
  if (now === null) return "";
  const height = altitude ?? now.pursuer.altitude_m;
  if (proposed !== null)
    return glass.line(raise(samplePath(proposed.plan.segments, wind, t - proposed.t_s), height));
  if (forecast === null || style?.path !== "committed") return "";
  const ahead = pointsAfter(forecast, forecastIndex(forecast, t), until);
  return glass.line(raise([now.pursuer, ...ahead], height));
}

export function raise(points: readonly Place[], altitude_m: number): High[] {
  return points.map(({ x_m, y_m }) => ({ x_m, y_m, altitude_m }));
}

/** A circle round a place, level. `radius` [m] */
export function ring(middle: High, radius: number): High[] {
  const { altitude_m } = middle;
  return Array.from({ length: 73 }, (_, k) => ({
    ...onwards(middle, velocity(1, 5 * k), radius),
    altitude_m,
  }));
}

/** The line down to the ground, with a tick at each level and a cross at its foot. */
function dropLine(aircraft: High, glass: Glass): string {
  const { x_m, y_m, altitude_m } = aircraft;
  const cross = (height: number, half: number) => [
    [
      { x_m: x_m - half, y_m, altitude_m: height },
      { x_m: x_m + half, y_m, altitude_m: height },
    ],
    [
      { x_m, y_m: y_m - half, altitude_m: height },
      { x_m, y_m: y_m + half, altitude_m: height },
    ],
  ];
  const ticks = levelsBelow(altitude_m).flatMap((height) => cross(height, TICK));
  const lines = [
    [
      { x_m, y_m, altitude_m },
      { x_m, y_m, altitude_m: 0 },
    ],
    ...cross(0, FOOT),
    ...ticks,
  ];
  return lines.map((each) => glass.line(each)).join("");
}

/** Own ship's level over or under another aircraft: a tick, and a line to there; "" where they are level. */
function levelMark({ x_m, y_m, altitude_m }: High, level: number, glass: Glass): string {
  if (Math.abs(altitude_m - level) < LEVEL_FROM) return "";
  const tick = [-TICK, TICK].map((half) => ({ x_m: x_m + half, y_m, altitude_m: level }));
  const line = [altitude_m, level].map((height) => ({ x_m, y_m, altitude_m: height }));
  return glass.line(tick) + glass.line(line);
}

/** A weather cell as a column from the ground to above all levels: its walls as one shape, and both rims. */
function column(cell: Cell, glass: Glass): { walls: string; rims: string } {
  const edge = edgeOf(cell, CELL_STEP).map(({ x, y }) => ({ x_m: x, y_m: y }));
  const walls = edge.map((from, k) => {
    const to = edge[(k + 1) % edge.length] ?? from;
    const outline = [
      { ...from, altitude_m: 0 },
      { ...to, altitude_m: 0 },
      { ...to, altitude_m: CELL_TOP },
      { ...from, altitude_m: CELL_TOP },
    ];
    const points = outline.map((each) => glass.at(each)).filter((each) => each !== null);
    if (points.length < outline.length) return ""; // beside or behind the camera
    const area = points.reduce((sum, { x, y }, i) => {
      const next = points[(i + 1) % points.length] ?? { x, y };
      return sum + x * next.y - next.x * y;
    }, 0);
    const round = area < 0 ? [...points].reverse() : points; // one way round: no wall cuts another out
    return `M${round.map(({ x, y }) => `${x} ${y}`).join("L")}Z`;
  });
  const closed = [...edge, ...edge.slice(0, 1)];
  const rims = [0, CELL_TOP].map((height) => glass.line(raise(closed, height)));
  return { walls: walls.join(""), rims: rims.join("") };
}

/** The levels of the altitude scale below an aircraft, but for one that its picture would hide [m]. */
export function levelsBelow(altitude: number): number[] {
  return Array.from(
    { length: Math.max(0, Math.floor(altitude / LEVEL - HIDDEN)) },
    (_, k) => (k + 1) * LEVEL,
  );
}

/** Where an aircraft has been: marks apart from each other, never a line. */
function marks(trail: readonly TrailPoint[], { altitude_m }: AircraftSample, glass: Glass): string {
  return trail
    .flatMap((point, k) => {
      const next = trail[k + 1];
      if (next === undefined) return [];
      const far = Math.hypot(next.x - point.x, next.y - point.y) || 1;
      const along = { x: (next.x - point.x) / far, y: (next.y - point.y) / far };
      const from = { x_m: point.x, y_m: point.y, altitude_m };
      return glass.line([from, { ...onwards(from, along, MARK), altitude_m }]);
    })
    .join("");
}

/** The edges of the gate: a box along the way through it; held, its corners only; crossed, its front. */
export function gateEdges(
  slot: PathPoint,
  altitude: number,
  length: number,
  look: "open" | "held" | "crossed",
): High[][] {
  const [ahead, beside] = [velocity(1, slot.heading_deg), velocity(1, slot.heading_deg + 90)];
  const corner = (along: number, across: number, up: number): High => ({
    ...onwards(
      onwards(slot, ahead, (along * length * GATE.long) / 2),
      beside,
      (across * length * GATE.wide) / 2,
    ),
    altitude_m: altitude + (up * length * GATE.high) / 4, // heights are drawn twice as large
  });
  const signs = [-1, 1] as const;
  const corners = signs.flatMap((x) => signs.flatMap((y) => signs.map((z) => corner(x, y, z))));
  const edge = (a: number, b: number) => [corners[a], corners[b]] as [High, High];
  const edges = corners.flatMap((_, k) =>
    [1, 2, 4].flatMap((bit) => ((k & bit) === 0 ? [edge(k, k | bit)] : [])),
  );
  if (look === "crossed") return [...edges, edge(4, 7), edge(5, 6)];
  if (look === "open") return edges;
  return edges.flatMap(([a, b]) => [
    [a, part(a, b, HELD)],
    [part(a, b, 1 - HELD), b],
  ]);
}

function part(a: High, b: High, share: number): High {
  return {
    x_m: a.x_m + share * (b.x_m - a.x_m),
    y_m: a.y_m + share * (b.y_m - a.y_m),
    altitude_m: a.altitude_m + share * (b.altitude_m - a.altitude_m),
  };
}

/** The lines of the ground round a place, fainter the farther away. */
function groundLines(middle: Place, glass: Glass): Stroke[] {
  const lines = HAZE.map(() => ({ thin: "", strong: "" }));
  const farthest = HAZE.at(-1)?.to ?? 0;
  for (const axis of ["x_m", "y_m"] as const) {
    const across = axis === "x_m" ? "y_m" : "x_m";
    const first = Math.ceil((middle[axis] - farthest) / CELL);
    for (let k = first; k * CELL < middle[axis] + farthest; k += 1) {
      const off = Math.abs(k * CELL - middle[axis]);
      let inner = 0;
      HAZE.forEach(({ to }, band) => {
        if (off >= to) return;
        const outer = Math.sqrt(to ** 2 - off ** 2);
        const at = (along: number) =>
          ({
            [axis]: k * CELL,
            [across]: middle[across] + along,
            altitude_m: 0,
          }) as unknown as High;
        const pieces =
          inner === 0
            ? [[-outer, outer]]
            : [
                [-outer, -inner],
                [inner, outer],
              ];
        const drawn = pieces.map(([a = 0, b = 0]) => glass.line([at(a), at(b)])).join("");
        const into = lines[band];
        if (into !== undefined) into[k % STRONG === 0 ? "strong" : "thin"] += drawn;
        inner = outer;
      });
    }
  }
  return HAZE.flatMap(({ opacity }, band) =>
    (["thin", "strong"] as const).map((kind) => ({
      name: `ground-${kind}-${band}`,
      d: lines[band]?.[kind] ?? "",
      colour: "ground-line" as const,
      width: kind === "strong" ? 1.6 : 1,
      dash: "",
      opacity: kind === "strong" ? opacity : 0.6 * opacity,
    })),
  );
}
