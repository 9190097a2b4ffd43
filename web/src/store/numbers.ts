/**
 * Every number that is read, as text or as the one value that all texts of it are made of: five times
 * a second, from one reading. What stands twice on the page is written once here.
 */

import {
  formatClock,
  formatHeading,
  formatKnots,
  formatMiles,
  formatSignedKnots,
  inPageUnits,
  KT,
  NM,
} from "../units";
import type { AircraftSample, FanChanged, PathPoint } from "../wire";
import {
  closestApproach,
  committedPoint,
  isClosestAtJoin,
  joinPoint,
  nextTurn,
  type Planned,
  shownPlan,
  timeToJoin,
} from "./committed";
import type { PairSample } from "./pair";
import { closureText, crossTrackText, spacingText, startLower, unableSentence } from "./reading";
import { AGE, GUIDANCE } from "./state-styles";
import {
  age,
  ageOf,
  type Guidance,
  guidance,
  hasLapsed,
  isRecent,
  leaderAge,
  NEWS,
  separation,
  wasDropped,
} from "./states";
import type { Moment } from "./types";

/** The next turn, or the join: bearing, distance and how long until then. */
export interface NextPoint {
  readonly name: string;
  /** Bearing in three digits. */
  readonly bearing: string;
  readonly miles: string;
  /** How long until then; "" where there is nothing to count down. */
  readonly left: string;
  /** Whether the roll-in is due. */
  readonly isUrgent: boolean;
}

/** The turn to come, as the panel says it. */
interface NextTurnText {
  /** "R 42°". */
  readonly size: string;
  readonly left: string;
}

/** Least separation on the way. */
export interface LeastAhead {
  readonly miles: string;
  /** How long until then; "" once joined or passed. */
  readonly left: string;
  readonly when: "ahead" | "passed" | "at_join";
}

/** Least separation from one of the others on the way. */
interface OtherAhead {
  readonly ident: string;
  readonly miles: string;
  readonly left: string;
  /** Whether height keeps them apart, where that is less than the minimum. */
  readonly isByHeight: boolean;
}

/** Own ship against the slot: late when it is behind. */
interface Timing {
  /** Where the pointer stands: 1 is as late as the scale goes, 0 in the gate. */
  readonly offset: number;
  /** "12 S LATE"; "ON TIME" in the gate. */
  readonly text: string;
}

/** The minimum separation is lost, or will be. */
export interface Alarm {
  readonly level: "caution" | "alert";
  /** "SEPARATION" or "SEP IN 45 S". */
  readonly text: string;
}

/** Why there is no plan. */
interface Trouble {
  /** "Unable" or "No plan"; from the sentence's own moment on some seconds, it says which that was. */
  readonly label: string;
  readonly sentence: string;
}

