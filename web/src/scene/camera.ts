/** Cameras of the scene: where a place is seen, and where to stand so that all that matters is. */

import type { Place, Point } from "../nd/view";
import { DEG, wrap360 } from "../units";

/** The two matrices of a camera, column by column. */
export interface Camera {
  readonly projection: readonly number[];
  readonly view: readonly number[];
}

/** A place over the ground, and how high [m]. */
export interface High extends Place {
  readonly altitude_m: number;
}

/** Where the camera can be put, by the names of the scene's own views. */
export const VIEWS = ["Chase", "Top", "Side", "Free"] as const;
export type ViewName = (typeof VIEWS)[number];

/** What belongs in the picture. */
export interface Sights {
  readonly own: High;
  readonly leader: High;
  /** Of the outermost circle round the leader [m]. */
  readonly radius: number;
  /** Of an aircraft as it is drawn [m]. */
  readonly length: number;
  /** The path ahead, to the join. */
  readonly ahead: readonly High[];
}

/** East, north, up from the middle of the two aircraft, heights as drawn [units of 1 km]. */
type Axis = readonly [number, number, number];

/** Where a camera stands: what it looks at, and from which side and how far. */
export interface Stand {
  readonly target: Axis;
  /** From the target to the camera [deg clockwise from north; deg over the horizon]. */
  readonly bearing: number;
  readonly elevation: number;
  /** [units] */
  readonly distance: number;
}

/** Metres in a unit of the scene, and how much heights are drawn larger: as the server draws it. */
const UNIT = 1000;
export const ALTITUDE_SCALE = 2;

/** Vertical field of view [rad], what part of half the picture must hold all sights, how near a camera may be
 * to any [units], and to an aircraft [halves of its length]: as in the server's scene/camera.py. */
const FOV = 45 * DEG;
const FOCAL = 1 / Math.tan(FOV / 2);
const ROOM = 0.76;
const NEAREST = 10;
const CLEAR = 8;
const HALVINGS = 10;
/** How far round from behind own ship to its right a camera stands, and how high [deg]. */
const STANDS = { Chase: { round: 0, elevation: 21 }, Side: { round: 65, elevation: 9 } } as const;
/** North is up, and the camera so little beside the zenith that it knows it [deg]. */
const TOP = { bearing: 180, elevation: 88.854 } as const;

/** A place in the camera's own terms: across, up, and how far before it; −1 to 1 once divided by that. */
export interface Clip {
  readonly x: number;
  readonly y: number;
  readonly w: number;
}

export function clip(camera: Camera, middle: Place, place: High): Clip {
  const [east, north] = [(place.x_m - middle.x_m) / UNIT, (place.y_m - middle.y_m) / UNIT];
  return toClip(camera, [east, north, heightOf(place.altitude_m)], 1);
}

/** Where a place is seen, −1 to 1 from left to right and from below; null behind the camera. */
export function see(camera: Camera, middle: Place, place: High): Point | null {
  const { x, y, w } = clip(camera, middle, place);
  return w <= 0 ? null : { x: x / w, y: y / w };
}

/** Where something infinitely far away is seen, in a direction [deg]; null behind the camera. */
export function seeFar(camera: Camera, bearing: number, elevation: number): Point | null {
  const { x, y, w } = toClip(camera, direction(bearing, elevation), 0);
  return w <= 1e-9 ? null : { x: x / w, y: y / w };
}

function toClip(camera: Camera, place: Axis, isPlace: 0 | 1): Clip {
  const eye = times(camera.view, [...drawn(place), isPlace]);
  const [x = 0, y = 0, , w = 0] = times(camera.projection, eye);
  return { x, y, w };
}

/** The stand of a view that holds all sights in a window so wide by its height. */
export function standFor(view: Exclude<ViewName, "Free">, sights: Sights, aspect: number): Stand {
  const { own, leader } = sights;
  const sight = Math.atan2(leader.x_m - own.x_m, leader.y_m - own.y_m) / DEG;
  if (view === "Top") return fitted(TOP.bearing, TOP.elevation, sights, aspect);
  const { round, elevation } = STANDS[view];
  const onGround = view === "Side" ? [own, leader].map((each) => ({ ...each, altitude_m: 0 })) : [];
  const ahead = [...sights.ahead, ...onGround];
  return fitted(wrap360(sight + 180 - round), elevation, { ...sights, ahead }, aspect);
}

/** The nearest stand in a direction that has all sights in the picture, as the server's `fit`. */
function fitted(bearing: number, elevation: number, sights: Sights, aspect: number): Stand {
  const { own, leader } = sights;
  const origin = { x_m: (own.x_m + leader.x_m) / 2, y_m: (own.y_m + leader.y_m) / 2 };
  const height = heightOf((own.altitude_m + leader.altitude_m) / 2);
  const places = [own, leader, ...sights.ahead].map(
    ({ x_m, y_m, altitude_m }): Axis => [
      (x_m - origin.x_m) / UNIT,
      (y_m - origin.y_m) / UNIT,
      heightOf(altitude_m) - height,
    ],
  );
  const radii = [sights.length / 2 / UNIT, sights.radius / UNIT];
  const { right, up, back } = axesOf(bearing, elevation);
  const reach = (side: Axis) => {
    const level = Math.hypot(side[0], side[1]);
    return Math.max(...places.map((place, k) => dot(place, side) + (radii[k] ?? 0) * level));
  };
  const beside = (axis: Axis, field: number, sign: 1 | -1): Axis => [
    sign * axis[0] + field * back[0],
    sign * axis[1] + field * back[1],
    sign * axis[2] + field * back[2],
  ];
  const needed = (axis: Axis, field: number) =>
    (reach(beside(axis, field, 1)) + reach(beside(axis, field, -1))) / (2 * field);
  const tall = ROOM / FOCAL;
  const fields = [
    [right, tall * aspect],
    [up, tall],
  ] as const;
  const nearest = reach(back) + Math.max(NEAREST, CLEAR * (radii[0] ?? 0));
  const distance = Math.max(nearest, ...fields.map(([axis, field]) => needed(axis, field)));
  let target: Axis = [0, 0, height];
  for (const [axis, whole] of fields) {
    // The field that is just filled from there: its middle is the picture's.
    let [least, most] = [0, whole];
    for (let k = 0; k < HALVINGS; k += 1) {
      const field = (least + most) / 2;
      if (needed(axis, field) <= distance) most = field;
      else least = field;
    }
    const shift = (reach(beside(axis, most, 1)) - reach(beside(axis, most, -1))) / 2;
    target = [
      target[0] + axis[0] * shift,
      target[1] + axis[1] * shift,
      target[2] + axis[2] * shift,
    ];
  }
  return { target, bearing, elevation, distance };
}

