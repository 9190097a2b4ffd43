/**
 * `<relguide-nd>`: the navigation display as an element of any page, in a shadow tree of its own.
 *
 * Fed by the documents of a flight (`documents`, `t`) or by its stream (`live(url)`). Colours are the
 * page's, as the variables of tokens.css; the groups of the drawing are parts, named as their classes.
 * The file exports nothing, so that it can be a module and a plain script, which pages from a disk need.
 */

import { effect, signal, untracked } from "@preact/signals";
import { h, options, render } from "preact";
import { NavigationDisplay } from "../nd/nd";
import ndStyle from "../nd/nd.css?inline";
import { fittingRange } from "../nd/range";
import { RANGES } from "../nd/view";
import { COLOURS, type Palette } from "../picture/palettes";
import { documentsOf } from "../picture/still";
import { createFlightStore, READING_PERIOD } from "../store/flight";
import { createShown } from "../store/shown";
import { openStream, type Stream } from "../stream";
import type { Document } from "../wire";

/** What the service calls the stream for programs. */
const STREAM = "relguide-stream-2";
const MODES = ["ARC", "ROSE"] as const;
type Mode = (typeof MODES)[number];
type Range = (typeof RANGES)[number];

interface TimeChange {
  /** Flight time that is shown [s]. */
  readonly t: number;
}

interface Selection {
  /** The aircraft whose symbol was clicked. */
  readonly ident: string;
}

class RelguideNd extends HTMLElement {
  static readonly observedAttributes = ["mode", "range", "t"];

  static get version(): string {
    return __VERSION__;
  }

  readonly #store = createFlightStore();
  readonly #shown = createShown(this.#store.flight);
  readonly #mode = signal<Mode>("ARC");
  /** Selected [NM]; null for the one that fits. */
  readonly #selected = signal<Range | null>(null);
  readonly #range = signal<Range>(40);
  readonly #root = this.attachShadow({ mode: "open" });
  #documents: readonly Document[] = [];
  #t: number | null = null;
  #stream: Pick<Stream, "retry" | "close"> | null = null;
  #stops: (() => void)[] = [];

  /** The flight's documents, in order of time: objects, or the text of a recording. */
  get documents(): readonly Document[] {
    return this.#documents;
  }

  set documents(given: readonly Document[] | string) {
    this.#hangUp();
    this.#documents = typeof given === "string" ? documentsOf(given) : given;
    this.#store.load("", this.#documents, performance.now());
    if (this.#t !== null) this.#seek(this.#t);
  }

  /** Flight time that is shown [s]; held to the flight. */
  get t(): number {
    return this.#store.flight.moment.value.t;
  }

  set t(t: number) {
    if (!Number.isFinite(t)) throw new RangeError(`t must be a flight time in seconds, not ${t}.`);
    this.#t = t;
    if (this.#stream === null) this.#seek(t);
  }

  /** "ARC" looks ahead, "ROSE" all round. */
  get mode(): Mode {
    return this.#mode.value;
  }

  set mode(mode: Mode) {
    if (!MODES.includes(mode)) throw new RangeError(`mode must be ARC or ROSE, not ${mode}.`);
    this.#mode.value = mode;
  }

  /** Range of the map [NM], or "auto": the smallest with path, leader and slot in sight. */
  get range(): Range | "auto" {
    return this.#selected.value ?? "auto";
  }

  set range(range: Range | "auto") {
    if (range !== "auto" && !RANGES.includes(range))
      throw new RangeError(`range must be auto or one of ${RANGES.join(", ")} NM, not ${range}.`);
    this.#selected.value = range === "auto" ? null : range;
  }

  /** Shows a flight as it flies: `url` is its `stream_url`. Ends when documents are given, or the element goes. */
  live(url: string): void {
    this.#hangUp();
    let frame = 0;
    let drawn = Number.NEGATIVE_INFINITY;
    const draw = (wall: number) => {
      if (wall - drawn >= READING_PERIOD) {
        this.#store.advance(wall);
        drawn = wall;
      } else this.#store.glide(wall);
      frame = requestAnimationFrame(draw);
    };
    const stream = openStream(url, STREAM, {
      tick: (tick) => this.#store.receive(tick, performance.now()),
      link: (state) => this.#store.link(state),
      broken: () => {},
      refused: () => {},
    });
    frame = requestAnimationFrame(draw);
    this.#stream = {
      retry: stream.retry,
      close() {
        cancelAnimationFrame(frame);
        stream.close();
      },
    };
  }

  connectedCallback(): void {
    const style = document.createElement("style");
    style.textContent = STYLE;
    const glass = document.createElement("div");
    this.#root.replaceChildren(style, glass);
    const designate = () => this.#tell("select", { ident: this.#shown.picture.value.ident });
    const display = { shown: this.#shown, mode: this.#mode, range: this.#range, designate };
    render(h(NavigationDisplay, display), glass);
    let told = this.t;
    this.#stops = [
      effect(() => this.#fitRange()),
      effect(() => {
        const { t } = this.#store.flight.moment.value;
        if (t === told) return;
        told = t;
        untracked(() => this.#tell("timechange", { t }));
      }),
      () => render(null, glass),
    ];
  }

  disconnectedCallback(): void {
    this.#hangUp();
    for (const stop of this.#stops) stop();
    this.#stops = [];
  }

  attributeChangedCallback(name: string, _: string | null, value: string | null): void {
    if (name === "mode") this.mode = (value ?? "ARC") as Mode;
    else if (name === "t") this.t = Number(value ?? 0);
    else this.range = value === null || value === "auto" ? "auto" : (Number(value) as Range);
  }

  /** A recording's range follows from the instant alone; a live one stays as long as it nearly fits. */
  #fitRange(): void {
    const [mode, selected] = [this.#mode.value, this.#selected.value];
    const { pose, places } = this.#shown.picture.value;
    if (selected !== null) this.#range.value = selected;
    else if (pose !== null && places.length > 0) {
      const present = this.#stream === null ? RANGES[0] : this.#range.peek();
      this.#range.value = fittingRange(mode, pose, places, present);
    }
  }

  #seek(t: number): void {
    this.#store.seek(t, 0, performance.now());
  }

  #hangUp(): void {
    this.#stream?.close();
    this.#stream = null;
  }

  #tell(name: string, detail: TimeChange | Selection): void {
    this.dispatchEvent(new CustomEvent(name, { detail, bubbles: true, composed: true }));
  }
}

function variables(palette: Palette): string {
  return Object.entries(palette)
    .map(([name, colour]) => `--${name}:${colour};`)
    .join("");
}

const STYLE = `:host { display: block; aspect-ratio: 1; overflow: hidden; ${variables(COLOURS.dark)}
--font-instrument: B612, "Segoe UI", system-ui, "DejaVu Sans", sans-serif }
:host([palette="light"]) { ${variables(COLOURS.light)} }
:host([hidden]) { display: none }
div:first-of-type { height: 100% }
${ndStyle}`;

/** Each named group is a part, so that a page can style it: `relguide-nd::part(leader)`. */
const before = options.vnode;
options.vnode = (node) => {
  const props = node.props as { class?: unknown; part?: string };
  if (typeof node.type === "string" && typeof props.class === "string")
    props.part = props.class.replaceAll("nd-", "");
  before?.(node);
};

if (customElements.get("relguide-nd") === undefined)
  customElements.define("relguide-nd", RelguideNd);

declare global {
  interface HTMLElementTagNameMap {
    "relguide-nd": RelguideNd;
  }
}
