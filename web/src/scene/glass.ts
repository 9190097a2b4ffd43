/** Lines on the glass: places seen by a camera, in pixels, cut off where they pass behind it. */

import type { Place, Point } from "../nd/view";
import { round } from "../nd/view";
import { type Camera, type Clip, clip, type High } from "./camera";

/** Width and height of the glass [px]. */
export interface Size {
  readonly width: number;
  readonly height: number;
}

/** Nearer to the camera than this nothing is drawn [units of 1 km]. */
const NEAREST = 0.5;

export interface Glass {
  readonly size: Size;
  /** A place [px]; null behind the camera. */
  at(place: High): Point | null;
  /** A line through places, as the data of an SVG path. */
  line(places: readonly High[]): string;
  /** How large a metre there is seen [px]; 0 behind the camera. */
  scale(place: High): number;
  /** How far before the camera a place is [units of 1 km]. */
  depth(place: High): number;
}

export function glassOf(camera: Camera, middle: Place, size: Size): Glass {
  const from = (place: High) => clip(camera, middle, place);
  const toGlass = ({ x, y, w }: Clip): Point => ({
    x: round(((1 + x / w) / 2) * size.width),
    y: round(((1 - y / w) / 2) * size.height),
  });
  const focal = camera.projection[5] ?? 1;
  return {
    size,
    at(place) {
      const seen = from(place);
      return seen.w < NEAREST ? null : toGlass(seen);
    },
    line(places) {
      let data = "";
      let before: Clip | null = null;
      for (const each of places.map(from)) {
        if (before !== null) {
          const piece = beforeCamera(before, each);
          if (piece !== null) {
            const [a, b] = piece.map(toGlass) as [Point, Point];
            if (data === "" || piece[0] !== before || before.w < NEAREST) data += `M${a.x} ${a.y}`;
            data += `L${b.x} ${b.y}`;
          }
        }
        before = each;
      }
      return data;
    },
    scale(place) {
      const { w } = from(place);
      return w < NEAREST ? 0 : (focal * size.height) / 2 / w / 1000;
    },
    depth: (place) => from(place).w,
  };
}

/** The part of a straight piece that is before the camera. */
function beforeCamera(a: Clip, b: Clip): readonly [Clip, Clip] | null {
  if (a.w < NEAREST && b.w < NEAREST) return null;
  if (a.w >= NEAREST && b.w >= NEAREST) return [a, b];
  const part = (NEAREST - a.w) / (b.w - a.w);
  const edge = { x: a.x + part * (b.x - a.x), y: a.y + part * (b.y - a.y), w: NEAREST };
  return a.w < NEAREST ? [edge, b] : [a, edge];
}
