import type { LayerProps } from "../nd/layer";
import { Stroke } from "../nd/stroke";
import { ink, LINES } from "../nd/style";
import { polar, round } from "../nd/view";

const LETTERS = [
  ["N", 0],
  ["E", 90],
  ["S", 180],
  ["W", 270],
] as const;

/** Range rings about the middle of the map, and where north is. */
export function Compass({ view }: LayerProps) {
  const layout = view.layout.value;
  const { x, y } = layout.centre;
  return (
    <g class="nd-rings">
      {layout.rings.map(({ radius, label }, i) => {
        const at = polar(layout, layout.ringLabels[0] ?? 0, radius - 14);
        const d = `M${x - radius} ${y}a${radius} ${radius} 0 1 1 ${2 * radius} 0a${radius} ${radius} 0 1 1 ${-2 * radius} 0`;
        return (
          <g key={radius}>
            <Stroke d={d} line={{ ...LINES.ring, dash: i === 0 ? "" : LINES.ring.dash }} />
            <rect
              class="nd-ground"
              x={round(at.x - 20)}
              y={round(at.y - 11)}
              width={40}
              height={22}
            />
            <text
              class="nd-text"
              fill={ink("unit")}
              font-size={18}
              text-anchor="middle"
              x={round(at.x)}
              y={round(at.y + 6)}
            >
              {label}
            </text>
          </g>
        );
      })}
      {LETTERS.map(([letter, direction]) => {
        const at = polar(layout, direction, (layout.rings[0]?.radius ?? 0) + 18);
        return (
          <text
            key={letter}
            class="nd-text"
            fill={ink("scale")}
            font-size={24}
            text-anchor="middle"
            x={round(at.x)}
            y={round(at.y + 8)}
          >
            {letter}
          </text>
        );
      })}
    </g>
  );
}
