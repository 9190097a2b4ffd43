/** The stick on the page: it shows what all inputs do, and a mouse or a finger moves it. */

import { useComputed, useSignal, useSignalEffect } from "@preact/signals";
import { useRef } from "preact/hooks";
import "./pad.css";
import { Panel } from "../parts";
import type { Actions, Session } from "../session";
import { formatBank } from "../units";
import type { HandFlying } from "./hand-flying";
import type { Measure } from "./latency";
import { type Deflection, sayStick } from "./stick";

/** Half the pad, and how far the stick goes on it. */
const HALF = 50;
const REACH = 40;
/** Those who listen are told where the stick is once it rests for so long [ms]. */
const RESTS = 400;

/** The stick while this page flies by hand. */
export function StickPad({ session, actions }: { session: Session; actions: Actions }) {
  const hands = session.hands.value;
  return hands === null ? null : <Stick hands={hands} actions={actions} />;
}

function Stick({ hands, actions }: { hands: HandFlying; actions: Actions }) {
  const wanted = hands.wanted.value;
  return (
    <Panel name="stick" title="Stick">
      <div class="stick-parts">
        <Pad hands={hands} />
        <div class="stick-side">
          <p class="hint">{hands.controller.value}</p>
          <p class="hint">{wanted === null ? "" : `To ${sayBank(wanted)}.`}</p>
          <fieldset class="choice">
            <legend class="visually-hidden">Bank in steps of 5°</legend>
            <button type="button" onClick={() => hands.step(-1)} aria-label="5° more to the left">
              −5°
            </button>
            <button type="button" onClick={() => hands.step(0)}>
              Level
            </button>
            <button type="button" onClick={() => hands.step(1)} aria-label="5° more to the right">
              +5°
            </button>
          </fieldset>
          <button type="button" onClick={() => actions.setAutopilot(true)}>
            Autopilot flies
          </button>
        </div>
      </div>
      <p class="stick-notice" role="alert">
        {hands.notice.value}
      </p>
      <Measured measure={hands.measure.value} />
      {hands.isSlow.value && (
        <p class="hint">The scene rests until you give back: drawn with it, the page was slow.</p>
      )}
      <Said hands={hands} />
    </Panel>
  );
}

/** The pad: right and left roll, back and forth pitch, as the stick itself goes. */
function Pad({ hands }: { hands: HandFlying }) {
  const pointer = useRef<number | null>(null);
  const place = useComputed(() => {
    const { roll, pitch } = hands.stick.value;
    return `transform: translate(${REACH * roll}px, ${REACH * pitch}px)`;
  });
  const letGo = (event: PointerEvent) => {
    if (event.pointerId !== pointer.current) return;
    pointer.current = null;
    hands.drag(null);
  };
  const drag = (event: PointerEvent & { currentTarget: Element }) => {
    if (event.pointerId === pointer.current) hands.drag(deflectionAt(event));
  };
  return (
    <svg
      class="stick-pad"
      viewBox={`${-HALF} ${-HALF} ${2 * HALF} ${2 * HALF}`}
      role="img"
      aria-label="Stick: drag it, or use the arrow keys"
      onPointerDown={(event) => {
        if (pointer.current !== null || event.button !== 0) return;
        event.preventDefault();
        pointer.current = event.pointerId;
        event.currentTarget.setPointerCapture(event.pointerId);
        drag(event);
      }}
      onPointerMove={drag}
      onPointerUp={letGo}
      onPointerCancel={letGo}
      onLostPointerCapture={letGo}
    >
      <rect class="stick-field" x={-REACH} y={-REACH} width={2 * REACH} height={2 * REACH} rx="6" />
      <path class="stick-middle" d={`M${-REACH} 0H${REACH}M0 ${-REACH}V${REACH}M-9-9H9V9H-9Z`} />
      <text x="0" y={-REACH - 2.5}>
        push
      </text>
      <text x="0" y={REACH + 8}>
        pull
      </text>
      <circle class="stick-knob" r="9" style={place} />
    </svg>
  );
}

/** How far a pointer deflects the stick: fully at the edge of the field, and beyond. */
function deflectionAt(event: PointerEvent & { currentTarget: Element }): Deflection {
  const { left, top, width, height } = event.currentTarget.getBoundingClientRect();
  const part = (at: number, size: number) =>
    Math.max(-1, Math.min(1, ((at / size - 0.5) * 2 * HALF) / REACH));
  return { roll: part(event.clientX - left, width), pitch: part(event.clientY - top, height) };
}

/** How often the page is drawn, and how old the stick is on the picture. */
function Measured({ measure }: { measure: Measure }) {
  const { framesPerSecond, half, most } = measure;
  const delay =
    half === null || most === null
      ? ""
      : `, ${Math.round(half)} ms to the picture (95 %: ${Math.round(most)}\xa0ms)`;
  return (
    <p
      class="hint stick-measure"
      title="From a move of the stick to the first frame with it, of the last 200; by this page"
    >
      {framesPerSecond} frames/s{delay}
    </p>
  );
}

/** For those who listen. */
function Said({ hands }: { hands: HandFlying }) {
  const said = useSignal("");
  useSignalEffect(() => {
    const now = sayStick(hands.stick.value);
    const timer = setTimeout(() => {
      said.value = now;
    }, RESTS);
    return () => clearTimeout(timer);
  });
  return (
    <p class="visually-hidden" role="status">
      {said}
    </p>
  );
}

function sayBank(bank: number): string {
  return bank === 0 ? "wings level" : `${formatBank(bank)} of bank`;
}
