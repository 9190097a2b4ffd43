/** Controllers: the first that has two axes is a stick. */

import { type Deflection, NEUTRAL, shaped } from "./stick";

/** What is said while none is there. */
const PRESS_A_BUTTON = "Controller: press a button on it.";
const NOT_SECURE = "A controller is read only over https, or on this machine.";

/** So near to its middle a stick has been let go, though it may not rest quite there. */
const LET_GO = 0.1;

/** What a controller does in one frame. */
interface Reading {
  readonly stick: Deflection;
  /** Its name, or what to do to have one. */
  readonly hint: string;
  /** What became of it; null for nothing new. */
  readonly notice: string | null;
}

export interface Controller {
  /** The page was left: what is held then does not fly when the page is back. */
  leave(): void;
  /** Of all that the browser has; undefined where it gives none away. */
  read(all: Parameters<typeof readController>[0] | undefined): Reading;
}

/** A controller in use: after it was unplugged or left, it flies again once its stick was let go. */
export function createController(): Controller {
  let name = "";
  let waits = false;
  return {
    leave() {
      waits ||= name !== "";
    },
    read(all) {
      const found = readController(all ?? []);
      if (found === null) {
        const hint = all === undefined ? NOT_SECURE : PRESS_A_BUTTON;
        if (name === "") return { stick: NEUTRAL, hint, notice: null };
        const notice = `${name} is gone: stick neutral. You have control, by keys and by this panel.`;
        name = "";
        waits = true;
        return { stick: NEUTRAL, hint, notice };
      }
      const { stick } = found;
      name = found.name;
      if (!waits) return { stick, hint: name, notice: null };
      waits = Math.max(Math.abs(stick.roll), Math.abs(stick.pitch)) > LET_GO;
      const notice = waits
        ? `${name} is back: let go of its stick once, then it flies.`
        : `${name} flies again.`;
      return { stick: NEUTRAL, hint: name, notice };
    },
  };
}

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
