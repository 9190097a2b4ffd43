import { useComputed } from "@preact/signals";
import { DEG } from "../units";
import type { LayerProps } from "./layer";
import { Stroke } from "./stroke";
import { LINES } from "./style";
import { offNose, project, round } from "./view";

/** A tick every so many seconds. */
const PIECE = 30;
/** Half the length of a tick [px]. */
const TICK = 7;

/** Where the own ship will be if it keeps turning as now: 30 s a piece, more of them at longer range. */
export function TrendVector({ shown, view }: LayerProps) {
  const d = useComputed(() => {
    const { now, trend } = shown.picture.value;
    const layout = view.layout.value;
    if (now === null || trend.length === 0) return "";
    const pieces = layout.range < 20 ? 1 : layout.range <= 40 ? 2 : 3;
    let data = `M${layout.centre.x} ${layout.centre.y}`;
    for (const then of trend.filter(({ in: ahead }) => ahead <= PIECE * pieces)) {
      const point = project(layout, now.pursuer, then);
      data += `L${round(point.x)} ${round(point.y)}`;
      if (then.in % PIECE === 0) {
        const across = offNose(now.pursuer, then.track_deg) * DEG;
        const [x, y] = [TICK * Math.cos(across), TICK * Math.sin(across)];
        data += `m${round(-x)} ${round(-y)}l${round(2 * x)} ${round(2 * y)}m${round(-x)} ${round(-y)}`;
      }
    }
    return data;
  });
  return (
    <g class="nd-trend">
      <Stroke d={d} line={LINES.trend} />
    </g>
  );
}
