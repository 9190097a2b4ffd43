import { type ReadonlySignal, useComputed } from "@preact/signals";
import { type LayerProps, type TimedPath, usePart } from "./layer";
import { pathData, pixelLength, restData, segmentAt } from "./path";
import { Stroke } from "./stroke";
import type { Line } from "./style";

interface Props extends LayerProps {
  readonly path: ReadonlySignal<TimedPath | null>;
  readonly line: Line;
  /** Shown this far ahead [s]. */
  readonly horizon?: number;
}

/** A path without its flown part: the segment being flown follows each frame, those to come stay. */
export function PathAhead({ shown, view, path, line, horizon = Number.POSITIVE_INFINITY }: Props) {
  const wind = usePart(shown, (picture) => picture.wind);
  const time = useComputed(() => shown.picture.value.t - (path.value?.start ?? 0));
  const index = useComputed(() => segmentAt(path.value?.segments ?? [], time.value));
  // Beyond the horizon nothing is drawn; it is moved on in whole seconds, so that what waits stays as it is.
  const until = useComputed(() => Math.ceil(time.value) + horizon);
  const current = useComputed(() => {
    const segment = path.value?.segments[index.value];
    return restData(view.layout.value, segment, wind.value, time.value, until.value);
  });
  const coming = useComputed(() =>
    (path.value?.segments ?? [])
      .slice(index.value + 1)
      .map((each) => restData(view.layout.value, each, wind.value, each.start.t_s, until.value))
      .join(""),
  );
  // Dashes stay where they are on the ground while the line is eaten up from its start.
  const phase = useComputed(() => {
    const segment = path.value?.segments[index.value];
    if (segment === undefined || line.dash === "") return 0;
    const part = (time.value - segment.start.t_s) / segment.duration_s;
    return Math.round(Math.max(0, part) * pixelLength(view.layout.value, segment));
  });
  return (
    <>
      <g stroke-dashoffset={phase}>
        <Stroke d={current} line={line} />
      </g>
      <Stroke d={coming} line={line} />
    </>
  );
}

/** A path as it was, whole. */
export function WholePath({ shown, view, path, line }: Props) {
  const d = useComputed(() =>
    pathData(view.layout.value, path.value?.segments ?? [], shown.picture.value.wind),
  );
  return <Stroke d={d} line={line} />;
}
