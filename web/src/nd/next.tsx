import { useComputed } from "@preact/signals";
import { committedPoint, joinPoint, nextTurn, timeToJoin } from "../committed";
import { formatClock, formatHeading, formatMiles, NM } from "../units";
import { Cell } from "./cell";
import { type LayerProps, leaderIdent, ROLL_IN, shownPlan, shownReading } from "./picture";
import type { Colour } from "./style";
import { bearing, distance, placeAt, READOUTS } from "./view";

/** What comes next on the plan: the turn with its bearing, distance and countdown, or the capture point. */
export function NextPoint({ flight }: LayerProps) {
  const next = useComputed(() => nextPoint(flight));
  const name = useComputed(() => next.value?.name ?? "");
  const place = useComputed(() => next.value?.place ?? "");
  const degree = useComputed(() => (next.value === null ? "" : "°/"));
  const miles = useComputed(() => next.value?.miles ?? "");
  const unit = useComputed(() => (next.value === null ? "" : "NM"));
  const left = useComputed(() => next.value?.left ?? "");
  const urgent = useComputed<Colour>(() => (next.value?.urgent === true ? "managed" : "value"));
  const { x, y, width } = READOUTS.next;
  return (
    <g class="nd-next" transform={placeAt({ x, y })}>
      <Cell x={width} y={22} text={name} colour="label" anchor="end" />
      <Cell x={46} y={52} text={place} colour="value" anchor="end" />
      <Cell x={46} y={52} text={degree} colour="unit" />
      <Cell x={width - 28} y={52} text={miles} colour="value" anchor="end" />
      <Cell x={width} y={52} text={unit} colour="unit" size={18} anchor="end" />
      <Cell x={width} y={82} text={left} colour={urgent} anchor="end" />
    </g>
  );
}

function nextPoint(flight: LayerProps["flight"]) {
  const [plan, shown] = [shownPlan(flight), shownReading(flight)];
  if (shown === null) return null;
  const own = shown.now.pursuer;
  if (plan === null) {
    if (!shown.look.crossTrack) return null;
    const name = leaderIdent(flight);
    return { name, ...toward(own, shown.now.leader), left: "", urgent: false };
  }
  const turn = nextTurn(plan, shown.now.t_s);
  const left = turn?.in ?? timeToJoin(flight);
  const point = turn === null ? joinPoint(flight) : committedPoint(flight, turn.at);
  if (point === null || left === null) return null;
  return {
    name: turn === null ? "CNV" : `${turn.name} ${turn.size}°`,
    ...toward(own, point),
    left: formatClock(left),
    urgent: turn !== null && left <= ROLL_IN,
  };
}

function toward(own: { x_m: number; y_m: number }, point: { x_m: number; y_m: number }) {
  const length = distance(own, point);
  const decimals = length < 20 * NM ? 1 : 0;
  return { place: formatHeading(bearing(own, point)), miles: formatMiles(length, decimals) };
}
