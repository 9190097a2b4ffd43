/**
 * One picture: everything that is shown of a flight at one instant, from what is known of the flight
 * and the time of the view. The display, the panels and the scene's poster read it and compute nothing.
 */

import { computed, type ReadonlySignal, type Signal, signal } from "@preact/signals";
import { CALM, pathPointAt, type Vector, velocity, windVector } from "../geometry";
import { KT, NM } from "../units";
import type {
  AircraftSample,
  ClearanceStatus,
  ComparedPlanner,
  FanChanged,
  ForecastChanged,
  LeaderRoute,
  PathPoint,
  PathSegment,
  PlanChanged,
} from "../wire";
import { type Announcements, announcementsOf } from "./announcements";
import {
  type Closest,
  closestApproach,
  committedPoint,
  isClosestAtJoin,
  joinPoint,
  joinTime,
  minutesToCome,
  type Planned,
  proposedPlan,
  shownPlan,
  type Turn,
  turnsOf,
} from "./committed";
import { describe } from "./description";
import { STALE_AGE } from "./flight";
import type { Ghost } from "./ghost";
import { type Moved, moveAircraft, movedBy, STILL } from "./motion";
import { type Notice, noticesOf } from "./notices";
import { type Numbers, numbersOf, ROLL_IN } from "./numbers";
import type { PairCard, PairSample } from "./pair";
import { AGE, type AgeStyle, GUIDANCE, type GuidanceStyle, PILOT } from "./state-styles";
import {
  age,
  ageOf,
  commandsSpeed,
  type Guidance,
  guidance,
  isRecent,
  leaderAge,
  NEWS,
  type Outlook,
  pilot,
  revertedAt,
  separation,
} from "./states";
import { type Traffic, trafficOf } from "./traffic";
import type { TrailPoint } from "./trail";
import type { Flight, Moment, Proposal } from "./types";
import { type Cell, cellsOf } from "./weather";

export type { Moved } from "./motion";

/** A turn to come, and where own ship will be when it begins and ends. */
export interface TurnAhead extends Turn {
  /** When it begins and ends [s, flight time]. */
  readonly begins: number;
  readonly ends: number;
  readonly hasBegun: boolean;
  /** Whether its roll-in is due. */
  readonly isRollIn: boolean;
  readonly from: PathPoint;
  readonly to: PathPoint;
}

/** What became of the crew's last order, or of the manoeuvre that was sent to air traffic control: a word first. */
export type Order = "" | `${OrderWord}${"" | ` ${string}`}`;
export type OrderWord =
  | "SENT"
  | "ACCEPTED"
  | "REJECTED"
  | "STANDBY"
  | "VALIDATED"
  | "UNABLE"
  | "WILCO"
  | "CLEARED"
  | "DEVIATING"
  | "ENDED";

/** A whole minute of the plan, and where both will be. */
export interface MinuteAhead {
  readonly minute: number;
  readonly own: PathPoint | null;
  readonly leader: PathPoint | null;
}

/** Own ship a while ahead. */
export interface TrendPoint {
  /** How far ahead [s]. */
  readonly in: number;
  readonly x_m: number;
  readonly y_m: number;
  readonly track_deg: number;
}

