/** The situation in numbers: all that the map shows, to be typed. */

import { Choice, Panel } from "../parts";
import { KT, NM } from "../units";
import type { IntentPiece } from "../wire";
import { type Editor, edit } from "./editor";
import { Field } from "./field";
import { BOUNDS, MOST_PIECES, type Situation } from "./situation";

const MILES = 539;
const DISTANCE = Math.floor(BOUNDS.distance[1] / NM);

type Who = "pursuer" | "leader";
const NAMES = { pursuer: "Own ship", leader: "Leader" } as const;

export function SituationForm({ map }: { map: Editor }) {
  const { slot_distance_m, min_separation_m, wind } = map.reading.situation.value;
  const change = (part: Partial<Situation>) => edit(map, (now) => ({ ...now, ...part }));
  return (
    <Panel name="situation" title="Situation">
      <AircraftFields map={map} who="pursuer" />
      <AircraftFields map={map} who="leader" />
      <IntentFields map={map} />
      <fieldset class="fields">
        <legend>Spacing and wind</legend>
        <Field
          label="Slot distance D"
          short="D"
          unit="NM"
          decimals={1}
          step={0.1}
          value={slot_distance_m / NM}
          least={Number((min_separation_m / NM).toFixed(1))}
          most={DISTANCE}
          change={(miles) => change({ slot_distance_m: miles * NM })}
        />
        <Field
          label="Minimum separation"
          short="MIN"
          unit="NM"
          decimals={1}
          step={0.1}
          value={min_separation_m / NM}
          least={0}
          most={Number((slot_distance_m / NM).toFixed(1))}
          change={(miles) => change({ min_separation_m: Math.min(miles * NM, slot_distance_m) })}
        />
        <Field
          label="Wind from"
          short="From"
          unit="°"
          value={wind.from_deg}
          least={0}
          most={360}
          change={(from) => change({ wind: { ...wind, from_deg: from } })}
        />
        <Field
          label="Wind speed"
          short="Wind"
          unit="kt"
          value={wind.speed_mps / KT}
          least={0}
          most={Math.floor(BOUNDS.wind[1] / KT)}
          change={(knots) => change({ wind: { ...wind, speed_mps: knots * KT } })}
        />
      </fieldset>
    </Panel>
  );
}

function AircraftFields({ map, who }: { map: Editor; who: Who }) {
  const aircraft = map.reading.situation.value[who];
  const name = NAMES[who];
  const change = (part: Partial<Situation[Who]>) =>
    edit(map, (now) => ({ ...now, [who]: { ...now[who], ...part } }));
  return (
    <fieldset class="fields">
      <legend class={`key-${who}`}>{name}</legend>
      <Field
        label={`${name}: east of the origin`}
        short="East"
        unit="NM"
        decimals={1}
        step={0.5}
        value={aircraft.x_m / NM}
        least={-MILES}
        most={MILES}
        change={(miles) => change({ x_m: miles * NM })}
      />
      <Field
        label={`${name}: north of the origin`}
        short="North"
        unit="NM"
        decimals={1}
        step={0.5}
        value={aircraft.y_m / NM}
        least={-MILES}
        most={MILES}
        change={(miles) => change({ y_m: miles * NM })}
      />
      <Field
        label={`${name}: heading`}
        short="HDG"
        unit="°"
        value={aircraft.heading_deg}
        least={0}
        most={360}
        change={(heading) => change({ heading_deg: heading })}
      />
      <Field
        label={`${name}: true airspeed`}
        short="TAS"
        unit="kt"
        value={aircraft.tas_mps / KT}
        least={Math.round(BOUNDS.tas[0] / KT)}
        most={Math.round(BOUNDS.tas[1] / KT)}
        change={(knots) => change({ tas_mps: knots * KT })}
      />
      {"max_bank_deg" in aircraft && (
        <Field
          label={`${name}: bank`}
          short="Bank"
          unit="°"
          value={aircraft.max_bank_deg}
          least={BOUNDS.bank[0]}
          most={BOUNDS.bank[1]}
          change={(bank) => change({ max_bank_deg: bank })}
        />
      )}
    </fieldset>
  );
}

/** What the leader has declared, piece by piece; what follows the last is flown for ever. */
function IntentFields({ map }: { map: Editor }) {
  const { intent, heading_deg } = map.reading.situation.value.leader;
  const change = (next: (pieces: IntentPiece[]) => IntentPiece[]) =>
    edit(map, (now) => ({ ...now, leader: { ...now.leader, intent: next(now.leader.intent) } }));
  const turn: IntentPiece = {
    turn_to_heading_deg: (Math.round(heading_deg) + 45) % 360,
    direction: "right",
    bank_deg: 20,
  };
  return (
    <fieldset class="fields intent">
      <legend class="key-leader">Leader declares</legend>
      {intent.length === 0 && <p class="hint">Nothing: its intent is not known.</p>}
      <ol>
        {intent.map((piece, i) => (
          <li key={i}>
            <Piece
              piece={piece}
              number={i + 1}
              change={(next) => change((pieces) => pieces.with(i, next))}
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
          disabled={intent.length >= MOST_PIECES}
          onClick={() => change((pieces) => [...pieces, { straight_s: 120 }])}
        >
          + Straight
        </button>
        <button
          type="button"
          class="grow"
          disabled={intent.length >= MOST_PIECES}
          onClick={() => change((pieces) => [...pieces, turn])}
        >
          + Turn
        </button>
      </div>
    </fieldset>
  );
}

function Piece(props: {
  piece: IntentPiece;
  number: number;
  change: (piece: IntentPiece) => void;
}) {
  const { piece, number, change } = props;
  const name = `Piece ${number}`;
  if ("straight_s" in piece)
    return (
      <Field
        label={`${name}: straight for`}
        short="Straight"
        unit="s"
        step={10}
        value={piece.straight_s}
        least={0}
        most={BOUNDS.piece[1]}
        change={(seconds) => change({ straight_s: seconds })}
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
      <Field
        label={`${name}: to heading`}
        short="to"
        unit="°"
        value={piece.turn_to_heading_deg}
        least={0}
        most={360}
        change={(heading) => change({ ...piece, turn_to_heading_deg: heading })}
      />
      <Field
        label={`${name}: bank`}
        short="at"
        unit="°"
        value={piece.bank_deg}
        least={BOUNDS.bank[0]}
        most={BOUNDS.bank[1]}
        change={(bank) => change({ ...piece, bank_deg: bank })}
      />
    </>
  );
}
