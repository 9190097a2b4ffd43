/** Alerts that are heard: a chime for a caution, and for a warning one a second until it is over. */

import { effect, type ReadonlySignal } from "@preact/signals";
import type { Session } from "./session";
import type { Notice } from "./store/notices";

/** Between two chimes of a warning [ms]. */
const AGAIN = 1000;
/** Pitch of a caution and of a warning [Hz], length [s] and loudness. */
const PITCH = { caution: 660, warning: 990 } as const;
const LENGTH = 0.35;
const LOUDNESS = 0.15;

/** How a level is sounded, where `isOn`; browsers allow it after the first click or key. */
export function createChime(isOn: ReadonlySignal<boolean>): (level: keyof typeof PITCH) => void {
  let context: AudioContext | null = null;
  const wake = () => {
    context ??= new AudioContext();
    void context.resume();
  };
  addEventListener("pointerdown", wake, { once: true });
  addEventListener("keydown", wake, { once: true });
  return (level) => {
    if (context === null || !isOn.value) return;
    const [tone, volume] = [context.createOscillator(), context.createGain()];
    tone.frequency.value = PITCH[level];
    volume.gain.setValueAtTime(LOUDNESS, context.currentTime);
    volume.gain.exponentialRampToValueAtTime(0.001, context.currentTime + LENGTH);
    tone.connect(volume).connect(context.destination);
    tone.start();
    tone.stop(context.currentTime + LENGTH);
  };
}

/** Sounds what a session's picture says. */
export function soundAlerts(session: Session): void {
  const chime = createChime(session.sound);
  let heard = "";
  let timer: ReturnType<typeof setInterval> | null = null;
  effect(() => {
    const urgent = urgentNotice(session.shown.picture.value.notices);
    const key = urgent === null ? "" : `${urgent.level} ${kindOf(urgent.text)}`;
    if (key === heard) return;
    heard = key;
    if (timer !== null) clearInterval(timer);
    timer = null;
    if (urgent === null) return;
    const { level } = urgent;
    chime(level);
    if (level === "warning") timer = setInterval(() => chime(level), AGAIN);
  });
}

type Urgent = Notice & { readonly level: keyof typeof PITCH };

/** The most urgent notice, if it is to be heard. */
export function urgentNotice(notices: readonly Notice[]): Urgent | null {
  return notices.find((each): each is Urgent => each.level in PITCH) ?? null;
}

/** A notice without its numbers: one that counts down is still the same. */
export function kindOf(text: string): string {
  return text.replace(/\d+/g, "");
}
