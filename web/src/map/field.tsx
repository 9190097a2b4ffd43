/** One number to type: taken as soon as it is right; what is wrong is refused beside it, and changes nothing. */

import { useSignal } from "@preact/signals";
import { useEffect, useId, useRef } from "preact/hooks";

export interface FieldProps {
  readonly label: string;
  /** What stands before it; the label says it in full. */
  readonly short: string;
  readonly unit: string;
  readonly value: number;
  readonly decimals?: number;
  readonly step?: number;
  /** Where it may lie. */
  readonly bounds: readonly [number, number];
  /** What sets a bound, where that is another number: "MIN is no more than D". */
  readonly limit?: string;
  /** `hand` is the same for all that is typed before the field is left. */
  readonly change: (value: number, hand: unknown) => void;
}

const STEPS: Readonly<Record<string, number>> = {
  ArrowUp: 1,
  ArrowDown: -1,
  PageUp: 10,
  PageDown: -10,
};

export function Field(props: FieldProps) {
  const { label, short, unit, value, decimals = 0, step = 1, bounds, change } = props;
  const [least, most] = bounds;
  const typed = useSignal<string | null>(null);
  const refused = useSignal("");
  const hand = useRef<unknown>({});
  const input = useRef<HTMLInputElement>(null);
  /** What stood there before it was typed over: what is refused leaves that, and no part of itself. */
  const before = useRef(value);
  const id = useId();
  const take = (text: string) => {
    refused.value = faultOf(text, { ...props, value: before.current });
    change(refused.value === "" ? numberOf(text) : before.current, hand.current);
  };
  // A refusal says which number stays: it goes once another has come from elsewhere.
  useEffect(() => {
    if (value !== before.current && document.activeElement !== input.current) refused.value = "";
  }, [value, refused]);
  return (
    <>
      <label class="field">
        <span aria-hidden="true">{short}</span>
        <input
          ref={input}
          type="text"
          role="spinbutton"
          autocomplete="off"
          {...(least >= 0 && { inputMode: "decimal" as const })}
          aria-label={[label, unit, `${least} to ${most}`].filter((part) => part !== "").join(", ")}
          aria-invalid={refused.value !== ""}
          aria-describedby={id}
          aria-valuenow={value}
          aria-valuemin={least}
          aria-valuemax={most}
          title={label}
          value={typed.value ?? textOf(value, decimals)}
          onFocus={() => {
            hand.current = {};
          }}
          onInput={(event) => {
            if (typed.value === null) before.current = value;
            typed.value = event.currentTarget.value;
            take(event.currentTarget.value);
          }}
          onBlur={() => {
            typed.value = null;
          }}
          onKeyDown={(event) => {
            const by = STEPS[event.key];
            if (event.key === "Escape") typed.value = null;
            if (by === undefined || event.ctrlKey || event.altKey || event.metaKey) return;
            event.preventDefault();
            typed.value = null;
            before.current = value;
            take((value + by * step).toFixed(decimals));
          }}
        />
        <span class="unit" aria-hidden="true">
          {unit}
        </span>
      </label>
      <p id={id} class="refusal" role="status" hidden={refused.value === ""}>
        {refused.value}
      </p>
    </>
  );
}

/** A number with the decimals of its field, and one more where it has one. */
function textOf(value: number, decimals: number): string {
  const rounded = value.toFixed(decimals);
  const finer = Number(value.toFixed(decimals + 1));
  return Number(rounded) === finer ? rounded : String(finer);
}

function numberOf(text: string): number {
  return text.trim() === "" ? Number.NaN : Number(text.trim().replace(",", "."));
}

/** What was found and what is right, in a sentence; empty if all is well. */
export function faultOf(
  text: string,
  { unit, value, decimals = 0, bounds: [least, most], limit }: FieldProps,
): string {
  const number = numberOf(text);
  const range = `${least} to ${say(String(most), unit)}`;
  const stays = `${say(textOf(value, decimals), unit)} stays.`;
  if (text.trim() === "") return `A number is missing: ${range} is right. ${stays}`;
  if (!Number.isFinite(number)) return `"${text.trim()}" is no number: ${range} is right. ${stays}`;
  if (number >= least && number <= most) return "";
  const why = limit === undefined ? "" : `, since ${limit}`;
  return `${say(text.trim(), unit)} is refused: ${range} is right${why}. ${stays}`;
}

function say(number: string, unit: string): string {
  return unit === "°" ? `${number}°` : `${number} ${unit}`;
}