export interface Numbers {
  /** Flight time of the reading [s]; null before the first. */
  readonly readAt: number | null;
  /** The reading; null when there is none, or it is too old to be read. */
  readonly sample: PairSample | null;
  /** The same, while what guidance says may be shown. */
  readonly guided: PairSample | null;
  /** Whether D, d and what else belongs to a leader to be joined is shown. */
  readonly isSpacing: boolean;
  readonly gs: string;
  readonly tas: string;
  /** Where the wind comes from, and its speed. */
  readonly windFrom: string;
  readonly windSpeed: string;
  /** Where the wind blows to [deg]; null in calm. */
  readonly windTo: number | null;
  /** D and MIN [NM]. */
  readonly slotDistance: string;
  readonly minSeparation: string;
  /** What is kept beside MIN for what is not certain [NM]; "" where all is exact. */
  readonly margin: string;
  /** How much sooner it joins if it knows of the leader's turn a minute ahead; "" where none is saved. */
  readonly saving: string;
  readonly separation: string;
  readonly closure: string;
  /** Offset from the leader's route, "0.3R"; "" below 0.05 NM. */
  readonly crossTrack: string;
  /** How long until it joins; "" when there is no way or it is over. */
  readonly toJoin: string;
  /** Flight time of the join; "" as above. */
  readonly joinsAt: string;
  readonly next: NextPoint | null;
  readonly nextTurn: NextTurnText | null;
  readonly least: LeastAhead | null;
  readonly nearestOther: OtherAhead | null;
  /** The plan that is flown, and what became of it when there is none. */
  readonly plan: Planned | null;
  readonly state: Guidance;
  /** How what is proposed differs from the path that the crew had accepted; "" if that still stands. */
  readonly lapsed: string;
  /** When the leader's data were lost while guidance was engaged, until the crew does the next step; "" else. */
  readonly droppedAt: string;
  /** Whether the minimum is lost or will be, in the words of the message line; null while it is kept. */
  readonly alarm: Alarm | null;
  /** The leader, while its data may be read. */
  readonly leader: AircraftSample | null;
  /** Whether the leader's turns to come are known; null when nothing is heard of it. */
  readonly isIntentKnown: boolean | null;
  readonly trouble: Trouble | null;
  /** Least separation so far, and whether that is less than the minimum. */
  readonly leastSoFar: string;
  readonly wasLost: boolean;
  /** "closing 35 kt". */
  readonly closureWords: string;
  /** "1.20 NM behind". */
  readonly spacingWords: string;
  /** "0.10 NM R". */
  readonly crossTrackWords: string;
  /** How early or late own ship is at the slot, once it closes on it. */
  readonly timing: Timing | null;
  readonly clock: string;
  readonly commandedSpeed: string;
  /** Bearing and distance to the leader. */
  readonly leaderBearing: string;
  readonly leaderSpeed: string;
}

/** Calm below this: no arrow. */
const ARROW_FROM = 2 * KT;
/** The roll-in to a turn is announced this long before [s]. */
export const ROLL_IN = 30;
const NOTHING = "---";

export function numbersOf(flight: Moment): Numbers {
  const seen = AGE[age(flight)];
  const sample = seen.numbers ? flight.now : null;
  const guided = seen.guidance ? sample : null;
  const style = GUIDANCE[guidance(flight)];
  const leader = AGE[ageOf(leaderAge(flight))].numbers;
  const left = guided === null ? null : timeToJoin(flight);
  const started = flight.started;
  const shown = leader ? (guided ?? sample) : null;
  return {
    readAt: flight.now?.t_s ?? null,
    sample,
    guided,
    isSpacing: guided !== null && style.spacing,
    ...airTexts(flight, guided),
    slotDistance: started === null ? NOTHING : formatMiles(started.slot_distance_m),
    minSeparation: started === null ? NOTHING : formatMiles(started.min_separation_m),
    margin: guided === null || guided.margin_m <= 0 ? "" : formatMiles(guided.margin_m, 2),
    saving: guided === null || flight.fan === null ? "" : savingText(flight.fan),
    separation: shown === null ? NOTHING : formatMiles(shown.separation_m),
    closure: shown === null ? NOTHING : formatSignedKnots(shown.closure_mps),
    crossTrack: shown === null ? NOTHING : formatSide(shown.cross_track_m),
    toJoin: left === null ? "" : formatClock(left),
    joinsAt: left === null || guided === null ? "" : formatClock(guided.t_s + left),
    next: guided === null ? null : nextPoint(flight, guided),
    nextTurn: guided === null ? null : nextTurnText(flight, guided),
    least: guided === null ? null : leastAhead(flight, guided),
    nearestOther: guided === null ? null : nearestOther(flight, guided),
    plan: guided === null ? null : shownPlan(flight),
    state: guidance(flight),
    lapsed: hasLapsed(flight) ? inPageUnits(flight.engagement?.message ?? "") : "",
    droppedAt: wasDropped(flight) ? formatClock(flight.engagement?.t_s ?? 0) : "",
    alarm: seen.map ? alarmOf(flight) : null,
    leader: shown?.leader ?? null,
    isIntentKnown: shown === null ? null : (flight.route?.intent_known ?? null),
    trouble: guided === null ? null : troubleOf(flight),
    leastSoFar: sample === null ? NOTHING : formatMiles(leastUntil(flight, sample)),
    wasLost: sample !== null && sample.least_separation_m < (started?.min_separation_m ?? 0),
    closureWords: shown === null ? "" : closureText(shown.closure_mps),
    spacingWords: shown === null ? "" : spacingText(shown.spacing_error_m),
    crossTrackWords: shown === null ? "" : crossTrackText(shown.cross_track_m),
    timing: shown === null ? null : timingOf(shown),
    clock: sample === null ? "––:––" : formatClock(sample.t_s),
    commandedSpeed:
      guided === null
        ? ""
        : formatKnots(flight.assignment?.selected_tas_mps[0] ?? guided.commanded_tas_mps),
    leaderBearing: shown === null ? "" : formatHeading(bearingTo(shown.pursuer, shown.leader)),
    leaderSpeed: shown === null ? "" : formatKnots(shown.leader.ground_speed_mps),
  };
}

