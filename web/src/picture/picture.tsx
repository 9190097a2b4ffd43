/**
 * The picture of a flight at one instant as one SVG: a function of documents, time and view, without a
 * browser. The same bytes from any engine at whole seconds, where the flight has a sample.
 */

import { signal } from "@preact/signals";
import { renderToString } from "preact-render-to-string";
import { fittingRange } from "../nd/range";
import { createView, type DisplayMode, RANGES } from "../nd/view";
import type { Shown } from "../store/shown";
import { formatClock } from "../units";
import { Drawing } from "./drawing";
import { inlined } from "./inlined";
import { COLOURS, type PaletteName } from "./palettes";
import { documentsOf, shownAt } from "./still";

/** The range of the map [NM], or the smallest that has all in sight that belongs there. */
type RangeChoice = (typeof RANGES)[number] | "auto";

export interface PictureView {
  readonly mode: Exclude<DisplayMode, "PLAN">;
  readonly range: RangeChoice;
  readonly palette: PaletteName;
}

export interface PictureOptions extends PictureView {
  /** Flight time [s]. */
  readonly t: number;
  /** What stands under the line with title, time and version, as the command that makes the picture. */
  readonly caption: string;
}

/** The picture of a flight that is given as text, a document a line or a JSON array. */
export function pictureOf(text: string, { t, caption, ...view }: PictureOptions): string {
  return pictureOfShown(shownAt(documentsOf(text), t), view, caption);
}

/** The picture of what is shown of a flight. */
export function pictureOfShown(
  shown: Shown,
  { mode, range, palette }: PictureView,
  caption: string,
): string {
  const { t, started, pose, places, plan } = shown.picture.value;
  const miles =
    range !== "auto"
      ? range
      : pose === null || places.length === 0
        ? 40
        : fittingRange(mode, pose, places, RANGES[0]);
  const view = createView(shown, signal<DisplayMode>(mode), signal<number>(miles));
  const title = `${started?.title ?? "Flight"} · ${formatClock(t)} · ${mode} ${miles} NM`;
  const drawn = renderToString(
    <Drawing
      shown={shown}
      view={view}
      palette={COLOURS[palette]}
      caption={[`${title} · relguide ${__VERSION__}`, ...caption.split("\n").filter(Boolean)]}
      description={shown.words.value}
    />,
  );
  const age = plan === null ? 0 : t - plan.t_s;
  const fading = Math.round(100 * (1 - 0.85 * Math.min(1, age / FADE))) / 100;
  // a string of one piece: some engines hand out strings that are still to be put together
  return [inlined(drawn, COLOURS[palette], fading)].join("");
}

/** How long the plan before takes to fade, as nd.css has it [s]. */
const FADE = 3;
