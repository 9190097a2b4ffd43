/** While the crew flies by hand: listens to keys, the pad and a controller, and sends the stick. */

import { effect, type ReadonlySignal, signal } from "@preact/signals";
import { isTaken } from "../keyboard";
import type { Session } from "../session";
import { speedOf } from "../store/flight";
import { pairSample } from "../store/pair";
import type { Upstream } from "../wire";
import { createController } from "./controller";
import { createFrames, SOONEST } from "./frames";
import { createLatency, type Measure } from "./latency";
import { nextStep, toward } from "./steps";
import { type Deflection, isNeutral, keyed, NEUTRAL, together } from "./stick";

/** Which way each key moves the stick: right and pulled are positive. */
const ROLLS: Readonly<Record<string, number>> = { ArrowLeft: -1, ArrowRight: 1 };
const PITCHES: Readonly<Record<string, number>> = { ArrowUp: -1, ArrowDown: 1 };
/** Single keys for steps of bank, where the number pad has its arrows; 5 is wings level. */
const STEPS: Readonly<Record<string, number>> = { "4": -1, "5": 0, "6": 1 };
/** What is measured is said anew so often [ms]. */
const SAID_EVERY = 1000;
/** So few frames a second, said twice in a row, are too few to fly by. */
const TOO_FEW = 40;
/** After a longer frame the stick goes on as if it had been so long [ms]. */
const LONGEST_FRAME = 100;
/** What is said while keys go elsewhere, and once they come here again. */
const AWAY = "Stick neutral: this page does not have the keys. Click here to fly on.";
const BACK = "The stick was neutral while you were away. You have control.";

export interface HandFlying {
  /** Where the stick is by all inputs together. */
  readonly stick: ReadonlySignal<Deflection>;
  /** The bank that steps lead to [deg]; null for none. */
  readonly wanted: ReadonlySignal<number | null>;
  /** The name of the controller, or what to do to have one. */
  readonly controller: ReadonlySignal<string>;
  /** Why an input does not fly now, and how it does again; empty once the stick is moved. */
  readonly notice: ReadonlySignal<string>;
  readonly measure: ReadonlySignal<Measure>;
  /** Whether this machine draws too few frames with the scene beside the stick. */
  readonly isSlow: ReadonlySignal<boolean>;
  /** Deflects the stick by the pad; null lets go of it. */
  drag(stick: Deflection | null): void;
  /** Banks 5° more to the right (1) or left (−1), or levels the wings (0). */
  step(way: number): void;
  /** Stops listening. */
  end(): void;
}

