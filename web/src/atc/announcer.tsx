/** What is said to those who listen: new requests and what became of answers, politely. */

import { effect, type Signal, signal } from "@preact/signals";
import type { ClearanceState } from "../wire";
import type { AtcStore } from "./store";
import { isWaiting } from "./urgency";
import { behindText, STATES, VERDICTS } from "./words";

/** Follows the newest states, and says each change once. */
export function followChanges(store: AtcStore): Signal<string> {
  const said = signal("");
  const known = new Map<string, ClearanceState>();
  let isFirst = true;
  effect(() => {
    const sentences: string[] = [];
    for (const { clearances } of store.skies.value)
      for (const card of clearances.values()) {
        const before = known.get(card.id);
        if (STATES[card.state].word === (before && STATES[before].word)) continue;
        known.set(card.id, card.state);
        const verdict = card.validation[0]?.verdict;
        const found = verdict === undefined ? "" : `, ${VERDICTS[verdict].word.toLowerCase()}`;
        sentences.push(
          isWaiting(card) && before === undefined
            ? `Request: ${card.aircraft} ${behindText(card).toLowerCase()}${found}.`
            : `${card.aircraft}: ${STATES[card.state].word.toLowerCase()}.`,
        );
      }
    // what stood there when the page was opened is read, not announced
    if (sentences.length > 0 && !isFirst) said.value = sentences.join(" ");
    if (known.size > 0 || store.skies.value.length > 0) isFirst = false;
  });
  return said;
}

export function Announcer({ said }: { said: Signal<string> }) {
  return (
    <p class="visually-hidden" role="status" aria-live="polite">
      {said.value}
    </p>
  );
}
