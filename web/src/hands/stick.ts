/** The stick: how each input deflects it, and how they are one. Pure functions; times in wall ms. */

/** Parts of full deflection, −1 … 1: right and pulled are positive. */
export interface Deflection {
  readonly roll: number;
  readonly pitch: number;
}

export const NEUTRAL: Deflection = { roll: 0, pitch: 0 };

/** A key deflects the stick so far at once, fully after so long, and lets go of it within so long [ms]. */
const AT_ONCE = 0.2;
const FULL_AFTER = 400;
const SPRINGS_BACK = 300;
/** A controller at rest says so little, and is gentle near its middle: the share of the cube. */
const DEAD_ZONE = 0.08;
const EXPO = 0.35;
/** Deflections are sent in hundredths. */
const HUNDREDTHS = 100;

/** One axis of the stick `dt` ms later, while a key holds it one way, the other, or not (0). */
export function keyed(before: number, way: number, dt: number): number {
  if (way !== 0)
    return way * Math.min(1, Math.max(way * before, AT_ONCE) + (dt * (1 - AT_ONCE)) / FULL_AFTER);
  return Math.sign(before) * Math.max(0, Math.abs(before) - dt / SPRINGS_BACK);
}

/** What an axis of a controller means. */
export function shaped(raw: number): number {
  const beyond = Math.min(1, Math.max(0, (Math.abs(raw) - DEAD_ZONE) / (1 - DEAD_ZONE)));
  return Math.sign(raw) * ((1 - EXPO) * beyond + EXPO * beyond ** 3);
}

/** On each axis the input that deflects the stick most has it, in hundredths. */
export function together(inputs: readonly Deflection[]): Deflection {
  const most = (axis: keyof Deflection) => {
    const far = inputs
      .map((each) => each[axis])
      .reduce((a, b) => (Math.abs(b) > Math.abs(a) ? b : a), 0);
    return Math.round(HUNDREDTHS * Math.max(-1, Math.min(1, far))) / HUNDREDTHS || 0; // no −0
  };
  return { roll: most("roll"), pitch: most("pitch") };
}

export function isNeutral({ roll, pitch }: Deflection): boolean {
  return roll === 0 && pitch === 0;
}

export function isSame(a: Deflection, b: Deflection): boolean {
  return a.roll === b.roll && a.pitch === b.pitch;
}

/** For those who listen: "Stick 40 % right, 10 % pulled", to the next tenth. */
export function sayStick({ roll, pitch }: Deflection): string {
  const part = (deflection: number, [less, more]: readonly [string, string]) => {
    const tenths = Math.round(10 * Math.abs(deflection));
    return tenths === 0 ? [] : [`${10 * tenths} % ${deflection < 0 ? less : more}`];
  };
  const said = [...part(roll, ["left", "right"]), ...part(pitch, ["pushed", "pulled"])];
  return said.length === 0 ? "Stick neutral" : `Stick ${said.join(", ")}`;
}
