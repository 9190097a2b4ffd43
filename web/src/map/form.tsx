/** The situation in numbers: all that the map shows, to be typed. */

import { Choice, Panel } from "../parts";
import { FT, KT, NM } from "../units";
import type { IntentPiece, LevelChange, LocalLeader, TurnPiece } from "../wire";
import { edit } from "./editing";
import type { Editor } from "./editor";
import { Field, type FieldProps } from "./field";
import { BOUNDS, type Declared, MOST_PIECES, type Situation } from "./situation";

/** A number of the situation: where it may lie, and what typing it makes of its part. */
export interface Numbered<Part> extends Omit<FieldProps, "change"> {
  readonly part: (typed: number) => Part;
}

export function Fields<Part>(props: {
  numbers: readonly Numbered<Part>[];
  change: (part: Part, hand: unknown) => void;
}) {
  return props.numbers.map(({ part, ...number }) => (
    <Field
      key={number.label}
      {...number}
      change={(typed, hand) => props.change(part(typed), hand)}
    />
  ));
}

export const TENTHS = { unit: "NM", decimals: 1 } as const;
const HEADINGS = [0, 360] as const;
const PLACES = [-539, 539] as const;
const SPEEDS = [Math.round(BOUNDS.tas[0] / KT), Math.round(BOUNDS.tas[1] / KT)] as const;
const WINDS = [0, Math.floor(BOUNDS.wind[1] / KT)] as const;
const DISTANCE = Math.floor(BOUNDS.distance[1] / NM);

type Who = "pursuer" | "leader";
const NAMES = { pursuer: "Own ship", leader: "Leader" } as const;

export function SituationForm({ map }: { map: Editor }) {
  return (
    <Panel name="situation" title="Situation">
      <AircraftFields map={map} who="pursuer" />
      <AircraftFields map={map} who="leader" />
      <IntentFields
        name="Leader"
        aircraft={map.reading.situation.value.leader}
        change={(next, hand) =>
          edit(
            map,
            (now) => ({ ...now, leader: { ...now.leader, intent: next(now.leader.intent) } }),
            hand,
          )
        }
      />
      <fieldset class="fields">
        <legend>Spacing and wind</legend>
        <Fields
          numbers={spacingAndWind(map.reading.situation.value)}
          change={(part, hand) => edit(map, (now) => ({ ...now, ...part }), hand)}
        />
      </fieldset>
    </Panel>
  );
}

function spacingAndWind(situation: Situation): Numbered<Partial<Situation>>[] {
  const { slot_distance_m, min_separation_m, wind } = situation;
  const tenth = (metres: number) => Number((metres / NM).toFixed(1));
  return [
    {
      ...TENTHS,
      label: "Slot distance D",
      short: "D",
      step: 0.1,
      value: slot_distance_m / NM,
      bounds: [tenth(min_separation_m), DISTANCE],
      limit: "D is no less than MIN",
      part: (miles) => ({ slot_distance_m: miles * NM }),
    },
    {
      ...TENTHS,
      label: "Minimum separation",
      short: "MIN",
      step: 0.1,
      value: min_separation_m / NM,
      bounds: [0, tenth(slot_distance_m)],
      limit: "MIN is no more than D",
      part: (miles) => ({ min_separation_m: Math.min(miles * NM, slot_distance_m) }),
    },
    {
      label: "Wind from",
      short: "From",
      unit: "°",
      value: wind.from_deg,
      bounds: HEADINGS,
      part: (from) => ({ wind: { ...wind, from_deg: from } }),
    },
    {
      label: "Wind speed",
      short: "Wind",
      unit: "kt",
      value: wind.speed_mps / KT,
      bounds: WINDS,
      part: (knots) => ({ wind: { ...wind, speed_mps: knots * KT } }),
    },
  ];
}

