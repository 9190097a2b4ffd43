/** What is shown in every state: tables, so that a state without a look does not compile. */

import type { Colour } from "./colours";
import type { Age, Guidance, Pilot } from "./states";

/** What the picture shows of guidance. */
export interface GuidanceStyle {
  /** The path own ship flies, the one that is proposed or armed, or the plan it can no longer fly. */
  readonly path: "none" | "proposed" | "armed" | "committed" | "old_plan";
  /** Turn points, final track and time ticks belong to a plan that is shown. */
  readonly points: boolean;
  /** Their colour, and that of the join. */
  readonly pathColour: Colour;
  /** Nothing but the present track says where own ship goes: no path is shown, since solid is flown. */
  readonly trackLine: boolean;
  /** Whether the leader is designated: ringed, its route, its past and the minimum round it shown. */
  readonly designated: boolean;
  readonly slot: "none" | "open" | "crossed";
  readonly slotColour: Colour;
  /** Offset from the leader's route, beside the own ship. */
  readonly crossTrack: boolean;
  /** D, d and what else belongs to a leader that is to be joined. */
  readonly spacing: boolean;
  readonly lateral: { readonly now: string; readonly next: string };
  /** Who will command the speed, while the crew does. */
  readonly speedNext: string;
}

const NOTHING = {
  path: "none",
  points: false,
  pathColour: "plan",
  trackLine: true,
  designated: true,
  slot: "open",
  slotColour: "selected",
  crossTrack: false,
  spacing: true,
  lateral: { now: "HDG", next: "" },
  speedNext: "",
} as const satisfies GuidanceStyle;

const FLOWN = {
  ...NOTHING,
  path: "committed",
  trackLine: false,
  slotColour: "plan",
} as const satisfies GuidanceStyle;

export const GUIDANCE: Record<Guidance, GuidanceStyle> = {
  off: { ...NOTHING, designated: false, slot: "none", spacing: false },
  designated: NOTHING,
  proposed: {
    ...NOTHING,
    path: "proposed",
    points: true,
    pathColour: "proposed",
    trackLine: false,
  },
  armed: {
    ...NOTHING,
    path: "armed",
    points: true,
    trackLine: false,
    pathColour: "armed",
    lateral: { now: "HDG", next: "RG" },
  },
  converge: {
    ...FLOWN,
    points: true,
    lateral: { now: "RG CNV", next: "RG CAP" },
    speedNext: "RG SPD",
  },
  capture: {
    ...FLOWN,
    crossTrack: true,
    lateral: { now: "RG CAP", next: "RG TRK" },
  },
  follow: {
    ...FLOWN,
    crossTrack: true,
    lateral: { now: "RG TRK", next: "" },
  },
  escape: {
    ...FLOWN,
    slot: "crossed",
    slotColour: "caution",
    lateral: { now: "RG ESC", next: "RG" },
  },
  infeasible: { ...NOTHING, path: "old_plan", slot: "crossed", slotColour: "caution" },
  unable: {
    ...NOTHING,
    path: "old_plan",
    slot: "crossed",
    slotColour: "caution",
    lateral: { now: "HDG", next: "RG" },
  },
  data_lost: { ...NOTHING, slot: "none", spacing: false },
};

/** What the mode strip says of who flies: what is switched on, and whether it is the crew's turn. */
export const PILOT: Record<Pilot, { readonly now: string; readonly next: string }> = {
  autopilot: { now: "AP1", next: "" },
  both: { now: "AP1 FD", next: "" },
  director: { now: "FD", next: "YOU FLY" },
  hand: { now: "", next: "YOU FLY" },
};

/** What the age of the data leaves of the picture. */
export interface AgeStyle {
  /** Own ship, leader and all that stands on the map. */
  readonly map: boolean;
  /** The plan, the slot and the numbers that go with them. */
  readonly guidance: boolean;
  /** The numbers beside the picture. */
  readonly numbers: boolean;
  readonly ring: "whole" | "broken";
  readonly colour: Colour;
  readonly showsAge: boolean;
  readonly flag: "" | "LDR DATA" | "LDR DATA LOST" | "MAP NOT AVAIL";
}

const NOT_AVAILABLE = {
  map: false,
  guidance: false,
  numbers: false,
  ring: "broken",
  colour: "alert",
  showsAge: false,
  flag: "MAP NOT AVAIL",
} as const satisfies AgeStyle;

export const AGE: Record<Age, AgeStyle> = {
  fresh: {
    map: true,
    guidance: true,
    numbers: true,
    ring: "whole",
    colour: "leader",
    showsAge: false,
    flag: "",
  },
  coasting: {
    map: true,
    guidance: true,
    numbers: true,
    ring: "broken",
    colour: "leader",
    showsAge: true,
    flag: "",
  },
  old: {
    map: true,
    guidance: true,
    numbers: false,
    ring: "broken",
    colour: "caution",
    showsAge: true,
    flag: "LDR DATA",
  },
  dropped: {
    map: true,
    guidance: false,
    numbers: false,
    ring: "broken",
    colour: "caution",
    showsAge: true,
    flag: "LDR DATA LOST",
  },
  gone: NOT_AVAILABLE,
  none: NOT_AVAILABLE,
};
