/** Draws layers into a document and reads them back as text with short numbers. */

import { type Signal, signal } from "@preact/signals";
import { type ComponentType, h, render } from "preact";
import type { LayerProps } from "../../src/nd/layer";
import { NavigationDisplay } from "../../src/nd/nd";
import { createView, type DisplayMode, type View } from "../../src/nd/view";
import { createShown, type Shown } from "../../src/store/shown";
import type { Flight } from "../../src/store/types";

export interface Screen {
  readonly shown: Shown;
  readonly view: View;
  readonly mode: Signal<DisplayMode>;
  readonly range: Signal<number>;
}

export function screenOf(flight: Flight, mode: DisplayMode, range: number): Screen {
  const [modeSignal, rangeSignal] = [signal(mode), signal(range)];
  const shown = createShown(flight);
  return {
    shown,
    view: createView(shown, modeSignal, rangeSignal),
    mode: modeSignal,
    range: rangeSignal,
  };
}

/** Mounts a layer, or the whole display, and returns its root; what changes later shows there. */
export function mount<P extends object>(
  component: ComponentType<P>,
  props: P,
  into: "svg" | "div" = "svg",
): Element {
  const space = into === "svg" ? "http://www.w3.org/2000/svg" : "http://www.w3.org/1999/xhtml";
  const root = document.createElementNS(space, into);
  render(h(component, props), root);
  return root;
}

/** The whole display. */
export function mountDisplay(props: Parameters<typeof NavigationDisplay>[0]): Element {
  return mount(NavigationDisplay, props, "div");
}

export function drawLayer(layer: ComponentType<LayerProps>, { shown, view }: Screen): string {
  return pretty(mount(layer, { shown, view }).innerHTML);
}

/** One element a line, numbers to three decimals. */
export function pretty(html: string): string {
  const short = html.replace(/-?\d+\.\d+/g, (number) => String(Number(Number(number).toFixed(3))));
  return `${short.replace(/></g, ">\n<")}\n`;
}
