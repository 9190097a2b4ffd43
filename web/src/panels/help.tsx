/** The keys, and how to read the picture. */

import type { Session } from "../session";

const KEYS: readonly (readonly [string, string])[] = [
  ["Space", "play or pause"],
  ["D", "designate the leader, or click on it"],
  ["C", "confirm the proposed path"],
  ["E", "engage what was accepted"],
  ["X", "disconnect, or cancel"],
  ["R  A", "ROSE or ARC"],
  ["+  −", "range outward or inward"],
  ["M", "maximise or restore the 3D scene"],
  ["?", "open or close this help"],
  ["Esc", "close, restore"],
];

const LINES: readonly (readonly [string, string])[] = [
  ["key-plan", "solid: the path being flown"],
  ["key-proposed", "dashed: a proposed path; cyan once accepted"],
  ["key-leader", "dash-dot: the leader's declared route"],
  ["key-dotted", "dotted: no intent, straight ahead assumed"],
  ["key-slot", "pennant: the slot, D behind the leader"],
  ["key-min", "circle: the minimum separation"],
];

export function Help(props: { session: Session }) {
  const { helpOpen, letterKeys } = props.session;
  if (!helpOpen.value) return null;
  return (
    <aside id="help" class="help" aria-labelledby="help-title">
      <h2 id="help-title">Keys</h2>
      <dl>
        {KEYS.map(([keys, what]) => (
          <div key={keys}>
            <dt>
              {keys.split("  ").map((key) => (
                <kbd key={key}>{key}</kbd>
              ))}
            </dt>
            <dd>{what}</dd>
          </div>
        ))}
      </dl>
      <h2>Lines</h2>
      <ul class="legend">
        {LINES.map(([name, what]) => (
          <li key={name} class={name}>
            {what}
          </li>
        ))}
      </ul>
      <label class="switch">
        <input
          type="checkbox"
          checked={letterKeys.value}
          onChange={(event) => {
            letterKeys.value = event.currentTarget.checked;
          }}
        />
        Single letters are keys
      </label>
      <p>
        Headings are true, in degrees; a dial takes digits, arrow keys or the wheel, Enter sends.
        The address of this page names the flight: all who open it see the same.
      </p>
      <p>
        <a href="/docs">The service's interface</a> · version {__VERSION__}
      </p>
      <button
        type="button"
        onClick={() => {
          helpOpen.value = false;
        }}
      >
        Close
      </button>
    </aside>
  );
}
