/**
 * The flight over time, under the pictures: the separation as its ground, d_min and what is proved as
 * lines, what happened as marks. The cursor is the time that all pictures show; dragging it moves them.
 */

import { useComputed, useSignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import type { Actions, Session } from "../session";
import { speedOf } from "../store/flight";
import { formatClock, formatMiles } from "../units";
import { Clock } from "./clock";
import { type Apart, type Mark, type Outline, outlineOf } from "./outline";
import "./timeline.css";

/** The box it is drawn in: wide as the page, so high [px]. */
const HEIGHT = 56;
const TOP = 12;
const BASE = HEIGHT - 2;
/** Words of marks so close to each other would run together [px]. */
const APART = 70;

interface Props {
  readonly session: Session;
  readonly actions: Actions;
}

export function Timeline({ session, actions }: Props) {
  const { flight } = session;
  const outline = useComputed(() => {
    void flight.revision.value;
    return outlineOf(session.history());
  });
  return (
    <section class="timeline" aria-label="The flight over time">
      <Clock session={session} actions={actions} outline={outline} />
      {outline.value === null ? (
        <p class="timeline-empty">The flight over time is drawn here.</p>
      ) : (
        <Track session={session} actions={actions} outline={outline.value} />
      )}
    </section>
  );
}

function Track({ session, actions, outline }: Props & { outline: Outline }) {
  const place = useRef<HTMLDivElement>(null);
  const width = useSignal(800);
  useEffect(() => {
    const box = place.current;
    if (box === null) return;
    const note = () => {
      width.value = Math.max(200, box.clientWidth);
    };
    note();
    const watch = new ResizeObserver(note);
    watch.observe(box);
    return () => watch.disconnect();
  }, [width]);
  const drag = useDrag(place, session, actions, outline);
  const { moment } = session.flight;
  const t = Math.max(outline.first, moment.value.t);
  const last = Math.max(outline.last, t); // the picture runs ahead of the newest that was heard
  return (
    <div
      ref={place}
      class="timeline-track"
      role="slider"
      tabIndex={0}
      aria-label="Flight time shown"
      aria-valuemin={Math.round(outline.first)}
      aria-valuemax={Math.round(last)}
      aria-valuenow={Math.round(t)}
      aria-valuetext={`${formatClock(t)} of ${formatClock(last)}`}
      {...drag}
    >
      <svg viewBox={`0 0 ${width.value} ${HEIGHT}`} aria-hidden="true">
        <Ground outline={outline} width={width.value} />
        {session.lost.value.map((part) => (
          <Part key={part.from} name="lost" part={part} outline={outline} width={width.value} />
        ))}
        {session.flight.loop.value !== null && (
          <Part
            name="loop"
            part={session.flight.loop.value}
            outline={outline}
            width={width.value}
          />
        )}
        <g
          class="timeline-cursor"
          transform={`translate(${across(outline, width.value, Math.min(outline.end, t))} 0)`}
        >
          <line y1="0" y2={HEIGHT} />
          <path d="M-5 0h10l-5 7z" />
        </g>
      </svg>
    </div>
  );
}

function across({ first, end }: Outline, width: number, t: number): number {
  return Math.round((width * (t - first) * 100) / Math.max(1, end - first)) / 100;
}

function up({ most }: Outline, d: number): number {
  return Math.round((BASE - ((BASE - TOP) * Math.min(d, most)) / most) * 100) / 100;
}

function Ground({ outline, width }: { outline: Outline; width: number }) {
  const x = (t: number) => across(outline, width, t);
  const y = (d: number) => up(outline, d);
  const line = (points: readonly Apart[]) => points.map(({ t, d }) => `${x(t)} ${y(d)}`).join("L");
  const { flown, ahead, minSeparation, proved, last } = outline;
  const min = y(minSeparation);
  const base = (points: readonly Apart[]) =>
    `M${x(points[0]?.t ?? 0)} ${BASE}L${line(points)}L${x(points.at(-1)?.t ?? 0)} ${BASE}Z`;
  return (
    <>
      <path class="timeline-flown" d={base(flown)} />
      {ahead.length > 1 && <path class="timeline-ahead" d={`M${line(ahead)}`} />}
      <line class="timeline-min" x1="0" x2={width} y1={min} y2={min} />
      <text class="timeline-word" x="4" y={min - 3}>
        MIN {formatMiles(minSeparation)} NM
      </text>
      {proved.map(({ from, to, above }) => (
        <line
          key={from}
          class="timeline-proved"
          x1={x(from)}
          x2={x(Math.min(to, last))}
          y1={y(above)}
          y2={y(above)}
        >
          <title>{`Proved: never below ${formatMiles(above, 2)} NM`}</title>
        </line>
      ))}
      <Marks outline={outline} width={width} />
    </>
  );
}

/** What is drawn of each kind of event: its sign, and a word where there is room. */
const SIGNS: Record<Mark["kind"], { readonly word: string; readonly path: string }> = {
  plan: { word: "PLAN", path: "M0 1l4 4-4 4-4-4z" },
  no_plan: { word: "NO PLAN", path: "M-4 1l8 8M4 1l-8 8" },
  refused: { word: "REFUSED", path: "M-4 1l8 8M4 1l-8 8" },
  leader: { word: "LEADER", path: "M0 1l4 8h-8z" },
  mode: { word: "MODE", path: "M-3 2h6v6h-6z" },
  engagement: { word: "CREW", path: "M0 2v7M-3 5h6" },
  clearance: { word: "ATC", path: "M-4 2h8v6h-8zM-4 2l4 3 4-3" },
  advisory: { word: "ADVICE", path: "M0 2v5M0 8v1" },
  caution: { word: "CAUTION", path: "M0 1l4 8h-8zM0 4v3" },
  warning: { word: "WARNING", path: "M-4 1h8v8h-8z" },
  clear: { word: "CLEAR", path: "M-4 5l3 3 5-6" },
  unable: { word: "UNABLE", path: "M-4 1l8 8M4 1l-8 8" },
  lost: { word: "LOST", path: "M-4 1h8v8h-8z" },
  joined: { word: "JOINED", path: "M-3 9v-8h6v4h-6" },
  end: { word: "END", path: "M-3 1v8M3 1v8" },
};
/** The most telling first, where there is room for the words of some. */
const TELLING: readonly Mark["kind"][] = [
  "lost",
  "warning",
  "joined",
  "caution",
  "unable",
  "no_plan",
  "leader",
  "plan",
  "mode",
];

function Marks({ outline, width }: { outline: Outline; width: number }) {
  const x = (t: number) => across(outline, width, t);
  const worded: Mark[] = [];
  for (const kind of TELLING)
    for (const mark of outline.marks)
      if (mark.kind === kind && worded.every((each) => Math.abs(x(each.t) - x(mark.t)) > APART))
        worded.push(mark);
  return (
    <g class="timeline-marks">
      {outline.marks.map((mark, k) => {
        const isLate = x(mark.t) > width - 60;
        return (
          <g key={k} class={`mark ${mark.kind}`} transform={`translate(${x(mark.t)} 0)`}>
            <title>{`${formatClock(mark.t)} ${mark.text}`}</title>
            <line y1="10" y2={BASE} />
            <path d={SIGNS[mark.kind].path} />
            {worded.includes(mark) && (
              <text x={isLate ? -7 : 7} y="9" text-anchor={isLate ? "end" : "start"}>
                {SIGNS[mark.kind].word}
              </text>
            )}
          </g>
        );
      })}
    </g>
  );
}

/** A part of the time, marked: the loop, or where time was lost. */
function Part(props: {
  name: string;
  part: { readonly from: number; readonly to: number };
  outline: Outline;
  width: number;
}) {
  const { part, outline } = props;
  const [from, to] = [
    across(outline, props.width, part.from),
    across(outline, props.width, part.to),
  ];
  return (
    <rect
      class={`timeline-${props.name}`}
      x={from}
      y="0"
      width={Math.max(1, to - from)}
      height={HEIGHT}
    />
  );
}

/** Scrubbing: pressing moves the cursor there, dragging keeps it under the finger, one move a frame. */
function useDrag(
  place: { readonly current: HTMLDivElement | null },
  session: Session,
  actions: Actions,
  outline: Outline,
) {
  const wanted = useRef<number | null>(null);
  const speed = useRef(0);
  const timeOf = (event: PointerEvent) => {
    const box = place.current?.getBoundingClientRect();
    if (box === undefined || box.width === 0) return null;
    const part = Math.min(1, Math.max(0, (event.clientX - box.left) / box.width));
    return Math.min(outline.last, outline.first + part * (outline.end - outline.first));
  };
  const show = () => {
    if (wanted.current !== null) actions.seek(wanted.current);
    wanted.current = null;
  };
  return {
    onPointerDown(event: PointerEvent) {
      if (event.button !== 0) return;
      place.current?.setPointerCapture(event.pointerId);
      speed.current = session.flight.source.value.kind === "replay" ? speedOf(session.flight) : 0;
      wanted.current = timeOf(event);
      show();
    },
    onPointerMove(event: PointerEvent) {
      if (place.current?.hasPointerCapture(event.pointerId) !== true) return;
      const isWaiting = wanted.current !== null;
      wanted.current = timeOf(event);
      if (!isWaiting) requestAnimationFrame(show);
    },
    onPointerUp() {
      show();
      if (speed.current > 0) actions.play();
    },
  };
}
