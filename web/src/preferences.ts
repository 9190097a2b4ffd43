/** What somebody chose once for all their flights: kept by the browser, where it lets pages keep things. */

import { effect } from "@preact/signals";
import type { Session } from "./session";

const KEY = "relguide";

type Preferences = Pick<
  Session,
  "letterKeys" | "sound" | "distinctColours" | "captions" | "pfdOpen"
>;
const NAMES = ["letterKeys", "sound", "distinctColours", "captions", "pfdOpen"] as const;

/** Takes up what was chosen before, keeps what is chosen from now on, and shows it. */
export function keepPreferences(session: Preferences): void {
  const kept = read();
  for (const name of NAMES) {
    const value = kept[name];
    if (typeof value === "boolean") session[name].value = value;
  }
  effect(() => {
    const chosen = Object.fromEntries(NAMES.map((name) => [name, session[name].value]));
    document.documentElement.dataset.palette = session.distinctColours.value ? "distinct" : "usual";
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
