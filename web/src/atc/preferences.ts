/** What a controller chose once: kept by the browser, where it lets pages keep things. */

import { effect } from "@preact/signals";
import type { Station } from "./station";

const KEY = "relguide-atc";
const NAMES = ["sound", "letterKeys", "all"] as const;

export function keepChoices(station: Pick<Station, (typeof NAMES)[number]>): void {
  const kept = read();
  for (const name of NAMES) {
    const value = kept[name];
    if (typeof value === "boolean") station[name].value = value;
  }
  effect(() => {
    const chosen = Object.fromEntries(NAMES.map((name) => [name, station[name].value]));
    try {
      localStorage.setItem(KEY, JSON.stringify(chosen));
    } catch {
      // A browser that keeps nothing: the choice holds as long as the page.
    }
  });
}

function read(): Record<string, unknown> {
  try {
    const kept: unknown = JSON.parse(localStorage.getItem(KEY) ?? "{}");
    return typeof kept === "object" && kept !== null ? { ...kept } : {};
  } catch {
    return {};
  }
}
