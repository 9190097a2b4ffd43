/** The scene's camera, as its page gives it with each picture: where a place is seen. */

import type { Place, Point } from "../nd/view";

/** The two matrices of a camera, column by column. */
export interface Camera {
  readonly projection: readonly number[];
  readonly view: readonly number[];
}

/** A place over the ground, and how high [m]. */
export interface High extends Place {
  readonly altitude_m: number;
}

/** Metres in a unit of the scene, and how much heights are drawn larger: as the server draws it. */
const UNIT = 1000;
export const ALTITUDE_SCALE = 2;

/** Where a place is seen, −1 to 1 from left to right and from below; null behind the camera. */
export function see(camera: Camera, middle: Place, place: High): Point | null {
  const [east, north] = [(place.x_m - middle.x_m) / UNIT, (place.y_m - middle.y_m) / UNIT];
  // The scene has z up; what draws it has y up.
  const eye = times(camera.view, [-north, (place.altitude_m / UNIT) * ALTITUDE_SCALE, -east, 1]);
  const [x = 0, y = 0, , w = 0] = times(camera.projection, eye);
  return w <= 0 ? null : { x: x / w, y: y / w };
}

/** Vertical field of view [rad], what part of half the picture must hold both aircraft, how far above
 * the horizontal the chase camera stands, and the least it looks across [units]: as on the server. */
const FOV = (45 * Math.PI) / 180;
const ROOM = 0.74;
const ELEVATION = (21 * Math.PI) / 180;
const LEAST_REACH = 12;

type Axis = readonly [number, number, number];

/** The camera behind own ship, towards the leader, that holds both and a circle round the leader [m]. */
export function chaseCamera(own: High, leader: High, radius: number, aspect: number): Camera {
  const [east, north] = [leader.x_m - own.x_m, leader.y_m - own.y_m];
  const apart = Math.hypot(east, north);
  const [x, y] = apart < 1e-3 ? [1, 0] : [east / apart, north / apart];
  const [level, high] = [Math.cos(ELEVATION), Math.sin(ELEVATION)];
  const right: Axis = [y, -x, 0];
  const up: Axis = [x * high, y * high, level];
  const back: Axis = [-x * level, -y * level, high];
  const middle = heightOf((own.altitude_m + leader.altitude_m) / 2);
  const half = apart / 2 / UNIT;
  const rise = heightOf(leader.altitude_m) - middle;
  const round = [0, 1, 2, 3].map((k): Axis => {
    const [dx, dy] = [Math.cos((k * Math.PI) / 2), Math.sin((k * Math.PI) / 2)];
    return [x * half + (dx * radius) / UNIT, y * half + (dy * radius) / UNIT, rise];
  });
  const places: Axis[] = [[-x * half, -y * half, -rise], [x * half, y * half, rise], ...round];
  const [tall, least] = [ROOM * Math.tan(FOV / 2), LEAST_REACH / Math.tan(FOV / 2)];
  const needed = places.map(
    (place) =>
      Math.max(Math.abs(dot(place, right)) / (tall * aspect), Math.abs(dot(place, up)) / tall) +
      dot(place, back),
  );
  const away = Math.max(least, ...needed);
  const eye: Axis = [back[0] * away, back[1] * away, back[2] * away + middle];
  const focal = 1 / Math.tan(FOV / 2);
  const columns = [0, 1, 2].flatMap((k) => [...[right, up, back].map((a) => drawn(a)[k] ?? 0), 0]);
  return {
    projection: [focal / aspect, 0, 0, 0, 0, focal, 0, 0, 0, 0, -1, -1, 0, 0, -0.2, 0],
    view: [...columns, -dot(right, eye), -dot(up, eye), -dot(back, eye), 1],
  };
}

/** East, north, up as what draws the scene has them. */
function drawn([east, north, up]: Axis): Axis {
  return [-north, up, -east];
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
