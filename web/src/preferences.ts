/** What somebody chose once: kept by the browser, where it lets pages keep things. */

import { effect, type Signal } from "@preact/signals";

/** Takes up what was chosen before, and keeps what is chosen from now on, under the key of a page. */
export function keepChoices(key: string, choices: Readonly<Record<string, Signal<boolean>>>): void {
  const kept = read(key);
  for (const [name, choice] of Object.entries(choices)) {
    const value = kept[name];
    if (typeof value === "boolean") choice.value = value;
  }
  effect(() => {
    const chosen = Object.entries(choices).map(([name, choice]) => [name, choice.value]);
    try {
      localStorage.setItem(key, JSON.stringify(Object.fromEntries(chosen)));
    } catch {
      // A browser that keeps nothing: the choice holds as long as the page.
    }
  });
}

function read(key: string): Record<string, unknown> {
  try {
    const kept: unknown = JSON.parse(localStorage.getItem(key) ?? "{}");
    return typeof kept === "object" && kept !== null ? { ...kept } : {};
  } catch {
    return {};
  }
}
