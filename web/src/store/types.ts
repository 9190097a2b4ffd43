/** What the display knows of a flight. */

import type { Signal } from "@preact/signals";
import type {
  Alert,
  EngagementChanged,
  ForecastChanged,
  LeaderRoute,
  LinkResult,
  ModeChanged,
  PlanChanged,
  PlanProposed,
  PlanUnavailable,
  PromiseChanged,
  SeparationLost,
  Unable,
} from "../wire";
import type { PairCard, PairSample } from "./pair";
import type { TrailPoint } from "./trail";

/** connecting: no data yet; live; stale: data older than 2 s; lost: no link, or data older than 5 s. */
export type Connection = "connecting" | "live" | "stale" | "lost";
/** The state of the socket, as the stream reports it. */
export type Link = "connecting" | "open" | "closed";

/** One line of the log: what happened, and the flight time [s] it happened at. */
export interface Message {
  readonly t: number;
  readonly kind:
    | "plan"
    | "no_plan"
    | "refused"
    | "leader"
    | "mode"
    | "engagement"
    | "advisory"
    | "caution"
    | "warning"
    | "clear"
    | "unable"
    | "lost"
    | "end";
  readonly text: string;
}

/** What the display knows. Wall-clock instants in ms. */
export interface Flight {
  readonly id: Signal<string | null>;
  readonly started: Signal<PairCard | null>;
  readonly route: Signal<LeaderRoute | null>;
  /** The last plan that was flown: `flownPlan` says whether it still is. */
  readonly plan: Signal<PlanChanged | null>;
  /** The last time of the join that was said anew, until the next plan. */
  readonly promise: Signal<PromiseChanged | null>;
  /** The path that could be flown; null when guidance is engaged, or there is none. */
  readonly proposal: Signal<PlanProposed | null>;
  /** The path that own ship will really fly, whatever its mode. */
  readonly forecast: Signal<ForecastChanged | null>;
  /** The plan before, shown until `until` [ms]. */
  readonly superseded: Signal<{ plan: PlanChanged; until: number } | null>;
  /** Set while the last answer was "no plan". */
  readonly unavailable: Signal<PlanUnavailable | null>;
  /** The alerts that stand: of each subject and other aircraft the newest. */
  readonly alerts: Signal<readonly Alert[]>;
  /** Set when guidance is unable, until the next plan. */
  readonly unable: Signal<Unable | null>;
  /** The last loss of separation. */
  readonly lost: Signal<SeparationLost | null>;
  readonly mode: Signal<ModeChanged | null>;
  /** When the mode last changed [ms]: the new mode is boxed for 10 s. */
  readonly modeSince: Signal<number>;
  /** When the last plan was made, separation was last lost, and it joined [ms]. */
  readonly planSince: Signal<number>;
  readonly lostSince: Signal<number>;
  readonly joinedSince: Signal<number>;
  /** When the separation was last seen below the minimum [ms]. */
  readonly belowSince: Signal<number>;
  /** What the crew last ordered, and what became of it. */
  readonly engagement: Signal<EngagementChanged | null>;
  /** Whether the crew has accepted a path and the service has not answered yet. */
  readonly isSent: Signal<boolean>;
  /** The newest sample that heard of the leader: it is expected to fly on from there. */
  readonly heard: Signal<PairSample | null>;
  /** The newest sample, as it came; of a leader that is not heard of, what is expected. */
  readonly sample: Signal<PairSample | null>;
  /** The newest sample carried on to this animation frame, at most 2 s of wall time ahead. */
  readonly now: Signal<PairSample | null>;
  /** The same for numbers to be read: it changes five times a second. */
  readonly reading: Signal<PairSample | null>;
  /** The time of the view: the wall clock at this animation frame [ms]. */
  readonly wall: Signal<number>;
  /** Flight time at this animation frame [s]. */
  readonly simTime: Signal<number>;
  /** Flight time since the picture was drawn [s]: what moves is carried on by it until the next one. */
  readonly since: Signal<number>;
  /** Wall time since the newest sample arrived [s]; while paused, since the newest tick. */
  readonly dataAge: Signal<number>;
  readonly trail: {
    readonly pursuer: Signal<readonly TrailPoint[]>;
    readonly leader: Signal<readonly TrailPoint[]>;
  };
  readonly ended: Signal<LinkResult | null>;
  readonly clock: Signal<{ rate: number; paused: boolean; ended: boolean }>;
  readonly connection: Signal<Connection>;
  /** Newest first. */
  readonly messages: Signal<readonly Message[]>;
}
