/** The controller's working position: what is shown, chosen, sent and silenced. */

import { batch, computed, type ReadonlySignal, type Signal, signal } from "@preact/signals";
import type { Point } from "../nd/view";
import type {
  AlternativeManoeuvre,
  ClearanceAnswer,
  ClearanceCard,
  ClearanceState,
  ClearanceTrial,
} from "../wire";
import { type Alert, alertsOf, loudOf, type Silenced } from "./alerts";
import { createView, type MapView, showAll, toPoint } from "./map/view";
import { type AtcStore, createAtcStore } from "./store";
import type { Link } from "./stream";
import { isOver, requestsOf } from "./urgency";

/** An answer on its way, or refused. */
export interface Sent {
  readonly id: string;
  readonly answer: ClearanceAnswer["answer"];
  /** The state that the stream said before. */
  readonly before: ClearanceState;
  /** Why it was refused; empty while the stream has not confirmed it. */
  readonly refusal: string;
}

/** A clearance that was tried again: what came of it, or why it could not be. */
export interface Tried {
  readonly id: string;
  readonly trial: ClearanceTrial | null;
  readonly sentence: string;
}

export interface Station {
  readonly store: AtcStore;
  readonly view: MapView;
  readonly link: Signal<Link>;
  /** Why the service closed the stream for good, or anything else that the page must say. */
  readonly notice: Signal<string>;
  /** The file that is shown in place of the stream; empty: the stream. */
  readonly file: Signal<string>;
  /** Why this page may not answer a clearance, by its id, once the service has said so. */
  readonly forbidden: Signal<ReadonlyMap<string, string>>;
  readonly selected: Signal<string | null>;
  /** The other aircraft of the pair that is looked at; null: that with the least margin. */
  readonly pair: Signal<string | null>;
  /** The alternative that is drawn. */
  readonly alternative: Signal<AlternativeManoeuvre | null>;
  readonly unableOpen: Signal<boolean>;
  readonly sent: Signal<Sent | null>;
  readonly tried: Signal<Tried | null>;
  readonly pairToolOpen: Signal<boolean>;
  /** The idents that the pair tool has, two at most. */
  readonly picked: Signal<readonly string[]>;
  /** Whether the list keeps what is over. */
  readonly all: Signal<boolean>;
  readonly silenced: Signal<Silenced>;
  /** Wall clock, once a second [ms]. */
  readonly wall: Signal<number>;
  readonly sound: Signal<boolean>;
  readonly letterKeys: Signal<boolean>;
  readonly helpOpen: Signal<boolean>;
  readonly busy: Signal<string>;

  readonly requests: ReadonlySignal<readonly ClearanceCard[]>;
  readonly card: ReadonlySignal<ClearanceCard | null>;
  readonly alerts: ReadonlySignal<readonly Alert[]>;
  /** Alerts that are not silenced. */
  readonly loud: ReadonlySignal<readonly Alert[]>;
}

export function createStation(): Station {
  const store = createAtcStore();
  const selected = signal<string | null>(null);
  const all = signal(false);
  const silenced = signal<Silenced>(new Map());
  const wall = signal(Date.now());
  const alerts = computed(() => alertsOf(store.skies.value));
  return {
    store,
    view: createView(),
    link: signal<Link>("connecting"),
    notice: signal(""),
    file: signal(""),
    forbidden: signal<ReadonlyMap<string, string>>(new Map()),
    selected,
    pair: signal<string | null>(null),
    alternative: signal<AlternativeManoeuvre | null>(null),
    unableOpen: signal(false),
    sent: signal<Sent | null>(null),
    tried: signal<Tried | null>(null),
    pairToolOpen: signal(false),
    picked: signal<readonly string[]>([]),
    all,
    silenced,
    wall,
    sound: signal(false),
    letterKeys: signal(true),
    helpOpen: signal(false),
    busy: signal(""),
    requests: computed(() => requestsOf(store.sky.value, all.value)),
    card: computed(() => store.sky.value.clearances.get(selected.value ?? "") ?? null),
    alerts,
    loud: computed(() => loudOf(alerts.value, silenced.value, wall.value)),
  };
}

/** Chooses a clearance, and with it a pair; null chooses none. */
export function choose(station: Station, id: string | null, pair: string | null = null): void {
  batch(() => {
    if (id !== station.selected.value) {
      station.alternative.value = null;
      station.unableOpen.value = false;
    }
    station.selected.value = id;
    station.pair.value = pair;
  });
}

/** Chooses the next request of the list, or the one before. */
export function chooseNext(station: Station, way: 1 | -1): void {
  const ids = station.requests.value.map(({ id }) => id);
  const at = ids.indexOf(station.selected.value ?? "");
  const next = at < 0 ? (way > 0 ? 0 : ids.length - 1) : at + way;
  const id = ids[Math.min(ids.length - 1, Math.max(0, next))];
  if (id !== undefined) choose(station, id);
}

/** Opens the tab of a sky. */
export function openTab(station: Station, id: string): void {
  if (station.store.tab.value === id) return;
  batch(() => {
    station.store.tab.value = id;
    station.store.instant.value = null;
    station.picked.value = [];
    choose(station, null);
    showAll(station.view, station.store.sky.value.aircraft);
  });
}

/** A tap on the map reaches so far [px]. */
const REACH = 24;

/** What is tapped is chosen: for the pair tool where it is open, else its clearance. */
export function tapOn(station: Station, at: Point): void {
  const { store, view } = station;
  const away = (each: { x_m: number; y_m: number }) => {
    const point = toPoint(view, each);
    return Math.hypot(point.x - at.x, point.y - at.y);
  };
  const [found] = [...store.sky.value.aircraft].sort((a, b) => away(a) - away(b));
  if (found === undefined || away(found) > REACH) return;
  if (station.pairToolOpen.value) pick(station, found.ident);
  else chooseAircraft(station, found.ident);
}

function chooseAircraft(station: Station, ident: string): void {
  const open = [...station.store.sky.value.clearances.values()].filter((each) => !isOver(each));
  const found =
    open.find(({ aircraft }) => aircraft === ident) ??
    open.find(({ traffic_id }) => traffic_id === ident);
  if (found !== undefined) choose(station, found.id);
}

/** Adds an aircraft to the pair tool; a third one takes the place of the first. */
export function pick({ picked }: Station, ident: string): void {
  const others = picked.value.filter((each) => each !== ident);
  picked.value = others.length < picked.value.length ? others : [...others, ident].slice(-2);
}

/** Silences an alert for a minute. */
export function silence({ silenced, wall }: Station, key: string, length: number): void {
  silenced.value = new Map(silenced.value).set(key, wall.value + length);
}
