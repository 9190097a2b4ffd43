/** How lines and symbols are drawn: patterns and widths by what they stand for. */

import type { Colour } from "../store/colours";
import type { Separation } from "../store/states";

export function ink(colour: Colour): string {
  return `var(--${colour})`;
}

export interface Line {
  readonly colour: Colour;
  /** Width [px]. */
  readonly width: number;
  /** Dashes and gaps [px]; "" is solid. The pattern carries the state, the colour repeats it. */
  readonly dash: string;
}

export const LINES = {
  active: { colour: "plan", width: 3, dash: "" },
  ideal: { colour: "plan", width: 1, dash: "" },
  proposed: { colour: "proposed", width: 3, dash: "15 12" },
  idealProposed: { colour: "proposed", width: 1.25, dash: "2 5" },
  armed: { colour: "armed", width: 3, dash: "15 12" },
  ghost: { colour: "superseded", width: 1.5, dash: "3 6" },
  rival: { colour: "value", width: 3, dash: "6 5" },
  fan: { colour: "superseded", width: 1.25, dash: "1 6" },
  tube: { colour: "plan", width: 1, dash: "2 6" },
  other: { colour: "superseded", width: 2, dash: "9 6" },
  beside: { colour: "superseded", width: 1.5, dash: "" },
  superseded: { colour: "superseded", width: 2.5, dash: "2 11" },
  final: { colour: "plan", width: 1.75, dash: "20 9" },
  declared: { colour: "leader", width: 2, dash: "12 4 2 4" },
  extrapolated: { colour: "leader", width: 2, dash: "2 6" },
  circle: { colour: "label", width: 2, dash: "7 5" },
  margin: { colour: "label", width: 1, dash: "3 5" },
  closest: { colour: "label", width: 1.75, dash: "4 3" },
  ghostRing: { colour: "label", width: 1.5, dash: "2 7" },
  hatch: { colour: "superseded", width: 1.25, dash: "" },
  cell: { colour: "label", width: 2, dash: "" },
  cellLater: { colour: "label", width: 1.25, dash: "9 7" },
  ring: { colour: "scale", width: 1.5, dash: "15 10" },
  tape: { colour: "scale", width: 2, dash: "" },
  trend: { colour: "label", width: 2, dash: "" },
  track: { colour: "value", width: 1.75, dash: "" },
  turn: { colour: "managed", width: 3, dash: "" },
  bug: { colour: "selected", width: 2.5, dash: "" },
  mark: { colour: "plan", width: 2.5, dash: "" },
  leaderMark: { colour: "leader", width: 2, dash: "" },
} as const satisfies Record<string, Line>;

/** The circle of least separation round the leader, and the leader inside it. */
interface SeparationLook {
  readonly colour: Colour;
  readonly width: number;
  readonly dash: string;
}

export const SEPARATION: Record<Separation, SeparationLook> = {
  kept: { colour: "label", width: 2, dash: LINES.circle.dash },
  predicted: { colour: "caution", width: 2.5, dash: LINES.circle.dash },
  lost: { colour: "alert", width: 3, dash: "" },
};
