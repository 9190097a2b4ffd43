/** Small building blocks of the panels. */

import type { Signal } from "@preact/signals";
import type { ComponentChildren } from "preact";
import { useEffect, useRef } from "preact/hooks";
import type { Alarm, Numbers } from "./store/numbers";
import { Toggle } from "./toggle";

/** A titled panel. `name` is its place in the grid and its class. */
export function Panel(props: {
  name: string;
  title: string;
  aside?: ComponentChildren;
  /** Whether its body may scroll: then it can be reached by keyboard. */
  scrolls?: boolean;
  /** Set while the minimum separation is lost, or will be; words in it say the same. */
  alarm?: Alarm["level"];
  children: ComponentChildren;
}) {
  const id = `panel-${props.name}`;
  return (
    <section class={`panel ${props.name} ${props.alarm ?? ""}`} aria-labelledby={id}>
      <header>
        <h2 id={id}>{props.title}</h2>
        {props.aside}
      </header>
      <div class="panel-body" {...(props.scrolls === true && { tabIndex: 0 })}>
        {props.children}
      </div>
    </section>
  );
}

/** Over all else in a panel: the minimum separation is lost, or will be. */
export function AlarmLine({ numbers }: { numbers: Numbers }) {
  const { alarm, separation, minSeparation } = numbers;
  if (alarm === null) return null;
  return (
    <p class={`alarm ${alarm.level}`}>
      <b>{alarm.text}</b> {separation} NM, MIN {minSeparation}
    </p>
  );
}

/** One labelled number. `tone` says what it means; it is never the only sign of it. */
export function Reading(props: {
  label: string;
  value: string;
  unit?: string;
  note?: string;
  /** What the value means, in plain words. */
  title?: string;
  tone?: "value" | "caution" | "alert" | "plain";
}) {
  return (
    <div class="reading">
      <dt>{props.label}</dt>
      <dd>
        <span class={`figure ${props.tone ?? "value"}`} title={props.title}>
          {props.value}
        </span>
        {props.unit !== undefined && <span class="unit">{props.unit}</span>}
        {props.note !== undefined && <span class="note">{props.note}</span>}
      </dd>
    </div>
  );
}

/** One choice of a few, all visible: a row of buttons of which one is down. */
export function Choice<T extends string | number>(props: {
  label: string;
  /** What kind of choice it is, as a class. */
  kind?: string;
  options: readonly T[];
  chosen: T | null;
  /** What holds now without having been chosen. */
  current?: T;
  text?: (option: T) => string;
  choose: (option: T) => void;
}) {
  return (
    <fieldset class={`choice ${props.kind ?? ""}`}>
      <legend class="visually-hidden">{props.label}</legend>
      {props.options.map((option) => (
        <button
          type="button"
          key={option}
          aria-pressed={option === props.chosen}
          {...(option === props.current && option !== props.chosen && { "aria-current": true })}
          onClick={() => props.choose(option)}
        >
          {props.text?.(option) ?? option}
        </button>
      ))}
    </fieldset>
  );
}

const ICONS = {
  play: "M7 4.5v15l12.5-7.5z",
  pause: "M6.5 4.5h4v15h-4zM13.5 4.5h4v15h-4z",
  before: "M5 5h2.5v14H5zM19.500 5v14L9 12z",
  after: "M16.500 5H19v14h-2.500zM4.500 5v14L15 12z",
  restart: "M12 5V1.5L6.5 6 12 10.5V7a6 6 0 1 1-6 6H4a8 8 0 1 0 8-8z",
  maximise: "M4 4h7v2H7.4l4 4L10 11.4l-4-4V11H4zM20 20h-7v-2h3.6l-4-4L14 12.6l4 4V13h2z",
  restore: "M11 11H4V9h3.6l-4-4L5 3.6l4 4V4h2zM13 13h7v2h-3.6l4 4-1.4 1.4-4-4V20h-2z",
  left: "M9 4 3 10l6 6v-4h5a4 4 0 0 1 4 4v3h2.5v-3A6.5 6.5 0 0 0 14 9.5H9z",
  right: "M15 4l6 6-6 6v-4h-5a4 4 0 0 0-4 4v3H3.5v-3A6.5 6.5 0 0 1 10 9.5h5z",
  sound:
    "M3 9v6h4l5 5V4L7 9zM15 8.500a4.500 4.500 0 0 1 0 7zM15 3.500v2.200a7 7 0 0 1 0 12.600v2.200a9 9 0 0 0 0-17z",
  silence:
    "M3 9v6h4l5 5V4L7 9zM15 9.400 16.400 8 19 10.600 21.600 8 23 9.400 20.400 12 23 14.600 21.600 16 19 13.400 16.400 16 15 14.600 17.600 12z",
  records:
    "M12 4a8 8 0 1 1-7.700 5.800l1.900.600A6 6 0 1 0 8 7.600L10 9.500H4v-6l2.500 2.600A8 8 0 0 1 12 4zM11 8h2v4l3 2-1 1.700-4-2.700z",
  charts: "M3 3h2v16h16v2H3zM7 14l4-6 4 4 5-7 1.6 1.2L15.300 15 11.200 10.900 8.700 15.200z",
  help: "M12 2a10 10 0 1 0 0 20 10 10 0 0 0 0-20zm-1 15h2v2h-2zm1-12a4 4 0 0 0-4 4h2a2 2 0 1 1 3.4 1.4C12 11.8 11 12.6 11 15h2c0-1.6.7-2.200 1.800-3.300A4 4 0 0 0 12 5z",
} as const;

/** A decorative icon: the button that holds it carries the words. */
export function Icon(props: { name: keyof typeof ICONS }) {
  return (
    <svg class="icon" viewBox="0 0 24 24" aria-hidden="true" focusable="false">
      <path d={ICONS[props.name]} fill="currentColor" fill-rule="evenodd" />
    </svg>
  );
}

/** Lets what stands in the scene's place have the room of the panels, or gives it back. */
export function Maximise({ on }: { on: Signal<boolean> }) {
  return (
    <Toggle on={on}>
      <Icon name={on.value ? "restore" : "maximise"} />
      {on.value ? "Restore" : "Maximise"}
    </Toggle>
  );
}

/** A dialog that takes the focus when it is drawn, and gives it back when it is gone. */
export function useFocus(): { readonly current: HTMLDivElement | null } {
  const dialog = useRef<HTMLDivElement>(null);
  useEffect(() => {
    const before = document.activeElement;
    dialog.current?.focus();
    return () => {
      if (before instanceof HTMLElement) before.focus();
    };
  }, []);
  return dialog;
}

/** What a button does that only sets something. */
export function set<T>(signal: Signal<T>, value: T): () => void {
  return () => {
    signal.value = value;
  };
}
