/** The scene drawn by the page itself: whatever instant is shown, seen by the page's own camera. */

import type { ReadonlySignal } from "@preact/signals";
import { useComputed } from "@preact/signals";
import { ink } from "../nd/style";
import { round } from "../nd/view";
import type { Picture, Shown } from "../store/picture";
import { DEG } from "../units";
import { type Camera, drawnLength, type Sights, seeFar } from "./camera";
import type { Size } from "./glass";
import { type Stroke, strokesOf } from "./strokes";

/** What belongs in the picture; null before the first position. */
export function sightsOf({ now, keepOut, join, places }: Picture): Sights | null {
  if (now === null) return null;
  const { altitude_m } = now.pursuer;
  return {
    own: now.pursuer,
    leader: now.leader,
    radius: keepOut + now.margin_m,
    length: drawnLength(now.separation_m),
    ahead: join === null ? [] : places.slice(1).map((place) => ({ ...place, altitude_m })),
  };
}

interface Props {
  readonly shown: Shown;
  readonly camera: ReadonlySignal<Camera | null>;
  readonly size: ReadonlySignal<Size>;
  /** A hand has moved so many pixels. */
  turn(right: number, down: number): void;
  /** A wheel was turned: nearer (below 1) or farther away. */
  zoom(factor: number): void;
}

/** How much farther away a step of the wheel is, for each of its pixels. */
const WHEEL = 0.0015;

export function Poster({ shown, camera, size, turn, zoom }: Props) {
  const strokes = useComputed(() =>
    camera.value === null ? [] : strokesOf(shown.picture.value, camera.value, size.value),
  );
  return (
    <svg
      class="poster nd"
      aria-hidden="true"
      onPointerDown={(event) => event.currentTarget.setPointerCapture(event.pointerId)}
      onPointerMove={(event) => {
        if (event.currentTarget.hasPointerCapture(event.pointerId))
          turn(event.movementX, event.movementY);
      }}
      onWheel={(event) => {
        event.preventDefault();
        zoom(Math.exp(WHEEL * event.deltaY));
      }}
    >
      <Sky camera={camera} size={size} />
      {strokes.value.map((stroke) => (
        <path key={stroke.name} class={`poster-${stroke.name}`} d={stroke.d} {...lookOf(stroke)} />
      ))}
    </svg>
  );
}

function lookOf({ colour, width, dash, opacity, light }: Stroke) {
  const drawn = colour === "ground-line" ? `var(--${colour})` : ink(colour);
  if (light !== undefined)
    return { fill: `color-mix(in srgb, ${drawn} ${Math.round(100 * light)}%, black)` };
  return {
    fill: "none",
    stroke: drawn,
    "stroke-width": width,
    "stroke-dasharray": dash,
    "stroke-opacity": opacity,
  };
}

/** Where the sun stands [deg clockwise from north]: as the server's scene/sky.py. */
const SUN = 205;
/** The horizon's haze reaches so far up the sky and down the ground [parts of the focal length]. */
const HAZE = { up: 0.7, down: 0.5 } as const;

/** Sky, horizon and ground behind all that is drawn. */
function Sky({ camera, size }: Pick<Props, "camera" | "size">) {
  const level = useComputed(() => horizonOf(camera.value, size.value));
  const { y, focal, sun } = level.value;
  const { width, height } = size.value;
  const line = Math.max(0, Math.min(height, y));
  return (
    <>
      <defs>
        <linearGradient
          id="sky"
          gradientUnits="userSpaceOnUse"
          y1={y}
          y2={y - HAZE.up * focal}
          x2="0"
        >
          <stop offset="0" stop-color="var(--haze)" />
          <stop offset="0.25" stop-color="var(--sky)" />
          <stop offset="1" stop-color="var(--zenith)" />
        </linearGradient>
        <linearGradient
          id="earth"
          gradientUnits="userSpaceOnUse"
          y1={y}
          y2={y + HAZE.down * focal}
          x2="0"
        >
          <stop offset="0" stop-color="var(--haze)" />
          <stop offset="0.3" stop-color="var(--far-ground)" />
          <stop offset="1" stop-color="var(--ground)" />
        </linearGradient>
        <radialGradient id="sun">
          <stop offset="0" stop-color="var(--sunlight)" stop-opacity="0.4" />
          <stop offset="1" stop-color="var(--sunlight)" stop-opacity="0" />
        </radialGradient>
      </defs>
      {line > 0 && <rect width={width} height={line} fill="url(#sky)" />}
      {line < height && <rect y={line} width={width} height={height - line} fill="url(#earth)" />}
      {sun !== null && (
        <ellipse cx={sun} cy={y} rx={0.55 * focal} ry={0.22 * focal} fill="url(#sun)" />
      )}
    </>
  );
}

/** Where the horizon is seen, the focal length, and how far right the sun's foot is [px]. */
function horizonOf(camera: Camera | null, { width, height }: Size) {
  if (camera === null) return { y: 0, focal: 1, sun: null };
  const { projection, view } = camera;
  const focal = ((projection[5] ?? 1) * height) / 2;
  // its third row points backward: where that is level, the camera looks along the horizon
  const ahead = Math.atan2(view[10] ?? 0, view[2] ?? 0) / DEG;
  const level = seeFar(camera, ahead, 0);
  const sun = seeFar(camera, SUN, 0);
  return {
    y: round(level === null ? -height : ((1 - level.y) / 2) * height),
    focal: round(focal),
    sun: sun === null ? null : round(((1 + sun.x) / 2) * width),
  };
}
