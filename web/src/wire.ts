// Made by `python -m tools.emit_types` from relguide/contract: do not edit.

/** Sub-protocol of the stream: a server of another version refuses it. */
export const PROTOCOL = "relguide-eab1000f38f8";

/** Which way round. */
export type Direction = "left" | "right";

/**
 * heading: no plan, a heading is held; converge: the plan is flown; capture: closes onto
 * the leader's route under speed control; follow: on the route D behind the leader, at
 * its speed; escape: turns away, as the separation would be lost on what was flown.
 */
export type Mode = "heading" | "converge" | "capture" | "follow" | "escape";

/**
 * off: nobody is to be joined; designated: paths to the leader's slot are proposed; armed:
 * the proposal is accepted, and waits; engaged: guidance flies.
 */
export type Engagement = "off" | "designated" | "armed" | "engaged";

/** Why a plan is optimal. */
export type Proof = "relaxation" | "certified" | "bound" | "none";

/** Why a new plan was made. */
export type PlanReason =
  | "engaged"
  | "resumed"
  | "better_plan"
  | "deviation"
  | "separation"
  | "leader_turned"
  | "leader_changed_speed"
  | "leader_elsewhere"
  | "intent_received"
  | "intent_withdrawn"
  | "braking"
  | "traffic"
  | "assignment_changed";

/** What is new about the leader. */
export type LeaderChange =
  | "heading"
  | "speed"
  | "level"
  | "intent_received"
  | "intent_withdrawn"
  | "intent_broken";

/** What became of a manoeuvre that was sent to air traffic control. */
export type ClearanceStatus =
  | "sent"
  | "standby"
  | "validated"
  | "unable"
  | "wilco"
  | "flying"
  | "deviating"
  | "over";

/** What a link keeps once joined: a distance, or a time. */
export type Spacing = "distance" | "time";

/** advisory: to be known; caution: to be seen to at once; warning: to be acted upon at once. */
export type AlertLevel = "advisory" | "caution" | "warning";

/** The highest level among the alerts that stand. */
export type AlertState = "none" | "advisory" | "caution" | "warning";

/** What an alert is about. */
export type AlertSubject = "separation" | "spacing" | "speed" | "data" | "geometry";

/** Why guidance cannot do what it is to do. */
export type UnableReason = "separation" | "speed" | "geometry" | "envelope" | "data" | "traffic";

/** A planner that is compared with others. */
export type ComparedPlanner = "exact" | "network" | "regular_dp" | "printed_network";

/** Whether a planner's own path may be flown. */
export type Verdict = "planned" | "refused" | "handed_over" | "no_plan" | "preparing";

/** What is wrong with a planner's plan. */
export type Fault =
  | "no_answer"
  | "start"
  | "bank"
  | "slot"
  | "heading"
  | "too_early"
  | "level"
  | "separation";

/** Why there is no plan. */
export type Reason =
  | "slot_unreachable"
  | "separation_already_lost"
  | "separation_unavoidable"
  | "beyond_horizon"
  | "deadline"
  | "traffic"
  | "level";

/** A piece of a path over the ground. */
export type PathSegment = TurnSegment | StraightSegment | BoundarySegment;

/** Another path to the slot, and why it is not flown. */
export type Alternative =
  | AlternativeCard
  | UnsafeAlternativeCard
  | EarlyAlternativeCard
  | MissingAlternativeCard;

/** What guidance asks of the autopilot. */
export type ReferenceCard = HeadingReference | TurnRateReference;

/** A document of a flight. */
export type Document =
  | FlightStarted
  | LeaderRoute
  | LeaderChanged
  | PlanChanged
  | PlanProposed
  | EngagementChanged
  | CommandGiven
  | ControlChanged
  | AssignmentChanged
  | ClearanceNews
  | PlanUnavailable
  | PlanRefused
  | ModeChanged
  | PromiseChanged
  | Alert
  | Unable
  | SeparationLost
  | ForecastChanged
  | FanChanged
  | Sample
  | FlightEnded;

/** The answer to a situation. */
export type PlanAnswer = PlanCard | NoPlanCard;

/** A piece of the leader's intent. */
export type IntentPiece = StraightPiece | TurnPiece | LevelChangePiece;

/** A request for a new flight. */
export type FlightRequest = ScenarioFlightRequest | SituationFlightRequest;

/** What a crew orders, and when. */
export type CrewOrderLine =
  | EngagementOrder
  | PursuerHeadingOrder
  | PursuerBankOrder
  | PursuerSpeedOrder
  | SpacingOrder
  | AutopilotOrder
  | DirectorOrder
  | StickOrder
  | LeaderDataOrder;

/** An order at a flight time. */
export type OrderLine =
  | HeadingOrder
  | SpeedOrder
  | LevelOrder
  | ReportOrder
  | IntentOrder
  | CrewOrderLine;

/** A command to a flight. */
export type Command =
  | PlayCommand
  | PauseCommand
  | SetRateCommand
  | LeaderHeadingCommand
  | LeaderSpeedCommand
  | LeaderLevelCommand
  | LeaderReportCommand
  | IntentKnownCommand
  | LeaderDataCommand
  | PursuerHeadingCommand
  | PursuerBankCommand
  | PursuerSpeedCommand
  | SetSpacingCommand
  | SetEngagementCommand
  | SetAutopilotCommand
  | SetDirectorCommand
  | StickCommand;

/** What a client may send up a flight's stream. */
export type Upstream = TakeControl | StickMove | GiveBack;

/** Who brings a clearance from one state to another. */
export type Actor = "crew" | "controller" | "service";

/** How far a clearance has come. */
export type ClearanceState =
  | "requested"
  | "validating"
  | "accepted"
  | "unable"
  | "standby"
  | "wilco"
  | "flying"
  | "flown"
  | "cancelled"
  | "expired"
  | "superseded"
  | "deviated"
  | "terminated";

/** What automation finds of a manoeuvre. */
export type ValidationVerdict = "acceptable" | "unable" | "standby";

/** Why a manoeuvre is not acceptable, or a clearance ends. */
export type ReasonCode =
  | "separation"
  | "airspace"
  | "bank"
  | "speed"
  | "leader_disagrees"
  | "traffic_without_intent"
  | "stale_picture"
  | "expired"
  | "horizon"
  | "slot_taken"
  | "conformance"
  | "crew"
  | "controller";

/** In what an aircraft is not where it is cleared to be. */
export type DeviationKind = "across" | "along" | "spacing" | "level" | "turn";

/** How far. */
export type DeviationLevel = "none" | "caution" | "alert";

/** What is kept behind the traffic. */
export type SpacingGoal = DistanceGoal | TimeGoal;

/** A request for a clearance. */
export type ClearanceRequest = FlightClearanceRequest | IntentClearanceRequest;

/** What the controllers' stream brings. */
export type AtcDocument =
  | ClearanceChanged
  | TrafficSeen
  | ProbeChanged
  | ConformanceChanged
  | Expired;

/** The air as it is, or as it is believed to be. */
export interface AirBody {
  wind?: WindBody | null;
  profile?: WindLevelBody[] | null;
  gusts_mps?: number;
  isa_deviation_k?: number;
}

/** Who an aircraft is. */
export interface AircraftCard {
  /** Its name in all documents of the flight. */
  ident: string;
  aircraft_type: string;
  max_bank_deg: number;
  /**
   * Most that its autopilot banks, to stay on a path that turns at the bank above; left out of an
   * aircraft that is not guided, and in older recordings.
   */
  autopilot_bank_deg?: number;
}

/** One aircraft at one instant, as it flies (roll dynamics included). */
export interface AircraftSample {
  ident: string;
  x_m: number;
  y_m: number;
  heading_deg: number;
  /** Direction of the ground velocity. */
  track_deg: number;
  /** Positive right wing down. */
  bank_deg: number;
  /** Positive to the right. */
  turn_rate_degps: number;
  tas_mps: number;
  ground_speed_mps: number;
  altitude_m: number;
  /** WGS84; there if the situation came with latitudes. */
  lat_deg?: number;
  /** WGS84; there if the situation came with latitudes. */
  lon_deg?: number;
}

/** A closed part of the sky. */
export interface AirspaceCard {
  ident: string;
  x_m: number[];
  y_m: number[];
  /** Its levels and times, e.g. FL200–FL310 until 14:30. */
  text: string;
  /** Whether it is closed now. */
  closed: boolean;
  /** WGS84; there if the situation came with latitudes. */
  lat_deg?: number[];
  /** WGS84; there if the situation came with latitudes. */
  lon_deg?: number[];
}

/**
 * Something a crew has to know of, or that it need no longer know of.
 *
 * One is given when its subject's level rises or falls, not each second that it stands.
 */
export interface Alert {
  kind: "alert";
  /** Flight time [s]. */
  t_s: number;
  /** The aircraft whose crew is alerted. */
  ident: string;
  /** The aircraft that it is about, which need not be the leader. */
  other: string;
  /** Of the alert that begins or, when cleared, ends. */
  level: AlertLevel;
  subject: AlertSubject;
  message: string;
  /** Least separation from the other ahead, flying on as now [m]. */
  predicted_least_m: number;
  /** Flight time at which the minimum is lost or, where it is kept, the least comes [s]. */
  predicted_at_s: number;
  /** Whether the alert ends: nothing stands on this subject any more. */
  cleared: boolean;
}

