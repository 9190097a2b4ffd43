/** One number to type: taken as it is typed, shown as it stands when it is left. */

import { useSignal } from "@preact/signals";

export function Field(props: {
  label: string;
  /** What stands before it; the label says it in full. */
  short: string;
  unit: string;
  value: number;
  decimals?: number;
  step?: number;
  least: number;
  most: number;
  change: (value: number) => void;
}) {
  const { label, short, unit, value, decimals = 0, step = 1, least, most, change } = props;
  const typed = useSignal<string | null>(null);
  const shown = typed.value ?? value.toFixed(decimals);
  const number = Number(shown);
  const isRefused = shown === "" || !Number.isFinite(number) || number < least || number > most;
  return (
    <label class="field">
      <span aria-hidden="true">{short}</span>
      <input
        type="number"
        aria-label={`${label}, ${unit}, ${least} to ${most}`}
        aria-invalid={isRefused}
        title={isRefused ? `${label}: ${least} to ${most} ${unit}` : label}
        step={step}
        min={least}
        max={most}
        value={shown}
        onInput={(event) => {
          const text = event.currentTarget.value;
          typed.value = text;
          const next = Number(text);
          if (text !== "" && next >= least && next <= most) change(next);
        }}
        onBlur={() => {
          typed.value = null;
        }}
      />
      <span class="unit" aria-hidden="true">
        {unit}
      </span>
    </label>
  );
}
