/** What is asked for and flown: pursuers' routes in the pattern of their state, and their leaders'. */

import type { Label } from "../../nd/labels";
import { ink } from "../../nd/style";
import type { Point } from "../../nd/view";
import type { ClearanceCard, TrackCard } from "../../wire";
import type { Station } from "../station";
import { partOf, placeOn } from "../tracks";
import { isOver } from "../urgency";
import { STATES, timeText } from "../words";
import { lineOf, type MapView, toPoint, typeOf } from "./view";

const LEADER_DASH = "12 4 2 4";

export function Routes({ station }: { station: Station }) {
  const { view, store, selected } = station;
  const sky = store.sky.value;
  const shown = [...sky.clearances.values()].filter(
    (card) => !isOver(card) || card.id === selected.value,
  );
  return (
    <g class="atc-routes">
      {shown.map((card) => (
        <Route key={card.id} card={card} station={station} isChosen={card.id === selected.value} />
      ))}
      <Alternative station={station} view={view} />
    </g>
  );
}

function Route(props: { card: ClearanceCard; station: Station; isChosen: boolean }) {
  const { card, isChosen, station } = props;
  const { view, store } = station;
  const { colour, dash } = STATES[card.state];
  const { t } = store.sky.value;
  const join = toPoint(view, placeOn(card.route, card.joins_s));
  return (
    <g class={isChosen ? "chosen" : ""} data-clearance={card.id}>
      <path class="leader" stroke-dasharray={LEADER_DASH} d={ahead(view, card.leader_route, t)} />
      <path
        class="pursuer"
        stroke={ink(colour)}
        stroke-dasharray={dash}
        d={ahead(view, card.route, t)}
      />
      {card.joins_s > t && (
        <g class="join" stroke={ink(colour)} transform={`translate(${join.x} ${join.y})`}>
          <circle r={6} />
          <circle r={1.5} fill={ink(colour)} />
        </g>
      )}
    </g>
  );
}

/** A track from now on. */
function ahead(view: MapView, track: TrackCard, t: number): string {
  const [begin, end] = [track.t_s[0] ?? 0, track.t_s.at(-1) ?? 0];
  const from = Math.max(begin, t);
  return from >= end ? "" : lineOf(view, partOf(track, from, end));
}

/** The alternative that is looked at. */
function Alternative({ station, view }: { station: Station; view: MapView }) {
  const found = station.alternative.value;
  if (found === null) return null;
  const { route } = found;
  const d = lineOf(view, partOf(route, route.t_s[0] ?? 0, route.t_s.at(-1) ?? 0));
  return <path class="alternative" stroke={ink("managed")} stroke-dasharray="9 6" d={d} />;
}

/** When the one that is chosen joins. */
export function joinLabel({ view, store, card }: Station): Label | null {
  const chosen = card.value;
  if (chosen === null || chosen.joins_s <= store.sky.value.t) return null;
  return {
    id: "join",
    at: toPoint(view, placeOn(chosen.route, chosen.joins_s)),
    lines: [
      {
        text: `JOIN ${timeText(chosen.sky, chosen.joins_s)}`,
        colour: STATES[chosen.state].colour,
      },
    ],
    side: 120,
    gap: 10,
    size: typeOf(view),
    optional: false,
  };
}

/** Points along the route of the one that is chosen [px]: better no text over them. */
export function routePoints({ view, card }: Station): Point[] {
  if (card.value === null) return [];
  const { route } = card.value;
  const [from, to] = [route.t_s[0] ?? 0, route.t_s.at(-1) ?? 0];
  return Array.from({ length: POINTS }, (_, k) =>
    toPoint(view, placeOn(route, from + (k * (to - from)) / POINTS)),
  );
}

const POINTS = 60;
