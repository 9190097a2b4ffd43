import { type ReadonlySignal, useComputed } from "@preact/signals";
import { forecastIndex, forecastPoint, joinTime, pointOf } from "../committed";
import type { ForecastChanged, PathPoint } from "../wire";
import { polyline } from "./path";
import { type LayerProps, shownGuidance } from "./picture";
import { Stroke } from "./stroke";
import type { Line } from "./style";

interface Props extends LayerProps {
  readonly forecast: ReadonlySignal<ForecastChanged | null>;
  readonly line: Line;
}

/** The path that will really be flown, without its flown part: point by point as it was forecast. */
export function ForecastAhead({ flight, view, forecast, line }: Props) {
  const until = useComputed(() => shownUntil(flight));
  const index = useComputed(() =>
    forecast.value === null ? 0 : forecastIndex(forecast.value, flight.simTime.value),
  );
  // Only the piece that is being flown changes each frame.
  const current = useComputed(() => {
    const [known, now] = [forecast.value, flight.simTime.value];
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

/** The points of a forecast from one on, up to a flight time [s]. */
export function pointsAfter(forecast: ForecastChanged, index: number, until: number): PathPoint[] {
  const points = forecast.times_s
    .map((_, k) => pointOf(forecast, k))
    .filter(({ t_s }, k) => k >= index && t_s <= until);
  const last = forecast.times_s.at(-1) ?? until;
  if (points.length > 0 && until < last) points.push(forecastPoint(forecast, until));
  return points;
}

/** Up to when the path is drawn [s, flight time]: the join, or once joined where the leader is now. */
export function shownUntil(flight: LayerProps["flight"]): number {
  const shown = shownGuidance(flight);
  if (shown?.now.mode !== "follow") return joinTime(flight) ?? Number.POSITIVE_INFINITY;
  const length = flight.started.value?.slot_distance_m ?? 0;
  // Its end moves on in whole seconds, so that what waits stays as it is.
  return Math.ceil(flight.simTime.value) + length / Math.max(1, shown.now.leader.ground_speed_mps);
}
