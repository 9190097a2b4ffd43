/**
 * A situation and the answer to it as a flight at its first instant, so that the display draws it as it
 * draws any other: the plan is what is proposed, and nothing has moved yet.
 */

import { batch } from "@preact/signals";
import { pathPointAt, windVector } from "../geometry";
import { NO_MOMENT } from "../store/flight";
import { forecastPoint } from "../store/forecast";
import type { PairCard, PairSample } from "../store/pair";
import type { Flight, Moment, Proposal } from "../store/types";
import { wrap360 } from "../units";
import type {
  AircraftSample,
  FlownCard,
  ForecastChanged,
  LocalLeader,
  OtherPathCard,
  PathPoint,
  PlanAnswer,
  PlanCard,
} from "../wire";
import { leaderRoute, slotNow } from "./leader-route";
import { cellCard } from "./others";
import type { Situation } from "./situation";

const OWN = "OWN";
const LEADER = "LEADER";

/** What was answered to a situation. */
export interface Answered {
  readonly situation: Situation;
  readonly answer: PlanAnswer & { readonly others?: readonly OtherPathCard[] };
}

/** Puts a situation on a flight: with its plan, if the answer to it is there. */
export function showWhatIf(flight: Flight, situation: Situation, answered: Answered | null): void {
  const wind = windVector(situation.wind);
  const segments = leaderRoute(situation, wind);
  const { point, opens } = slotNow(situation, segments, wind);
  const sample = sampleOf(situation, point, opens);
  const answer = answered?.answer ?? null;
  const moment: Moment = {
    ...NO_MOMENT,
    started: cardOf(situation),
    route: {
      kind: "leader_route",
      t_s: 0,
      ident: LEADER,
      expected_by: OWN,
      intent_known: situation.leader.intent.length > 0,
      segments,
    },
    sample,
    now: sample,
    proposal:
      answer?.status === "planned" ? proposalOf(answer, answer.others ?? [], segments, wind) : null,
    unavailable:
      answer?.status === "no_plan"
        ? { kind: "plan_unavailable", t_s: 0, ident: OWN, answer }
        : null,
  };
  batch(() => {
    flight.id.value = "map";
    flight.moment.value = moment;
    flight.read.value = moment;
    flight.clock.value = { rate: 1, paused: true, ended: false };
    flight.connection.value = "live";
  });
}

function cardOf(situation: Situation): PairCard {
  return {
    t_s: 0,
    scenario: "",
    title: "Map",
    planner: "exact",
    pursuer: {
      ident: OWN,
      aircraft_type: "",
      max_bank_deg: situation.pursuer.max_bank_deg,
    },
    leader: { ident: LEADER, aircraft_type: "", max_bank_deg: 0 },
    slot_distance_m: situation.slot_distance_m,
    min_separation_m: situation.min_separation_m,
    spacing: "distance",
    spacing_time_s: 0,
    wind: situation.wind,
    step_s: 0,
    seed: 0,
    others: situation.traffic.map(({ ident }) => ({
      ident,
      aircraft_type: "",
      max_bank_deg: 0,
      follows: "",
    })),
    cells: situation.cells.map(cellCard),
  };
}

function sampleOf(situation: Situation, slot: PathPoint, opens: number): PairSample {
  const { pursuer, leader } = situation;
  const [own, other] = [aircraft(OWN, pursuer, situation), aircraft(LEADER, leader, situation)];
  const [east, north] = [leader.x_m - pursuer.x_m, leader.y_m - pursuer.y_m];
  const separation = Math.hypot(east, north);
  const [v, w] = [ground(pursuer, situation), ground(leader, situation)];
  const closure = separation > 0 ? ((v.x - w.x) * east + (v.y - w.y) * north) / separation : 0;
  return {
    t_s: 0,
    pursuer: own,
    leader: other,
    others: situation.traffic.map((each) => aircraft(each.ident, each, situation)),
    mode: "heading",
    reference: { kind: "hold_heading", heading_deg: pursuer.heading_deg },
    commanded_tas_mps: pursuer.tas_mps,
    separation_m: separation,
    closure_mps: closure,
    least_separation_m: separation,
    slot,
    slot_open: opens === 0,
    spacing_error_m: 0,
    cross_track_m: 0,
    time_to_go_s: 0,
    joined: false,
    alert: "none",
    leader_age_s: 0,
    margin_m: 0,
    engagement: "designated",
  };
}

