/** What is shown in every state: tables, so that a state without a look does not compile. */

import type { Colour } from "./colours";
import type { Age, Guidance } from "./states";

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
  /** The numbers beside the picture. */
  readonly numbers: boolean;
  readonly ring: "whole" | "broken";
  readonly colour: Colour;
  readonly showsAge: boolean;
  readonly flag: "" | "LDR DATA" | "LDR DATA LOST" | "MAP NOT AVAIL";
}

export const AGE: Record<Age, AgeLook> = {
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
  gone: {
    map: false,
    guidance: false,
    numbers: false,
    ring: "broken",
    colour: "alert",
    showsAge: false,
    flag: "MAP NOT AVAIL",
  },
  none: {
    map: false,
    guidance: false,
    numbers: false,
    ring: "broken",
    colour: "alert",
    showsAge: false,
    flag: "MAP NOT AVAIL",
  },
};
