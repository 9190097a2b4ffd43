/** The keys, and how to read the picture. */

import { type Signal, useSignal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { LessonList } from "../lessons/list";
import { set, useFocus } from "../parts";
import type { Actions, Session } from "../session";
import { ELEMENTS } from "../words";
import "./dialogs.css";

const KEYS: readonly (readonly [string, string])[] = [
  ["Space", "play or pause"],
  ["←  →", "a second back or on; with Shift ten seconds"],
  [",  .", "to the event before or after"],
  ["[  ]", "where a loop begins, and where it ends"],
  ["L", "back to the newest"],
  ["D", "designate the leader, or click on it"],
  ["C", "confirm the proposed path"],
  ["E", "engage what was accepted"],
  ["X", "disconnect, or cancel"],
  ["H", "take control, to fly by hand, or give it back to the autopilot"],
  ["B", "the flight director's bars"],
  ["←  →  ↑  ↓", "by hand: the stick; ↓ pulls"],
  ["4  6  5", "by hand: bank 5° more to the left or right, or wings level; as Shift with ←  →"],
  ["R  A  P", "ROSE, ARC, or PLAN: the map"],
  ["F", "on the map: all into sight; arrow keys move it, or what has the focus"],
  ["+  −", "range outward or inward"],
  ["T", "the numbers of the next of the other aircraft, or of none"],
  ["G", "the flight over time: charts in the place of the scene"],
  ["I", "the instrument that own ship is flown by: the PFD"],
  ["M", "maximise or restore the 3D scene"],
  ["?", "open or close this help"],
  ["Esc", "close, restore"],
];

interface Props {
  readonly session: Session;
  readonly actions: Actions;
}

export function Help(props: Props) {
  return props.session.helpOpen.value ? <HelpText {...props} /> : null;
}

function HelpText(props: Props) {
  const { helpOpen, letterKeys, distinctColours, captions, scenarios } = props.session;
  const missing = scenarios.value.filter(({ available }) => !available);
  const dialog = useFocus();
  return (
    <div
      id="help"
      class="help"
      role="dialog"
      aria-labelledby="help-title"
      tabIndex={-1}
      ref={dialog}
    >
      <LessonList {...props} />
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
      <h2>On the display</h2>
      <p>Point at anything on it, or tap it, to read what it is.</p>
      <ul class="legend">
        {ELEMENTS.map(({ name, title, what, key }) => (
          <li key={name} class={key}>
            <b>{title}</b> {what}
          </li>
        ))}
      </ul>
      <p>
        A path is named by its pieces: S straight, L and R a turn to the left or right, B along the
        minimum round the leader. SRSR is straight, right, straight, right.
      </p>
      {missing.map(({ name, title, message }) => (
        <p key={name}>
          <b>{title}</b> is not available. {message}
        </p>
      ))}
      <Switch text="Single letters are keys" choice={letterKeys} />
      <Switch text="Colours that anybody can tell apart" choice={distinctColours} />
      <Switch text="Captions for a first minute" choice={captions} />
      <p>
        Headings are true, in degrees; a dial takes digits, arrow keys or the wheel, Enter sends.
        The address of this page names the flight: all who open it see the same.
      </p>
      <p>
        <GuideLink />
        <a href="docs">the service's interface</a> · version {__VERSION__}
      </p>
      <button type="button" onClick={set(helpOpen, false)}>
        Close
      </button>
    </div>
  );
}

/** The guide, where the service has one: it says so with the page. */
function GuideLink() {
  const isThere = useSignal(false);
  useEffect(() => {
    const ask = async () => {
      const { headers } = await fetch("./", { method: "HEAD" });
      isThere.value = headers.get("link")?.includes('rel="help"') ?? false;
    };
    ask().catch(() => undefined); // no answer, no link
  }, [isThere]);
  return (
    isThere.value && (
      <>
        <a href="guide/">The guide</a> ·{" "}
      </>
    )
  );
}

function Switch({ text, choice }: { text: string; choice: Signal<boolean> }) {
  return (
    <label class="switch">
      <input
        type="checkbox"
        checked={choice.value}
        onChange={(event) => {
          choice.value = event.currentTarget.checked;
        }}
      />
      {text}
    </label>
  );
}
