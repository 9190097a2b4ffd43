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
  /** Where it may lie; without them it is an angle, and any number means one. */
  bounds?: readonly [number, number];
  change: (value: number) => void;
}) {
  const { label, short, unit, value, decimals = 0, step = 1, bounds, change } = props;
  const [least, most] = bounds ?? [Number.NEGATIVE_INFINITY, Number.POSITIVE_INFINITY];
  const range = bounds === undefined ? "" : `${least} to ${most}`;
  const isTaken = (text: string) =>
    text !== "" && Number.isFinite(Number(text)) && Number(text) >= least && Number(text) <= most;
  const typed = useSignal<string | null>(null);
  const shown = typed.value ?? value.toFixed(decimals);
  const isRefused = !isTaken(shown);
  return (
    <label class="field">
      <span aria-hidden="true">{short}</span>
      <input
        type="number"
        aria-label={[label, unit, range].filter((part) => part !== "").join(", ")}
        aria-invalid={isRefused}
        title={isRefused ? `${label}: ${range} ${unit}` : label}
        step={step}
        {...(bounds !== undefined && { min: least, max: most })}
        value={shown}
        onInput={(event) => {
          const text = event.currentTarget.value;
          typed.value = text;
          if (isTaken(text)) change(Number(text));
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
