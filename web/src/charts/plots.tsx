/** The strips as canvases, the cursor over all of them, and the hand that moves it. */

import { type ReadonlySignal, useSignalEffect } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import type { Colour } from "../store/colours";
import { formatClock } from "../units";
import type { Props } from "./charts";
import { createPlot, LEFT, type Plot, RIGHT, type Window } from "./plot";
import { type Strip, valueAt } from "./strips";

/** Height of a strip's plot [px]. */
const HEIGHT = 92;
/** Keys move the clock by so much [s]. */
const STEPS: Record<string, number> = {
  ArrowLeft: -1,
  ArrowRight: 1,
  PageDown: -60,
  PageUp: 60,
};

interface StripsProps extends Props {
  readonly strips: ReadonlySignal<readonly Strip[]>;
  readonly window: ReadonlySignal<Window>;
}

export function Strips({ session, actions, strips, window }: StripsProps) {
  const { flight } = session;
  const place = useRef<HTMLDivElement>(null);
  const cursor = useRef<HTMLDivElement>(null);
  // The cursor is carried on with each picture; nothing is drawn for it.
  useSignalEffect(() => {
    const { from, to } = window.value;
    const t = flight.moment.value.t + flight.since.value;
    const part = (t - from) / (to - from);
    const line = cursor.current;
    if (line === null) return;
    line.hidden = part < 0 || part > 1;
    line.style.left = `calc(${LEFT}px + (100% - ${LEFT + RIGHT}px) * ${part.toFixed(5)})`;
  });
  const timeAt = (event: PointerEvent) => {
    const box = place.current?.getBoundingClientRect();
    if (box === undefined) return null;
    const part = (event.clientX - box.left - LEFT) / (box.width - LEFT - RIGHT);
    const { from, to } = window.value;
    return from + Math.min(1, Math.max(0, part)) * (to - from);
  };
  const drag = (event: PointerEvent) => {
    const t = event.buttons === 1 ? timeAt(event) : null;
    if (t !== null) actions.seek(t);
  };
  const { read, span } = flight;
  const [first, last] = [span.value?.first ?? 0, span.value?.last ?? 0];
  return (
    <div
      ref={place}
      class="chart-strips"
      role="slider"
      tabIndex={0}
      aria-label="Flight time shown in the charts"
      aria-valuemin={Math.round(first)}
      aria-valuemax={Math.round(last)}
      aria-valuenow={Math.round(read.value.t)}
      aria-valuetext={formatClock(read.value.t)}
      onPointerDown={(event) => {
        if (event.button !== 0) return;
        place.current?.setPointerCapture(event.pointerId);
        drag(event);
      }}
      onPointerMove={drag}
      onKeyDown={(event) => {
        const step = STEPS[event.key];
        const end = { Home: first, End: last }[event.key];
        if (step === undefined && end === undefined) return;
        event.preventDefault();
        event.stopPropagation();
        if (end !== undefined) actions.seek(end);
        else actions.step((step ?? 0) * (event.shiftKey ? 10 : 1));
      }}
    >
      {strips.value.map((strip) => (
        <StripPlot
          key={`${strip.name} ${strip.lines.length}`}
          strip={strip}
          window={window.value}
          t={Math.min(read.value.t, last)}
          palette={session.distinctColours.value ? "distinct" : "usual"}
        />
      ))}
      <div ref={cursor} class="chart-cursor" />
    </div>
  );
}

interface StripPlotProps {
  readonly strip: Strip;
  readonly window: Window;
  readonly t: number;
  readonly palette: string;
}

function StripPlot({ strip, window, t, palette }: StripPlotProps) {
  const place = useRef<HTMLDivElement>(null);
  const plot = useRef<Plot | null>(null);
  useEffect(() => {
    const box = place.current;
    if (box === null) return;
    const made = createPlot(box, strip, { width: box.clientWidth, height: HEIGHT }, inkOf(box));
    plot.current = made;
    made.draw(strip, window);
    const watch = new ResizeObserver(() => made.resize(box.clientWidth));
    watch.observe(box);
    return () => {
      watch.disconnect();
      made.destroy();
      plot.current = null;
    };
  }, [palette]);
  useEffect(() => plot.current?.draw(strip, window), [strip, window.from, window.to]);
  return (
    <div class="chart-strip">
      <p class="chart-title">
        <b>{strip.title}</b> <span class="unit">{strip.unit}</span>
        {strip.lines.map((line) => (
          <span key={line.label} class="chart-value">
            {line.label} <Value strip={strip} line={line} t={t} />
          </span>
        ))}
      </p>
      <div ref={place} class="chart-plot" aria-hidden="true" />
    </div>
  );
}

function Value({ strip, line, t }: { strip: Strip; line: Strip["lines"][number]; t: number }) {
  const value = valueAt(strip, line, t);
  return (
    <span style={{ color: `var(--${line.colour})` }}>
      {value === null ? "–" : strip.format(value)}
    </span>
  );
}

/** The colours of the page as the canvas needs them. */
function inkOf(place: HTMLElement): (colour: Colour) => string {
  const style = getComputedStyle(place);
  return (colour) => style.getPropertyValue(`--${colour}`);
}