export interface Picture {
  /** Flight time [s]. */
  readonly t: number;
  readonly style: GuidanceStyle | null;
  readonly age: AgeStyle;
  /** The same for what is known of the leader, and how old that is in whole seconds. */
  readonly leaderAge: AgeStyle;
  readonly ageSeconds: number;
  /** What is missing, in large letters. */
  readonly flag: AgeStyle["flag"];
  readonly state: Guidance;
  /** The leader, while it may be shown. */
  readonly leader: AircraftSample | null;
  /** Least separation, and as much more as the leader may be away from where it is drawn [m]. */
  readonly keepOut: number;
  /** Whether it is designated: the one that is to be joined. */
  readonly designated: boolean;
  readonly separation: Outlook;
  /** Own ship, whatever the age of its data; null before the first. */
  readonly pose: AircraftSample | null;
  /** The two, while the map may be shown. */
  readonly now: PairSample | null;
  /** The two, while what guidance says may be shown. */
  readonly guided: PairSample | null;
  readonly started: PairCard | null;
  /** The other aircraft, the least urgent first; none while the map may not be shown. */
  readonly traffic: readonly Traffic[];
  readonly cells: readonly Cell[];
  /** How fast own ship climbs [m/s]. */
  readonly climb: number;
  /** How fast the leader climbs [m/s]. */
  readonly leaderClimb: number;
  /** What the leader is called. */
  readonly ident: string;
  /** Where own ship will be if it keeps turning as now; nothing when it is too slow for that. */
  readonly trend: readonly TrendPoint[];
  readonly route: LeaderRoute | null;
  readonly wind: Vector;
  /** Where the leader has been, while it is designated; and own ship. */
  readonly trail: readonly TrailPoint[];
  readonly ownTrail: readonly TrailPoint[];
  /** The last plan, flown or not. */
  readonly plan: PlanChanged | null;
  /** The plan whose points are shown: flown, or proposed. */
  readonly flown: Planned | null;
  /** The path that is proposed, accepted or not. */
  readonly proposed: Proposal | null;
  readonly superseded: PlanChanged | null;
  readonly forecast: ForecastChanged | null;
  /** Joins after turns that the leader has not announced, while a path is proposed or flown. */
  readonly fan: FanChanged | null;
  /** Up to when the path is drawn [s, flight time]. */
  readonly until: number;
  readonly turns: readonly TurnAhead[];
  readonly minutes: readonly MinuteAhead[];
  /** Where own ship joins. */
  readonly join: PathPoint | null;
  /** The closest approach that is still to come and is a point of its own. */
  readonly closest: Closest | null;
  /** The closest approach, when it is at the join. */
  readonly closestAtJoin: Closest | null;
  /** How far from the slot own ship has joined [m]. */
  readonly gate: { readonly along: number; readonly across: number };
  /** What belongs in sight: the path ahead, the leader, the slot. */
  readonly places: readonly Place[];
  /** The direction in which the slot moves over the ground, as a unit vector. */
  readonly slotTrack: Vector;
  /** What became of the path that the crew accepted. */
  readonly order: Order;
  /** A new mode is boxed for a while. */
  readonly boxed: boolean;
  /** Who commands the speed now, and who will; boxed for a while once that has changed. */
  readonly speed: {
    readonly now: string;
    readonly next: string;
    /** Whether the crew has selected it in place of guidance. */
    readonly isSelected: boolean;
    readonly boxed: boolean;
  };
  /** Who flies; boxed for a while once that has changed, in amber where the crew did not ask for it. */
  readonly pilot: {
    readonly now: string;
    readonly next: string;
    readonly boxed: boolean;
    readonly isLost: boolean;
  };
  readonly notices: readonly Notice[];
  readonly ended: boolean;
}

/** The path that one of several compared planners would fly, over the ground from its beginning. */
export interface Rival {
  readonly planner: ComparedPlanner;
  readonly segments: readonly PathSegment[];
  /** Whether it may be flown, and whether it is drawn strongest. */
  readonly isFlyable: boolean;
  readonly isChosen: boolean;
}

/** What is shown: the picture and its numbers, and how far all has moved since it was drawn. */
export interface Shown {
  readonly picture: ReadonlySignal<Picture>;
  /** Changes with each frame between two pictures. */
  readonly moved: ReadonlySignal<Moved>;
  readonly numbers: ReadonlySignal<Numbers>;
  /** The picture in words. */
  readonly words: ReadonlySignal<string>;
  /** What is spoken of it. */
  readonly spoken: ReadonlySignal<Announcements>;
  /** Another flight that is seen beside this one; null if there is none. */
  readonly ghost: ReadonlySignal<Ghost | null>;
  /** What planners that are compared would fly; none while that is closed. */
  readonly rivals: ReadonlySignal<readonly Rival[]>;
  /** Whether one instant stands on the page, so that nothing in its picture depends on what came before. */
  readonly stands: ReadonlySignal<boolean>;
  /** The ident of the other aircraft whose numbers are shown; null for none. */
  readonly chosen: Signal<string | null>;
}

