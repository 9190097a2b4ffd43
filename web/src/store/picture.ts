/**
 * One picture: everything that is shown of a flight at one instant, from what is known of the flight
 * and the time of the view. The display, the panels and the scene's poster read it and compute nothing.
 */

import type { Vector } from "../geometry";
import { NM } from "../units";
import type {
  AircraftSample,
  FanChanged,
  ForecastChanged,
  LeaderRoute,
  PathPoint,
  PlanChanged,
} from "../wire";
import {
  AHEAD,
  type MinuteAhead,
  minutesAhead,
  type Place,
  placesOf,
  shownUntil,
  slotTrack,
  type TrendPoint,
  type TurnAhead,
  trendOf,
  turnsAhead,
  windOver,
} from "./ahead";
import {
  type Closest,
  closestApproach,
  isClosestAtJoin,
  joinPoint,
  type Planned,
  proposedPlan,
  shownPlan,
} from "./committed";
import { STALE_AGE } from "./flight";
import {
  type Order,
  orderOf,
  type PilotWords,
  pilotOf,
  type SpeedWords,
  speedOf,
} from "./mode-words";
import { type Notice, noticesOf } from "./notices";
import type { PairCard, PairSample } from "./pair";
import { AGE, type AgeStyle, GUIDANCE, type GuidanceStyle } from "./state-styles";
import {
  age,
  ageOf,
  type Guidance,
  guidance,
  isRecent,
  leaderAge,
  NEWS,
  type Outlook,
  separation,
} from "./states";
import { type Traffic, trafficOf } from "./traffic";
import type { TrailPoint } from "./trail";
import type { Moment, Proposal } from "./types";
import { type Cell, cellsOf } from "./weather";

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
  readonly speed: SpeedWords;
  readonly pilot: PilotWords;
  readonly notices: readonly Notice[];
  readonly ended: boolean;
}

/** The plan before is shown this long [s]. */
const SUPERSEDED_SHOWN = 3;

/** Within so much of the slot, along and across the leader's route, own ship has joined [m]. */
const GATE = { along: 0.2 * NM, across: 0.1 * NM };
/** Where a turn of the leader moves the join. */
const FANNED: readonly Guidance[] = ["proposed", "armed", "converge"];
const NO_TRAIL: readonly TrailPoint[] = [];

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
