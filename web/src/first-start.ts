/** What the server has yet to compile: asked for until it has all, then never again. */

import { type Signal, signal } from "@preact/signals";
import { type Readiness, readReadiness } from "./api";

/** Between two questions [ms]. */
const PERIOD = 1000;

/** The server's first start, as a signal: null when nothing is left to prepare, or nothing is known. */
export function followFirstStart(): Signal<Readiness | null> {
  const readiness = signal<Readiness | null>(null);
  async function ask(): Promise<void> {
    const answer = await readReadiness();
    const busy = answer !== null && (answer.status === "preparing" || answer.preparing !== null);
    readiness.value = busy ? answer : null;
    if (readiness.value !== null) setTimeout(() => void ask(), PERIOD);
  }
  void ask();
  return readiness;
}

/** "First start: preparing the limited search, 40 %"; empty when there is nothing to say. */
export function firstStartText(readiness: Readiness | null): string {
  const now = readiness?.preparing ?? null;
  if (now === null) return "";
  return `First start: preparing ${now.name}, ${Math.round(100 * now.share)} %`;
}