/** The camera that stands there. */
export function cameraAt({ target, bearing, elevation, distance }: Stand, aspect: number): Camera {
  const { right, up, back } = axesOf(bearing, elevation);
  const eye: Axis = [
    target[0] + distance * back[0],
    target[1] + distance * back[1],
    target[2] + distance * back[2],
  ];
  const columns = [0, 1, 2].flatMap((k) => [...[right, up, back].map((a) => drawn(a)[k] ?? 0), 0]);
  return {
    projection: [FOCAL / aspect, 0, 0, 0, 0, FOCAL, 0, 0, 0, 0, -1, -1, 0, 0, -0.2, 0],
    view: [...columns, -dot(right, eye), -dot(up, eye), -dot(back, eye), 1],
  };
}

/** Where a camera stands that a hand has moved; it is turned round what lies before it, at a height [m]. */
export function standOf({ view }: Camera, altitude_m: number): Stand {
  const row = (k: number): Axis => undrawn([view[k] ?? 0, view[4 + k] ?? 0, view[8 + k] ?? 0]);
  const [right, up, back] = [row(0), row(1), row(2)];
  const moved = [view[12] ?? 0, view[13] ?? 0, view[14] ?? 0] as const;
  const eye = [0, 1, 2].map(
    (k) => -((right[k] ?? 0) * moved[0] + (up[k] ?? 0) * moved[1] + (back[k] ?? 0) * moved[2]),
  ) as unknown as Axis;
  const from: Axis = [eye[0], eye[1], eye[2] - heightOf(altitude_m)];
  const distance = Math.max(NEAREST, dot(from, back));
  return {
    target: [eye[0] - distance * back[0], eye[1] - distance * back[1], eye[2] - distance * back[2]],
    bearing: wrap360(Math.atan2(back[0], back[1]) / DEG),
    elevation: Math.asin(Math.max(-1, Math.min(1, back[2]))) / DEG,
    distance,
  };
}

/** How far a hand turns a camera [deg for each pixel], how low and high, and how near and far. */
const TURN = 0.3;
const ELEVATIONS = [1, 89] as const;
const DISTANCES = [8, 1400] as const;

/** Turned by a hand that has moved so many pixels to the right and down. */
export function turned(stand: Stand, right: number, down: number): Stand {
  const elevation = within(ELEVATIONS, stand.elevation + TURN * down);
  return { ...stand, bearing: wrap360(stand.bearing + TURN * right), elevation };
}

/** Nearer (below 1) or farther away. */
export function zoomed(stand: Stand, factor: number): Stand {
  return { ...stand, distance: within(DISTANCES, stand.distance * factor) };
}

function within([least, most]: readonly [number, number], value: number): number {
  return Math.max(least, Math.min(most, value));
}

function direction(bearing: number, elevation: number): Axis {
  const level = Math.cos(elevation * DEG);
  return [
    level * Math.sin(bearing * DEG),
    level * Math.cos(bearing * DEG),
    Math.sin(elevation * DEG),
  ];
}

function axesOf(bearing: number, elevation: number): { right: Axis; up: Axis; back: Axis } {
  const [sin, cos] = [Math.sin(bearing * DEG), Math.cos(bearing * DEG)];
  const [low, high] = [Math.sin(elevation * DEG), Math.cos(elevation * DEG)];
  return {
    right: [-cos, sin, 0],
    up: [-sin * low, -cos * low, high],
    back: direction(bearing, elevation),
  };
}

/** East, north, up as what draws the scene has them: it has y up. */
function drawn([east, north, up]: Axis): Axis {
  return [-north, up, -east];
}

function undrawn([x, y, z]: Axis): Axis {
  return [-z, -x, y];
}

function heightOf(altitude: number): number {
  return (altitude / UNIT) * ALTITUDE_SCALE;
}

function dot(a: Axis, b: Axis): number {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

function times(matrix: readonly number[], vector: readonly number[]): number[] {
  return [0, 1, 2, 3].map((row) =>
    vector.reduce((sum, each, column) => sum + each * (matrix[4 * column + row] ?? 0), 0),
  );
}

/** An aircraft's length [m], how much larger it is drawn at most, never longer than this share of their
 * separation, and in which steps: as in the server's scene/aircraft.py. */
const LENGTH = 54;
const ENLARGED = 100;
const SHARE = 0.3;
const STEP = 5;

/** How much both aircraft are drawn larger than they are. `separation` [m] */
export function enlargement(separation: number): number {
  const steps = Math.floor((SHARE * separation) / LENGTH / STEP);
  return Math.max(STEP, Math.min(ENLARGED, STEP * steps));
}

/** The length of an aircraft as it is drawn [m]. `separation` [m] */
export function drawnLength(separation: number): number {
  return LENGTH * enlargement(separation);
}
