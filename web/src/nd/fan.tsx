import { useComputed } from "@preact/signals";
import { formatClock } from "../units";
import type { FanJoin } from "../wire";
import type { Label } from "./labels";
import { type LayerProps, usePart } from "./layer";
import { line } from "./path";
import { Stroke } from "./stroke";
import { LINES } from "./style";
import { offNose, onMap, project, round, toMap } from "./view";

/** A join's sign: a hollow diamond, as half its width [px]. */
const SIGN = 5;
/** Each turn of the fan but none: that join is the path's own. */
export const FAN_IDS = [-30, -20, -10, 10, 20, 30].map((turn) => `fan ${turn}`);

/** Where own ship would join if the leader turned now: a dotted ray and a hollow diamond for each turn. */
export function Fan({ shown, view }: LayerProps) {
  const fan = usePart(shown, (picture) => picture.fan);
  const leader = usePart(shown, (picture) => picture.leader);
  const isShown = useComputed(() => fan.value !== null && leader.value !== null);
  const rays = useComputed(() => {
    const from = leader.value;
    if (from === null) return "";
    return turned(fan.value?.joins)
      .map((join) => line(view.layout.value, from, join))
      .join("");
  });
  const signs = useComputed(() =>
    turned(fan.value?.joins)
      .map((join) => {
        const { x, y } = toMap(view.layout.value, join);
        const [left, right] = [round(x - SIGN), round(x + SIGN)];
        return `M${left} ${round(y)}L${round(x)} ${round(y - SIGN)}L${right} ${round(y)}L${round(x)} ${round(y + SIGN)}Z`;
      })
      .join(""),
  );
  if (!isShown.value) return null;
  return (
    <g class="nd-fan">
      <Stroke d={rays} line={LINES.fan} />
      <Stroke d={signs} line={{ ...LINES.fan, dash: "" }} />
    </g>
  );
}

function turned(joins: readonly FanJoin[] | undefined): FanJoin[] {
  return (joins ?? []).filter(({ turn_deg }) => Math.round(turn_deg) !== 0);
}

/** How long until it would join, at the end of each ray. */
export function fanLabels({ shown, view }: LayerProps): Label[] {
  const [{ fan, leader, t }, pose] = [shown.picture.value, view.pose.value];
  if (fan === null || leader === null || pose === null) return [];
  const layout = view.layout.value;
  return turned(fan.joins).flatMap((join) => {
    const at = project(layout, pose, join);
    if (!onMap(layout, at)) return [];
    const turn = Math.round(join.turn_deg);
    const text = formatClock(Math.max(0, join.joins_s - t));
    const side = offNose(pose, leader.heading_deg + turn);
    const lines = [{ text, colour: LINES.fan.colour }];
    return [{ id: `fan ${turn}`, at, lines, side, gap: 9, size: 16, optional: true }];
  });
}