/** Less than this is not worth saying [s]. */
const SAVED = 5;

function savingText({ most_saved_s: most, mean_saved_s: mean }: FanChanged): string {
  return most < SAVED ? "" : `${formatClock(most)}, on average ${formatClock(mean)}`;
}

/** A separation no farther above the least is the least itself, but for rounding [m]. */
const AT_LEAST = 1;

/** The least separation until a reading, which is a little earlier or later than the sample that says it [m]. */
function leastUntil(flight: Moment, reading: PairSample): number {
  const told = flight.sample ?? reading;
  const least = told.least_separation_m;
  if (told.leader_age_s > 0) return least;
  const isFalling = told.separation_m - least < AT_LEAST;
  if (isFalling && reading.t_s <= told.t_s) return reading.separation_m;
  return Math.min(least, reading.separation_m);
}

/** In the gate so near the slot, and off the scale so far from it [m]. */
const IN_GATE = 0.2 * NM;
const SCALE_END = 2 * NM;

function timingOf({ mode, spacing_error_m: error, leader }: PairSample): Timing | null {
  if (mode !== "capture" && mode !== "follow") return null;
  // Inside the tolerance nothing moves: there is nothing to correct.
  if (Math.abs(error) <= IN_GATE) return { offset: 0, text: "ON TIME" };
  const seconds = Math.round(Math.abs(error) / Math.max(1, leader.ground_speed_mps));
  return {
    offset: Math.max(-1, Math.min(1, error / SCALE_END)),
    text: `${seconds} S ${error > 0 ? "LATE" : "EARLY"}`,
  };
}

function alarmOf(flight: Moment): Alarm | null {
  const { state, within } = separation(flight);
  switch (state) {
    case "lost":
      return { level: "alert", text: "SEPARATION" };
    case "predicted":
      return { level: "caution", text: `SEP IN ${within} S` };
    case "kept":
      return null;
  }
}

function troubleOf(flight: Moment): Trouble | null {
  const [unavailable, unable] = [flight.unavailable, flight.unable];
  // The numbers in a sentence are those of its moment: once that is over, it is said to be.
  const dated = (label: string, t: number, message: string): Trouble => {
    const sentence = inPageUnits(message);
    if (isRecent(flight, t, NEWS)) return { label, sentence };
    return { label, sentence: `As of ${formatClock(t)}: ${startLower(sentence)}` };
  };
  if (unavailable !== null) return dated("No plan", unavailable.t_s, unavailable.answer.message);
  return unable === null ? null : dated("Unable", unable.t_s, unableSentence(unable));
}

