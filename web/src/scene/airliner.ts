/** An airliner as a few shaded shapes: what the poster draws of an aircraft. */

import type { Point } from "../nd/view";
import { round } from "../nd/view";
import { DEG } from "../units";
import type { AircraftSample } from "../wire";
import { ALTITUDE_SCALE, type High } from "./camera";
import type { Glass } from "./glass";

/** One shape: how much light falls on it (0 to 1), and how far away it is [units of 1 km]. */
interface Facet {
  readonly name: string;
  readonly d: string;
  readonly light: number;
  readonly depth: number;
}

/** Forward, right and up, of an aircraft 1 long. */
type Body = readonly [number, number, number];

/** Stations along the fuselage and radius there; the same of an engine. */
const FUSELAGE: readonly Body[] = [
  [0.5, 0, 0.004],
  [0.48, 0, 0.026],
  [0.43, 0, 0.046],
  [0.36, 0, 0.053],
  [-0.22, 0, 0.053],
  [-0.38, 0, 0.034],
  [-0.5, 0, 0.008],
];
const ENGINE: readonly Body[] = [
  [0.11, 0.16, 0.024],
  [0.03, 0.16, 0.03],
  [-0.015, 0.16, 0.017],
];
/** How far an engine hangs below. */
const BELOW = -0.062;
const WING: readonly Body[] = [
  [0.13, 0.03, -0.025],
  [-0.115, 0.47, 0.012],
  [-0.16, 0.47, 0.012],
  [-0.07, 0.17, -0.015],
  [-0.085, 0.03, -0.025],
];
const TAIL: readonly Body[] = [
  [-0.385, 0.01, 0.02],
  [-0.48, 0.175, 0.035],
  [-0.515, 0.175, 0.035],
  [-0.475, 0.01, 0.02],
];
const FIN: readonly Body[] = [
  [-0.35, 0, 0.03],
  [-0.47, 0, 0.205],
  [-0.52, 0, 0.205],
  [-0.475, 0, 0.02],
];
/** Light of each part on its upper and its lower side. */
const LIGHT = {
  wing: [0.9, 0.5],
  tail: [0.9, 0.5],
  fin: [0.72, 0.72],
  body: [1, 1],
  engine: [0.6, 0.6],
} as const;

/** Its shapes, the farthest first. `length` [m] as it is drawn. */
export function airliner(aircraft: AircraftSample, length: number, glass: Glass): Facet[] {
  const place = placer(aircraft, length);
  const isFromAbove = seenFromAbove(glass, place);
  const facet = (name: string, part: keyof typeof LIGHT, d: string, at: Body): Facet => ({
    name,
    d,
    light: LIGHT[part][isFromAbove ? 0 : 1],
    depth: glass.depth(place(at)),
  });
  const plate = (outline: readonly Body[], side: number) =>
    `${glass.line(outline.map(([x, y, z]) => place([x, side * y, z])))}Z`;
  const sides = [
    ["left", -1],
    ["right", 1],
  ] as const;
  const facets = [
    facet("body", "body", tube(FUSELAGE, 0, length, glass, place), [0, 0, 0]),
    facet("fin", "fin", plate(FIN, 1), [-0.46, 0, 0.12]),
    ...sides.flatMap(([name, side]) => [
      facet(`${name}-wing`, "wing", plate(WING, side), [-0.05, side * 0.2, -0.02]),
      facet(`${name}-tail`, "tail", plate(TAIL, side), [-0.46, side * 0.09, 0.03]),
      facet(
        `${name}-engine`,
        "engine",
        tube(
          ENGINE.map(([x, y, r]) => [x, side * y, r]),
          BELOW,
          length,
          glass,
          place,
        ),
        [0.05, side * 0.16, BELOW],
      ),
    ]),
  ];
  return facets.sort((a, b) => b.depth - a.depth);
}

/** From the aircraft's own axes to a place; its shape is not stretched as heights are. */
function placer(aircraft: AircraftSample, length: number): (at: Body) => High {
  const [h, bank] = [aircraft.heading_deg * DEG, aircraft.bank_deg * DEG];
  const [ahead, right] = [
    { x: Math.sin(h), y: Math.cos(h) },
    { x: Math.cos(h), y: -Math.sin(h) },
  ];
  return ([forward, across, up]) => {
    const level = across * Math.cos(bank) + up * Math.sin(bank);
    const rise = up * Math.cos(bank) - across * Math.sin(bank);
    return {
      x_m: aircraft.x_m + length * (forward * ahead.x + level * right.x),
      y_m: aircraft.y_m + length * (forward * ahead.y + level * right.y),
      altitude_m: aircraft.altitude_m + (length * rise) / ALTITUDE_SCALE,
    };
  };
}

/** Whether its upper side is the one that is seen: what lies above is nearer. */
function seenFromAbove(glass: Glass, place: (at: Body) => High): boolean {
  return glass.depth(place([0, 0, 0.5])) < glass.depth(place([0, 0, -0.5]));
}

/** The outline of something round: its stations, as wide on the glass as they are. */
function tube(
  stations: readonly Body[],
  height: number,
  length: number,
  glass: Glass,
  place: (at: Body) => High,
): string {
  const seen = stations.map(([x, y, radius]) => {
    const at = place([x, y, height]);
    return { point: glass.at(at), wide: radius * length * glass.scale(at) };
  });
  const [first, last] = [seen[0]?.point, seen.at(-1)?.point];
  if (first == null || last == null) return "";
  const long = Math.hypot(last.x - first.x, last.y - first.y) || 1;
  const beside = { x: -(last.y - first.y) / long, y: (last.x - first.x) / long };
  const side = (sign: 1 | -1) =>
    seen.flatMap(({ point, wide }) =>
      point === null
        ? []
        : [{ x: point.x + sign * wide * beside.x, y: point.y + sign * wide * beside.y }],
    );
  return outline([...side(1), ...side(-1).reverse()]);
}

function outline(points: readonly Point[]): string {
  return `${points.map(({ x, y }, k) => `${k === 0 ? "M" : "L"}${round(x)} ${round(y)}`).join("")}Z`;
}
