/** Best times: kept by the browser alone, where it lets pages keep things; else as long as the page. */

import { type Signal, signal } from "@preact/signals";

const KEY = "relguide.lessons";
/** Of what is kept: another one is not read. */
const VERSION = 1;

/** How late one joined at best, against the autopilot [s], by scenario. */
export type Best = Readonly<Record<string, number>>;

export const best: Signal<Best> = signal(read());

/** Keeps a time if it is better; whether it was. */
export function note(scenario: string, late: number): boolean {
  const before = best.value[scenario];
  if (before !== undefined && before <= late) return false;
  keep({ ...best.value, [scenario]: late });
  return true;
}

export function clearBest(): void {
  keep({});
}

function keep(times: Best): void {
  best.value = times;
  try {
    if (Object.keys(times).length === 0) localStorage.removeItem(KEY);
    else localStorage.setItem(KEY, JSON.stringify({ version: VERSION, late_s: times }));
  } catch {
    // A browser that keeps nothing: the times hold as long as the page.
  }
}

function read(): Best {
  try {
    const kept: unknown = JSON.parse(localStorage.getItem(KEY) ?? "{}");
    if (typeof kept !== "object" || kept === null) return {};
    const { version, late_s } = kept as { version?: unknown; late_s?: unknown };
    if (version !== VERSION || typeof late_s !== "object" || late_s === null) return {};
    const times = Object.entries(late_s).filter(([, late]) => Number.isFinite(late));
    return Object.fromEntries(times) as Best;
  } catch {
    return {};
  }
}
