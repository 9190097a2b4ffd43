import { useComputed } from "@preact/signals";
import { committedPoint, joinTime } from "../committed";
import { pathPointAt } from "../geometry";
import { DEG } from "../units";
import type { PathPoint } from "../wire";
import type { Label } from "./labels";
import { type LayerProps, planTime, shownPlan, windNow } from "./picture";
import { Stroke } from "./stroke";
import { LINES, type Line } from "./style";
import { offNose, onMap, project, round, toMap } from "./view";

/** Beyond this range the ticks would run together [NM]. */
const TICKS_TO = 80;

/** Half the length of a tick [px]. */
const HALF = 5;

/** Marks of the same minutes on both paths: where the two are relative to each other in time. */
export function TimeTicks({ flight, view }: LayerProps) {
  const plan = useComputed(() => shownPlan(flight));
  const shown = useComputed(() => view.layout.value.range <= TICKS_TO);
  const own = useComputed(() => ticks({ flight, view }, ownPoint));
  const leader = useComputed(() => ticks({ flight, view }, leaderPoint));
  if (plan.value === null || !shown.value) return null;
  return (
    <g class="nd-minutes">
      <Stroke d={own} line={thin(LINES.mark)} />
      <Stroke d={leader} line={thin(LINES.leaderMark)} />
    </g>
  );
}

function thin(line: Line): Line {
  return { ...line, width: 1.75 };
}

/** Where one of the two is on its path at flight time `t` [s]. */
type PointAt = (flight: LayerProps["flight"], t: number) => PathPoint | null;

const ownPoint: PointAt = committedPoint;

const leaderPoint: PointAt = (flight, t) => {
  const segments = flight.route.value?.segments ?? [];
  const [from, to] = [segments[0]?.start.t_s ?? 0, segments.at(-1)?.end.t_s ?? 0];
  return t < from || t > to ? null : pathPointAt(segments, t, windNow(flight));
};

function ticks({ flight, view }: LayerProps, pointAt: PointAt): string {
  return minutes(flight)
    .map(({ t }) => pointAt(flight, t))
    .filter((point) => point !== null)
    .map((point) => {
      const { x, y } = toMap(view.layout.value, point);
      const across = point.heading_deg * DEG;
      const [dx, dy] = [HALF * Math.cos(across), HALF * Math.sin(across)];
      return `M${round(x - dx)} ${round(y - dy)}l${round(2 * dx)} ${round(2 * dy)}`;
    })
    .join("");
}

/** The minutes of the plan still to come, and when they are over [s, flight time]. */
function minutes(flight: LayerProps["flight"]): { minute: number; t: number }[] {
  const [plan, join] = [shownPlan(flight), joinTime(flight)];
  if (plan === null || join === null) return [];
  const last = Math.floor((join - plan.t_s - 1) / 60);
  const next = Math.max(1, Math.floor(planTime(flight, plan) / 60) + 1);
  return Array.from({ length: Math.max(0, last - next + 1) }, (_, i) => ({
    minute: next + i,
    t: plan.t_s + 60 * (next + i),
  }));
}

/** The numbers of every fifth minute, on both paths. */
export function minuteLabels({ flight, view }: LayerProps): Label[] {
  const [plan, pose] = [shownPlan(flight), view.pose.value];
  const layout = view.layout.value;
  if (plan === null || pose === null || layout.range > TICKS_TO) return [];
  const both = [
    { pointAt: ownPoint, colour: "plan" },
    { pointAt: leaderPoint, colour: "leader" },
  ] as const;
  const labels: Label[] = [];
  for (const { minute, t } of minutes(flight).filter((each) => each.minute % 5 === 0)) {
    for (const { pointAt, colour } of both) {
      const point = pointAt(flight, t);
      if (point === null) continue;
      const at = project(layout, pose, point);
      if (!onMap(layout, at)) continue;
      const lines = [{ text: String(minute), colour }];
      const side = offNose(pose, point.heading_deg + 90);
      const id = `minute ${minute} ${colour}`;
      labels.push({ id, at, lines, side, gap: 8, size: 18, optional: true });
    }
  }
  return labels;
}
