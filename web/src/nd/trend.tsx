import { useComputed } from "@preact/signals";
import { moveAircraft } from "../motion";
import { KT } from "../units";
import { type LayerProps, shownNow } from "./picture";
import { Stroke } from "./stroke";
import { LINES } from "./style";
import { offNose, project, round } from "./view";

const STEP = 5;
/** Below this there is no trend worth showing. */
const SLOWEST = 100 * KT;

/** Where the own ship will be if it keeps turning as now: 30 s a piece, more of them at longer range. */
export function TrendVector({ flight, view }: LayerProps) {
  const d = useComputed(() => {
    const own = shownNow(flight)?.pursuer;
    const layout = view.layout.value;
    if (own === undefined || own.ground_speed_mps < SLOWEST) return "";
    const pieces = layout.range < 20 ? 1 : layout.range <= 40 ? 2 : 3;
    let data = placeM(layout.centre);
    for (let t = STEP; t <= 30 * pieces; t += STEP) {
      const then = moveAircraft(own, t);
      const point = project(layout, own, then);
      data += `L${round(point.x)} ${round(point.y)}`;
      if (t % 30 === 0) {
        const [sin, cos] = [Math.sin, Math.cos].map((f) =>
          f((offNose(own, then.track_deg) * Math.PI) / 180),
        );
        const [x, y] = [(cos ?? 1) * 7, (sin ?? 0) * 7];
        data += `m${round(-x)} ${round(-y)}l${round(2 * x)} ${round(2 * y)}m${round(-x)} ${round(-y)}`;
      }
    }
    return data;
  });
  return <Stroke d={d} line={LINES.trend} />;
}

function placeM({ x, y }: { x: number; y: number }): string {
  return `M${x} ${y}`;
}