type Moving = Omit<LocalLeader, "intent">;

function ground({ heading_deg, tas_mps }: Moving, { wind }: Situation): { x: number; y: number } {
  const [psi, air] = [(heading_deg * Math.PI) / 180, windVector(wind)];
  return { x: tas_mps * Math.sin(psi) + air.x, y: tas_mps * Math.cos(psi) + air.y };
}

function aircraft(ident: string, moving: Moving, situation: Situation): AircraftSample {
  const { x, y } = ground(moving, situation);
  return {
    ident,
    x_m: moving.x_m,
    y_m: moving.y_m,
    heading_deg: moving.heading_deg,
    track_deg: wrap360((Math.atan2(x, y) * 180) / Math.PI),
    bank_deg: 0,
    turn_rate_degps: 0,
    tas_mps: moving.tas_mps,
    ground_speed_mps: Math.hypot(x, y),
    altitude_m: levelOf(ident, moving, situation),
  };
}

/** Where a level is not known, what is over own ship is not: that of the two is then one. */
function levelOf(ident: string, { altitude_m }: Moving, { pursuer, leader }: Situation): number {
  const own = pursuer.altitude_m ?? null;
  if (ident === OWN) return own ?? 0;
  if (ident === LEADER) return own === null ? 0 : (leader.altitude_m ?? own);
  return own === null ? Number.NaN : (altitude_m ?? Number.NaN);
}

function proposalOf(
  plan: PlanCard,
  others: readonly OtherPathCard[],
  route: ReturnType<typeof leaderRoute>,
  wind: { x: number; y: number },
): Proposal | null {
  const { flown } = plan;
  if (flown?.status === "flown" && flown.reason !== "")
    return flightOf(plan, flown, others, route, wind);
  const { least_m, at_s } = plan.separation;
  const pursuer = pathPointAt(plan.segments, at_s, wind);
  const leader = pathPointAt(route, at_s, wind);
  if (pursuer === null || leader === null) return null;
  return {
    kind: "plan_proposed",
    t_s: 0,
    ident: OWN,
    message: "",
    plan,
    pursuer_at_closest: pursuer,
    leader_at_closest: leader,
    promised_s: flown?.status === "flown" ? flown.join_s : plan.time_to_converge_s,
    flown_least_m: least_m,
    others: [...others],
  };
}

/** The path that guidance would fly in the place of a plan that no aircraft flies as it is. */
function flightOf(
  ideal: PlanCard,
  card: FlownCard,
  others: readonly OtherPathCard[],
  route: ReturnType<typeof leaderRoute>,
  wind: { x: number; y: number },
): Proposal | null {
  const points = card.points;
  const places = {
    times_s: points.map(({ t_s }) => t_s),
    x_m: points.map(({ x_m }) => x_m),
    y_m: points.map(({ y_m }) => y_m),
    heading_deg: points.map(({ heading_deg }) => heading_deg),
  };
  const leader = pathPointAt(route, card.at_s, wind);
  const first = points[0];
  const time = card.segments.at(-1)?.end.t_s;
  if (leader === null || first === undefined || time === undefined) return null;
  const head = { kind: "forecast_changed", t_s: 0, ident: OWN } as const;
  const ends = { pursuer_at_closest: first, leader_at_closest: leader };
  const flown: ForecastChanged = { ...head, ...places, least_separation_m: card.least_m, ...ends };
  const closest = forecastPoint(flown, card.at_s);
  return {
    kind: "plan_proposed",
    t_s: 0,
    ident: OWN,
    message: "",
    plan: {
      ...ideal,
      word: card.word,
      segments: card.segments,
      time_to_converge_s: time,
      length_m: (ideal.length_m / ideal.time_to_converge_s) * time,
      separation: { ...ideal.separation, least_m: card.least_m, at_s: card.at_s },
    },
    pursuer_at_closest: closest,
    leader_at_closest: leader,
    promised_s: card.join_s,
    flown_least_m: card.least_m,
    others: [...others],
    flown: { ...flown, pursuer_at_closest: closest },
    ideal,
  };
}