function airTexts(flight: Moment, reading: PairSample | null) {
  const wind = reading === null ? null : (flight.started?.wind ?? null);
  return {
    gs: reading === null ? NOTHING : formatKnots(reading.pursuer.ground_speed_mps).padStart(3, "0"),
    tas: reading === null ? NOTHING : formatKnots(reading.pursuer.tas_mps).padStart(3, "0"),
    windFrom:
      wind === null || wind.speed_mps < ARROW_FROM / 2 ? NOTHING : formatHeading(wind.from_deg),
    windSpeed: wind === null ? NOTHING : formatKnots(wind.speed_mps).padStart(2, "0"),
    windTo: wind === null || wind.speed_mps <= ARROW_FROM ? null : wind.from_deg + 180,
  };
}

/** From here on an offset has no decimals: there is room for four places [NM]. */
const FAR_OFF = 99.95;

/** An offset with its side, e.g. "0.3R", "142L"; "" below 0.05 NM. */
function formatSide(offset: number): string {
  const miles = formatMiles(Math.abs(offset), Math.abs(offset) < FAR_OFF * NM ? 1 : 0);
  return miles === "0.0" ? "" : `${miles}${offset > 0 ? "R" : "L"}`;
}

function nextPoint(flight: Moment, reading: PairSample): NextPoint | null {
  const style = GUIDANCE[guidance(flight)];
  const plan = style.points ? shownPlan(flight) : null;
  if (plan === null) {
    if (!style.crossTrack) return null;
    const name = flight.started?.leader.ident ?? "LEADER";
    return { name, ...toward(reading, reading.leader), left: "", isUrgent: false };
  }
  const turn = nextTurn(plan, reading.t_s);
  const left = turn?.in ?? timeToJoin(flight);
  const point = turn === null ? joinPoint(flight) : committedPoint(flight, turn.at);
  if (point === null || left === null) return null;
  return {
    name: turn === null ? "CNV" : `${turn.name} ${turn.size}°`,
    ...toward(reading, point),
    left: formatClock(left),
    isUrgent: turn !== null && left <= ROLL_IN,
  };
}

function nextTurnText(flight: Moment, reading: PairSample): NextTurnText | null {
  const plan = shownPlan(flight);
  const turn = plan === null ? null : nextTurn(plan, reading.t_s);
  if (turn === null) return null;
  return { size: `${turn.size[0]} ${turn.size.slice(1)}°`, left: formatClock(turn.in) };
}

/** Of the others that a plan keeps clear of the one that it is nearest to, until that is past. */
function nearestOther(flight: Moment, reading: PairSample): OtherAhead | null {
  const planned = shownPlan(flight);
  const [nearest] = planned?.plan.separation.others ?? [];
  if (planned === null || nearest === undefined) return null;
  const left = planned.t_s + nearest.at_s - reading.t_s;
  if (left < 0) return null;
  const { ident, least_m, min_separation_m, vertical = [] } = nearest;
  const isByHeight = vertical.length > 0 && least_m < min_separation_m;
  return { ident, miles: formatMiles(least_m), left: formatClock(left), isByHeight };
}

function leastAhead(flight: Moment, reading: PairSample): LeastAhead | null {
  const closest = closestApproach(flight);
  if (closest === null) return null;
  const miles = formatMiles(closest.least);
  if (closest.at <= reading.t_s) return { miles, left: "", when: "passed" };
  if (isClosestAtJoin(flight, closest)) return { miles, left: "", when: "at_join" };
  return { miles, left: formatClock(closest.at - reading.t_s), when: "ahead" };
}

type Place = Pick<PathPoint, "x_m" | "y_m">;

function toward({ pursuer }: PairSample, place: Place): { bearing: string; miles: string } {
  const length = Math.hypot(place.x_m - pursuer.x_m, place.y_m - pursuer.y_m);
  const decimals = length < 20 * NM ? 1 : 0;
  return {
    bearing: formatHeading(bearingTo(pursuer, place)),
    miles: formatMiles(length, decimals),
  };
}

function bearingTo(from: Place, to: Place): number {
  return (Math.atan2(to.x_m - from.x_m, to.y_m - from.y_m) * 180) / Math.PI;
}
