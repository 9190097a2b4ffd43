/** Keeps the situation of the map in the page's address, and lays out what is there already. */

import { effect } from "@preact/signals";
import type { Session } from "../session";
import { clearAddress, writeAddress } from "./link";
import type { Situation } from "./situation";

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
      history.replaceState(null, "", addressOf(isShown ? situation : null));
    }, REST);
  });
}

/** This page with a situation on its map, or without the map. */
function addressOf(situation: Situation | null): URL {
  const address = new URL(location.href);
  clearAddress(address);
  address.searchParams.delete("plan");
  if (situation !== null) {
    address.searchParams.set("plan", "");
    writeAddress(address, situation);
  }
  return address;
}

/** Leaves the map behind as it is: the browser's Back leads to it, and not away from the page. */
export function rememberMap(situation: Situation): void {
  history.replaceState(null, "", addressOf(situation));
  history.pushState(null, "", addressOf(null));
}