/** Begins to fly by hand, sending by `send`. */
export function flyByHand(session: Session, send: (frame: Upstream) => void): HandFlying {
  const { flight } = session;
  const frames = createFrames();
  const latency = createLatency();
  const stick = signal(NEUTRAL);
  const wanted = signal<number | null>(null);
  const device = createController();
  const controller = signal("");
  const notice = signal("");
  const measure = signal(latency.measure());
  const isSlow = signal(false);
  const held = new Set<string>();
  const listening = new AbortController();
  const { signal: until } = listening;
  let byKeys = NEUTRAL;
  let byPad = NEUTRAL;
  let byController = NEUTRAL;
  let before = performance.now();
  let saidAt = before;

  /** Whether the flight on the screen is the one that is flown, now. */
  function isFlown(): boolean {
    return flight.source.value.kind === "live" && speedOf(flight) > 0;
  }

  /** Own bank as it was last heard of [deg]. */
  function bankNow(): number | null {
    const { started } = flight.moment.value;
    const sample = flight.heard.value?.tick.documents.findLast(({ kind }) => kind === "sample");
    if (started === null || sample?.kind !== "sample") return null;
    return pairSample(sample, started)?.pursuer.bank_deg ?? null;
  }

  function way(ways: Readonly<Record<string, number>>): number {
    return [...held].reduce((sum, key) => sum + (ways[key] ?? 0), 0);
  }

  function springKeys(dt: number): void {
    byKeys = {
      roll: keyed(byKeys.roll, way(ROLLS), dt),
      pitch: keyed(byKeys.pitch, way(PITCHES), dt),
    };
  }

  function move(now: number): void {
    const byHand = together([byKeys, byPad, byController]);
    if (byHand.roll !== 0) wanted.value = null;
    if (!isNeutral(byHand) || wanted.value !== null) notice.value = "";
    const bank = wanted.value === null ? null : bankNow();
    const bySteps =
      wanted.value === null || bank === null
        ? NEUTRAL
        : { roll: toward(wanted.value, bank, speedOf(flight)), pitch: 0 };
    stick.value = isFlown() ? together([byHand, bySteps]) : NEUTRAL;
    latency.moved(stick.value, now);
    const due = frames.due(stick.value, now);
    if (due === null) return;
    latency.sent();
    send({ kind: "stick", ...stick.value });
  }

  /** Lets go of all that a hand held here. */
  function letGo(): void {
    held.clear();
    byKeys = byPad = byController = NEUTRAL;
    wanted.value = null;
    notice.value = AWAY;
    if (!isHere()) device.leave();
    move(performance.now());
    setTimeout(() => move(performance.now()), SOONEST); // a page out of sight has no frames
  }

  function comeBack(): void {
    if (isHere() && notice.value === AWAY) notice.value = BACK;
  }

  function readControllers(): void {
    if (!isHere()) {
      device.leave();
      byController = NEUTRAL;
      return;
    }
    const read = device.read(navigator.getGamepads?.());
    byController = read.stick;
    controller.value = read.hint;
    notice.value = read.notice ?? notice.value;
  }

  function frame(now: number): void {
    if (until.aborted) return;
    requestAnimationFrame(frame);
    latency.frame(now);
    springKeys(Math.min(LONGEST_FRAME, now - before));
    before = now;
    readControllers();
    move(now);
    if (now - saidAt < SAID_EVERY) return;
    saidAt = now;
    const { framesPerSecond: earlier } = measure.value;
    measure.value = latency.measure();
    const fastest = Math.max(earlier, measure.value.framesPerSecond);
    if (earlier > 0 && fastest < TOO_FEW) isSlow.value = true;
  }

  function step(way: number): void {
    wanted.value = way === 0 ? 0 : nextStep(wanted.value ?? bankNow() ?? 0, way);
    byKeys = { ...byKeys, roll: 0 }; // a key that springs back still holds nothing
    move(performance.now());
  }

  function onKey(event: KeyboardEvent): void {
    const { key, shiftKey, repeat, timeStamp } = event;
    const isArrow = key in ROLLS || key in PITCHES;
    const steps = STEPS[key] ?? (shiftKey ? ROLLS[key] : undefined);
    if ((!isArrow && steps === undefined) || !isFlown() || isElsewhere(event)) return;
    event.preventDefault();
    event.stopPropagation(); // the clock and the map have these keys otherwise
    if (repeat) return;
    if (steps !== undefined) {
      step(steps);
      return;
    }
    held.add(key);
    springKeys(0);
    move(timeStamp);
  }

  const options = { capture: true, signal: until } as const;
  addEventListener("keydown", onKey, options);
  addEventListener("keyup", ({ key }) => held.delete(key), options);
  addEventListener("blur", letGo, { signal: until });
  addEventListener("focus", comeBack, { signal: until });
  document.addEventListener("visibilitychange", () => (document.hidden ? letGo() : comeBack()), {
    signal: until,
  });
  requestAnimationFrame(frame);
  const stopHearing = effect(() => {
    const tick = flight.heard.value?.tick;
    if (tick === undefined || !latency.heard(tick)) return;
    // The picture is drawn in the next frame; what follows it comes when that is done.
    requestAnimationFrame(() => setTimeout(() => latency.drawn(performance.now())));
  });

  return {
    stick,
    wanted,
    controller,
    notice,
    measure,
    isSlow,
    drag(deflection) {
      byPad = deflection ?? NEUTRAL;
      move(performance.now());
    },
    step,
    end() {
      listening.abort();
      stopHearing();
      stick.value = NEUTRAL;
    },
  };
}

/** Whether the page is in sight, and what is pressed comes to it or to the scene in it. */
function isHere(): boolean {
  return !document.hidden && document.hasFocus();
}

/** Whether a key belongs to a field that is typed in, or to a dialog that is open. */
function isElsewhere(event: KeyboardEvent): boolean {
  const { target } = event;
  return isTaken(event) || (target instanceof Element && target.closest("[role=dialog]") !== null);
}
