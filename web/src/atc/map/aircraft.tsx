/** Aircraft: where they are, were, and will be in a minute; who they are. */

import type { Label } from "../../nd/labels";
import { ink } from "../../nd/style";
import { within } from "../../nd/view";
import { formatMiles } from "../../units";
import type { ClearanceCard, TrafficCard } from "../../wire";
import { straightOn } from "../closest";
import { aircraftOf, type Sky } from "../sky";
import type { Station } from "../station";
import { apart } from "../tracks";
import { isOver } from "../urgency";
import { flightText, STATES } from "../words";
import { glassOf, lineOf, type MapView, toPoint, typeOf } from "./view";

/** A speed vector is so long [s]. */
export const VECTOR = 60;
/** What was seen longer ago is marked as old [s]. */
const OLD = 10;
/** Dots of this age would not be seen. */
const FADED = 14;
const CHEVRON = "M0 -9L7 8L0 4L-7 8Z";
/** With more aircraft than this, those that no clearance is about may lose their label. */
const MANY = 40;

/** Where all were, fading: one path for each age, its dots as round ends of lines without length. */
export function Dots({ station: { view, store } }: { station: Station }) {
  return (
    <g class="atc-dots">
      {store.trail.value.map(({ aircraft, t }, age) => (
        <path
          key={t}
          opacity={1 - age / FADED}
          d={aircraft.map((each) => `${lineOf(view, [each])}h0`).join("")}
        />
      ))}
    </g>
  );
}

export function Symbols({ station }: { station: Station }) {
  const { view, store, selected } = station;
  const sky = store.sky.value;
  const chosen = sky.clearances.get(selected.value ?? "") ?? null;
  return (
    <g class="atc-aircraft">
      {sky.aircraft.map((each) => (
        <Chevron
          key={each.ident}
          view={view}
          card={each}
          clearance={clearanceOf(sky, each.ident)}
          ring={ringOf(each.ident, chosen, station)}
        />
      ))}
    </g>
  );
}

/** Chosen pursuers are ringed, their leaders twice, those picked for the pair tool with dashes. */
function ringOf(ident: string, chosen: ClearanceCard | null, { picked }: Station): string {
  if (picked.value.includes(ident)) return "picked";
  if (chosen?.aircraft === ident) return "own";
  return chosen?.traffic_id === ident ? "leader" : "";
}

function Chevron(props: {
  view: MapView;
  card: TrafficCard;
  clearance: ClearanceCard | null;
  ring: string;
}) {
  const { view, card, clearance, ring } = props;
  const { x, y } = toPoint(view, card);
  const colour = clearance === null ? "label" : STATES[clearance.state].colour;
  const isOld = card.age_s > OLD;
  return (
    <g
      data-ident={card.ident}
      class={`${clearance === null ? "other" : "cleared"}${isOld ? " old" : ""}`}
      style={{ color: ink(isOld ? "caution" : colour) }}
    >
      <path
        class="vector"
        stroke-dasharray={card.intends ? "" : "2 4"}
        d={lineOf(view, [card, straightOn(card, VECTOR)])}
      />
      <g transform={`translate(${x.toFixed(1)} ${y.toFixed(1)})`}>
        {ring !== "" && <circle class={`ring ${ring}`} r={14} />}
        {ring === "leader" && <circle class="ring leader" r={18} />}
        <path class="symbol" d={CHEVRON} transform={`rotate(${card.track_deg})`} />
      </g>
    </g>
  );
}

/** The clearance that an aircraft asks for or flies. */
function clearanceOf(sky: Sky, ident: string): ClearanceCard | null {
  const own = [...sky.clearances.values()].filter((each) => each.aircraft === ident);
  return own.find((each) => !isOver(each)) ?? null;
}

/** The label of each that is seen: first that of the clearance that is chosen, then those of the others. */
export function aircraftLabels({ view, store, selected }: Station): Label[] {
  const sky = store.sky.value;
  const glass = glassOf(view);
  const labels = sky.aircraft
    .map((card) => ({ card, clearance: clearanceOf(sky, card.ident), at: toPoint(view, card) }))
    .filter(({ at }) => within(glass, at))
    .map(({ card, clearance, at }) => ({
      id: card.ident,
      at,
      lines: linesOf(sky, card, clearance),
      side: card.track_deg + 120,
      gap: 16,
      size: typeOf(view),
      optional: clearance === null && sky.aircraft.length > MANY,
      rank: clearance === null ? 2 : clearance.id === selected.value ? 0 : 1,
    }));
  return labels.sort((a, b) => a.rank - b.rank);
}

function linesOf(sky: Sky, card: TrafficCard, clearance: ClearanceCard | null): Label["lines"] {
  const old = card.age_s > OLD ? ` OLD ${Math.round(card.age_s)} s` : "";
  const flight = { text: flightText(card), colour: "label" } as const;
  if (clearance === null) return [{ text: `${card.ident}${old}`, colour: "label" }, flight];
  const { word, colour } = STATES[clearance.state];
  const name = { text: `${card.ident} ${word}${old}`, colour };
  const leader = aircraftOf(sky, clearance.traffic_id);
  if (leader === null) return [name, flight];
  const wanted =
    clearance.spacing_type === "time"
      ? `${Math.round(clearance.spacing_time_s)} s`
      : `${formatMiles(clearance.slot_distance_m)} NM`;
  const spacing = `${formatMiles(apart(card, leader))}→${wanted}`;
  return [name, flight, { text: spacing, colour: "selected" }];
}
