/** Keeps the ND's range fitting while none is selected: as often as numbers are read. */

import { effect, untracked } from "@preact/signals";
import { areInSight, fittingRange, largestLegible, type Range, stepToward } from "./nd/range";
import type { Session } from "./session";
import type { Picture } from "./store/picture";

type Followed = Pick<Session, "flight" | "shown" | "ndAuto" | "ndMode" | "ndRange">;

/** The leader, and two minutes of the path: the part of the picture that must not drop off. */
const NEAR = 5;
/** Flight time between two readings that follow on each other [s], and in seconds of the viewer. */
const SLACK = 3;
const READINGS = 1.5;

export function followRange(
  { flight, shown, ndAuto, ndMode, ndRange }: Followed,
  now: () => number = () => performance.now(),
): void {
  let last = { key: "", t: Number.NEGATIVE_INFINITY };
  let stepped = Number.NEGATIVE_INFINITY;
  effect(() => {
    const mode = ndMode.value;
    const isAuto = ndAuto.value && mode !== "PLAN";
    if (!isAuto || shown.numbers.value.readAt === null) {
      last = { ...last, key: "" };
      return;
    }
    untracked(() => {
      const picture = shown.picture.value;
      const { pose, t, designated } = picture;
      const ghost = shown.ghost.value;
      const places = ghost === null ? picture.places : [...picture.places, ghost.pursuer];
      if (pose === null || places.length === 0) return;
      const key = `${flight.id.value} ${mode} ${designated}`;
      const passed = t - last.t;
      const isNext = passed >= 0 && passed <= SLACK + READINGS * flight.read.value.rate;
      const isNew = key !== last.key || !isNext;
      last = { key, t };
      const present = ndRange.value;
      const largest = largestNow(picture, mode);
      const fitting = Math.min(fittingRange(mode, pose, places, present), largest) as Range;
      const since = (now() - stepped) / 1000;
      const isUrgent = present > largest || !areInSight(mode, pose, places.slice(0, NEAR), present);
      const range = isNew ? fitting : stepToward(fitting, present, { since, isUrgent });
      if (range === present) return;
      stepped = now();
      ndRange.value = range;
    });
  });
}

/** While a turn is due or flown, the minimum round the leader can be told apart. */
function largestNow({ turns, started }: Picture, mode: "ROSE" | "ARC"): Range {
  const isTurning = turns.some(({ isRollIn, hasBegun }) => isRollIn || hasBegun);
  return isTurning ? largestLegible(mode, started?.min_separation_m ?? 0) : 320;
}