/**
 * Another path to the slot that lost because it is no faster.
 *
 * `as_fast`: it arrives with the plan. `faster`: it keeps the limit and was not found, which only
 * a planner that is not exact lets happen.
 */
export interface AlternativeCard {
  /** Its letters, e.g. `LSR`: L and R are turns, S a straight, B slides along d_min. */
  word: string;
  /** When the pursuer is at the slot, on the leader's heading. */
  time_to_converge_s: number;
  /** How much it turns in all, left and right added. */
  turning_deg: number;
  /** Whether it crosses the line ahead of the leader on its final leg. */
  passes: "behind" | "ahead";
  /** How it goes round the leader: left is counter-clockwise, with the leader on its left hand. */
  side: Direction;
  /** Why it is not flown, e.g. `38 s slower`. */
  why: string;
  /** Why, in a word. */
  rejected: "slower" | "as_fast" | "faster";
}

/** A manoeuvre that is acceptable, tried as the one that was asked for was. */
export interface AlternativeManoeuvre {
  /** What is different. */
  change: "later" | "word" | "spacing" | "level";
  /** In a sentence. */
  message: string;
  /** How much later it begins. */
  begins_s: number;
  /** Letters of its plan. */
  word: string;
  /** D. */
  spacing_m: number;
  /** When it is in its place. */
  joins_s: number;
  /** How near it comes to any aircraft but its leader. */
  least_m: number;
  /** What is flown. */
  route: TrackCard;
}

/** A convergence area: lines of equal time-to-converge, and regions of equal word. */
export interface AreaAnswer {
  grid: AreaGrid;
  pursuer_heading_deg: number;
  levels_s: number[];
  contours: AreaContour[];
  regions: AreaRegion[];
  count: AreaCount;
  notes: string[];
  compute_ms: number;
  times_s?: (number | null)[][] | null;
  lower_bounds_s?: (number | null)[][] | null;
}

/** The places from which the time-to-converge is equal to a level. */
export interface AreaContour {
  level_s: number;
  lines: number[][][];
}

/** How many nodes of the grid have each kind of answer. */
export interface AreaCount {
  proved: number;
  limited: number;
  no_plan: number;
}

/** Where the pursuer was put: the nodes of a rectangle with sides toward east and north. */
export interface AreaGrid {
  x_m: number;
  y_m: number;
  width_m: number;
  height_m: number;
  columns: number;
  rows: number;
}

/** A region with one word as its answer. */
export interface AreaRegion {
  word: string;
  limited: boolean;
  polygons: number[][][][];
}

/** Whose convergence area is asked for, and on which grid: either a flight or a situation. */
export interface AreaRequest {
  flight?: string | null;
  situation?: SituationBody | null;
  x_m?: number | null;
  y_m?: number | null;
  width_m?: number;
  height_m?: number;
  columns?: number;
  rows?: number;
  levels_s?: number[];
  exact?: boolean;
  planner?: "exact" | "network";
  times?: boolean;
}

/** How a plan's end meets eq. (7): the pursuer at the slot, on the leader's heading, it open. */
export interface ArrivalCard {
  /** Distance from the slot when the plan ends. */
  slot_error_m: number;
  /** Between its last heading and the leader's final one. */
  heading_error_deg: number;
  /** How long before the slot opens it ends; 0 if the slot is open then. */
  early_s: number;
}

/** The crew has changed what its guidance is to do; or what it ordered could not be done. */
export interface AssignmentChanged {
  kind: "assignment_changed";
  /** Flight time [s]. */
  t_s: number;
  /** The pursuer's. */
  ident: string;
  /** D from now on. */
  slot_distance_m: number;
  /** d_min from now on. */
  min_separation_m: number;
  /** What plans turn with from now on. */
  max_bank_deg: number;
  /** The speed that the crew has selected; none while guidance sets the speed. */
  selected_tas_mps: number[];
  message: string;
}

/** A frame of the controllers' stream: what happened since the last one, in order. */
export interface AtcFrame {
  kind: "atc";
  number: number;
  snapshot: boolean;
  documents: AtcDocument[];
}

/** The crew takes control from the autopilot, or gives it back. */
export interface AutopilotOrder {
  t_s?: number;
  on?:
    | "start"
    | "proposed"
    | "designated"
    | "armed"
    | "engaged"
    | "off"
    | "new_plan"
    | "converge"
    | "capture"
    | "follow"
    | "escape"
    | "unable"
    | "data_lost"
    | "alert";
  after_s?: number;
  ident?: string;
  autopilot: boolean;
}

/** The flight director's bars at one instant: what is commanded less what is flown. */
export interface Bars {
  /** Commanded bank less bank, smoothed over half a second: positive asks to roll right. */
  roll_deg: number;
  /** Commanded flight path angle less the one flown: positive asks to pull up. */
  pitch_deg: number;
  /** What the autopilot would go for, or does, positive right wing down. */
  commanded_bank_deg: number;
  /** The same of the rate of climb. */
  commanded_climb_mps: number;
}

/** A segment flown along d = d_min at partial bank. */
export interface BoundaryArcCard {
  /** When it begins. */
  start_s: number;
  /** When it ends. */
  end_s: number;
  /** Least μ on it; 0 or more by eq. (10). */
  least_multiplier_per_m: number;
}

/** A boundary arc along d = d_min with less than full bank. */
export interface BoundarySegment {
  /** A boundary arc. */
  kind: "boundary";
  /** The side it turns to: left boundary arcs counter-clockwise round the leader. */
  side: Direction;
  /** How long it takes. */
  duration_s: number;
  /** Where it begins. */
  start: PathPoint;
  /** Where it ends. */
  end: PathPoint;
  /** Points between, close enough to draw straight lines. */
  via: PathPoint[];
}

/**
 * A weather cell: all places no farther than `radius` from the convex hull of its corners.
 *
 * A disc has one corner, its middle; a polygon has radius 0. Given as it is at t = 0, in columns
 * of equal length; it moves over the ground, and its radius grows.
 */
export interface CellCard {
  /** Its name in all documents of the flight. */
  ident: string;
  /** Of its corners, counter-clockwise, east. */
  x_m: number[];
  /** … and north. */
  y_m: number[];
  radius_m: number;
  /** How fast it moves toward the east. */
  east_mps: number;
  /** … and toward the north. */
  north_mps: number;
  /** How fast its radius grows. */
  growth_mps: number;
  /** WGS84; there if the situation came with latitudes. */
  lat_deg?: number[];
  /** WGS84; there if the situation came with latitudes. */
  lon_deg?: number[];
}

/** What the controller says to a request, or does with a clearance. */
export interface ClearanceAnswer {
  answer: "accepted" | "unable" | "standby" | "cancelled" | "terminated";
  reason?:
    | "separation"
    | "airspace"
    | "bank"
    | "speed"
    | "leader_disagrees"
    | "traffic_without_intent"
    | "stale_picture"
    | "expired"
    | "horizon"
    | "slot_taken"
    | "conformance"
    | "crew"
    | "controller"
    | "";
  message?: string;
}

/** A clearance: what is asked for, what automation finds, what was answered. */
export interface ClearanceCard {
  /** To ask for it by. */
  id: string;
  /** Empty: the one on the earth; else the flight whose sky it is. */
  sky: string;
  /** The flight that flies it, if it is one of this service. */
  flight_id?: string;
  /** What is asked for. */
  clearance_type: "capture_then_maintain";
  /** Who asks. */
  aircraft: string;
  /** Behind whom. */
  traffic_id: string;
  /** What is kept behind the traffic. */
  spacing_type: Spacing;
  /** D; 0 with spacing by time. */
  slot_distance_m: number;
  /** Time behind the leader; 0 with spacing by distance. */
  spacing_time_s: number;
  /** From the leader. */
  min_separation_m: number;
  /** Letters of the plan; empty where they are not known. */
  word: string;
  /** The request in the words of data link. */
  text: string;
  /** How far it has come. */
  state: ClearanceState;
  /** When it expires if nothing happens; 0 where nothing expires. */
  due_s: number;
  /** When it is in its place. */
  joins_s: number;
  /** What is to be flown. */
  route: TrackCard;
  /** What its traffic is expected to fly. */
  leader_route: TrackCard;
  /** That its turns need; left out where it is not known. */
  bank_deg?: number;
  /** That the aircraft has; left out where it is not known. */
  max_bank_deg?: number;
  /** The last one; none before the first. */
  validation: ValidationCard[];
  /** Those that stand now. */
  deviations: Deviation[];
  /** Oldest first. */
  history: StateChange[];
  /** Whether the automation answers in the controller's place, as in a demonstration. */
  auto_answer: boolean;
}

/** A clearance is new, or something of it is. */
export interface ClearanceChanged {
  kind: "clearance_changed";
  t_s: number;
  clearance: ClearanceCard;
}

/** Clearances. */
export interface ClearanceList {
  clearances: ClearanceCard[];
}

/**
 * What air traffic control says of the manoeuvre that a crew has sent it.
 *
 * It comes from outside the flight, which flies the same without it.
 */
export interface ClearanceNews {
  kind: "clearance_news";
  /** Flight time [s]. */
  t_s: number;
  /** The pursuer's. */
  ident: string;
  clearance_id: string;
  clearance: ClearanceStatus;
  /** caution: something is to be seen to; warning: it is no longer cleared, or far off its path. */
  level: AlertState;
  /** Why, in a word: `separation`, `airspace`, `across` …; left out where nothing is wrong. */
  reason?: string;
  /** In a sentence. */
  message: string;
  /** Whether the automation answered in the controller's place. */
  automated: boolean;
}

