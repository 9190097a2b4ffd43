/** How everything looks in every state: tables, so that a state without a look does not compile. */

import type { Age, Guidance, Separation } from "./states";

/** The colours by meaning, as the tokens name them. */
export type Colour =
  | "scale"
  | "ownship"
  | "plan"
  | "selected"
  | "leader"
  | "leader-ring"
  | "managed"
  | "value"
  | "label"
  | "unit"
  | "caution"
  | "alert"
  | "superseded";

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
  superseded: { colour: "superseded", width: 2.5, dash: "2 11" },
  final: { colour: "plan", width: 1.75, dash: "20 9" },
  declared: { colour: "leader", width: 2, dash: "12 4 2 4" },
  extrapolated: { colour: "leader", width: 2, dash: "2 6" },
  circle: { colour: "label", width: 2, dash: "7 5" },
  closest: { colour: "label", width: 1.75, dash: "4 3" },
  ring: { colour: "scale", width: 1.5, dash: "15 10" },
  tape: { colour: "scale", width: 2, dash: "" },
  trend: { colour: "label", width: 2, dash: "" },
  track: { colour: "value", width: 1.75, dash: "" },
  turn: { colour: "managed", width: 3, dash: "" },
  mark: { colour: "plan", width: 2.5, dash: "" },
  leaderMark: { colour: "leader", width: 2, dash: "" },
} as const satisfies Record<string, Line>;

export type LineName = keyof typeof LINES;

/** What the picture shows of guidance. */
export interface GuidanceLook {
  /** The path own ship flies, or the plan that it can no longer fly. */
  readonly path: "none" | "committed" | "old_plan";
  /** Turn points, final track and time ticks belong to a plan being flown. */
  readonly points: boolean;
  /** Nothing but the present track says where own ship goes. */
  readonly trackLine: boolean;
  readonly slot: "open" | "crossed";
  readonly slotColour: Colour;
  /** Offset from the leader's route, beside the own ship. */
  readonly crossTrack: boolean;
  readonly lateral: { readonly now: string; readonly next: string };
  readonly speed: { readonly now: string; readonly next: string };
}

export const GUIDANCE: Record<Guidance, GuidanceLook> = {
  off: {
    path: "none",
    points: false,
    trackLine: true,
    slot: "open",
    slotColour: "selected",
    crossTrack: false,
    lateral: { now: "HDG", next: "RG" },
    speed: { now: "SPD", next: "" },
  },
  converge: {
    path: "committed",
    points: true,
    trackLine: false,
    slot: "open",
    slotColour: "plan",
    crossTrack: false,
    lateral: { now: "RG CNV", next: "RG CAP" },
    speed: { now: "SPD", next: "RG SPD" },
  },
  capture: {
    path: "committed",
    points: false,
    trackLine: false,
    slot: "open",
    slotColour: "plan",
    crossTrack: true,
    lateral: { now: "RG CAP", next: "RG TRK" },
    speed: { now: "SPD", next: "RG SPD" },
  },
  follow: {
    path: "committed",
    points: false,
    trackLine: false,
    slot: "open",
    slotColour: "plan",
    crossTrack: true,
    lateral: { now: "RG TRK", next: "" },
    speed: { now: "RG SPD", next: "" },
  },
  escape: {
    path: "committed",
    points: false,
    trackLine: false,
    slot: "crossed",
    slotColour: "caution",
    crossTrack: false,
    lateral: { now: "RG ESC", next: "" },
    speed: { now: "SPD", next: "" },
  },
  unable: {
    path: "old_plan",
    points: false,
    trackLine: true,
    slot: "crossed",
    slotColour: "caution",
    crossTrack: false,
    lateral: { now: "HDG", next: "" },
    speed: { now: "SPD", next: "" },
  },
};

/** What the age of the data leaves of the picture. */
export interface AgeLook {
  /** Own ship, leader and all that stands on the map. */
  readonly map: boolean;
  /** The plan, the slot and the numbers that go with them. */
  readonly guidance: boolean;
  readonly ring: "whole" | "broken";
  readonly colour: Colour;
  readonly showsAge: boolean;
  readonly flag: "" | "LDR DATA" | "LDR DATA LOST" | "MAP NOT AVAIL";
}

export const AGE: Record<Age, AgeLook> = {
  fresh: {
    map: true,
    guidance: true,
    ring: "whole",
    colour: "leader",
    showsAge: false,
    flag: "",
  },
  coasting: {
    map: true,
    guidance: true,
    ring: "broken",
    colour: "leader",
    showsAge: true,
    flag: "",
  },
  old: {
    map: true,
    guidance: true,
    ring: "broken",
    colour: "caution",
    showsAge: true,
    flag: "LDR DATA",
  },
  dropped: {
    map: true,
    guidance: false,
    ring: "broken",
    colour: "caution",
    showsAge: true,
    flag: "LDR DATA LOST",
  },
  gone: {
    map: false,
    guidance: false,
    ring: "broken",
    colour: "alert",
    showsAge: false,
    flag: "MAP NOT AVAIL",
  },
  none: {
    map: false,
    guidance: false,
    ring: "broken",
    colour: "alert",
    showsAge: false,
    flag: "MAP NOT AVAIL",
  },
};

/** The circle of least separation round the leader, and the leader inside it. */
export interface SeparationLook {
  readonly colour: Colour;
  readonly width: number;
  readonly dash: string;
}

export const SEPARATION: Record<Separation, SeparationLook> = {
  kept: { colour: "label", width: 2, dash: LINES.circle.dash },
  predicted: { colour: "caution", width: 2.5, dash: LINES.circle.dash },
  lost: { colour: "alert", width: 3, dash: "" },
};
