import { useComputed } from "@preact/signals";
import { forecastIndex } from "../store/forecast";
import { DEG } from "../units";
import type { ForecastChanged } from "../wire";
import { type LayerProps, usePart } from "./layer";
import { polyline } from "./path";
import { Stroke } from "./stroke";
import { LINES } from "./style";
import type { Place } from "./view";

/** Nearer to the path its edges would not be told from it [px]. */
const APART = 3;

/** How far beside the path own ship may come, as its two edges: what is uncertain of leader and wind. */
export function Tube({ shown, view }: LayerProps) {
  const isFlown = usePart(shown, ({ style }) => style?.path === "committed");
  const forecast = usePart(shown, (picture) => picture.forecast);
  const until = usePart(shown, (picture) => picture.until);
  const time = usePart(shown, ({ t }) => Math.floor(t));
  const d = useComputed(() => {
    const [known, layout] = [forecast.value, view.layout.value];
    const widest = Math.max(0, ...(known?.aside_m ?? []));
    if (known === null || widest * layout.scale < APART) return "";
    return [-1, 1]
      .map((side) => polyline(layout, edge(known, side, time.value, until.value)))
      .join("");
  });
  const isShown = useComputed(() => isFlown.value && d.value !== "");
  if (!isShown.value) return null;
  return (
    <g class="nd-tube">
      <Stroke d={d} line={LINES.tube} />
    </g>
  );
}

/** One edge, from now on: side −1 on the left, 1 on the right. */
function edge(forecast: ForecastChanged, side: number, t: number, until: number): Place[] {
  const { times_s, x_m, y_m, heading_deg, aside_m = [] } = forecast;
  const first = forecastIndex(forecast, t);
  return times_s.flatMap((time, k) => {
    if (k < first || time > until) return [];
    const across = ((heading_deg[k] ?? 0) + 90) * DEG;
    const off = side * (aside_m[k] ?? 0);
    return [
      { x_m: (x_m[k] ?? 0) + off * Math.sin(across), y_m: (y_m[k] ?? 0) + off * Math.cos(across) },
    ];
  });
}
