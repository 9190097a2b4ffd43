import { useComputed } from "@preact/signals";
import { DEG } from "../units";
import type { PathPoint } from "../wire";
import type { Label } from "./labels";
import { type LayerProps, usePart } from "./layer";
import { Stroke } from "./stroke";
import { LINES, type Line } from "./style";
import { type Layout, offNose, onMap, project, round, toMap } from "./view";

/** Beyond this range the ticks would run together [NM]. */
const TICKS_TO = 80;

/** Half the length of a tick [px]. */
const HALF = 5;

/** Marks of the same minutes on both paths: where the two are relative to each other in time. */
export function TimeTicks({ shown, view }: LayerProps) {
  const isPlanned = usePart(shown, (picture) => picture.flown !== null);
  const isWide = useComputed(() => view.layout.value.range > TICKS_TO);
  const own = useComputed(() => ticks(view.layout.value, shown.picture.value.minutes, "own"));
  const leader = useComputed(() => ticks(view.layout.value, shown.picture.value.minutes, "leader"));
  const colour = usePart(shown, ({ style }) => style?.pathColour ?? "plan");
  if (!isPlanned.value || isWide.value) return null;
  return (
    <g class="nd-minutes">
      <Stroke d={own} line={{ ...thin(LINES.mark), colour: colour.value }} />
      <Stroke d={leader} line={thin(LINES.leaderMark)} />
    </g>
  );
}

function thin(line: Line): Line {
  return { ...line, width: 1.75 };
}

type Who = "own" | "leader";

function ticks(
  layout: Layout,
  minutes: readonly Record<Who, PathPoint | null>[],
  who: Who,
): string {
  return minutes
    .map((each) => each[who])
    .filter((point) => point !== null)
    .map((point) => {
      const { x, y } = toMap(layout, point);
      const across = point.heading_deg * DEG;
      const [dx, dy] = [HALF * Math.cos(across), HALF * Math.sin(across)];
      return `M${round(x - dx)} ${round(y - dy)}l${round(2 * dx)} ${round(2 * dy)}`;
    })
    .join("");
}

/** The numbers of every fifth minute, on both paths. */
export function minuteLabels({ shown, view }: LayerProps): Label[] {
  const pose = view.pose.value;
  const layout = view.layout.value;
  if (pose === null || layout.range > TICKS_TO) return [];
  const path = shown.picture.value.style?.pathColour ?? "plan";
  const labels: Label[] = [];
  for (const each of shown.picture.value.minutes.filter(({ minute }) => minute % 5 === 0)) {
    for (const who of ["own", "leader"] as const) {
      const point = each[who];
      if (point === null) continue;
      const at = project(layout, pose, point);
      if (!onMap(layout, at)) continue;
      const lines = [
        { text: String(each.minute), colour: who === "own" ? path : "leader" },
      ] as const;
      const side = offNose(pose, point.heading_deg + 90);
      const id = `minute ${each.minute} ${who}`;
      labels.push({ id, at, lines, side, gap: 8, size: 18, optional: true });
    }
  }
  return labels;
}