const NO_GHOST: ReadonlySignal<Ghost | null> = signal(null);
const NO_RIVALS: ReadonlySignal<readonly Rival[]> = signal([]);

/** The plan before is shown this long [s]. */
const SUPERSEDED_SHOWN = 3;

export function createShown(
  { moment, read, since, isSent, source }: Flight,
  ghost: Shown["ghost"] = NO_GHOST,
  rivals: Shown["rivals"] = NO_RIVALS,
): Shown {
  const numbers = computed(() => numbersOf(read.value));
  return {
    picture: computed(() => pictureOf({ ...moment.value, isSent: isSent.value })),
    moved: computed(() => {
      const { now } = moment.value;
      return now === null ? STILL : movedBy(now, since.value);
    }),
    numbers,
    words: computed(() => describe(read.value, numbers.value)),
    spoken: computed(() => announcementsOf(read.value)),
    ghost,
    rivals,
    stands: computed(() => source.value.kind === "replay" && source.value.rate === 0),
    chosen: signal(null),
  };
}

export function pictureOf(flight: Moment): Picture {
  const seen = AGE[age(flight)];
  const seconds = leaderAge(flight);
  const known = seen.map ? AGE[ageOf(seconds)] : seen;
  const now = seen.map ? flight.now : null;
  const guided = seen.guidance ? flight.now : null;
  const state = guidance(flight);
  const style = guided === null ? null : GUIDANCE[state];
  const designated = GUIDANCE[state].designated;
  const flown = style?.points === true ? shownPlan(flight) : null;
  const isAhead = style !== null && AHEAD.includes(style.path);
  const pair = isAhead ? closestApproach(flight) : null;
  const isAtJoin = pair !== null && isClosestAtJoin(flight, pair);
  const t = flight.t;
  return {
    t,
    style,
    age: seen,
    leaderAge: known,
    ageSeconds: Math.floor(seconds),
    flag: flagOf(seen, known, state),
    state,
    leader: known.map ? (now?.leader ?? null) : null,
    keepOut: keepOut(flight, seconds),
    designated,
    separation: separation(flight),
    pose: flight.now?.pursuer ?? null,
    now,
    guided,
    started: flight.started,
    traffic: seen.map ? trafficOf(flight) : [],
    cells: seen.map ? cellsOf(flight) : [],
    climb: flight.climbs.get(now?.pursuer.ident ?? "") ?? 0,
    leaderClimb: flight.climbs.get(flight.started?.leader.ident ?? "") ?? 0,
    ident: flight.started?.leader.ident ?? "LEADER",
    trend: now === null ? [] : trendOf(now),
    route: now === null || !designated || !known.guidance ? null : flight.route,
    wind: windOver(flight),
    trail: now === null || !designated ? NO_TRAIL : flight.trail.leader,
    ownTrail: now === null ? NO_TRAIL : flight.trail.pursuer,
    plan: guided === null ? null : flight.plan,
    flown,
    superseded: guided === null ? null : supersededPlan(flight),
    forecast: flight.forecast,
    fan: FANNED.includes(state) && known.guidance ? flight.fan : null,
    until: shownUntil(flight, guided),
    turns: flown === null ? [] : turnsAhead(flight, flown),
    minutes: flown === null ? [] : minutesAhead(flight, flown),
    proposed: guided === null ? null : proposedPlan(flight),
    join: isAhead ? joinPoint(flight) : null,
    closest: pair !== null && !isAtJoin && t < pair.at ? pair : null,
    closestAtJoin: isAtJoin ? pair : null,
    gate: GATE,
    places: placesOf(flight, now, style),
    slotTrack: slotTrack(flight),
    order: guided === null ? "" : orderOf(flight, state),
    boxed: style !== null && isRecent(flight, flight.mode?.t_s, NEWS),
    speed: speedOf(flight, style),
    pilot: pilotOf(flight, style),
    notices: noticesOf(flight),
    ended: flight.ended,
  };
}

function supersededPlan(flight: Moment): PlanChanged | null {
  const { superseded } = flight;
  return isRecent(flight, superseded?.at, SUPERSEDED_SHOWN) ? (superseded?.plan ?? null) : null;
}

