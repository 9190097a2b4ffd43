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

function times(matrix: readonly number[], vector: readonly number[]): number[] {
  return [0, 1, 2, 3].map((row) =>
    vector.reduce((sum, each, column) => sum + each * (matrix[4 * column + row] ?? 0), 0),
  );
}
