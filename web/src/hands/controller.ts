/** Controllers: the first that has two axes is a stick. */

import { type Deflection, shaped } from "./stick";

/** What is said while none is there. */
export const PRESS_A_BUTTON = "Controller: press a button on it.";
export const NOT_SECURE = "A controller is read only over https, or on this machine.";

/** How far a controller's stick is deflected: pulled back is nose up; null if there is none. */
export function readController(
  all: readonly (Pick<Gamepad, "axes" | "connected" | "id"> | null)[],
): { readonly name: string; readonly stick: Deflection } | null {
  for (const each of all) {
    const [roll, pitch] = each?.axes ?? [];
    if (each?.connected !== true || roll === undefined || pitch === undefined) continue;
    return { name: nameOf(each.id), stick: { roll: shaped(roll), pitch: shaped(pitch) } };
  }
  return null;
}

/** Its name without the numbers that browsers add in brackets. */
function nameOf(id: string): string {
  return id.replace(/\s*\(.*$/, "").trim() || "Controller";
}
