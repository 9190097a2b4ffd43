/** Keeps the situation of the map in the page's address, and lays out what is there already. */

import { effect } from "@preact/signals";
import type { Session } from "../session";
import { clearAddress, writeAddress } from "./situation";

/** Browsers take so many changes of the address and no more: it follows when the hand rests [ms]. */
const REST = 300;

export function followAddress({ ndMode, map }: Pick<Session, "ndMode" | "map">): void {
  let timer: ReturnType<typeof setTimeout> | undefined;
  let isThere = false;
  effect(() => {
    const situation = map.situation.value;
    const isShown = ndMode.value === "PLAN";
    clearTimeout(timer);
    if (!isShown && !isThere) return;
    timer = setTimeout(() => {
      isThere = isShown;
      const address = new URL(location.href);
      clearAddress(address);
      address.searchParams.delete("plan");
      if (isShown) {
        address.searchParams.set("plan", "");
        writeAddress(address, situation);
      }
      history.replaceState(null, "", address);
    }, REST);
  });
}
