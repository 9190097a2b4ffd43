/** Steps of 5° of bank: one press each, and nothing has to be held. All angles in degrees. */

const STEP = 5;
/** A stick rolls no farther. */
const MOST = 45;
/** So near to a step counts as there: the next press goes on to the one after. */
const NEAR = 1;
/** Where the stick may be let go: the roll's own lag does the rest. */
const REACHED = 0.25;
/** So far away the stick is deflected fully, at the pace of life. */
const FULL = 6;

/** The next whole step from `bank`, to the right (+1) or left (−1). */
export function nextStep(bank: number, way: number): number {
  const steps = Math.floor((way * bank + NEAR) / STEP) + 1;
  return way * Math.min(MOST, STEP * steps) + 0; // no −0
}

/**
 * The stick that brings `bank` to `wanted`, −1 … 1; 0 once it is there.
 *
 * What is seen is old by a tenth of a second of the viewer, so a faster flight is led more gently.
 */
export function toward(wanted: number, bank: number, rate: number): number {
  const error = wanted - bank;
  if (Math.abs(error) < REACHED) return 0;
  return Math.max(-1, Math.min(1, error / (FULL * (0.7 + 0.3 * rate))));
}
