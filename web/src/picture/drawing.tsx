/** The navigation display as one drawing: all sheets of the glass in one SVG, at rest. */

import type { LayerProps } from "../nd/layer";
import { GLASS_LAYERS, GROUND_LAYERS, MAP_LAYERS } from "../nd/nd";
import { SIZE } from "../nd/view";
import type { Palette } from "./palettes";

/** As tokens.css has it; B612 where it is installed. */
const FONT = "B612, Inter, 'Segoe UI', 'DejaVu Sans', sans-serif";
/** The lines under the glass: size of the type, where the first stands, from one to the next, and below [px]. */
const CAPTION = { size: 13, left: 14, first: 22, step: 21, below: 13 } as const;
/** Longest line at that size [characters]. */
const LONGEST = 94;

interface Props extends LayerProps {
  readonly palette: Palette;
  /** What stands under the glass, line by line. */
  readonly caption: readonly string[];
  /** What is seen, in words. */
  readonly description: string;
}

export function Drawing({ shown, view, palette, caption, description }: Props) {
  const { mode, centre, tape } = view.layout.value;
  const map = `map-${mode}`; // pictures of several modes may stand on one page
  const isKnown = shown.picture.value.now !== null;
  const { first, step, below } = CAPTION;
  const height = SIZE + first + step * (caption.length - 1) + below;
  const layers = (those: typeof GLASS_LAYERS | typeof GROUND_LAYERS | typeof MAP_LAYERS) =>
    those.map((Layer) => <Layer key={Layer.name} shown={shown} view={view} />);
  return (
    <svg
      xmlns="http://www.w3.org/2000/svg"
      width={SIZE}
      height={height}
      viewBox={`0 0 ${SIZE} ${height}`}
      font-family={FONT}
    >
      <title>{caption[0] ?? "Navigation display"}</title>
      <desc>{description}</desc>
      <defs>
        <clipPath id="glass">
          <rect width={SIZE} height={SIZE} />
        </clipPath>
        <clipPath id={map}>
          <circle cx={centre.x} cy={centre.y} r={tape} />
        </clipPath>
      </defs>
      <rect width={SIZE} height={height} fill={palette.glass} />
      <g clip-path="url(#glass)">
        {layers(GROUND_LAYERS)}
        {isKnown && (
          <g clip-path={`url(#${map})`}>
            <g transform={view.mapTransform}>{layers(MAP_LAYERS)}</g>
          </g>
        )}
        {layers(GLASS_LAYERS)}
      </g>
      <g font-size={CAPTION.size} fill={palette.label}>
        <path d={`M0 ${SIZE + 0.5}H${SIZE}`} stroke={palette.scale} stroke-opacity={0.4} />
        {caption.map((line, i) => (
          <text key={line} x={CAPTION.left} y={SIZE + first + step * i}>
            {line.length > LONGEST ? `${line.slice(0, LONGEST - 1)}…` : line}
          </text>
        ))}
      </g>
    </svg>
  );
}