/** What the crew says to its clearance. */
export interface ClearanceReply {
  reply: "WILCO" | "UNABLE" | "CANCEL";
  message?: string;
}

/** What a request would be found to be; nothing is kept of it. */
export interface ClearanceTrial {
  text: string;
  joins_s: number;
  route: TrackCard;
  leader_route: TrackCard;
  validation: ValidationCard;
}

/** How near a pursuer came to one other aircraft, or to the edge of a cell. */
export interface ClosestOther {
  ident: string;
  /** The least; negative inside a cell. */
  separation_m: number;
  /** When. */
  t_s: number;
  /** What was to be kept; 0 for a cell. */
  min_separation_m: number;
}

/**
 * An aircraft is ordered to do something, by its crew or by others.
 *
 * A flight is flown again to the bit from its scenario, its seed and these.
 */
export interface CommandGiven {
  kind: "command_given";
  /** Flight time [s]. */
  t_s: number;
  command:
    | LeaderHeading
    | LeaderSpeed
    | LeaderLevel
    | LeaderReport
    | IntentKnown
    | LeaderData
    | PursuerHeading
    | PursuerBank
    | PursuerSpeed
    | SetSpacing
    | SetEngagement
    | SetAutopilot
    | SetDirector
    | Stick;
}

/** What the best path that was found comes too close to. */
export interface ConflictCard {
  /** Of other traffic, or of a cell. */
  ident: string;
  /** When it is nearest. */
  at_s: number;
  /** How near it comes; negative inside a cell. */
  least_m: number;
  /** What is to be kept; 0 of a cell. */
  min_separation_m: number;
}

/** A deviation begins, changes its level, or ends. */
export interface ConformanceChanged {
  kind: "conformance";
  t_s: number;
  /** The clearance. */
  id: string;
  aircraft: string;
  /** All that stand now. */
  deviations: Deviation[];
  message: string;
}

/** A contact with d = d_min, or the beginning or end of a boundary arc. */
export interface ContactCard {
  /** When. */
  t_s: number;
  /** From pursuer to leader, clockwise from north, in [−180°, 180°]. */
  bearing_deg: number;
  /** By how much λ_d rises there; 0 or more along a minimum. */
  jump_s_per_m: number;
  /** Of other traffic that is touched. Left out for the leader. */
  ident?: string;
}

/** A frame to the one client that has asked for control, or has had it. */
export interface ControlAnswer {
  kind: "control";
  yours: boolean;
  message: string;
}

/**
 * The crew has taken control or given it back, or switched the flight director; or could not.
 *
 * Guidance goes on in all cases: the autopilot follows it, or the crew does.
 */
export interface ControlChanged {
  kind: "control_changed";
  /** Flight time [s]. */
  t_s: number;
  /** The pursuer's. */
  ident: string;
  /** Whether the autopilot flies now. */
  autopilot: boolean;
  /** Whether the flight director is on now. */
  director: boolean;
  message: string;
}

/**
 * H, the switching function and the costates along a plan, in columns of equal length.
 *
 * The ends of segments and the contacts with d_min appear twice, with the values before and after:
 * columns may jump there. Between two different times they are smooth.
 */
export interface CostatesCard {
  /** Ascending. */
  t_s: number[];
  /** H of eq. (9): 0 once the leader has no turn to come; 1 if it arrives as the slot opens. */
  hamiltonian: number[];
  /** λ_ψ, eq. (16): above 0 the pursuer turns left, below 0 right, at 0 it flies straight. */
  switching_s_per_deg: number[];
  /** λ_d; it jumps at contacts with d_min. */
  separation_costate_s_per_m: number[];
  /** λ_θ. */
  bearing_costate_s_per_deg: number[];
}

/** How far an aircraft is from what it is cleared to fly, of one kind. */
export interface Deviation {
  /** In what. */
  subject: DeviationKind;
  /** How far. */
  level: DeviationLevel;
  /** Beside the path, from D, from the level [m]; before or behind [s]; of a turn how late [s]. */
  amount: number;
  /** Of the amount. */
  unit: "m" | "s";
  /** Since when it is at this level or above. */
  since_s: number;
  /** In a sentence. */
  message: string;
}

/** The crew switches the flight director. */
export interface DirectorOrder {
  t_s?: number;
  on?:
    | "start"
    | "proposed"
    | "designated"
    | "armed"
    | "engaged"
    | "off"
    | "new_plan"
    | "converge"
    | "capture"
    | "follow"
    | "escape"
    | "unable"
    | "data_lost"
    | "alert";
  after_s?: number;
  ident?: string;
  director: boolean;
}

/** A round weather cell at all levels, to be kept out of. */
export interface DiscCell {
  ident: string;
  disc: LocalDisc | GeodeticDisc;
  velocity_mps?: number[];
  growth_mps?: number;
}

/** A distance to keep behind the traffic. */
export interface DistanceGoal {
  type: "distance";
  value_m: number;
}

/** A word that reaches the place of the slot before it opens. */
export interface EarlyAlternativeCard {
  /** Its letters, e.g. `LSR`: L and R are turns, S a straight, B slides along d_min. */
  word: string;
  /** When it is there. */
  time_to_converge_s: number;
  /** When the slot opens. */
  release_time_s: number;
  /** Why it is not flown. */
  why: string;
  /** The slot is not open then. */
  rejected: "not_open";
}

/** The crew has engaged guidance further, or less far; or what it ordered could not be done. */
export interface EngagementChanged {
  kind: "engagement_changed";
  /** Flight time [s]. */
  t_s: number;
  /** The pursuer's. */
  ident: string;
  engagement: Engagement;
  /** The same, if the order was refused. */
  previous: Engagement;
  message: string;
}

/** The crew designates the leader, accepts what is proposed, engages it, or disconnects. */
export interface EngagementOrder {
  t_s?: number;
  on?:
    | "start"
    | "proposed"
    | "designated"
    | "armed"
    | "engaged"
    | "off"
    | "new_plan"
    | "converge"
    | "capture"
    | "follow"
    | "escape"
    | "unable"
    | "data_lost"
    | "alert";
  after_s?: number;
  ident?: string;
  engagement: Engagement;
}

/** A clearance was not answered, or not begun, in time. */
export interface Expired {
  kind: "expired";
  t_s: number;
  /** The clearance. */
  id: string;
  message: string;
}

/**
 * Where a pursuer would join after turns that its leader may begin and has not announced.
 *
 * Said to viewers, while the leader's intent is not known and a path is proposed or
 * flown. What is saved is how much sooner it joins if it knows of a turn a minute before it begins
 * than if it learns of it as it begins; both are forecast by flying the closed loop ahead.
 */
export interface FanChanged {
  kind: "fan_changed";
  /** Flight time [s]. */
  t_s: number;
  /** The pursuer's. */
  ident: string;
  /**
   * For turns of −30°, −20° … 30°; those after which there is no path are left out. None at all
   * once the intent is known, or the pursuer has joined: the fan is closed.
   */
  joins: FanJoin[];
  /** By knowing the turn for which that saves the most [s]; 0 where nothing is saved. */
  most_saved_s: number;
  /** On average of all these turns [s]. */
  mean_saved_s: number;
}

/** Where a pursuer would join if its leader began a turn now. */
export interface FanJoin {
  /** To the right of where the leader flies now; negative to the left. */
  turn_deg: number;
  /** When, flight time. */
  joins_s: number;
  /** East. */
  x_m: number;
  /** North. */
  y_m: number;
  /** Least separation on the way, as forecast. */
  least_m: number;
  /** WGS84; there if the situation came with latitudes. */
  lat_deg?: number;
  /** WGS84; there if the situation came with latitudes. */
  lon_deg?: number;
}

/** Why a manoeuvre is not acceptable. */
export interface Finding {
  /** In a word. */
  reason: ReasonCode;
  /** In the words of data link, e.g. UNABLE DUE TO TRAFFIC BAW12. */
  text: string;
  /** In a sentence, with what would help. */
  message: string;
  /** Of the aircraft or airspaces that it is about. */
  idents?: string[];
}

/** A flight of this service asks for what its guidance flies or proposes. */
export interface FlightClearanceRequest {
  flight_id: string;
  aircraft?: string;
  clearance_type?: "capture_then_maintain";
}

/** How the flight went: the last document. */
export interface FlightEnded {
  kind: "flight_ended";
  /** Flight time [s]. */
  t_s: number;
  reason: "joined" | "time_over" | "recording_over" | "plane_left";
  /** The same in a sentence. */
  message: string;
  /** In the order of `FlightStarted.links`. */
  results: LinkResult[];
}

/** All flights. */
export interface FlightList {
  flights: FlightStatus[];
  missing?: string[];
}

/** All that is known before the flight: the first document. */
export interface FlightStarted {
  kind: "flight_started";
  /** Flight time [s]. */
  t_s: number;
  scenario: string;
  title: string;
  /** Who makes the plans, as in `PlanCard`. */
  planner: string;
  /** All that fly, each with an ident of its own. */
  aircraft: AircraftCard[];
  /** Who is to join whom. Displays for one pair show the first. */
  links: LinkCard[];
  wind: WindCard;
  /** Integration step [s]. */
  step_s: number;
  seed: number;
  /** Weather to be kept out of. */
  cells?: CellCard[];
}

