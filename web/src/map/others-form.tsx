/** The other aircraft and cells in numbers: added, removed, and each with how near the plan comes to it. */

import { Panel } from "../parts";
import { formatClock, formatMiles, KT, NM } from "../units";
import type { OtherSeparationCard } from "../wire";
import { edit } from "./editing";
import type { Editor } from "./editor";
import { Fields, IntentFields, LevelField, type Numbered, placeAndSpeed, TENTHS } from "./form";
import { changeCell, changeTraffic, removeOther } from "./other-handles";
import { addCell, addTraffic } from "./others";
import { BOUNDS, type MapCell, type MapTraffic, MOST_OTHERS, type Situation } from "./situation";

export function OthersForm({ map }: { map: Editor }) {
  const { traffic, cells } = map.reading.situation.value;
  const answer = map.reading.answered.value?.answer;
  const others = answer?.status === "planned" ? (answer.separation.others ?? []) : [];
  const keptOf = (ident: string) => others.find((each) => each.ident === ident);
  const isFull = traffic.length + cells.length >= MOST_OTHERS;
  const add = (change: typeof addTraffic) => edit(map, (now) => change(now, map.centre.peek()));
  return (
    <Panel name="map-others" title="Others">
      <div class="row">
        <button type="button" class="grow" disabled={isFull} onClick={() => add(addTraffic)}>
          Add aircraft
        </button>
        <button type="button" class="grow" disabled={isFull} onClick={() => add(addCell)}>
          Add cell
        </button>
      </div>
      {traffic.length + cells.length === 0 && (
        <p class="hint">Nothing else is in the sky. What is added keeps its own distance.</p>
      )}
      {traffic.map((each, number) => (
        <TrafficFields
          key={each.ident}
          map={map}
          number={number}
          traffic={each}
          kept={keptOf(each.ident)}
        />
      ))}
      {cells.map((each, number) => (
        <CellFields
          key={each.ident}
          map={map}
          number={number}
          cell={each}
          kept={keptOf(each.ident)}
        />
      ))}
    </Panel>
  );
}

function TrafficFields(props: {
  map: Editor;
  number: number;
  traffic: MapTraffic;
  kept: OtherSeparationCard | undefined;
}) {
  const { map, number, traffic, kept } = props;
  const { ident, min_separation_m } = traffic;
  const situation = map.reading.situation.value;
  const change = (part: Partial<MapTraffic>, hand?: unknown) =>
    edit(map, (now) => changeTraffic(now, number, () => part), hand);
  const least: Numbered<Partial<MapTraffic>> = {
    ...TENTHS,
    label: `${ident}: minimum separation`,
    short: "MIN",
    step: 0.1,
    value: (min_separation_m ?? situation.min_separation_m) / NM,
    bounds: [0, Math.floor(BOUNDS.distance[1] / NM)],
    part: (miles) => ({ min_separation_m: miles * NM }),
  };
  return (
    <details class="other">
      <summary>
        <b>{ident}</b> <Kept kept={kept} />
      </summary>
      <fieldset class="fields">
        <legend class="visually-hidden">{ident}</legend>
        <Fields numbers={[...placeAndSpeed(ident, traffic), least]} change={change} />
        <LevelField
          name={ident}
          altitude={traffic.altitude_m ?? null}
          change={(altitude_m, hand) => change({ altitude_m }, hand)}
        />
      </fieldset>
      <IntentFields
        name={ident}
        aircraft={traffic}
        change={(next, hand) =>
          edit(
            map,
            (now) => changeTraffic(now, number, ({ intent }) => ({ intent: next(intent) })),
            hand,
          )
        }
      />
      <Remove
        map={map}
        ident={ident}
        remove={(now) => removeOther({ part: "traffic", number }, now)}
      />
    </details>
  );
}

function CellFields(props: {
  map: Editor;
  number: number;
  cell: MapCell;
  kept: OtherSeparationCard | undefined;
}) {
  const { map, number, cell, kept } = props;
  const { ident } = cell;
  return (
    <details class="other">
      <summary>
        <b>{ident}</b> <Kept kept={kept} />
      </summary>
      <fieldset class="fields">
        <legend class="visually-hidden">{ident}</legend>
        <Fields
          numbers={cellNumbers(cell)}
          change={(part, hand) => edit(map, (now) => changeCell(now, number, () => part), hand)}
        />
      </fieldset>
      <Remove
        map={map}
        ident={ident}
        remove={(now) => removeOther({ part: "cell", number }, now)}
      />
    </details>
  );
}

function cellNumbers(cell: MapCell): Numbered<Partial<MapCell>>[] {
  const { ident } = cell;
  const [east, north] = placeAndSpeed(ident, { ...cell, heading_deg: 0, tas_mps: 0 });
  const drift = (name: "east_mps" | "north_mps", toward: string): Numbered<Partial<MapCell>> => ({
    label: `${ident}: moves ${toward}`,
    short: toward === "east" ? "→ E" : "→ N",
    unit: "kt",
    value: cell[name] / KT,
    bounds: [-Math.floor(BOUNDS.drift[1] / KT), Math.floor(BOUNDS.drift[1] / KT)],
    part: (knots) => ({ [name]: knots * KT }),
  });
  return [
    ...[east, north].filter((each) => each !== undefined),
    {
      ...TENTHS,
      label: `${ident}: radius`,
      short: "Radius",
      step: 0.5,
      value: cell.radius_m / NM,
      bounds: [0.1, Math.floor(BOUNDS.radius[1] / NM)],
      part: (miles) => ({ radius_m: miles * NM }),
    },
    drift("east_mps", "east"),
    drift("north_mps", "north"),
    {
      label: `${ident}: grows by`,
      short: "Grows",
      unit: "m/s",
      value: cell.growth_mps,
      bounds: BOUNDS.growth,
      part: (growth) => ({ growth_mps: growth }),
    },
  ];
}

/** How near the plan comes, and when; in words where height keeps them apart. */
function Kept({ kept }: { kept: OtherSeparationCard | undefined }) {
  if (kept === undefined) return null;
  const byHeight = (kept.vertical?.length ?? 0) > 0 && kept.least_m < kept.min_separation_m;
  return (
    <span class="hint">
      {byHeight ? "kept by height" : `${formatMiles(kept.least_m)} NM at ${formatClock(kept.at_s)}`}
    </span>
  );
}

function Remove(props: { map: Editor; ident: string; remove: (now: Situation) => Situation }) {
  const { map, ident, remove } = props;
  return (
    <button
      type="button"
      class="quiet"
      aria-label={`Remove ${ident}`}
      onClick={() => edit(map, remove)}
    >
      Remove {ident}
    </button>
  );
}
