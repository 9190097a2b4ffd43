/** The keys, and what shapes and lines mean. */

import { useEffect, useRef } from "preact/hooks";
import type { Station } from "./station";

const KEYS = [
  ["↓ ↑", "the next request, the one before"],
  ["N", "the next that waits for an answer"],
  ["A", "accept"],
  ["U, 1–7", "unable, and why"],
  ["S", "stand by"],
  ["P", "probe: validate again, nothing is kept"],
  ["[ ]", "the pair before, the next pair of CARD"],
  ["R", "pair tool: range, bearing, closest approach"],
  ["X", "silence all alerts for 60 s"],
  ["+ −", "zoom; Shift and arrows move the map"],
  ["F", "show all aircraft"],
  ["L", "live: the newest instant"],
  ["Esc", "close what is open; then choose nothing"],
  ["?", "these keys"],
] as const;

const SHAPES = [
  ["yellow, dashes", "asked for"],
  ["cyan, dashes", "accepted"],
  ["green, solid", "flown"],
  ["amber, long and short dashes", "deviates"],
  ["white, dash and dot", "what a leader is expected to fly"],
  ["dotted vector", "its intent is not known"],
  ["■ ▲ ●", "too close for certain, possibly, not at all"],
] as const;

export function Help({ station }: { station: Station }) {
  const dialog = useRef<HTMLDivElement>(null);
  const { helpOpen, letterKeys } = station;
  useEffect(() => {
    const before = document.activeElement;
    dialog.current?.focus();
    return () => {
      if (before instanceof HTMLElement) before.focus();
    };
  }, []);
  return (
    <div class="atc-help" role="dialog" aria-labelledby="help" tabIndex={-1} ref={dialog}>
      <h2 id="help">Keys</h2>
      <dl>
        {KEYS.map(([key, what]) => (
          <div key={key}>
            <dt>
              <kbd>{key}</kbd>
            </dt>
            <dd>{what}</dd>
          </div>
        ))}
      </dl>
      <label>
        <input
          type="checkbox"
          checked={letterKeys.value}
          onChange={() => {
            letterKeys.value = !letterKeys.value;
          }}
        />
        Letters are keys
      </label>
      <h2>Lines and shapes</h2>
      <dl>
        {SHAPES.map(([look, what]) => (
          <div key={look}>
            <dt>{look}</dt>
            <dd>{what}</dd>
          </div>
        ))}
      </dl>
      <button
        type="button"
        onClick={() => {
          helpOpen.value = false;
        }}
      >
        Close
      </button>
    </div>
  );
}