/** Where a flight stands. */
export interface FlightStatus {
  id: string;
  scenario: string;
  title: string;
  t_s: number;
  rate: number;
  paused: boolean;
  ended: boolean;
  outcome: "" | "broken" | "stopped" | "joined" | "time_over" | "recording_over" | "plane_left";
  started_at: string;
  mode: Mode;
  engagement: Engagement;
  joined: boolean;
  separation_m: number;
  stream_url: string;
  scene_url: string;
  seed: number;
  version: string;
  recorded: boolean;
}

/** How a crew flew by hand. */
export interface FlownByHand {
  /** For how long. */
  time_s: number;
  /** … of that with the flight director's bars in view … */
  with_bars_s: number;
  /** … and of that with the bank within 2° of the commanded one. */
  within_bar_s: number;
  /** Largest distance beside the path of the plan that was flown. */
  tube_m: number;
}

/** The flight of a plan's situation, guidance engaged at once: rolls and braking included. */
export interface FlownCard {
  /** It joins. */
  status: "flown";
  /** When it has joined, from the situation on. */
  join_s: number;
  /** How close it comes until then. */
  least_m: number;
  /** When it is closest. */
  at_s: number;
  /** Of the path that guidance flies: it may be another than the plan's. */
  word: string;
  /** Why it takes another time than the plan, in sentences; empty if it does not. */
  reason: string;
  /** What guidance plans to fly: straight until it can turn, and without rolls and braking. */
  segments: PathSegment[];
  /** Where it goes, until it has joined: to be drawn with straight lines between them. */
  points: FlownPoint[];
}

/** A place along a path as an aircraft will fly it, over the ground. */
export interface FlownPoint {
  /** From the beginning of the path. */
  t_s: number;
  /** East. */
  x_m: number;
  /** North. */
  y_m: number;
  /** Where the nose points. */
  heading_deg: number;
  /** True airspeed. */
  tas_mps: number;
  /** WGS84; there if the situation came with latitudes. */
  lat_deg?: number;
  /** WGS84; there if the situation came with latitudes. */
  lon_deg?: number;
}

/** A situation to be flown. */
export interface FlownSituationBody {
  pursuer: LocalPursuer | GeodeticPursuer;
  leader: LocalLeader | GeodeticLeader;
  slot_distance_m: number;
  min_separation_m: number;
  wind?: WindBody;
  traffic?: (LocalTraffic | GeodeticTraffic)[];
  cells?: (DiscCell | PolygonCell)[];
  id?: string | number;
  pursuer_ident?: string;
  leader_ident?: string;
  air?: AirBody | null;
  believed_air?: AirBody | null;
  surveillance?: SurveillanceBody | null;
  ahead?: (LocalFollower | GeodeticFollower)[];
  followers?: (LocalFollower | GeodeticFollower)[];
}

/**
 * The path that an aircraft will really fly: the closed loop flown ahead, without planning.
 *
 * Columns of equal length; points close enough to draw straight lines between.
 */
export interface ForecastChanged {
  kind: "forecast_changed";
  /** Flight time [s]. */
  t_s: number;
  ident: string;
  /** Flight times, ascending [s]. */
  times_s: number[];
  /** East of each point [m]. */
  x_m: number[];
  /** North of each point [m]. */
  y_m: number[];
  /** Clockwise from north at each point: radians in Python, degrees in JSON. */
  heading_deg: number[];
  /** From its leader on the way [m], the leader flying as expected. */
  least_separation_m: number;
  /** Where the aircraft is when the separation is least. */
  pursuer_at_closest: PathPoint;
  /** Where its leader is then. */
  leader_at_closest: PathPoint;
  /**
   * How far to either side of the line it may come at each point [m], by what is not certain of
   * the leader's track and of the wind (2 σ of what is believed now); none where all is exact.
   */
  aside_m?: number[];
  /** WGS84; there if the situation came with latitudes. */
  lat_deg?: number[];
  /** WGS84; there if the situation came with latitudes. */
  lon_deg?: number[];
}

/** Who asks, now, placed on the earth (WGS84). */
export interface GeodeticAircraft {
  ident: string;
  lat_deg: number;
  lon_deg: number;
  heading_deg: number;
  tas_mps: number;
  max_bank_deg: number;
  altitude_m?: number | null;
}

/** A corner of a cell, placed on the earth (WGS84). */
export interface GeodeticCorner {
  lat_deg: number;
  lon_deg: number;
}

/** A round cell, at t = 0, placed on the earth (WGS84). */
export interface GeodeticDisc {
  lat_deg: number;
  lon_deg: number;
  radius_m: number;
}

/** A guided aircraft of a queue, at t = 0, placed on the earth (WGS84). */
export interface GeodeticFollower {
  ident: string;
  lat_deg: number;
  lon_deg: number;
  heading_deg: number;
  tas_mps: number;
  max_bank_deg: number;
}

/** The aircraft to be joined, at t = 0, placed on the earth (WGS84). */
export interface GeodeticLeader {
  lat_deg: number;
  lon_deg: number;
  heading_deg: number;
  tas_mps: number;
  intent?: IntentPiece[];
  altitude_m?: number | null;
}

/** The aircraft that is guided, at t = 0, placed on the earth (WGS84). */
export interface GeodeticPursuer {
  lat_deg: number;
  lon_deg: number;
  heading_deg: number;
  tas_mps: number;
  max_bank_deg: number;
  altitude_m?: number | null;
  levels?: PlannedLevel[];
}

/** Another aircraft, at t = 0, placed on the earth (WGS84): to be kept clear of. */
export interface GeodeticTraffic {
  ident: string;
  lat_deg: number;
  lon_deg: number;
  heading_deg: number;
  tas_mps: number;
  altitude_m?: number | null;
  intent?: IntentPiece[];
  min_separation_m?: number | null;
}

/** Give control back to the autopilot. */
export interface GiveBack {
  kind: "give_back";
}

/** What the guidance of one pursuer does at one instant, and how it stands to its leader. */
export interface GuidanceSample {
  /** The pursuer's. */
  ident: string;
  /** Its leader's ident. */
  leader: string;
  mode: Mode;
  reference: ReferenceCard;
  /** What guidance asks of the autothrust. */
  commanded_tas_mps: number;
  separation_m: number;
  /** Rate at which the separation shrinks, positive when closing. */
  closure_mps: number;
  /** Least separation so far. */
  least_separation_m: number;
  /** The slot now (with turns to come: on the backward extension of the leader's final leg). */
  slot: PathPoint;
  slot_open: boolean;
  /** Distance still to close along the leader's route to be at D: positive when too far behind. */
  spacing_error_m: number;
  /** Offset from the leader's final route, positive to its right. */
  cross_track_m: number;
  /** Until the slot is reached by the plan flown; 0 when there is none or it is joined. */
  time_to_go_s: number;
  joined: boolean;
  alert: AlertState;
  /** How long ago the leader was last heard of. */
  leader_age_s: number;
  /** How far the crew has engaged it. */
  engagement: Engagement;
  /**
   * What guidance keeps beside d_min for what it is not certain of, and while the crew flies by
   * hand; 0 where all is exact.
   */
  margin_m: number;
  /** Whether the autopilot flies the pursuer; if not, its crew does by hand. */
  autopilot?: boolean;
  /** Whether the flight director is on. */
  director?: boolean;
  /**
   * The slowest that its aircraft can fly at its level, wings level; left out in older
   * recordings.
   */
  least_tas_mps?: number;
  /** Its bars; none while they are out of view: it is off, or guidance is. */
  bars?: Bars[];
}

/** The leader is to turn to a heading. */
export interface HeadingOrder {
  t_s: number;
  ident?: string;
  leader_heading_deg: number;
  direction?: "left" | "right" | "shorter";
}

/** Guidance asks the autopilot to hold a heading. */
export interface HeadingReference {
  kind: "hold_heading";
  heading_deg: number;
}

/** An aircraft asks for what it declares that it will fly. */
export interface IntentClearanceRequest {
  aircraft: LocalAircraft | GeodeticAircraft;
  intent: IntentPiece[];
  clearance_type?: "capture_then_maintain";
  traffic_id: string;
  assigned_spacing_goal: SpacingGoal;
  min_separation_m: number;
  wind?: WindBody;
  sky?: string;
}

/** The leader's intent is received (`True`) or withdrawn (`False`). */
export interface IntentKnown {
  kind: "intent_known";
  known: boolean;
  /** Of the leader; empty for the first link's. */
  ident: string;
}

/** Give the leader's intent to the pursuer, or withdraw it. */
export interface IntentKnownCommand {
  command: "intent_known";
  known: boolean;
  ident?: string;
}

/** The leader's intent is given to the pursuer, or withdrawn. */
export interface IntentOrder {
  t_s: number;
  ident?: string;
  intent_known: boolean;
}

/** The leader does something new, or its intent was received or withdrawn. */
export interface LeaderChanged {
  kind: "leader_changed";
  /** Flight time [s]. */
  t_s: number;
  /** The leader's. */
  ident: string;
  change: LeaderChange;
  message: string;
}

/** The leader's reports are received (`True`) or not (`False`). */
export interface LeaderData {
  kind: "leader_data";
  received: boolean;
  /** Of the pursuer that receives them; empty for the first link's. */
  ident: string;
}

/** Let the leader's reports be received, or not. */
export interface LeaderDataCommand {
  command: "leader_data";
  received: boolean;
  ident?: string;
}

