import {
  computed,
  effect,
  type ReadonlySignal,
  signal,
  untracked,
  useComputed,
} from "@preact/signals";
import { useLayoutEffect, useMemo, useRef } from "preact/hooks";
import { samplePath } from "../geometry";
import { forecastIndex, pointsAfter } from "../store/forecast";
import { captureLabel } from "./capture";
import { circleLabel } from "./circle";
import { closestLabel } from "./closest";
import { FAN_IDS, fanLabels } from "./fan";
import { ghostLabels } from "./ghost";
import { intentLabels } from "./intent";
import { type Label, LINE_HEIGHT, type Placement, placeLabels } from "./labels";
import { type LayerProps, usePart } from "./layer";
import { leaderOnMap, leaderTag } from "./leader";
import { minuteLabels } from "./minutes";
import { offScaleTag } from "./offscale";
import { Plane } from "./plane";
import { proposalLabel } from "./proposal";
import { LETTERS, letterPoint, ringLabelPoints } from "./rings";
import { ink } from "./style";
import { offScaleTrafficLabels, trafficId, trafficLabels } from "./traffic";
import { turnLabels } from "./turns";
import { type Box, onMap, type Point, placeAt, project, round, SIZE } from "./view";
import { weatherId, weatherLabels } from "./weather";

/** All labels of the map, the most important first. */
function labelsOf(props: LayerProps): Label[] {
  return [
    leaderTag(props),
    offScaleTag(props),
    ...offScaleTrafficLabels(props),
    captureLabel(props),
    proposalLabel(props),
    closestLabel(props),
    circleLabel(props),
    ...ghostLabels(props),
    ...turnLabels(props),
    ...intentLabels(props),
    ...minuteLabels(props),
    ...trafficLabels(props),
    ...weatherLabels(props),
    ...fanLabels(props),
  ].filter((label) => label !== null);
}

/** Every label that can be: each has its own element, so that a frame moves it and builds nothing. */
const IDS = [
  "leader",
  "offscale",
  "capture",
  "proposal",
  "closest",
  "circle",
  "other",
  "other leader",
  ...[1, 2, 3, 4, 5, 6, 7, 8].map((i) => `T${i}`),
  "intent",
  ...[0, 1, 2].map((i) => `leg ${i}`),
  ...FAN_IDS,
  ...[5, 10, 15, 20, 25, 30, 35, 40].flatMap((i) => [`minute ${i} own`, `minute ${i} leader`]),
  ...[0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11].map(regionId),
];

/** Where a plan is nearest to others, on the map. */
const NEAREST = [0, 1, 2].map((i) => `nearest ${i}`);

/** What a label names, as words.ts calls it, by the beginning of its id. */
const NAMED = {
  capture: "capture",
  proposal: "proposed",
  intent: "intent",
  leg: "intent",
  minute: "minutes",
  fan: "fan",
  "traffic at the edge": "traffic-edge",
  traffic: "traffic",
  weather: "weather",
  nearest: "nearest",
  region: "area",
  T: "turns",
} as const;

function elementOfLabel(id: string): string {
  const found = Object.entries(NAMED).find(([begin]) => id.startsWith(begin));
  return found?.[1] ?? id;
}

/** The name of a region under the map. */
export function regionId(number: number): string {
  return `region ${number}`;
}

/** What else is written on a map: labels that are less important, and points to keep clear of. */
export interface More {
  readonly labels: readonly Label[];
  readonly points: readonly Point[];
}

const NO_MORE: ReadonlySignal<More> = signal({ labels: [], points: [] });

/** The map's labels, clear of each other. They stand upright: outside the turning map. */
export function Labels(props: LayerProps & { more?: ReadonlySignal<More> }) {
  const others = useOthers(props);
  const ids = [
    ...IDS,
    ...others.cells.map(weatherId),
    ...NEAREST,
    ...others.traffic.flatMap((ident) => [trafficId(ident), trafficId(ident, true)]),
  ];
  return <LabelTexts ids={ids} {...useLabels(props, props.more ?? NO_MORE)} />;
}

/** The idents of all that is about the two: they stay the same for a flight. */
function useOthers({ shown }: LayerProps) {
  const key = usePart(shown, ({ traffic, cells }) =>
    JSON.stringify([traffic.map(({ ident }) => ident).sort(), cells.map(({ ident }) => ident)]),
  );
  const [traffic, cells] = JSON.parse(key.value) as [string[], string[]];
  return { traffic, cells };
}

