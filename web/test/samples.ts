/** Documents and ticks for tests: a plain flight at 35,000 ft, own aircraft east-bound from the origin. */

import { batch } from "@preact/signals";
import type { PairSample } from "../src/store/pair";
import type { Flight, Moment } from "../src/store/types";
import type {
  AircraftSample,
  Alert,
  Document,
  FlightStarted,
  ModeChanged,
  PathPoint,
  PlanCard,
  PlanChanged,
  PlanUnavailable,
  Sample,
  SeparationLost,
  StraightSegment,
  Tick,
  TurnSegment,
  Unable,
} from "../src/wire";

export const OWN = "RG001";
export const LEADER = "AF123";

export function point(t: number, x: number, y: number, heading: number): PathPoint {
  return { t_s: t, x_m: x, y_m: y, heading_deg: heading };
}

export function aircraft(changes: Partial<AircraftSample> = {}): AircraftSample {
  return {
    ident: OWN,
    x_m: 0,
    y_m: 0,
    heading_deg: 90,
    track_deg: 90,
    bank_deg: 0,
    turn_rate_degps: 0,
    tas_mps: 240,
    ground_speed_mps: 240,
    altitude_m: 10668,
    ...changes,
  };
}

/** What the page makes of `sample`. */
export function pairAt(t: number, changes: Partial<PairSample> = {}): PairSample {
  return {
    t_s: t,
    pursuer: aircraft({ x_m: 240 * t }),
    leader: aircraft({
      ident: LEADER,
      x_m: 20000 + 200 * t,
      tas_mps: 200,
      ground_speed_mps: 200,
    }),
    others: [],
    mode: "converge",
    reference: { kind: "hold_heading", heading_deg: 90 },
    commanded_tas_mps: 240,
    separation_m: 20000 - 40 * t,
    closure_mps: 40,
    least_separation_m: 20000 - 40 * t,
    slot: point(t, 10000 + 200 * t, 0, 90),
    slot_open: true,
    spacing_error_m: 10000 - 40 * t,
    cross_track_m: 0,
    time_to_go_s: Math.max(0, 250 - t),
    joined: false,
    alert: "none",
    leader_age_s: 0,
    margin_m: 0,
    engagement: "engaged",
    ...changes,
  };
}

export function sample(t: number, changes: Partial<PairSample> = {}): Sample {
  const { t_s, pursuer, leader, others, ...guidance } = pairAt(t, changes);
  return {
    kind: "sample",
    t_s,
    aircraft: [pursuer, leader, ...others],
    guidance: [{ ident: pursuer.ident, leader: leader.ident, ...guidance }],
  };
}

/** A right turn from north through `angle` [deg] at 100 m/s on a circle of 1 km, from the origin. */
export function rightTurn(angle: number): TurnSegment {
  const psi = (angle * Math.PI) / 180;
  const duration = 10 * psi;
  return {
    kind: "turn",
    direction: "right",
    angle_deg: angle,
    bank_deg: 25,
    radius_m: 1000,
    duration_s: duration,
    start: point(0, 0, 0, 0),
    end: point(duration, 1000 * (1 - Math.cos(psi)), 1000 * Math.sin(psi), angle),
  };
}

export function straight(from: PathPoint, duration: number, speed: number): StraightSegment {
  const psi = (from.heading_deg * Math.PI) / 180;
  const length = speed * duration;
  return {
    kind: "straight",
    length_m: length,
    duration_s: duration,
    start: from,
    end: point(
      from.t_s + duration,
      from.x_m + length * Math.sin(psi),
      from.y_m + length * Math.cos(psi),
      from.heading_deg,
    ),
  };
}

export function planCard(changes: Partial<PlanCard> = {}): PlanCard {
  const turn = rightTurn(90);
  return {
    status: "planned",
    planner: "exact",
    word: "RS",
    time_to_converge_s: 250,
    length_m: 60_000, // at the speed of the samples
    segments: [turn, straight(turn.end, 250 - turn.duration_s, 100)],
    separation: { least_m: 10000, at_s: 250, proved_above_m: 9999 },
    optimality: { proof: "relaxation", lower_bound_s: 250 },
    arrival: { slot_error_m: 0, heading_error_deg: 0, early_s: 0 },
    alternatives: [],
    compute_ms: 0.08,
    ...changes,
  };
}

export function planChanged(t: number, plan: Partial<PlanCard> = {}): PlanChanged {
  return {
    kind: "plan_changed",
    t_s: t,
    ident: OWN,
    reason: "engaged",
    message: `Plan made at ${t}.`,
    plan: planCard(plan),
    leader_at_closest: point(250, 0, 0, 90),
    pursuer_at_closest: point(250, 0, 0, 90),
    announced: true,
    promised_s: 260,
    tube_m: 0,
    flown_least_m: 10000,
  };
}

export function noPlan(t: number): PlanUnavailable {
  return {
    kind: "plan_unavailable",
    t_s: t,
    ident: OWN,
    answer: {
      status: "no_plan",
      reason: "slot_unreachable",
      message: "The leader is faster.",
      lower_bound_s: 0,
    },
  };
}

export function modeChanged(t: number, mode: ModeChanged["mode"] = "converge"): ModeChanged {
  return {
    kind: "mode_changed",
    t_s: t,
    ident: OWN,
    mode,
    previous: "heading",
    message: "Engaged.",
  };
}

export function alert(t: number, changes: Partial<Alert> = {}): Alert {
  return {
    kind: "alert",
    t_s: t,
    ident: OWN,
    other: LEADER,
    level: "caution",
    subject: "separation",
    message: "The leader slows down.",
    predicted_least_m: 9000,
    predicted_at_s: t + 45,
    cleared: false,
    ...changes,
  };
}

export function unable(t: number): Unable {
  return {
    kind: "unable",
    t_s: t,
    ident: OWN,
    reason: "geometry",
    message: "The leader turns back.",
  };
}

export function separationLost(t: number): SeparationLost {
  return {
    kind: "separation_lost",
    t_s: t,
    ident: OWN,
    other: LEADER,
    separation_m: 9259,
    x_m: 0,
    y_m: 0,
    cause: "The leader turned towards own ship.",
    announced_s: [t - 10],
  };
}

export const STARTED: FlightStarted = {
  kind: "flight_started",
  t_s: 0,
  scenario: "fig_6b",
  title: "Fig. 6b",
  planner: "exact",
  aircraft: [
    { ident: OWN, aircraft_type: "A300", max_bank_deg: 25 },
    { ident: LEADER, aircraft_type: "A300", max_bank_deg: 25 },
  ],
  links: [
    {
      pursuer: OWN,
      leader: LEADER,
      slot_distance_m: 10000,
      min_separation_m: 9260,
      spacing: "distance",
      spacing_time_s: 0,
    },
  ],
  wind: { from_deg: 0, speed_mps: 0 },
  step_s: 0.05,
  seed: 0,
};

export function tick(t: number, documents: Document[], changes: Partial<Tick> = {}): Tick {
  return {
    kind: "tick",
    flight_id: "one",
    t_s: t,
    rate: 1,
    paused: false,
    ended: false,
    documents,
    ...changes,
  };
}

/** Changes what is known of a flight at the instant that is shown. */
export function amend(flight: Flight, changes: Partial<Moment>): void {
  batch(() => {
    flight.moment.value = { ...flight.moment.value, ...changes };
    flight.read.value = flight.moment.value;
  });
}
