/** Why the controller is unable: the reason that automation has comes first in the focus. */

import { useEffect, useRef } from "preact/hooks";
import type { ClearanceCard } from "../wire";
import { answer, reasonOf, refusalOf } from "./answering";
import type { Station } from "./station";
import { REASONS } from "./words";

export function UnableReasons({ station, card }: { station: Station; card: ClearanceCard }) {
  const list = useRef<HTMLFieldSetElement>(null);
  useEffect(() => {
    const before = document.activeElement;
    const fitting =
      list.current?.querySelector<HTMLElement>(`[data-reason="${reasonOf(card)}"]`) ??
      list.current?.querySelector<HTMLElement>("button");
    fitting?.focus();
    return () => {
      if (before instanceof HTMLElement && before.isConnected) before.focus();
    };
  }, []);
  const why = refusalOf(station, card, "unable");
  return (
    <fieldset class="atc-reasons" ref={list}>
      <legend>UNABLE, because …</legend>
      {REASONS.map(({ code, text }, k) => (
        <button
          key={code}
          type="button"
          data-reason={code}
          disabled={why !== ""}
          onClick={() => void answer(station, "unable", code)}
        >
          <kbd>{k + 1}</kbd>
          {text}
          {code === reasonOf(card) && <span class="unit">as automation finds</span>}
        </button>
      ))}
    </fieldset>
  );
}