/** The leader's reports are received, or not. */
export interface LeaderDataOrder {
  t_s?: number;
  on?:
    | "start"
    | "proposed"
    | "designated"
    | "armed"
    | "engaged"
    | "off"
    | "new_plan"
    | "converge"
    | "capture"
    | "follow"
    | "escape"
    | "unable"
    | "data_lost"
    | "alert";
  after_s?: number;
  ident?: string;
  leader_data_received: boolean;
}

/** An aircraft is to turn to a heading. It drops its intent, or leaves its recording. */
export interface LeaderHeading {
  kind: "leader_heading";
  /** To roll out on, clockwise from north. */
  heading_deg: number;
  direction: "left" | "right" | "shorter";
  /** Of the aircraft that is to do so; empty for the first link's leader. */
  ident: string;
}

/** Instruct the leader to turn to a heading. */
export interface LeaderHeadingCommand {
  command: "leader_heading";
  heading_deg: number;
  direction?: Direction | null;
  ident?: string;
}

/** An aircraft is to climb or descend to a level. A recorded one leaves its recording. */
export interface LeaderLevel {
  kind: "leader_level";
  /** Pressure altitude [m]. */
  altitude_m: number;
  /** How fast [m/s], > 0; 1,500 ft/min. */
  rate_mps: number;
  /** Of the aircraft that is to do so; empty for the first link's leader. */
  ident: string;
}

/** Instruct the leader to climb or descend to a level. */
export interface LeaderLevelCommand {
  command: "leader_level";
  altitude_m: number;
  rate_mps?: number;
  ident?: string;
}

/**
 * Where an aircraft is reported to be, a second from now: it flies there.
 *
 * It drops its intent, or leaves its recording. Without another report in the next second it
 * flies on as it then flies.
 */
export interface LeaderReport {
  kind: "leader_report";
  /** East [m]. */
  x_m: number;
  /** North [m]. */
  y_m: number;
  /** Direction of its ground velocity, clockwise from north. */
  track_deg: number;
  /** [m/s]. */
  ground_speed_mps: number;
  /** Pressure altitude [m]. */
  altitude_m: number;
  /** Of the aircraft; empty for the first link's leader. */
  ident: string;
  /** WGS84; there if the situation came with latitudes. */
  lat_deg?: number;
  /** WGS84; there if the situation came with latitudes. */
  lon_deg?: number;
}

/**
 * Say where the leader will be a second from now, as it is reported: it flies there.
 *
 * Sent each second, it flies as another aircraft does; without the next one it flies straight on.
 */
export interface LeaderReportCommand {
  x_m: number;
  y_m: number;
  track_deg: number;
  ground_speed_mps: number;
  altitude_m: number;
  command: "leader_report";
  ident?: string;
}

/**
 * What a pursuer expects its leader to fly from now on: its declared intent, or straight ahead.
 *
 * Times in the segments are flight times. The last segment is the final leg, cut short.
 */
export interface LeaderRoute {
  kind: "leader_route";
  /** Flight time [s]. */
  t_s: number;
  /** The leader's. */
  ident: string;
  /** The pursuer's ident. */
  expected_by: string;
  intent_known: boolean;
  segments: PathSegment[];
}

/** An aircraft is to fly at a true airspeed [m/s]. A recorded one leaves its recording. */
export interface LeaderSpeed {
  kind: "leader_speed";
  /** True airspeed [m/s]. */
  tas_mps: number;
  /** Of the aircraft that is to do so; empty for the first link's leader. */
  ident: string;
}

/** Instruct the leader to fly at a speed. */
export interface LeaderSpeedCommand {
  command: "leader_speed";
  tas_mps: number;
  ident?: string;
}

/** A climb or a descent to a level. */
export interface LevelChange {
  to_altitude_m: number;
  rate_mps: number;
  hold?: "cas" | "mach" | "tas";
}

/** A climb or a descent that the pursuer makes on its way. */
export interface LevelChangeCard {
  /** When it begins. */
  at_s: number;
  /** Pressure altitude to level off at. */
  to_altitude_m: number;
  /** How fast. */
  rate_mps: number;
}

/** A piece of intent: begin to change the level. The pieces behind it are flown meanwhile. */
export interface LevelChangePiece {
  level_change: LevelChange;
}

/** The leader is to climb or descend. */
export interface LevelOrder {
  t_s: number;
  ident?: string;
  leader_level_m: number;
  rate_mps?: number;
}

/** At another level there is a plan. */
export interface LevelRemedy {
  /** Another level. */
  kind: "level";
  /** The level. */
  altitude_m: number;
  /** T of that plan. */
  time_to_converge_s: number;
  /** The same in a sentence. */
  message: string;
}

/** What a pursuer is to do: join its leader, and stay behind it. */
export interface LinkCard {
  /** Its ident. */
  pursuer: string;
  /** Its ident. */
  leader: string;
  /** D, along the leader's route behind it; with spacing by time, as it is at the start. */
  slot_distance_m: number;
  /** d_min, to be kept at all times. */
  min_separation_m: number;
  spacing: Spacing;
  /** Time behind the leader to keep once joined; 0 where the distance is kept. */
  spacing_time_s: number;
}

/** How the flight of one pursuer behind its leader went. */
export interface LinkResult {
  /** The pursuer's. */
  ident: string;
  /** Its leader's ident. */
  leader: string;
  joined: boolean;
  /** When eq. (7) first held within tolerance; the flight's duration if it never did. */
  join_time_s: number;
  /** Time to converge of the plan at engagement, from then on; 0 if there was none. */
  planned_time_s: number;
  /** Time until joined that the plan at engagement promised, braking included; 0 as above. */
  promised_s: number;
  least_separation_m: number;
  /** Total variation of the pursuer's heading until joined. */
  heading_swing_deg: number;
  bank_reversals: number;
  /** Plans after the one at engagement, announced or not. */
  replans: number;
  /** Those of them that the crew was shown. */
  replans_announced: number;
  /** How often the exact plan took the place of a planner's. */
  fallbacks: number;
  /** Distance flown over the ground until joined. */
  track_m: number;
  losses: Loss[];
  /**
   * Time to converge of the fastest plan from the start, with the bank that was asked for and all
   * that the leader was to fly; 0 where there is none, or the leader is recorded.
   */
  optimum_s: number;
  /** Largest distance along the route from where it should be, while it followed. */
  along_error_m: number;
  /** Largest distance beside the route, while it followed. */
  across_error_m: number;
  /**
   * Of all others the one that it came nearest to, measured by what was to be kept; none where
   * there are no others.
   */
  least_other?: ClosestOther[];
  /** How it was flown by hand; none where the autopilot flew all the while. */
  by_hand?: FlownByHand[];
}

/** Who asks, now, in the sky of a flight. */
export interface LocalAircraft {
  ident: string;
  x_m: number;
  y_m: number;
  heading_deg: number;
  tas_mps: number;
  max_bank_deg: number;
  altitude_m?: number | null;
}

/** A round cell, at t = 0. */
export interface LocalDisc {
  x_m: number;
  y_m: number;
  radius_m: number;
}

/** A guided aircraft of a queue, at t = 0. */
export interface LocalFollower {
  ident: string;
  x_m: number;
  y_m: number;
  heading_deg: number;
  tas_mps: number;
  max_bank_deg: number;
}

/** The aircraft to be joined, at t = 0, with what it has declared it will do. */
export interface LocalLeader {
  x_m: number;
  y_m: number;
  heading_deg: number;
  tas_mps: number;
  intent?: IntentPiece[];
  altitude_m?: number | null;
}

/** The aircraft that is guided, at t = 0. */
export interface LocalPursuer {
  x_m: number;
  y_m: number;
  heading_deg: number;
  tas_mps: number;
  max_bank_deg: number;
  altitude_m?: number | null;
  levels?: PlannedLevel[];
}

/** Another aircraft, at t = 0, with what it has declared it will do: to be kept clear of. */
export interface LocalTraffic {
  ident: string;
  x_m: number;
  y_m: number;
  heading_deg: number;
  tas_mps: number;
  altitude_m?: number | null;
  intent?: IntentPiece[];
  min_separation_m?: number | null;
}

/** A loss of separation: from when the separation fell below d_min until it was d_min again. */
export interface Loss {
  /** When it fell below. */
  t_s: number;
  /** The least while it was lost. */
  separation_m: number;
  /** Why, in a sentence. */
  cause: string;
  /** When the first alert or `Unable` that came before it was given; empty if there was none. */
  announced_s: number[];
  /** Ident of the aircraft or cell that it came too close to; empty for the leader. */
  other?: string;
}

/** A word of which no path reaches the slot, or none within 12 hours. */
export interface MissingAlternativeCard {
  /** Its letters, e.g. `LSR`: L and R are turns, S a straight, B slides along d_min. */
  word: string;
  /** Why there is none. */
  why: string;
  /** No root. */
  rejected: "no_root";
}

/** Guidance went from one mode to another. */
export interface ModeChanged {
  kind: "mode_changed";
  /** Flight time [s]. */
  t_s: number;
  /** The pursuer's. */
  ident: string;
  mode: Mode;
  previous: Mode;
  message: string;
}

/** No plan, why, and what would help. */
export interface NoPlanCard {
  /** There is none. */
  status: "no_plan";
  /** In a word. */
  reason: Reason;
  /** A sentence that says what would help. */
  message: string;
  /** No plan that keeps d_min is faster than this [s]; 0 where nothing is known. */
  lower_bound_s: number;
  /** With the reason `traffic`: what is in the way, when, and how near. Else left out. */
  conflict?: ConflictCard;
  /** With the reason `traffic`: what would help, each of it tried. Left out if there is none. */
  remedies?: (SlotDistanceRemedy | LevelRemedy)[];
}