function AircraftFields({ map, who }: { map: Editor; who: Who }) {
  const aircraft = map.reading.situation.value[who];
  const name = NAMES[who];
  const numbers = placeAndSpeed(name, aircraft);
  return (
    <fieldset class="fields">
      <legend class={`key-${who}`}>{name}</legend>
      <Fields
        numbers={
          "max_bank_deg" in aircraft ? [...numbers, bankOf(name, aircraft.max_bank_deg)] : numbers
        }
        change={(part, hand) =>
          edit(map, (now) => ({ ...now, [who]: { ...now[who], ...part } }), hand)
        }
      />
      <LevelField
        name={name}
        altitude={aircraft.altitude_m ?? null}
        change={(altitude_m, hand) =>
          edit(map, (now) => ({ ...now, [who]: { ...now[who], altitude_m } }), hand)
        }
      />
    </fieldset>
  );
}

export function placeAndSpeed(
  name: string,
  { x_m, y_m, heading_deg, tas_mps }: Omit<LocalLeader, "intent">,
): Numbered<Partial<Omit<LocalLeader, "intent">>>[] {
  return [
    {
      ...TENTHS,
      label: `${name}: east of the origin`,
      short: "East",
      step: 0.5,
      value: x_m / NM,
      bounds: PLACES,
      part: (miles) => ({ x_m: miles * NM }),
    },
    {
      ...TENTHS,
      label: `${name}: north of the origin`,
      short: "North",
      step: 0.5,
      value: y_m / NM,
      bounds: PLACES,
      part: (miles) => ({ y_m: miles * NM }),
    },
    {
      label: `${name}: heading`,
      short: "HDG",
      unit: "°",
      value: heading_deg,
      bounds: HEADINGS,
      part: (heading) => ({ heading_deg: heading }),
    },
    {
      label: `${name}: true airspeed`,
      short: "TAS",
      unit: "kt",
      value: tas_mps / KT,
      bounds: SPEEDS,
      part: (knots) => ({ tas_mps: knots * KT }),
    },
  ];
}

function bankOf(name: string, bank: number): Numbered<Partial<Situation["pursuer"]>> {
  return {
    label: `${name}: bank`,
    short: "Bank",
    unit: "°",
    value: bank,
    bounds: BOUNDS.bank,
    part: (typed) => ({ max_bank_deg: typed }),
  };
}

/** The level that is entered first [m], and how a new change of level goes on from there. */
const FIRST_LEVEL = 310;
const LEVELS = [0, Math.floor(BOUNDS.altitude[1] / FT / 100)] as const;
const CHANGE = { by: -2000 * FT, rate: 8 } as const;

/** The level of an aircraft, where it is known: else its height keeps nothing apart. */
export function LevelField(props: {
  name: string;
  altitude: number | null;
  change: (altitude: number | null, hand?: unknown) => void;
}) {
  const { name, altitude, change } = props;
  if (altitude === null)
    return (
      <button
        type="button"
        class="quiet"
        onClick={() => change(FIRST_LEVEL * 100 * FT)}
        aria-label={`${name}: give its level`}
      >
        + Level
      </button>
    );
  return (
    <div class="level">
      <Fields
        numbers={[levelNumber(`${name}: flight level`, "FL", altitude)]}
        change={(level, hand) => change(level, hand)}
      />
      <button
        type="button"
        class="quiet"
        onClick={() => change(null)}
        aria-label={`${name}: forget its level`}
      >
        ×
      </button>
    </div>
  );
}

function levelNumber(label: string, short: string, altitude: number): Numbered<number> {
  return {
    label,
    short,
    unit: "",
    step: 10,
    value: altitude / FT / 100,
    bounds: LEVELS,
    part: (level) => level * 100 * FT,
  };
}

