import { Cell } from "../nd/cell";
import type { LayerProps } from "../nd/layer";
import { LETTERS, letterPoint, RingLabel } from "../nd/rings";
import { Stroke } from "../nd/stroke";
import { LINES } from "../nd/style";
import { polar, round } from "../nd/view";

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
            <RingLabel {...at} text={label} />
          </g>
        );
      })}
      {Object.entries(LETTERS).map(([letter, direction]) => {
        const at = letterPoint(layout, direction);
        return (
          <Cell
            key={letter}
            x={round(at.x)}
            y={round(at.y + 8)}
            text={letter}
            colour="scale"
            size={24}
            anchor="middle"
          />
        );
      })}
    </g>
  );
}
