/** Flights as the display gets them: documents made by the exact planner, samples where both would be. */

import { cutPath, pathPointAt, samplePath, velocity, windVector } from "../../src/geometry";
import { emptyFlight } from "../../src/store/flight";
import { type PairCard, type PairSample, pairCard } from "../../src/store/pair";
import type { Flight } from "../../src/store/types";
import { wrap360 } from "../../src/units";
import type {
  AircraftSample,
  FlightStarted,
  ForecastChanged,
  LeaderRoute,
  Mode,
  PathPoint,
  PathSegment,
  PlanChanged,
} from "../../src/wire";
import { amend } from "../samples";
import crossing from "./flights/crossing.json" with { type: "json" };
import fig6a from "./flights/fig_6a.json" with { type: "json" };
import fig6b from "./flights/fig_6b.json" with { type: "json" };
import fig6bWind from "./flights/fig_6b_wind.json" with { type: "json" };
import left from "./flights/left.json" with { type: "json" };

const FLIGHTS = { crossing, fig_6a: fig6a, fig_6b: fig6b, fig_6b_wind: fig6bWind, left };
export type FlightName = keyof typeof FLIGHTS;

interface Documents {
  readonly started: PairCard;
  readonly route: LeaderRoute;
  readonly plan: PlanChanged;
}

export function documentsOf(name: FlightName): Documents {
  const [first, route, plan] = FLIGHTS[name] as unknown as [
    FlightStarted,
    LeaderRoute,
    PlanChanged,
  ];
  const started = pairCard(first);
  if (started === null) throw new Error("A flight without a link.");
  return { started, route, plan };
}

/** A forecast that bulges so far to the left of the plan, as if flown with more room [m]. */
export function forecastOf(name: FlightName, bulge = 400): ForecastChanged {
  const { plan, started } = documentsOf(name);
  const points = samplePath(plan.plan.segments, windVector(started.wind), 0, Infinity, 3);
  const last = points.length - 1;
  const beside = points.map((point, k) => {
    const across = velocity(bulge * Math.sin((Math.PI * k) / last), point.heading_deg - 90);
    return { ...point, x_m: point.x_m + across.x, y_m: point.y_m + across.y };
  });
  const closest = beside[Math.floor(last / 2)];
  if (closest === undefined) throw new Error("A plan without a path.");
  return {
    kind: "forecast_changed",
    t_s: 0,
    ident: started.pursuer.ident,
    times_s: beside.map(({ t_s }) => t_s),
    x_m: beside.map(({ x_m }) => x_m),
    y_m: beside.map(({ y_m }) => y_m),
    heading_deg: beside.map(({ heading_deg }) => heading_deg),
    least_separation_m: 11_000,
    pursuer_at_closest: closest,
    leader_at_closest: { ...closest, x_m: closest.x_m + 11_000 },
  };
}

/** The flight `t` [s] after its plan was made, everything flown as planned. */
export function flightAt(name: FlightName, t: number, mode: Mode = "converge"): Flight {
  const documents = documentsOf(name);
  const flight = emptyFlight();
  flight.id.value = name;
  const { started, route, plan } = documents;
  const ident = documents.started.pursuer.ident;
  const entered = { kind: "mode_changed", t_s: 0, ident, mode, previous: "heading" } as const;
  amend(flight, { started, route, plan, mode: { ...entered, message: "" } });
  flight.connection.value = "live";
  setTime(flight, t, mode);
  return flight;
}

export function setTime(flight: Flight, t: number, mode: Mode): void {
  const { started, route, plan } = flight.moment.value;
  if (started === null || route === null || plan === null) throw new Error("An empty flight.");
  const sample = sampleAt({ started, route, plan }, t, mode);
  const wind = windVector(started.wind);
  const times = Array.from({ length: 61 }, (_, i) => t - 600 + 10 * i).filter((each) => each >= 0);
  const leader = times.map((each) => {
    const point = pathPointAt(route.segments, each, wind);
    return { t: each, x: point?.x_m ?? 0, y: point?.y_m ?? 0 };
  });
  const joinedAt = sample.joined ? plan.plan.time_to_converge_s : Number.POSITIVE_INFINITY;
  amend(flight, { t, sample, now: sample, joinedAt, trail: { pursuer: [], leader } });
}

