/** What of the map is fetched when it is first shown: it asks the service and keeps the address then. */

import type { Session } from "../session";
import { followAddress } from "./address";
import { followMap } from "./asking";
import { followMode } from "./flying";

export { fly, layOut, mapFromFlight } from "./flying";

const open = new WeakSet<Session>();

/** Begins what goes on behind the map, once. */
export function openMap(session: Session): void {
  if (open.has(session)) return;
  open.add(session);
  followMap(session);
  followAddress(session);
  followMode(session);
}
