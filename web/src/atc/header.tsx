/** The strip on top: skies as tabs, the time, the connection, and what concerns the whole page. */

import { Toggle } from "../toggle";
import type { Actions } from "./actions";
import { openTab, type Station } from "./station";
import { waitingIn } from "./urgency";
import { timeText } from "./words";

export function Header({ station, actions }: { station: Station; actions: Actions }) {
  const { sound, helpOpen, pairToolOpen, notice, busy } = station;
  const { value: sky } = station.store.sky;
  return (
    <header class="atc-top">
      <h1>
        <img src="./favicon.svg" alt="" width="26" height="26" />
        <span>relguide ATC</span>
      </h1>
      <Tabs station={station} />
      <Clock station={station} />
      <div class="atc-tools">
        <Toggle on={pairToolOpen}>Pair tool</Toggle>
        <button type="button" class="quiet" disabled={busy.value !== ""} onClick={actions.demo}>
          Demo: five requests
        </button>
        <button type="button" class="quiet" onClick={actions.save}>
          Save
        </button>
        <label class="atc-open">
          <span>Open</span>
          <input
            type="file"
            class="visually-hidden"
            accept=".jsonl"
            onChange={({ currentTarget }) => {
              const [file] = currentTarget.files ?? [];
              if (file !== undefined) void actions.openFile(file);
              currentTarget.value = "";
            }}
          />
        </label>
        <Toggle on={sound}>Sound {sound.value ? "on" : "off"}</Toggle>
        <Toggle on={helpOpen} opens>
          Keys
        </Toggle>
        <a href={sky.id === "" ? "./" : `./?flight=${sky.id}`}>Cockpit</a>
      </div>
      <p class="atc-notice" role="status">
        {busy.value || notice.value}
      </p>
    </header>
  );
}

function Tabs({ station }: { station: Station }) {
  const { skies, tab } = station.store;
  const ids = skies.value.map(({ id }) => id);
  const move = (event: KeyboardEvent) => {
    const way = event.key === "ArrowRight" ? 1 : event.key === "ArrowLeft" ? -1 : 0;
    const next = ids[(ids.indexOf(tab.value) + way + ids.length) % Math.max(1, ids.length)];
    if (way === 0 || next === undefined) return;
    openTab(station, next);
    const list = event.currentTarget as HTMLElement;
    requestAnimationFrame(() => list.querySelector<HTMLElement>("[aria-selected=true]")?.focus());
  };
  if (ids.length === 0) return <p class="atc-tabs">No sky yet</p>;
  return (
    <div class="atc-tabs" role="tablist" aria-label="Skies" onKeyDown={move}>
      {skies.value.map((sky) => {
        const waiting = waitingIn(sky);
        return (
          <button
            key={sky.id}
            type="button"
            role="tab"
            aria-selected={sky.id === tab.value}
            tabIndex={sky.id === tab.value ? 0 : -1}
            onClick={() => openTab(station, sky.id)}
          >
            {sky.title}
            {waiting > 0 && <b>{` ${waiting} waiting`}</b>}
          </button>
        );
      })}
    </div>
  );
}

const LINKS = { connecting: "Connecting", open: "Live", closed: "Connection lost" } as const;

function Clock({ station: { store, link, file } }: { station: Station }) {
  const { id, t } = store.sky.value;
  const state = file.value !== "" ? "Recorded" : store.instant.value !== null ? "Past" : "";
  return (
    <p class="atc-clock">
      <span class="time">{timeText(id, t)}</span>
      <span class="unit">{id === "" ? "UTC" : "flight"}</span>
      <span class={`link ${state === "" ? link.value : "past"}`}>{state || LINKS[link.value]}</span>
    </p>
  );
}