function speedOf(flight: Moment, style: GuidanceStyle | null): Picture["speed"] {
  const { sample, before, plan, assignment } = flight;
  if (style === null || sample === null)
    return { now: "", next: "", isSelected: false, boxed: false };
  const isSelected = (assignment?.selected_tas_mps.length ?? 0) > 0;
  const isCommanded = !isSelected && commandsSpeed(sample, plan);
  const wasCommanded = before !== null && commandsSpeed(before, plan);
  return {
    now: isCommanded ? "RG SPD" : "SPD",
    next: isCommanded || isSelected ? "" : style.speedNext,
    isSelected,
    boxed: isSelected
      ? isRecent(flight, assignment?.t_s, NEWS)
      : before !== null && isCommanded !== wasCommanded,
  };
}

function pilotOf(flight: Moment, style: GuidanceStyle | null): Picture["pilot"] {
  const { sample, before } = flight;
  if (style === null || sample === null) return { now: "", next: "", boxed: false, isLost: false };
  const flies = pilot(sample);
  const isLost = flies === "director" && isRecent(flight, revertedAt(flight), NEWS);
  const boxed = isLost || (before !== null && pilot(before) !== flies);
  return { ...PILOT[flies], boxed, isLost };
}

function orderOf(flight: Moment, state: Guidance): Order {
  if (flight.isSent) return "SENT";
  const answer = flight.engagement;
  const since = answer === null ? Number.POSITIVE_INFINITY : flight.t - answer.t_s;
  if (answer?.engagement === answer?.previous && since < NEWS) return "REJECTED";
  return clearanceText(flight, state) || (state === "armed" ? "ACCEPTED" : "");
}

const CLEARANCE: Record<ClearanceStatus, OrderWord> = {
  sent: "SENT",
  standby: "STANDBY",
  validated: "VALIDATED",
  unable: "UNABLE",
  wilco: "WILCO",
  flying: "CLEARED",
  deviating: "DEVIATING",
  over: "ENDED",
};

/** What air traffic control says; it is said while there is something to be flown, and what is over for a while. */
function clearanceText({ clearance, t }: Moment, state: Guidance): Order {
  if (clearance === null || state === "off") return "";
  if (clearance.clearance === "over" && t - clearance.t_s > NEWS) return "";
  const { automated, reason = "" } = clearance;
  const about = SHORT[reason] ?? (automated ? "AUTO" : reason.toUpperCase());
  const word = CLEARANCE[clearance.clearance];
  return about === "" ? word : `${word} ${about}`;
}
/** Reasons that are too long for the column, and those that say nothing new there. */
const SHORT: Readonly<Record<string, string>> = {
  separation: "TRAFFIC",
  traffic_without_intent: "TRAFFIC",
  stale_picture: "DATA",
  leader_disagrees: "LDR INTENT",
  slot_taken: "SLOT",
  horizon: "TIME",
  conformance: "",
  controller: "",
  crew: "",
};

/** Within so much of the slot, along and across the leader's route, own ship has joined [m]. */
const GATE = { along: 0.2 * NM, across: 0.1 * NM };
/** Between two places of the path that are kept in sight [s]. */
const SEEN_EVERY = 30;

type Place = Pick<PathPoint, "x_m" | "y_m">;

function placesOf(flight: Moment, now: PairSample | null, style: GuidanceStyle | null): Place[] {
  if (now === null) return [];
  const places: Place[] = [now.leader];
  if (style === null || !style.designated) return places;
  if (!AHEAD.includes(style.path)) return style.slot === "none" ? places : [...places, now.slot];
  const join = joinTime(flight);
  if (join === null) return [...places, now.slot];
  const count = Math.max(1, Math.ceil((join - now.t_s) / SEEN_EVERY));
  for (let k = 1; k <= count; k += 1) {
    const point = committedPoint(flight, Math.min(join, now.t_s + k * SEEN_EVERY));
    if (point !== null) places.push(point);
  }
  return places;
}