/** A plan that no aircraft flies, and why. */
export interface NotFlownCard {
  /** It does not join, or is not begun. */
  status: "not_flown";
  /** In a sentence. */
  reason: string;
}

/** What is proved of a plan's time; and, if asked for, how it meets Pontryagin's conditions. */
export interface OptimalityCard {
  /**
   * `relaxation`: it is the fastest. `certified`: within 0.1 s of it. `bound`: nothing is faster
   * than the lower bound. `none`: nothing is known.
   */
  proof: Proof;
  /** No plan that keeps d_min is faster. */
  lower_bound_s: number;
  /**
   * What sets t_f: the plan alone, the slot's release time, or that it is in the slot at once.
   * If asked for.
   */
  arrival?: "free" | "release" | "at_once";
  /**
   * Largest |H − H required|.
   * If asked for.
   */
  hamiltonian_residual?: number;
  /**
   * Largest |λ_ψ| at a switch or on a straight.
   * If asked for.
   */
  switching_residual_s_per_deg?: number;
  /**
   * Whether each arc turns as eq. (16) requires, λ_ψ vanishes where it should, H is as required,
   * and no jump and no μ is below 0, all to a thousandth of R. If not, a small change of the plan
   * makes it faster.
   * If asked for.
   */
  stationary?: boolean;
  /** If asked for. */
  contacts?: ContactCard[];
  /** If asked for. */
  boundary_arcs?: BoundaryArcCard[];
  /** If asked for. */
  costates?: CostatesCard;
}

/** Another path to the slot, to be drawn beside a proposal. */
export interface OtherPathCard {
  /** Its letters, e.g. `LSR`: L and R are turns, S a straight, B slides along d_min. */
  word: string;
  /** When the pursuer is at the slot, on the leader's heading. */
  time_to_converge_s: number;
  /** Times count from the instant of the proposal. */
  segments: PathSegment[];
  /** Why it is not proposed, e.g. `38 s slower`. */
  why: string;
}

/** Least separation from another aircraft or a cell, until two minutes after joining. */
export interface OtherSeparationCard {
  /** Of the aircraft or the cell. */
  ident: string;
  /** The least distance to the aircraft, or to the edge of the cell: negative inside. */
  least_m: number;
  /** When it is so. */
  at_s: number;
  /** It is proved never to be less. */
  proved_above_m: number;
  /** What is to be kept; 0 of a cell. */
  min_separation_m: number;
  /** When height keeps it. Left out if it never does. */
  vertical?: VerticalCard[];
}

/** How near a manoeuvre comes to another aircraft. */
export interface PairCard {
  /** The other aircraft. */
  ident: string;
  /** When they are closest, as both are expected to fly. */
  at_s: number;
  /** How close. */
  least_m: number;
  /** They are proved never to be closer while both stay on their tracks. */
  proved_above_m: number;
  /** What is added then for what may differ. */
  bound_m: number;
  /** What is to be kept. */
  minimum_m: number;
  /** Least height between the two then; left out where it is not known. */
  vertical_m?: number[];
  /** certain: too close as both are expected to fly; possible: by what may differ. */
  certainty: "certain" | "possible" | "clear";
  /** Where the manoeuvre is when they are closest. */
  own: PlaceAt;
  /** Where the other aircraft is then. */
  other: PlaceAt;
  /** From when they are too close, by what may differ … */
  since_s: number;
  /** … until when; both are `at` where they are clear. */
  until_s: number;
}

/**
 * A path as an aircraft would really fly it, rolls and braking included.
 *
 * Columns of equal length; points close enough to draw straight lines between.
 */
export interface PathAhead {
  /** Flight times, ascending. */
  times_s: number[];
  /** East. */
  x_m: number[];
  /** North. */
  y_m: number[];
  /** Where the nose points. */
  heading_deg: number[];
  /** WGS84; there if the situation came with latitudes. */
  lat_deg?: number[];
  /** WGS84; there if the situation came with latitudes. */
  lon_deg?: number[];
}

/** A place and a heading along a path, over the ground. */
export interface PathPoint {
  /** From the beginning of the path. */
  t_s: number;
  /** East. */
  x_m: number;
  /** North. */
  y_m: number;
  /** Where the nose points. */
  heading_deg: number;
  /** WGS84; there if the situation came with latitudes. */
  lat_deg?: number;
  /** WGS84; there if the situation came with latitudes. */
  lon_deg?: number;
}

/** Pause the flight. */
export interface PauseCommand {
  command: "pause";
}

/** The constants of the crossover model; those left out are as pilots were found to have. */
export interface PilotBody {
  bandwidth_radps?: number;
  delay_s?: number;
  remnant_share?: number;
  threshold_deg?: number;
  reaction_s?: number;
}

/** A place at a time. */
export interface PlaceAt {
  /** When. */
  t_s: number;
  /** East. */
  x_m: number;
  /** North. */
  y_m: number;
  /** WGS84; there if the situation came with latitudes. */
  lat_deg?: number;
  /** WGS84; there if the situation came with latitudes. */
  lon_deg?: number;
}

/** A plan as outsiders read it: the answer of REST, of the command line, and of the display. */
export interface PlanCard {
  /** There is a plan. */
  status: "planned";
  /** Who made it: `exact`, `network`, `regular_dp`, or the name of a planner of one's own. */
  planner: string;
  /** Its letters, e.g. `LSR`: L and R are turns, S a straight, B slides along d_min. */
  word: string;
  /** When the pursuer is at the slot, on the leader's heading. */
  time_to_converge_s: number;
  /** Path length in the air mass [m]. */
  length_m: number;
  /** In the order they are flown. */
  segments: PathSegment[];
  /** Changes of level on the way. Left out if there is none. */
  levels?: LevelChangeCard[];
  /** From the leader, along the path. */
  separation: Separation;
  /** How its end meets the slot. */
  arrival: ArrivalCard;
  /** What is proved of its time. */
  optimality: OptimalityCard;
  /** By time; words without any path last. In an answer only if asked for. */
  alternatives?: Alternative[];
  /** How long planning took. */
  compute_ms: number;
  /**
   * The other paths to be drawn, the fastest first.
   * If asked for.
   */
  others?: OtherPathCard[];
  /**
   * The flight of it, with guidance engaged at once.
   * If asked for.
   */
  flown?: FlownCard | NotFlownCard;
}

/** A new plan is flown. */
export interface PlanChanged {
  kind: "plan_changed";
  /** Flight time [s]. */
  t_s: number;
  /** The pursuer's. */
  ident: string;
  reason: PlanReason;
  message: string;
  plan: PlanCard;
  /** Where the leader is when the separation is least; its t counts from the plan's start. */
  leader_at_closest: PathPoint;
  /** Where the pursuer is then. */
  pursuer_at_closest: PathPoint;
  /** Whether it is news for the crew; if not, its path is drawn and nothing is said. */
  announced: boolean;
  /** How long until joined, braking included [s]: as forecast by flying the closed loop ahead. */
  promised_s: number;
  /** Largest distance of that forecast from the plan's ideal path [m]. */
  tube_m: number;
  /** Least separation of that forecast [m], which is what must keep d_min. */
  flown_least_m: number;
}

/** A path that could be flown from now on, if the crew accepts it. It is not flown. */
export interface PlanProposed {
  kind: "plan_proposed";
  /** Flight time [s]. */
  t_s: number;
  /** The pursuer's. */
  ident: string;
  message: string;
  plan: PlanCard;
  /** Where the leader is when the separation is least; its t counts from the plan's start. */
  leader_at_closest: PathPoint;
  /** Where the pursuer is then. */
  pursuer_at_closest: PathPoint;
  /** How long until joined, braking included [s]: as forecast by flying the closed loop ahead. */
  promised_s: number;
  /** Least separation of that forecast [m], which is what must keep d_min. */
  flown_least_m: number;
  /** Other paths to the slot that could be flown, fastest first: at most three. */
  others: OtherPathCard[];
  /** What would be flown, as forecast; none in recordings of before. */
  ahead?: PathAhead[];
}

/**
 * The planner's own plan may not be flown; the exact plan, if there is one, takes its place.
 *
 * Said once while the fault stays the same.
 */
export interface PlanRefused {
  kind: "plan_refused";
  /** Flight time [s]. */
  t_s: number;
  /** The pursuer's. */
  ident: string;
  /** Who made it; empty if the answer was no plan. */
  planner: string;
  fault: Fault;
  message: string;
}

/** Guidance asked for a plan and there is none. */
export interface PlanUnavailable {
  kind: "plan_unavailable";
  /** Flight time [s]. */
  t_s: number;
  /** The pursuer's. */
  ident: string;
  answer: NoPlanCard;
}

/** A climb or a descent of the pursuer. */
export interface PlannedLevel {
  at_s: number;
  to_altitude_m: number;
  rate_mps: number;
}

/** What planners would fly in one situation. */
export interface PlannerComparison {
  planners: PlannerVerdict[];
}