/** What an aircraft has declared, piece by piece; what follows the last is flown for ever. */
export function IntentFields(props: {
  /** Whose. */
  name: string;
  aircraft: Declared;
  change: (next: (pieces: readonly IntentPiece[]) => IntentPiece[], hand?: unknown) => void;
}) {
  const { name, aircraft, change } = props;
  const { intent, heading_deg, altitude_m } = aircraft;
  const turn: IntentPiece = {
    turn_to_heading_deg: (Math.round(heading_deg) + 45) % 360,
    direction: "right",
    bank_deg: 20,
  };
  const descent: IntentPiece = {
    level_change: { to_altitude_m: (altitude_m ?? 0) + CHANGE.by, rate_mps: CHANGE.rate },
  };
  const isFull = intent.length >= MOST_PIECES;
  return (
    <fieldset class="fields intent">
      <legend class={name === "Leader" ? "key-leader" : ""}>{name} declares</legend>
      {intent.length === 0 && (
        <p class="hint">
          {name === "Leader"
            ? "Nothing: its intent is not known."
            : "Nothing: it flies straight on."}
        </p>
      )}
      <ol>
        {intent.map((piece, i) => (
          <li key={i}>
            <Piece
              piece={piece}
              number={i + 1}
              name={name === "Leader" ? "" : `${name}, `}
              change={(next, hand) => change((pieces) => pieces.with(i, next), hand)}
            />
            <button
              type="button"
              class="quiet"
              aria-label={`Remove piece ${i + 1}`}
              onClick={() => change((pieces) => pieces.toSpliced(i, 1))}
            >
              ×
            </button>
          </li>
        ))}
      </ol>
      <div class="row">
        <button
          type="button"
          class="grow"
          disabled={isFull}
          onClick={() => change((pieces) => [...pieces, { straight_s: 120 }])}
        >
          + Straight
        </button>
        <button
          type="button"
          class="grow"
          disabled={isFull}
          onClick={() => change((pieces) => [...pieces, turn])}
        >
          + Turn
        </button>
        {altitude_m != null && (
          <button
            type="button"
            class="grow"
            disabled={isFull}
            onClick={() => change((pieces) => [...pieces, descent])}
          >
            + Level
          </button>
        )}
      </div>
    </fieldset>
  );
}

function Piece(props: {
  piece: IntentPiece;
  number: number;
  /** Of whom, where that is not the leader. */
  name: string;
  change: (piece: IntentPiece, hand?: unknown) => void;
}) {
  const { piece, number, change } = props;
  const name = `${props.name}${props.name === "" ? "Piece" : "piece"} ${number}`;
  if ("straight_s" in piece)
    return <Fields numbers={[durationOf(name, piece.straight_s)]} change={change} />;
  if ("level_change" in piece)
    return (
      <Fields
        numbers={levelNumbers(name, piece.level_change)}
        change={(part, hand) => change({ level_change: { ...piece.level_change, ...part } }, hand)}
      />
    );
  return (
    <>
      <Choice
        label={`${name}: turn`}
        options={["left", "right"]}
        chosen={piece.direction}
        text={(side) => (side === "left" ? "L" : "R")}
        choose={(direction) => change({ ...piece, direction })}
      />
      <Fields
        numbers={turnNumbers(name, piece)}
        change={(part, hand) => change({ ...piece, ...part }, hand)}
      />
    </>
  );
}

function durationOf(name: string, seconds: number): Numbered<IntentPiece> {
  return {
    label: `${name}: straight for`,
    short: "Straight",
    unit: "s",
    step: 10,
    value: seconds,
    bounds: BOUNDS.piece,
    part: (typed) => ({ straight_s: typed }),
  };
}

function levelNumbers(name: string, change: LevelChange): Numbered<Partial<LevelChange>>[] {
  const to = levelNumber(`${name}: to flight level`, "to FL", change.to_altitude_m);
  return [
    { ...to, part: (level) => ({ to_altitude_m: to.part(level) }) },
    {
      label: `${name}: rate of climb or descent`,
      short: "at",
      unit: "ft/min",
      step: 100,
      value: (change.rate_mps / FT) * 60,
      bounds: [Math.ceil((BOUNDS.rate[0] / FT) * 60), Math.floor((BOUNDS.rate[1] / FT) * 60)],
      part: (rate) => ({ rate_mps: (rate * FT) / 60 }),
    },
  ];
}

function turnNumbers(name: string, turn: TurnPiece): Numbered<Partial<TurnPiece>>[] {
  return [
    {
      label: `${name}: to heading`,
      short: "to",
      unit: "°",
      value: turn.turn_to_heading_deg,
      bounds: HEADINGS,
      part: (heading) => ({ turn_to_heading_deg: heading }),
    },
    { ...bankOf(name, turn.bank_deg), short: "at", part: (bank) => ({ bank_deg: bank }) },
  ];
}