/** Those of the leader and of the edge move with them, all others with the ground. */
const LABEL_CARRIERS = [
  { by: "map", ids: IDS.filter((id) => !["leader", "circle", "offscale"].includes(id)) },
  { by: "tape", ids: ["offscale"] },
  { by: "leader", ids: ["circle", "leader"] },
] as const;

/** The same in flight, carried on between two pictures with what they belong to. */
export function CarriedLabels({ shown, view }: LayerProps) {
  const placed = useLabels({ shown, view }, NO_MORE);
  const others = useOthers({ shown, view });
  return (
    <>
      {others.cells.length > 0 && (
        <Plane shown={shown} view={view} by="map">
          <LabelTexts ids={others.cells.map(weatherId)} {...placed} />
        </Plane>
      )}
      {others.traffic.length > 0 && (
        <Plane shown={shown} view={view} by="tape">
          <LabelTexts ids={others.traffic.map((ident) => trafficId(ident, true))} {...placed} />
        </Plane>
      )}
      {others.traffic.map((ident) => (
        <Plane key={ident} shown={shown} view={view} by={`other ${ident}`}>
          <LabelTexts ids={[trafficId(ident)]} {...placed} />
        </Plane>
      ))}
      {LABEL_CARRIERS.map(({ by, ids }) => (
        <Plane key={by} shown={shown} view={view} by={by}>
          <LabelTexts ids={ids} {...placed} />
        </Plane>
      ))}
    </>
  );
}

interface Placed {
  readonly labels: ReadonlySignal<ReadonlyMap<string, Label>>;
  readonly placements: ReadonlySignal<ReadonlyMap<string, Placement>>;
}

const NONE_BEFORE: ReadonlyMap<string, Placement> = new Map();

function useLabels({ shown, view }: LayerProps, more: ReadonlySignal<More>): Placed {
  const labels = useComputed(
    () =>
      new Map([...labelsOf({ shown, view }), ...more.value.labels].map((each) => [each.id, each])),
  );
  const forecast = usePart(shown, (picture) => picture.forecast);
  const placements = useMemo(() => {
    let before = NONE_BEFORE;
    return computed(() => {
      void view.beat.value;
      void forecast.value;
      void shown.chosen.value;
      // Sides are chosen at the pace of reading; between, each label moves with its point.
      const all = [...labels.peek().values()];
      const kept = shown.stands.value ? NONE_BEFORE : before;
      before = untracked(() => choose({ shown, view }, all, kept, more.peek().points));
      return before;
    });
  }, [shown, view, labels, forecast, more]);
  return { labels, placements };
}

function LabelTexts({ ids, labels, placements }: Placed & { ids: readonly string[] }) {
  return (
    <g class="nd-labels">
      {ids.map((id) => (
        <LabelText key={id} id={id} labels={labels} placements={placements} />
      ))}
    </g>
  );
}

/** The labels of this moment that have a place, and where. */
export function chooseLabels(
  props: LayerProps,
  more: More = NO_MORE.value,
): { label: Label; placement: Placement }[] {
  const labels = [...labelsOf(props), ...more.labels];
  const placements = choose(props, labels, NONE_BEFORE, more.points);
  return labels.flatMap((label) => {
    const placement = placements.get(label.id);
    return placement === undefined ? [] : [{ label, placement }];
  });
}

interface LabelTextProps extends Placed {
  readonly id: string;
}

function LabelText({ id, labels, placements }: LabelTextProps) {
  const place = useComputed(() => {
    const point = labelPoint(id, labels.value, placements.value);
    return point === null ? "" : placeAt(point);
  });
  return <LabelRows id={id} labels={labels} placements={placements} transform={place} />;
}

/** A label on a sheet of its own: moved with each picture of the scene, it makes no browser lay out. */
export function LabelSheet({ id, labels, placements }: LabelTextProps) {
  const sheet = useRef<SVGSVGElement>(null);
  useLayoutEffect(() => {
    const { current } = sheet;
    if (current === null) return;
    return effect(() => {
      const { x, y } = labelPoint(id, labels.value, placements.value) ?? { x: 0, y: 0 };
      current.style.transform = `translate(${round(x)}px, ${round(y)}px)`;
    });
  }, [id, labels, placements]);
  return (
    <svg ref={sheet} class="nd-plane" aria-hidden="true">
      <LabelRows id={id} labels={labels} placements={placements} />
    </svg>
  );
}

/** The middle of a label's upper edge; null while it has no place. */
function labelPoint(
  id: string,
  labels: ReadonlyMap<string, Label>,
  placements: ReadonlyMap<string, Placement>,
): Point | null {
  const [label, box] = [labels.get(id), placements.get(id)?.box];
  if (label === undefined || box === undefined) return null;
  return { x: label.at.x + box.x + box.width / 2, y: label.at.y + box.y };
}

