/** Alerts that are heard: a chime every few seconds, until the last one is over or silenced. */

import { effect } from "@preact/signals";
import { createChime } from "../sound";
import type { Station } from "./station";

/** Between two chimes [ms]. */
const AGAIN = 4000;

export function soundDeviations({ sound, loud }: Station): void {
  const chime = createChime(sound);
  let timer: ReturnType<typeof setInterval> | null = null;
  effect(() => {
    const isLoud = loud.value.length > 0;
    if (isLoud === (timer !== null)) return;
    if (timer !== null) clearInterval(timer);
    timer = null;
    if (!isLoud) return;
    chime("warning");
    timer = setInterval(() => chime("warning"), AGAIN);
  });
}