/** What one planner would fly in a situation, and what is wrong with that. */
export interface PlannerVerdict {
  /** Whether its own path may be flown. */
  status: Verdict;
  /** Who finds it. */
  planner: ComparedPlanner;
  /** The same in a sentence, with what is wrong or how good it is. */
  message: string;
  /** Its letters; empty where it has no path. */
  word: string;
  /** When its path ends; 0 as above. */
  time_to_converge_s: number;
  /**
   * How much later than the exact plan that is; below 0 for a path that may not be flown. 0 where
   * either has none.
   */
  over_exact_s: number;
  /** Least separation on it; 0 where it has no path. */
  least_m: number;
  /** How long it takes to find, once all that it needs is loaded. */
  compute_ms: number;
  /** The path, in the order flown. */
  segments: PathSegment[];
}

/** Continue the flight. */
export interface PlayCommand {
  command: "play";
}

/** A convex weather cell at all levels, to be kept out of. */
export interface PolygonCell {
  ident: string;
  polygon: (number[] | GeodeticCorner)[];
  velocity_mps?: number[];
  growth_mps?: number;
}

/** What is accepted or flown was validated again, and the verdict is another. */
export interface ProbeChanged {
  kind: "probe_changed";
  t_s: number;
  /** The clearance. */
  id: string;
  validation: ValidationCard;
}

/** The pursuer will join at another time than was last said, on the path that it flies. */
export interface PromiseChanged {
  kind: "promise_changed";
  /** Flight time [s]. */
  t_s: number;
  /** The pursuer's. */
  ident: string;
  /** How long until joined, braking included [s]: as forecast by flying the closed loop ahead. */
  promised_s: number;
  /** The same as was last said, counted from now [s]; negative if that instant has passed. */
  was_s?: number;
  message: string;
}

/** The crew selects the bank that plans turn with. */
export interface PursuerBank {
  kind: "pursuer_bank";
  /** φ_max, > 0. */
  bank_deg: number;
  /** Of the pursuer whose crew does so; empty for the first link's. */
  ident: string;
}

/** Select the bank that plans turn with. */
export interface PursuerBankCommand {
  command: "pursuer_bank";
  bank_deg: number;
  ident?: string;
}

/** The crew selects the bank that plans turn with. */
export interface PursuerBankOrder {
  t_s?: number;
  on?:
    | "start"
    | "proposed"
    | "designated"
    | "armed"
    | "engaged"
    | "off"
    | "new_plan"
    | "converge"
    | "capture"
    | "follow"
    | "escape"
    | "unable"
    | "data_lost"
    | "alert";
  after_s?: number;
  ident?: string;
  pursuer_max_bank_deg: number;
}

/** The crew selects a heading, which is flown until guidance is engaged. */
export interface PursuerHeading {
  kind: "pursuer_heading";
  /** Clockwise from north. */
  heading_deg: number;
  /** Of the pursuer whose crew does so; empty for the first link's. */
  ident: string;
}

/** Select a heading for the pursuer, while guidance is not engaged. */
export interface PursuerHeadingCommand {
  command: "pursuer_heading";
  heading_deg: number;
  ident?: string;
}

/** The crew selects a heading, while guidance is not engaged. */
export interface PursuerHeadingOrder {
  t_s?: number;
  on?:
    | "start"
    | "proposed"
    | "designated"
    | "armed"
    | "engaged"
    | "off"
    | "new_plan"
    | "converge"
    | "capture"
    | "follow"
    | "escape"
    | "unable"
    | "data_lost"
    | "alert";
  after_s?: number;
  ident?: string;
  pursuer_heading_deg: number;
}

/** The crew selects a speed in place of the one that guidance asks for. */
export interface PursuerSpeed {
  kind: "pursuer_speed";
  /** True airspeed [m/s]; 0 leaves the speed to guidance again. */
  tas_mps: number;
  /** Of the pursuer whose crew does so; empty for the first link's. */
  ident: string;
}

/** Select a speed in place of the one that guidance asks for, or leave it to guidance again. */
export interface PursuerSpeedCommand {
  command: "pursuer_speed";
  tas_mps: number | null;
  ident?: string;
}

/** The crew selects a speed in place of the one that guidance asks for. */
export interface PursuerSpeedOrder {
  t_s?: number;
  on?:
    | "start"
    | "proposed"
    | "designated"
    | "armed"
    | "engaged"
    | "off"
    | "new_plan"
    | "converge"
    | "capture"
    | "follow"
    | "escape"
    | "unable"
    | "data_lost"
    | "alert";
  after_s?: number;
  ident?: string;
  pursuer_tas_mps: number | null;
}

/** The leader flies to where it is reported to be a second later. */
export interface ReportOrder {
  t_s: number;
  ident?: string;
  leader_report: Reported;
}

/** Where an aircraft is reported to be, over the ground. */
export interface Reported {
  x_m: number;
  y_m: number;
  track_deg: number;
  ground_speed_mps: number;
  altitude_m: number;
}

/** The flight at one instant. */
export interface Sample {
  kind: "sample";
  /** Flight time [s]. */
  t_s: number;
  /** In the order of `FlightStarted.aircraft`. */
  aircraft: AircraftSample[];
  /** In the order of `FlightStarted.links`. */
  guidance: GuidanceSample[];
}

/** Start a flight of a scenario. */
export interface ScenarioFlightRequest {
  rate?: number;
  paused?: boolean;
  intent_known?: boolean | null;
  engagement?: Engagement;
  seed?: number;
  spacing_time_s?: number | null;
  by_hand?: boolean | PilotBody;
  orders?: OrderLine[];
  crew?: CrewOrderLine[] | null;
  scenario: string;
}

/** A scenario that can be flown. */
export interface ScenarioInfo {
  name: string;
  title: string;
  description: string;
  available: boolean;
  message: string;
}

/** All scenarios. */
export interface ScenarioList {
  scenarios: ScenarioInfo[];
}

/** Least separation along a plan, and what is proved of it. */
export interface Separation {
  /** The least distance between the two aircraft. */
  least_m: number;
  /** When it is so. */
  at_s: number;
  /** They are proved never to be closer. */
  proved_above_m: number;
  /** When height keeps it. Left out if it never does. */
  vertical?: VerticalCard[];
  /** The same of other traffic and cells, least margin first. Left out if there are none. */
  others?: OtherSeparationCard[];
}

/** The separation fell below d_min: once for each time it does. */
export interface SeparationLost {
  kind: "separation_lost";
  /** Flight time [s]. */
  t_s: number;
  /** The pursuer's. */
  ident: string;
  /** The aircraft that it came too close to. */
  other: string;
  /** At this instant [m]. */
  separation_m: number;
  /** Where the pursuer is, east [m]. */
  x_m: number;
  /** … and north [m]. */
  y_m: number;
  /** Why, in a sentence. */
  cause: string;
  /** Flight time [s] of the first alert or `Unable` that came before it; empty without one. */
  announced_s: number[];
  /** WGS84; there if the situation came with latitudes. */
  lat_deg?: number;
  /** WGS84; there if the situation came with latitudes. */
  lon_deg?: number;
}

/** The crew takes control from the autopilot (`False`), or gives it back (`True`). */
export interface SetAutopilot {
  kind: "set_autopilot";
  on: boolean;
  /** Of the pursuer whose crew does so; empty for the first link's. */
  ident: string;
}

/** Take control from the autopilot, to fly by hand, or give it back. */
export interface SetAutopilotCommand {
  command: "set_autopilot";
  on: boolean;
  ident?: string;
}

/** The crew switches the flight director's bars on (`True`) or off. */
export interface SetDirector {
  kind: "set_director";
  on: boolean;
  /** Of the pursuer whose crew does so; empty for the first link's. */
  ident: string;
}

/** Switch the flight director. */
export interface SetDirectorCommand {
  command: "set_director";
  on: boolean;
  ident?: string;
}

/** The crew engages guidance further, or less far. */
export interface SetEngagement {
  kind: "set_engagement";
  engagement: Engagement;
  /** Of the pursuer whose crew does so; empty for the first link's. */
  ident: string;
}

/** Designate the leader, accept what is proposed, engage it, or disconnect. */
export interface SetEngagementCommand {
  command: "set_engagement";
  engagement: Engagement;
  ident?: string;
}

/** Change how fast simulated time runs. */
export interface SetRateCommand {
  command: "set_rate";
  rate: number;
}

/** The crew changes D, d_min or both in flight. */
export interface SetSpacing {
  kind: "set_spacing";
  /** D [m]; 0 leaves it as it is. */
  slot_distance_m: number;
  /** d_min [m]; 0 leaves it as it is. */
  min_separation_m: number;
  /** Of the pursuer whose crew does so; empty for the first link's. */
  ident: string;
}

/** Change D, d_min or both in flight. */
export interface SetSpacingCommand {
  command: "set_spacing";
  slot_distance_m?: number | null;
  min_separation_m?: number | null;
  ident?: string;
}

/** Everything a plan depends on, at one instant. */
export interface SituationBody {
  pursuer: LocalPursuer | GeodeticPursuer;
  leader: LocalLeader | GeodeticLeader;
  slot_distance_m: number;
  min_separation_m: number;
  wind?: WindBody;
  traffic?: (LocalTraffic | GeodeticTraffic)[];
  cells?: (DiscCell | PolygonCell)[];
}

/** Start a flight from a situation of your own. */
export interface SituationFlightRequest {
  rate?: number;
  paused?: boolean;
  intent_known?: boolean | null;
  engagement?: Engagement;
  seed?: number;
  spacing_time_s?: number | null;
  by_hand?: boolean | PilotBody;
  orders?: OrderLine[];
  crew?: CrewOrderLine[] | null;
  situation: FlownSituationBody;
  flown_intent?: IntentPiece[] | null;
  reported_leader?: string | null;
}