function LabelRows(props: LabelTextProps & { transform?: ReadonlySignal<string> }) {
  const { id, labels, placements, transform } = props;
  const count = useComputed(() =>
    placements.value.has(id) ? (labels.value.get(id)?.lines.length ?? 0) : 0,
  );
  const size = useComputed(() => labels.value.get(id)?.size ?? 0);
  if (count.value === 0) return null;
  return (
    <g
      class="nd-label"
      data-element={elementOfLabel(id)}
      font-size={size}
      text-anchor="middle"
      transform={transform}
    >
      {Array.from({ length: count.value }, (_, i) => (
        <LabelRow key={i} id={id} row={i} labels={labels} />
      ))}
    </g>
  );
}

function LabelRow({
  id,
  row,
  labels,
}: {
  id: string;
  row: number;
  labels: LabelTextProps["labels"];
}) {
  const text = useComputed(() => labels.value.get(id)?.lines[row]?.text ?? "");
  const fill = useComputed(() => ink(labels.value.get(id)?.lines[row]?.colour ?? "label"));
  return (
    <text class="nd-text" y={`${0.84 + LINE_HEIGHT * row}em`} fill={fill}>
      {text}
    </text>
  );
}

function choose(
  props: LayerProps,
  labels: Label[],
  before: ReadonlyMap<string, Placement>,
  points: readonly Point[] = [],
) {
  const layout = props.view.layout.value;
  const around = {
    isSeen: (point: Point) => onMap(layout, point, 4) && point.x > 4 && point.x < SIZE - 4,
    boxes: [...layout.readouts, ...symbols(props)],
    points: [...linePoints(props), ...points],
  };
  return placeLabels(labels, around, before);
}

/** The symbols that no label may cover. */
function symbols({ shown, view }: LayerProps): Box[] {
  const [{ now, style, closest, closestAtJoin, join, traffic }, pose] = [
    shown.picture.value,
    view.pose.value,
  ];
  const layout = view.layout.value;
  if (now === null || pose === null) return [];
  const boxes = [square(project(layout, pose, now.pursuer), 28)];
  if (style !== null && style.slot !== "none")
    boxes.push(square(project(layout, pose, now.slot), 22));
  if (leaderOnMap({ shown, view }) !== null)
    boxes.push(square(project(layout, pose, now.leader), 24));
  boxes.push(...traffic.map(({ aircraft }) => square(project(layout, pose, aircraft), 22)));
  const pair = closest ?? closestAtJoin;
  const points = [pair?.pursuer, pair?.leader, join].filter((point) => point != null);
  boxes.push(...points.map((point) => square(project(layout, pose, point), 11)));
  for (const { radius } of layout.rings)
    boxes.push(...ringLabelPoints(layout, radius).map((point) => square(point, 14)));
  if (layout.mode === "PLAN")
    boxes.push(...Object.values(LETTERS).map((each) => square(letterPoint(layout, each), 14)));
  return boxes;
}

export function square({ x, y }: Point, half: number): Box {
  return { x: x - half, y: y - half, width: 2 * half, height: 2 * half };
}

/** Points along both paths, close enough that no label can stand between two of them. */
function linePoints({ shown, view }: LayerProps): Point[] {
  const pose = view.pose.value;
  if (pose === null) return [];
  const layout = view.layout.value;
  const { t, flown, proposed, forecast, route, until, wind } = shown.picture.value;
  const planned = flown === null ? [] : samplePath(flown.plan.segments, wind, t - flown.t_s);
  const own =
    forecast === null || proposed !== null
      ? planned
      : pointsAfter(forecast, forecastIndex(forecast, t), until);
  const leader = route === null ? [] : samplePath(route.segments, wind, t);
  return [own, leader].flatMap((path) => dense(path.map((point) => project(layout, pose, point))));
}

/** Fills in what is further apart than a line of text is high [px]. */
function dense(points: readonly Point[]): Point[] {
  return points.flatMap((point, i) => {
    const next = points[i + 1];
    if (next === undefined) return [point];
    const count = Math.min(200, Math.ceil(Math.hypot(next.x - point.x, next.y - point.y) / 12));
    return Array.from({ length: Math.max(1, count) }, (_, k) => ({
      x: point.x + ((next.x - point.x) * k) / Math.max(1, count),
      y: point.y + ((next.y - point.y) * k) / Math.max(1, count),
    }));
  });
}