/** What is missing; the message line says by itself that guidance has lost its leader. */
function flagOf(seen: AgeStyle, known: AgeStyle, state: Guidance): AgeStyle["flag"] {
  if (!seen.map) return seen.flag;
  if (state === "data_lost") return "";
  return known.map ? known.flag : "LDR DATA LOST";
}

/** How far a leader can be from where it is expected: as if it turned since, at 25° of bank [m/s²]. */
const ASTRAY = 0.5 * 9.81 * Math.tan((25 * Math.PI) / 180);

function keepOut(flight: Moment, seconds: number): number {
  const least = flight.started?.min_separation_m ?? 0;
  return least > 0 && seconds > STALE_AGE ? least + ASTRAY * seconds ** 2 : least;
}

/** Where a turn of the leader moves the join. */
const FANNED: readonly Guidance[] = ["proposed", "armed", "converge"];
/** The paths that lead somewhere. */
const AHEAD: readonly GuidanceStyle["path"][] = ["proposed", "armed", "committed"];
const NO_TRAIL: readonly TrailPoint[] = [];

function windOver(flight: Moment): Vector {
  const wind = flight.started?.wind;
  return wind === undefined ? CALM : windVector(wind);
}

/** The trend is bent every so many seconds, and ends after so many. */
const TREND_STEP = 5;
const TREND_END = 90;
/** Below this there is no trend worth showing [m/s]. */
const SLOWEST = 100 * KT;

function trendOf({ pursuer }: PairSample): TrendPoint[] {
  if (pursuer.ground_speed_mps < SLOWEST) return [];
  return Array.from({ length: TREND_END / TREND_STEP }, (_, i) => {
    const ahead = TREND_STEP * (i + 1);
    const { x_m, y_m, track_deg } = moveAircraft(pursuer, ahead);
    return { in: ahead, x_m, y_m, track_deg };
  });
}

/** Up to when the path is drawn: the join, or once joined where the leader is now. */
function shownUntil(flight: Moment, guided: PairSample | null): number {
  if (guided?.mode !== "follow") return joinTime(flight) ?? Number.POSITIVE_INFINITY;
  const length = flight.started?.slot_distance_m ?? 0;
  // Its end moves on in whole seconds, so that what waits stays as it is.
  return Math.ceil(flight.t) + length / Math.max(1, guided.leader.ground_speed_mps);
}

function turnsAhead(flight: Moment, plan: Planned): TurnAhead[] {
  return turnsOf(plan)
    .map((turn) => ({
      ...turn,
      begins: plan.t_s + turn.segment.start.t_s,
      ends: plan.t_s + turn.segment.end.t_s,
    }))
    .filter(({ ends }) => ends > flight.t)
    .map((turn) => ({
      ...turn,
      hasBegun: flight.t > turn.begins,
      isRollIn: isSoon(turn.begins - flight.t),
      from: committedPoint(flight, turn.begins) ?? turn.segment.start,
      to: committedPoint(flight, turn.ends) ?? turn.segment.end,
    }));
}

function isSoon(left: number): boolean {
  return left > 0 && left <= ROLL_IN;
}

function minutesAhead(flight: Moment, plan: Planned): MinuteAhead[] {
  return minutesToCome(flight, plan).map(({ minute, t }) => ({
    minute,
    own: committedPoint(flight, t),
    leader: leaderPoint(flight, t),
  }));
}

/** Where the leader is expected at flight time `t` [s]. */
function leaderPoint(flight: Moment, t: number): PathPoint | null {
  const segments = flight.route?.segments ?? [];
  const [from, to] = [segments[0]?.start.t_s ?? 0, segments.at(-1)?.end.t_s ?? 0];
  return t < from || t > to ? null : pathPointAt(segments, t, windOver(flight));
}

function slotTrack(flight: Moment): Vector {
  const now = flight.now;
  if (now === null) return { x: 0, y: 1 };
  const air = velocity(now.leader.tas_mps, now.slot.heading_deg);
  const wind = windOver(flight);
  const [x, y] = [air.x + wind.x, air.y + wind.y];
  const speed = Math.hypot(x, y) || 1;
  return { x: x / speed, y: y / speed };
}
