/** A selector for one number: typed, stepped by 1 or 10, with arrow keys or the wheel. */

import { useSignal } from "@preact/signals";

const STEPS = [-10, -1, 1, 10] as const;

export function Dial(props: {
  label: string;
  unit: string;
  value: number;
  digits: number;
  /** The number that is meant by one that was typed or stepped to: 400° is 040°. */
  correct: (value: number) => number;
  /** The largest number that there is. */
  most: number;
  change: (value: number) => void;
  /** Enter: what is selected is commanded, as it was typed. */
  commit: (value: number) => void;
}) {
  const { label, unit, value, digits, correct, most, change, commit } = props;
  const typed = useSignal<string | null>(null);
  const selected = correct(value);
  const shown = String(selected).padStart(digits, "0");
  const step = (by: number) => {
    typed.value = null;
    change(correct(selected + by));
  };
  const keys: Record<string, () => void> = {
    ArrowUp: () => step(1),
    ArrowDown: () => step(-1),
    PageUp: () => step(10),
    PageDown: () => step(-10),
    Enter: () => {
      typed.value = null;
      commit(value);
    },
    Escape: () => {
      typed.value = null;
    },
  };
  const button = (by: number) => (
    <button
      type="button"
      key={by}
      class="step"
      aria-label={`${label}: ${by > 0 ? "plus" : "minus"} ${Math.abs(by)}`}
      onClick={() => step(by)}
    >
      {by > 0 ? `+${by}` : `−${-by}`}
    </button>
  );
  return (
    <div class="dial">
      {STEPS.filter((by) => by < 0).map(button)}
      <span class="dial-window">
        <input
          type="text"
          inputMode="numeric"
          role="spinbutton"
          aria-label={label}
          aria-valuenow={selected}
          aria-valuemax={most}
          maxLength={3}
          size={3}
          value={typed.value ?? shown}
          onFocus={(event) => event.currentTarget.select()}
          onInput={(event) => {
            const digitsOnly = event.currentTarget.value.replace(/\D/g, "");
            typed.value = digitsOnly;
            if (digitsOnly !== "") change(Number(digitsOnly));
          }}
          onBlur={() => {
            typed.value = null;
          }}
          onKeyDown={(event) => {
            const act = keys[event.key];
            if (act === undefined) return;
            event.preventDefault();
            act();
          }}
          onWheel={(event) => {
            if (document.activeElement !== event.currentTarget) return;
            event.preventDefault();
            step(event.deltaY < 0 ? 1 : -1);
          }}
        />
        <span class="unit" aria-hidden="true">
          {unit}
        </span>
      </span>
      {STEPS.filter((by) => by > 0).map(button)}
    </div>
  );
}