/** A sky: one plane, one clock. Flights without a place on the earth have one each. */
export interface SkyCard {
  /** Empty: the one on the earth. */
  id: string;
  title: string;
  airspaces: AirspaceCard[];
}

/** With another D there is a plan. */
export interface SlotDistanceRemedy {
  /** Another D. */
  kind: "slot_distance";
  /** D. */
  slot_distance_m: number;
  /** T of that plan. */
  time_to_converge_s: number;
  /** The same in a sentence. */
  message: string;
}

/** The crew changes D, d_min or both. */
export interface SpacingOrder {
  t_s?: number;
  on?:
    | "start"
    | "proposed"
    | "designated"
    | "armed"
    | "engaged"
    | "off"
    | "new_plan"
    | "converge"
    | "capture"
    | "follow"
    | "escape"
    | "unable"
    | "data_lost"
    | "alert";
  after_s?: number;
  ident?: string;
  slot_distance_m?: number;
  min_separation_m?: number;
}

/** The leader is to fly at a speed. */
export interface SpeedOrder {
  t_s: number;
  ident?: string;
  leader_tas_mps: number;
}

/** A step in the life of a clearance. */
export interface StateChange {
  /** It is from then on. */
  state: ClearanceState;
  /** When, in the time of its sky. */
  t_s: number;
  /** Wall clock, UTC, ISO 8601. */
  at: string;
  /** Who brought it there. */
  by: Actor;
  /** A `ReasonCode`, where there is one. */
  reason?: string;
  /** In a sentence, or in the words of data link. */
  message: string;
}

/**
 * The crew moves the stick, which stays there until the next such order.
 *
 * Deflections ask for rates: neutral keeps the bank, and the rate of climb.
 */
export interface Stick {
  kind: "stick";
  /** 1 asks for the type's full rate of roll to the right, −1 to the left. */
  roll: number;
  /** 1 pulls up with 0.1 g, −1 pushes down with as much. */
  pitch: number;
  /** Of the pursuer whose crew does so; empty for the first link's. */
  ident: string;
}

/** Move the stick, while the crew has control; it stays there until the next such command. */
export interface StickCommand {
  command: "stick";
  roll: number;
  pitch?: number;
  ident?: string;
}

/**
 * Move the stick.
 *
 * Sent as it moves, 20 times a second at most, and each 0.2 s while it is held out of neutral:
 * after 0.5 s without one the stick is neutral.
 */
export interface StickMove {
  kind: "stick";
  roll: number;
  pitch?: number;
}

/** The crew moves the stick, which stays there until the next such order. */
export interface StickOrder {
  t_s?: number;
  on?:
    | "start"
    | "proposed"
    | "designated"
    | "armed"
    | "engaged"
    | "off"
    | "new_plan"
    | "converge"
    | "capture"
    | "follow"
    | "escape"
    | "unable"
    | "data_lost"
    | "alert";
  after_s?: number;
  ident?: string;
  stick_roll?: number;
  stick_pitch?: number;
}

/** A piece of intent: keep the heading. */
export interface StraightPiece {
  straight_s: number;
}

/** A piece at constant heading. */
export interface StraightSegment {
  /** A straight. */
  kind: "straight";
  /** In the air mass [m]. */
  length_m: number;
  /** How long it takes. */
  duration_s: number;
  /** Where it begins. */
  start: PathPoint;
  /** Where it ends. */
  end: PathPoint;
}

/** How well the pursuer sees its leader. */
export interface SurveillanceBody {
  kind: "exact" | "adsb";
  nacp?: number;
  nacv?: number;
  latency_s?: number;
  interval_s?: number;
  loss_share?: number;
  burst_s?: number;
}

/** Take a pursuer's control from the autopilot, to fly it by hand. */
export interface TakeControl {
  kind: "take_control";
  director?: boolean;
  ident?: string;
}

/** A frame of the stream: what happened in a flight since the last one. */
export interface Tick {
  kind: "tick";
  flight_id: string;
  t_s: number;
  rate: number;
  paused: boolean;
  ended: boolean;
  documents: Document[];
  started_at?: string;
  version?: string;
}

/** A time to keep behind the traffic. */
export interface TimeGoal {
  type: "time";
  value_s: number;
}

/** A track in columns of equal length: straight lines between knots. */
export interface TrackCard {
  /** Of its knots, ascending. */
  t_s: number[];
  /** East. */
  x_m: number[];
  /** North. */
  y_m: number[];
  /** Pressure altitude in the middle of what is possible; left out where it is not known. */
  altitude_m?: number[];
  /** It is at least this high … */
  low_m?: number[];
  /** … and at most this; both are left out with the altitude. */
  high_m?: number[];
  /** What is flown strays from these lines by no more than this, at its time. */
  error_m?: number;
  /** WGS84; there if the situation came with latitudes. */
  lat_deg?: number[];
  /** WGS84; there if the situation came with latitudes. */
  lon_deg?: number[];
}

/** An aircraft of the picture, for a controller's label. */
export interface TrafficCard {
  ident: string;
  /** East. */
  x_m: number;
  /** North. */
  y_m: number;
  /** Direction of its ground velocity. */
  track_deg: number;
  ground_speed_mps: number;
  /** Pressure altitude; left out where it is not known. */
  altitude_m?: number;
  climb_mps?: number;
  /** How long ago it was seen. */
  age_s: number;
  /** Whether its intent is known. */
  intends: boolean;
  /** Who reports it: a flight of this service, `traffic` (put by REST), or a feed. */
  source: string;
  flight_id?: string;
  /** WGS84; there if the situation came with latitudes. */
  lat_deg?: number;
  /** WGS84; there if the situation came with latitudes. */
  lon_deg?: number;
}

/** A sky at one instant: once a second. */
export interface TrafficSeen {
  kind: "traffic";
  t_s: number;
  sky: SkyCard;
  aircraft: TrafficCard[];
}

/** A piece of intent: turn at constant bank. */
export interface TurnPiece {
  turn_to_heading_deg: number;
  direction: Direction;
  bank_deg: number;
}

/** Guidance asks the autopilot for a turn rate. */
export interface TurnRateReference {
  kind: "turn_rate";
  turn_rate_degps: number;
}

/** A turn at constant bank. In wind its ground path is a trochoid: air-mass arc + wind × t. */
export interface TurnSegment {
  /** A turn. */
  kind: "turn";
  /** Which way round. */
  direction: Direction;
  /** How far it turns. */
  angle_deg: number;
  /** |φ|. */
  bank_deg: number;
  /** In the air mass. */
  radius_m: number;
  /** How long it takes. */
  duration_s: number;
  /** Where it begins. */
  start: PathPoint;
  /** Where it ends. */
  end: PathPoint;
}

/** Guidance cannot do what it is to do, and the crew is informed. Holds until the next plan. */
export interface Unable {
  kind: "unable";
  /** Flight time [s]. */
  t_s: number;
  /** The pursuer's. */
  ident: string;
  reason: UnableReason;
  message: string;
}

/** Another path to the slot that lost because it comes too close. */
export interface UnsafeAlternativeCard {
  /** Its letters, e.g. `LSR`: L and R are turns, S a straight, B slides along d_min. */
  word: string;
  /** When the pursuer is at the slot, on the leader's heading. */
  time_to_converge_s: number;
  /** How much it turns in all, left and right added. */
  turning_deg: number;
  /** Whether it crosses the line ahead of the leader on its final leg. */
  passes: "behind" | "ahead";
  /** How it goes round the leader: left is counter-clockwise, with the leader on its left hand. */
  side: Direction;
  /** How close it comes. */
  least_separation_m: number;
  /** When it is closest. */
  at_s: number;
  /** To whom: other traffic, or a cell. Left out for the leader. */
  ident?: string;
  /** Why it is not flown, e.g. `comes within 4.22 NM at 212 s`. */
  why: string;
  /** It loses the separation. */
  rejected: "separation";
}

/** What automation finds of a manoeuvre. It advises: the controller decides. */
export interface ValidationCard {
  /** In a word. */
  verdict: ValidationVerdict;
  /** None where it is acceptable. */
  findings: Finding[];
  /** Those that matter, least margin first. */
  pairs: PairCard[];
  /** Acceptable ones, soonest first; only where it is not. */
  alternatives: AlternativeManoeuvre[];
  /** It holds until then if nobody leaves what conformance allows. */
  valid_until_s: number;
  /** When it was computed. */
  computed_s: number;
  /** How old the picture was that it was computed on. */
  picture_as_of_s: number;
  /** How many others were looked at. */
  aircraft: number;
}

/** A time in which height keeps two aircraft apart: their separation does not count then. */
export interface VerticalCard {
  /** Since when. */
  from_s: number;
  /** Until when. */
  to_s: number;
  /** The least height between the two in between, to be sure of. */
  least_m: number;
}

/** Uniform wind as reports give it. */
export interface WindBody {
  from_deg: number;
  speed_mps: number;
}

/** Uniform wind as reports give it. */
export interface WindCard {
  /** Where it comes from, clockwise from north. */
  from_deg: number;
  speed_mps: number;
}

/** The wind at one altitude. */
export interface WindLevelBody {
  altitude_m: number;
  from_deg: number;
  speed_mps: number;
}
