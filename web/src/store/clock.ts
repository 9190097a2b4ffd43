/**
 * Flight time on the screen: follows the producer's time smoothly and never runs backward.
 *
 * Ticks arrive 20 times a second with jitter; taking each at its word would make the picture tremble.
 * Between ticks the clock runs at the tick's rate; each tick only pulls it a little toward what it says.
 */

/** Part of the error taken up at each tick: at 20 Hz about half a second to settle. */
const PULL = 0.1;
/** Beyond this error [wall s] the clock jumps instead of gliding: a pause, a sleep, a late joiner. */
const JUMP = 0.5;

/** Flight time t [s] was `t` when the wall clock was `wall` [ms]; since then it runs at `rate`. */
export interface FlightClock {
  readonly wall: number;
  readonly t: number;
  readonly rate: number;
}

/** Flight time [s] at a wall-clock instant [ms]. */
export function readClock(clock: FlightClock, wall: number): number {
  return clock.t + (Math.max(0, wall - clock.wall) / 1000) * clock.rate;
}

/** The clock after a tick that says `t` [s] at rate `rate` (0 while paused or ended). */
export function setClock(
  clock: FlightClock | null,
  tick: { readonly t: number; readonly rate: number; readonly wall: number },
): FlightClock {
  const { t, rate, wall } = tick;
  if (clock === null) return { wall, t, rate };
  const shown = readClock(clock, wall);
  const error = t - shown;
  if (rate === 0 || Math.abs(error) > JUMP * Math.max(rate, clock.rate)) {
    return { wall, t, rate };
  }
  return { wall, t: shown + PULL * error, rate };
}
