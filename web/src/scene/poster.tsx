/** The scene drawn by the page itself: whatever instant is shown, seen by the page's own camera. */

import type { ReadonlySignal } from "@preact/signals";
import { useComputed } from "@preact/signals";
import { ink } from "../nd/style";
import { round } from "../nd/view";
import type { Ghost } from "../store/ghost";
import type { Picture } from "../store/picture";
import type { Shown } from "../store/shown";
import { DEG } from "../units";
import { type Camera, drawnLength, type Sights, seeFar } from "./camera";
import type { Size } from "./glass";
import { type Stroke, strokesOf } from "./strokes";

/** What belongs in the picture, the other flight of a comparison as well; null before the first position. */
export function sightsOf(
  { now, keepOut, join, places }: Picture,
  ghost: Ghost | null = null,
): Sights | null {
  if (now === null) return null;
  const { altitude_m } = now.pursuer;
  return {
    own: now.pursuer,
    leader: now.leader,
    radius: keepOut + now.margin_m,
    length: drawnLength(now.separation_m),
    ahead: [
      ...(join === null ? [] : places.slice(1).map((place) => ({ ...place, altitude_m }))),
      ...(ghost === null ? [] : [ghost.pursuer, ...(ghost.leader === null ? [] : [ghost.leader])]),
    ],
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
    camera.value === null
      ? []
      : strokesOf(shown.picture.value, camera.value, size.value, shown.ghost.value),
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
  if (width === 0 && light === undefined) return { fill: drawn, "fill-opacity": opacity };
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

/** Where the sun stands [deg clockwise from north], and how much of the haze below it is its light: as in the
 * server's scene/sky.py. */
const SUN = 205;
const GLOW = 0.7;
/** The horizon's haze reaches so far up the sky and down the ground, and the sun's light so far up and down
 * [parts of the focal length]. */
const HAZE = { up: 0.7, down: 0.5 } as const;
const LIT = 0.3;
/** Where across the picture the sun's light is reckoned. */
const ACROSS = [0, 0.25, 0.5, 0.75, 1] as const;

/** Sky, horizon and ground behind all that is drawn. */
function Sky({ camera, size }: Pick<Props, "camera" | "size">) {
  const horizon = useComputed(() => horizonOf(camera.value, size.value));
  const { y, focal, glow } = horizon.value;
  const { width, height } = size.value;
  const line = Math.max(0, Math.min(height, y));
  const rising = { gradientUnits: "userSpaceOnUse", x2: "0", y1: y } as const;
  return (
    <>
      <defs>
        <linearGradient id="sky" {...rising} y2={y - HAZE.up * focal}>
          <stop offset="0" stop-color="var(--haze)" />
          <stop offset="0.25" stop-color="var(--sky)" />
          <stop offset="1" stop-color="var(--zenith)" />
        </linearGradient>
        <linearGradient id="earth" {...rising} y2={y + HAZE.down * focal}>
          <stop offset="0" stop-color="var(--haze)" />
          <stop offset="0.3" stop-color="var(--far-ground)" />
          <stop offset="1" stop-color="var(--ground)" />
        </linearGradient>
        <linearGradient id="sunlight" gradientUnits="userSpaceOnUse" x1="0" x2={width}>
          {ACROSS.map((offset, k) => (
            <stop
              key={offset}
              offset={offset}
              stop-color="var(--sunlight)"
              stop-opacity={glow[k]}
            />
          ))}
        </linearGradient>
        <linearGradient id="lit" {...rising} y1={y - LIT * focal} y2={y + LIT * focal}>
          <stop offset="0" stop-color="white" stop-opacity="0" />
          <stop offset="0.5" stop-color="white" />
          <stop offset="1" stop-color="white" stop-opacity="0" />
        </linearGradient>
        <mask
          id="near-horizon"
          maskUnits="userSpaceOnUse"
          x="0"
          y="0"
          width={width}
          height={height}
        >
          <rect width={width} height={height} fill="url(#lit)" />
        </mask>
      </defs>
      <rect width={width} height={height} fill="url(#sky)" />
      {line < height && <rect y={line} width={width} height={height - line} fill="url(#earth)" />}
      <rect width={width} height={height} fill="url(#sunlight)" mask="url(#near-horizon)" />
    </>
  );
}

/** Where the horizon is seen, the focal length [px], and how much of the sun's light falls on the haze. */
function horizonOf(camera: Camera | null, { width, height }: Size) {
  if (camera === null) return { y: 0, focal: 1, glow: [] };
  const { projection, view } = camera;
  const focal = ((projection[5] ?? 1) * height) / 2;
  // its third row points backward: where that is level, the camera looks along the horizon
  const ahead = Math.atan2(view[10] ?? 0, view[2] ?? 0) / DEG;
  const level = seeFar(camera, ahead, 0);
  const glow = ACROSS.map((part) => {
    const bearing = ahead + Math.atan(((part - 0.5) * width) / focal) / DEG;
    return GLOW * Math.max(0, Math.cos((bearing - SUN) * DEG)) ** 3;
  });
  const y = level === null ? -height : ((1 - level.y) / 2) * height;
  return { y: round(Math.max(-9 * height, Math.min(9 * height, y))), focal: round(focal), glow };
}
