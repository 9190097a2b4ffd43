import { useComputed } from "@preact/signals";
import { moveAircraft } from "../motion";
import { DEG, KT } from "../units";
import { type LayerProps, shownNow } from "./picture";
import { Stroke } from "./stroke";
import { LINES } from "./style";
import { offNose, project, round } from "./view";

/** The line is bent every so many seconds, and has a tick every `PIECE`. */
const STEP = 5;
const PIECE = 30;
/** Half the length of a tick [px]. */
const TICK = 7;
/** Below this there is no trend worth showing. */
const SLOWEST = 100 * KT;

/** Where the own ship will be if it keeps turning as now: 30 s a piece, more of them at longer range. */
export function TrendVector({ flight, view }: LayerProps) {
  const d = useComputed(() => {
    const own = shownNow(flight)?.pursuer;
    const layout = view.layout.value;
    if (own === undefined || own.ground_speed_mps < SLOWEST) return "";
    const pieces = layout.range < 20 ? 1 : layout.range <= 40 ? 2 : 3;
    let data = `M${layout.centre.x} ${layout.centre.y}`;
    for (let t = STEP; t <= PIECE * pieces; t += STEP) {
      const then = moveAircraft(own, t);
      const point = project(layout, own, then);
      data += `L${round(point.x)} ${round(point.y)}`;
      if (t % PIECE === 0) {
        const across = offNose(own, then.track_deg) * DEG;
        const [x, y] = [TICK * Math.cos(across), TICK * Math.sin(across)];
        data += `m${round(-x)} ${round(-y)}l${round(2 * x)} ${round(2 * y)}m${round(-x)} ${round(-y)}`;
      }
    }
    return data;
  });
  return <Stroke d={d} line={LINES.trend} />;
}
