import { useComputed } from "@preact/signals";
import { committedPoint, type Turn, turnsOf } from "../committed";
import type { Label } from "./labels";
import { type LayerProps, planTime, ROLL_IN, shownPlan } from "./picture";
import { Stroke } from "./stroke";
import { LINES } from "./style";
import { offNose, onMap, placeAt, project, toMap } from "./view";

/** Beyond these ranges the sizes of the turns, then their names, would only clutter [NM]. */
const SIZES_TO = 40;
const NAMES_TO = 80;

/** Where each turn begins and ends, as ticks across the path; chevrons where the next roll-in is due. */
export function TurnPoints({ flight, view }: LayerProps) {
  const plan = useComputed(() => shownPlan(flight));
  if (plan.value === null) return null;
  const start = plan.value.t_s;
  return (
    <g class="nd-turns">
      {turnsOf(plan.value).map(({ name, segment }) => (
        <g key={`${start} ${name}`}>
          <Mark flight={flight} view={view} at={start + segment.start.t_s} half={9} />
          <Mark flight={flight} view={view} at={start + segment.end.t_s} half={6} />
          <RollIn flight={flight} view={view} at={start + segment.start.t_s} />
        </g>
      ))}
    </g>
  );
}

interface MarkProps extends LayerProps {
  /** When own ship is there [s, flight time]. */
  readonly at: number;
}

/** Where a mark stands, across the path that is drawn. */
function markPlace({ flight, view, at }: MarkProps): string {
  const point = committedPoint(flight, at);
  return point === null ? "" : placeAt(toMap(view.layout.value, point), point.heading_deg);
}

function Mark({ flight, view, at, half }: MarkProps & { half: number }) {
  const shown = useComputed(() => flight.simTime.value < at);
  const place = useComputed(() => markPlace({ flight, view, at }));
  if (!shown.value) return null;
  return (
    <g transform={place}>
      <Stroke d={`M${-half} 0H${half}`} line={LINES.mark} />
    </g>
  );
}

function RollIn({ flight, view, at }: MarkProps) {
  const shown = useComputed(() => {
    const left = at - flight.simTime.value;
    return left > 0 && left <= ROLL_IN;
  });
  const place = useComputed(() => markPlace({ flight, view, at }));
  if (!shown.value) return null;
  return (
    <g class="nd-rollin" transform={place}>
      <Stroke d="M-9 -6L0 -14L9 -6M-9 -15L0 -23L9 -15" line={LINES.turn} />
    </g>
  );
}

/** The names of the turns to come, on their outer side. */
export function turnLabels({ flight, view }: LayerProps): Label[] {
  const [plan, pose] = [shownPlan(flight), view.pose.value];
  const layout = view.layout.value;
  if (plan === null || pose === null || layout.range > NAMES_TO) return [];
  return turnsOf(plan)
    .filter(({ segment }) => planTime(flight, plan) < segment.start.t_s)
    .slice(0, 6)
    .map((turn) => {
      const begins = turn.segment.start;
      const point = committedPoint(flight, plan.t_s + begins.t_s) ?? begins;
      return {
        id: turn.name,
        at: project(layout, pose, point),
        lines: [{ text: nameOf(turn, layout.range), colour: "plan" as const }],
        side: offNose(pose, point.heading_deg + (turn.size[0] === "R" ? -90 : 90)),
        gap: 13,
        size: 20,
        optional: true,
      };
    })
    .filter(({ at }) => onMap(layout, at));
}

function nameOf({ name, size }: Turn, range: number): string {
  return range <= SIZES_TO ? `${name} ${size}` : name;
}
