import { type ReadonlySignal, useComputed } from "@preact/signals";
import { forecastIndex, forecastPoint, pointOf, pointsAfter } from "../store/forecast";
import type { ForecastChanged } from "../wire";
import { type LayerProps, usePart } from "./layer";
import { polyline } from "./path";
import { Stroke } from "./stroke";
import type { Line } from "./style";

interface Props extends LayerProps {
  readonly forecast: ReadonlySignal<ForecastChanged | null>;
  readonly line: Line;
}

/** The path that will really be flown, without its flown part: point by point as it was forecast. */
export function ForecastAhead({ shown, view, forecast, line }: Props) {
  const until = usePart(shown, (picture) => picture.until);
  const time = usePart(shown, (picture) => picture.t);
  const index = useComputed(() =>
    forecast.value === null ? 0 : forecastIndex(forecast.value, time.value),
  );
  // Only the piece that is being flown changes each frame.
  const current = useComputed(() => {
    const [known, now] = [forecast.value, time.value];
    if (known === null) return "";
    const end = Math.min(pointOf(known, index.value).t_s, until.value);
    if (end <= now) return "";
    return polyline(view.layout.value, [forecastPoint(known, now), forecastPoint(known, end)]);
  });
  const coming = useComputed(() => {
    if (forecast.value === null) return "";
    return polyline(view.layout.value, pointsAfter(forecast.value, index.value, until.value));
  });
  return (
    <>
      <Stroke d={current} line={line} />
      <Stroke d={coming} line={line} />
    </>
  );
}