function sampleAt({ started, route, plan }: Documents, t: number, mode: Mode): PairSample {
  const wind = windVector(started.wind);
  const end = plan.plan.time_to_converge_s;
  const final = route.segments.at(-1);
  if (final === undefined) throw new Error("A route without segments.");
  const leader = aircraft(started.leader.ident, route.segments, t, wind, 10_668);
  const along = velocity(
    1,
    Math.atan2(leaderVelocity(final).x, leaderVelocity(final).y) / (Math.PI / 180),
  );
  const since = t - final.start.t_s;
  const slot: PathPoint = {
    t_s: t,
    x_m: final.start.x_m + leaderVelocity(final).x * since - started.slot_distance_m * along.x,
    y_m: final.start.y_m + leaderVelocity(final).y * since - started.slot_distance_m * along.y,
    heading_deg: final.start.heading_deg,
  };
  const pursuer =
    t <= end
      ? aircraft(started.pursuer.ident, plan.plan.segments, t, wind, 10_668)
      : { ...leader, ident: started.pursuer.ident, x_m: slot.x_m, y_m: slot.y_m };
  const dx = leader.x_m - pursuer.x_m;
  const dy = leader.y_m - pursuer.y_m;
  const separation = Math.hypot(dx, dy);
  const [v, w] = [pursuer, leader].map((each) => velocity(each.ground_speed_mps, each.track_deg));
  const closure =
    (((v?.x ?? 0) - (w?.x ?? 0)) * dx + ((v?.y ?? 0) - (w?.y ?? 0)) * dy) / separation;
  return {
    t_s: t,
    pursuer,
    leader,
    others: [],
    mode,
    reference:
      Math.abs(pursuer.turn_rate_degps) > 0.01
        ? { kind: "turn_rate", turn_rate_degps: pursuer.turn_rate_degps }
        : { kind: "hold_heading", heading_deg: pursuer.heading_deg },
    commanded_tas_mps: pursuer.tas_mps,
    separation_m: separation,
    closure_mps: closure,
    least_separation_m: separation,
    slot,
    slot_open:
      since >
      started.slot_distance_m / Math.hypot(leaderVelocity(final).x, leaderVelocity(final).y),
    spacing_error_m: (slot.x_m - pursuer.x_m) * along.x + (slot.y_m - pursuer.y_m) * along.y,
    cross_track_m: (pursuer.x_m - slot.x_m) * along.y - (pursuer.y_m - slot.y_m) * along.x,
    time_to_go_s: Math.max(0, end - t),
    joined: t >= end,
    alert: "none",
    leader_age_s: 0,
    margin_m: 0,
    engagement: "engaged",
  };
}

function leaderVelocity(leg: PathSegment): { x: number; y: number } {
  const duration = leg.end.t_s - leg.start.t_s;
  return {
    x: (leg.end.x_m - leg.start.x_m) / duration,
    y: (leg.end.y_m - leg.start.y_m) / duration,
  };
}

function aircraft(
  ident: string,
  segments: readonly PathSegment[],
  t: number,
  wind: { x: number; y: number },
  altitude: number,
): AircraftSample {
  const point = pathPointAt(segments, t, wind);
  const segment = cutPath(segments, wind, t)[0] ?? segments.at(-1);
  if (point === null || segment === undefined) throw new Error("An empty path.");
  const straight = segments.find((each) => each.kind === "straight");
  if (straight === undefined) throw new Error("A path without a straight segment.");
  const tas = straight.length_m / straight.duration_s;
  const air = velocity(tas, point.heading_deg);
  const ground = { x: air.x + wind.x, y: air.y + wind.y };
  const side = segment.kind === "turn" && segment.direction === "left" ? -1 : 1;
  const turning = segment.kind === "turn" ? segment.angle_deg / segment.duration_s : 0;
  return {
    ident,
    x_m: point.x_m,
    y_m: point.y_m,
    heading_deg: point.heading_deg,
    track_deg: wrap360((Math.atan2(ground.x, ground.y) * 180) / Math.PI),
    bank_deg: segment.kind === "turn" ? side * segment.bank_deg : 0,
    turn_rate_degps: side * turning,
    tas_mps: tas,
    ground_speed_mps: Math.hypot(ground.x, ground.y),
    altitude_m: altitude,
  };
}
