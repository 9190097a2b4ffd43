/** Draws layers into a document and reads them back as text with short numbers. */

import { type Signal, signal } from "@preact/signals";
import { type ComponentType, h, render } from "preact";
import type { Flight } from "../../src/flight";
import type { LayerProps } from "../../src/nd/picture";
import { createView, type DisplayMode, type View } from "../../src/nd/view";

export interface Screen {
  readonly view: View;
  readonly mode: Signal<DisplayMode>;
  readonly range: Signal<number>;
}

export function screenOf(flight: Flight, mode: DisplayMode, range: number): Screen {
  const [modeSignal, rangeSignal] = [signal(mode), signal(range)];
  return {
    view: createView(flight, modeSignal, rangeSignal),
    mode: modeSignal,
    range: rangeSignal,
  };
}

/** Mounts something and returns its root; what changes later shows there. */
export function mount<P extends object>(component: ComponentType<P>, props: P): Element {
  const root = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  render(h(component, props), root);
  return root;
}

export function drawLayer(layer: ComponentType<LayerProps>, flight: Flight, view: View): string {
  return pretty(mount(layer, { flight, view }).innerHTML);
}

/** One element a line, numbers to three decimals. */
export function pretty(html: string): string {
  const short = html.replace(/-?\d+\.\d+/g, (number) => String(Number(Number(number).toFixed(3))));
  return `${short.replace(/></g, ">\n<")}\n`;
}
