/** Who flies, and what the crew selects for guidance: bank, speed, D and d_min; each with its unit. */

import { useSignal } from "@preact/signals";
import { type Actions, isFlying, type Session } from "../session";
import { formatMiles, KT, NM } from "../units";
import "./crew.css";

interface Props {
  readonly session: Session;
  readonly actions: Actions;
}

/** Autopilot, flight director, and the instrument to fly by: each is on or off. */
export function Switches({ session, actions }: Props) {
  const { sample } = session.shown.numbers.value;
  const { autopilot = true, director = false } = sample ?? {};
  const absent = sample === null || !isFlying(session);
  const isOpen = session.pfdOpen.value || !autopilot;
  return (
    <fieldset class="switches">
      <legend class="visually-hidden">Who flies</legend>
      <button
        type="button"
        aria-pressed={autopilot}
        aria-label="Autopilot"
        title={
          autopilot
            ? "The autopilot flies: press to fly by hand"
            : "You fly: press to give control back"
        }
        disabled={absent}
        onClick={() => actions.setAutopilot(!autopilot)}
      >
        AP
      </button>
      <button
        type="button"
        aria-pressed={director}
        aria-label="Flight director"
        title="Bars that show what guidance commands"
        disabled={absent}
        onClick={() => actions.setDirector(!director)}
      >
        FD
      </button>
      <button
        type="button"
        aria-pressed={isOpen}
        title="The instrument to fly by (I); it is shown while you fly"
        disabled={!autopilot}
        onClick={() => {
          session.pfdOpen.value = !isOpen;
        }}
      >
        PFD
      </button>
    </fieldset>
  );
}

/** What the crew selects, in one line; opened, a field for each. */
export function Selections({ session, actions }: Props) {
  const { assignment, started } = session.flight.read.value;
  const { commandedSpeed, sample } = session.shown.numbers.value;
  const refusal = useSignal("");
  if (started === null) return null;
  const bank = assignment?.max_bank_deg ?? started.pursuer.max_bank_deg;
  const isSelected = (assignment?.selected_tas_mps.length ?? 0) > 0;
  const [slot, least] = [started.slot_distance_m, started.min_separation_m].map((each) =>
    formatMiles(each),
  );
  const absent = sample === null || !isFlying(session);
  const common = { refusal, absent };
  return (
    <details class="selections">
      <summary>
        <span>Bank</span> <b>{Math.round(bank)}°</b> <span>TAS</span>{" "}
        <b>{isSelected ? `${commandedSpeed} kt` : "RG"}</b> <span>D</span> <b>{slot}</b>{" "}
        <span>MIN</span> <b>{least} NM</b>
      </summary>
      <div class="selection-fields">
        <Field
          {...common}
          label="Bank"
          unit="°"
          value={String(Math.round(bank))}
          commit={actions.selectBank}
        />
        <Field
          {...common}
          label="TAS"
          unit="kt"
          value={commandedSpeed}
          commit={(knots) => actions.selectSpeed(knots * KT)}
        />
        <Field
          {...common}
          label="D"
          unit="NM"
          value={slot ?? ""}
          commit={(miles) => actions.setSpacing({ slot_distance_m: miles * NM })}
        />
        <Field
          {...common}
          label="MIN"
          unit="NM"
          value={least ?? ""}
          commit={(miles) => actions.setSpacing({ min_separation_m: miles * NM })}
        />
        <button
          type="button"
          disabled={absent || !isSelected}
          onClick={() => actions.selectSpeed(null)}
        >
          Speed by guidance
        </button>
      </div>
      <p class="refusal" role="alert">
        {refusal}
      </p>
    </details>
  );
}

const NAMES: Readonly<Record<string, string>> = {
  Bank: "Bank that plans turn with, in degrees",
  TAS: "Own true airspeed, in knots",
  D: "Distance to keep behind the leader, in nautical miles",
  MIN: "Minimum separation, in nautical miles",
};

/** A number with its unit: Enter, or leaving it, commands what was typed. */
function Field(props: {
  label: string;
  unit: string;
  value: string;
  absent: boolean;
  refusal: { value: string };
  commit: (value: number) => void;
}) {
  const { label, unit, value, absent, refusal, commit } = props;
  const typed = useSignal<string | null>(null);
  const take = () => {
    const text = typed.value;
    typed.value = null;
    refusal.value = "";
    if (text === null || text.trim() === value) return;
    const number = Number(text.replace(",", "."));
    if (text.trim() !== "" && number > 0) commit(number);
    else
      refusal.value = `“${text}” is no ${label} above 0: type a number such as ${value}, in ${unit}.`;
  };
  return (
    <label class="selection">
      <span>{label}</span>
      <input
        type="text"
        inputMode="decimal"
        aria-label={NAMES[label] ?? label}
        disabled={absent}
        value={typed.value ?? value}
        onInput={(event) => {
          typed.value = event.currentTarget.value;
        }}
        onKeyDown={({ key }) => {
          if (key === "Enter") take();
          if (key === "Escape") typed.value = null;
        }}
        onBlur={take}
      />
      <span class="unit">{unit}</span>
    </label>
  );
}
