/** What the display knows of a flight: the fold of its documents, one instant of it, and the signals of the page. */

import type { Signal } from "@preact/signals";
import type {
  Alert,
  AssignmentChanged,
  ClearanceNews,
  ControlChanged,
  EngagementChanged,
  FanChanged,
  ForecastChanged,
  LeaderRoute,
  LinkResult,
  ModeChanged,
  PlanCard,
  PlanChanged,
  PlanProposed,
  PlanUnavailable,
  PromiseChanged,
  SeparationLost,
  Tick,
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
    | "clearance"
    | "advisory"
    | "caution"
    | "warning"
    | "clear"
    | "unable"
    | "lost"
    | "end";
  readonly text: string;
}

/** A path that could be flown; on the map also its flight, and the ideal plan that it takes the place of. */
export interface Proposal extends PlanProposed {
  readonly flown?: ForecastChanged;
  readonly ideal?: PlanCard;
}

/** What all documents but the samples say, up to some instant. */
export interface Known {
  readonly started: PairCard | null;
  readonly route: LeaderRoute | null;
  /** The last plan that was flown: `flownPlan` says whether it still is. */
  readonly plan: PlanChanged | null;
  /** The last time of the join that was said anew, until the next plan. */
  readonly promise: PromiseChanged | null;
  /** The path that could be flown; null when guidance is engaged, or there is none. */
  readonly proposal: Proposal | null;
  /** The path that own ship will really fly, whatever its mode. */
  readonly forecast: ForecastChanged | null;
  /** Where it would join if the leader began a turn now; null while its intent is known. */
  readonly fan: FanChanged | null;
  /** The plan before, and the flight time [s] at which another took its place. */
  readonly superseded: { readonly plan: PlanChanged; readonly at: number } | null;
  /** Set while the last answer was "no plan". */
  readonly unavailable: PlanUnavailable | null;
  /** The alerts that stand: of each subject and other aircraft the newest. */
  readonly alerts: readonly Alert[];
  /** Set when guidance is unable, until the next plan. */
  readonly unable: Unable | null;
  /** The last loss of separation. */
  readonly lost: SeparationLost | null;
  readonly mode: ModeChanged | null;
  /** What the crew last ordered, and what became of it. */
  readonly engagement: EngagementChanged | null;
  /** Who flies, as it was last said. */
  readonly control: ControlChanged | null;
  /** What guidance is to do, as the crew last changed it: D and d_min are those of `started`, too. */
  readonly assignment: AssignmentChanged | null;
  /** What air traffic control last said of the manoeuvre that was sent to it. */
  readonly clearance: ClearanceNews | null;
  /** How it went, once it is over. */
  readonly result: LinkResult | null;
  /** Newest first. */
  readonly messages: readonly Message[];
}

/** What the samples say up to some instant. */
export interface Seen {
  /** The newest sample, as it came; of a leader that is not heard of, what is expected. */
  readonly sample: PairSample | null;
  /** The sample of a while ago: what has changed since is news. */
  readonly before: PairSample | null;
  /** Since when it has joined, and when the minimum was last infringed [s, flight time]. */
  readonly joinedAt: number;
  readonly belowAt: number;
  /** How fast each aircraft climbs [m/s], by ident. */
  readonly climbs: ReadonlyMap<string, number>;
  readonly trail: {
    readonly pursuer: readonly TrailPoint[];
    readonly leader: readonly TrailPoint[];
  };
}

/** A flight at one instant: all that its picture and numbers are made of. */
export interface Moment extends Known, Seen {
  /** Flight time [s]. */
  readonly t: number;
  /** The newest sample carried on to `t`. */
  readonly now: PairSample | null;
  /** Seconds of flight in a second of the viewer: what is shown for a while is shown for two of these. */
  readonly rate: number;
  /** Wall time since the newest sample arrived [s]; 0 of what is replayed. */
  readonly dataAge: number;
  /** Whether it is over, so that nothing moves any more. */
  readonly ended: boolean;
  /** Whether the crew has accepted a path and the service has not answered yet. */
  readonly isSent: boolean;
}

/**
 * Whose time is shown: `live`, the newest there is; `replay`, any other, `rate` seconds of flight in a
 * second, 0 while it stands.
 */
type Source = { readonly kind: "live" } | { readonly kind: "replay"; readonly rate: number };

/** The signals of a flight on the page. */
export interface Flight {
  readonly id: Signal<string | null>;
  /** The instant whose picture is drawn. */
  readonly moment: Signal<Moment>;
  /** The newest tick, as soon as it is there, and when that was [wall ms]: what is flown by hand shows it. */
  readonly heard: Signal<{ readonly tick: Tick; readonly wall: number } | null>;
  /** The same for numbers to be read: it changes five times a second. */
  readonly read: Signal<Moment>;
  /** Flight time since the picture was drawn [s]: what moves is carried on by it until the next one. */
  readonly since: Signal<number>;
  readonly source: Signal<Source>;
  /** First and last flight time that can be shown [s]; null before the first sample. */
  readonly span: Signal<{ readonly first: number; readonly last: number } | null>;
  /** Changes whenever more is known of the flight: what is drawn over time is drawn anew. */
  readonly revision: Signal<number>;
  /** The part of the flight that is shown again and again; null for none [s, flight time]. */
  readonly loop: Signal<{ readonly from: number; readonly to: number } | null>;
  /** What the server says of its clock; of a recording, that it has ended. */
  readonly clock: Signal<{
    readonly rate: number;
    readonly paused: boolean;
    readonly ended: boolean;
  }>;
  readonly connection: Signal<Connection>;
  /** Whether the crew has accepted a path and the service has not answered yet. */
  readonly isSent: Signal<boolean>;
}
