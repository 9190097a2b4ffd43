/** Keeps the ND's range fitting while none is selected: as often as numbers are read. */

import { effect, untracked } from "@preact/signals";
import { fittingRange } from "./nd/range";
import type { Session } from "./session";

export function followRange({ shown, ndAuto, ndMode, ndRange }: Session): void {
  effect(() => {
    const mode = ndMode.value;
    if (!ndAuto.value || mode === "PLAN" || shown.numbers.value.readAt === null) return;
    untracked(() => {
      const { pose, places: own } = shown.picture.value;
      const ghost = shown.ghost.value;
      const places = ghost === null ? own : [...own, ghost.pursuer];
      if (pose !== null && places.length > 0)
        ndRange.value = fittingRange(mode, pose, places, ndRange.value);
    });
  });
}
