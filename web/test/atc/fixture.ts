/** A sky made by hand: five requests amid others, told as the service tells it. */

import type {
  AtcDocument,
  ClearanceCard,
  ClearanceState,
  PairCard,
  TrackCard,
  TrafficCard,
  ValidationCard,
} from "../../src/wire";

/** A time of day, UTC [s]. */
export const NOW = 1_790_000_000;

export function straight(
  from: readonly [number, number],
  track: number,
  speed: number,
  begin = NOW,
  length = 1200,
): TrackCard {
  const [x, y] = from;
  const [east, north] = [Math.sin((track * Math.PI) / 180), Math.cos((track * Math.PI) / 180)];
  const t_s = [begin, begin + length / 2, begin + length];
  return {
    t_s,
    x_m: t_s.map((t) => x + speed * (t - begin) * east),
    y_m: t_s.map((t) => y + speed * (t - begin) * north),
  };
}

export function traffic(ident: string, change: Partial<TrafficCard> = {}): TrafficCard {
  return {
    ident,
    x_m: 0,
    y_m: 0,
    track_deg: 90,
    ground_speed_mps: 230,
    altitude_m: 9449,
    age_s: 1,
    intends: true,
    source: "traffic",
    ...change,
  };
}

export function pair(ident: string, change: Partial<PairCard> = {}): PairCard {
  return {
    ident,
    at_s: NOW + 300,
    least_m: 12_000,
    proved_above_m: 11_990,
    bound_m: 900,
    minimum_m: 9260,
    certainty: "clear",
    own: { t_s: NOW + 300, x_m: 10_000, y_m: 0 },
    other: { t_s: NOW + 300, x_m: 10_000, y_m: 12_000 },
    since_s: NOW + 300,
    until_s: NOW + 300,
    ...change,
  };
}

export function validation(change: Partial<ValidationCard> = {}): ValidationCard {
  return {
    verdict: "acceptable",
    findings: [],
    pairs: [pair("BAW12")],
    alternatives: [],
    valid_until_s: NOW + 60,
    computed_s: NOW,
    picture_as_of_s: NOW,
    aircraft: 7,
    ...change,
  };
}

export function clearance(id: string, change: Partial<ClearanceCard> = {}): ClearanceCard {
  const state = change.state ?? "validating";
  return {
    id,
    sky: "",
    clearance_type: "capture_then_maintain",
    aircraft: `DLH${id}`,
    traffic_id: `AFR${id}`,
    spacing_type: "distance",
    slot_distance_m: 9260,
    spacing_time_s: 0,
    min_separation_m: 9260,
    word: "LSR",
    text: `REQUEST CAPTURE THEN MAINTAIN 5.0 NM BEHIND AFR${id}`,
    state,
    due_s: NOW + 60,
    joins_s: NOW + 600,
    route: straight([-40_000, 20_000], 90, 230),
    leader_route: straight([0, 0], 90, 210),
    validation: [validation()],
    deviations: [],
    history: [change_of(state)],
    auto_answer: false,
    ...change,
  };
}

function change_of(state: ClearanceState): ClearanceCard["history"][number] {
  return { state, t_s: NOW, at: "2026-09-21T13:33:20Z", by: "crew", message: "Requested." };
}

export function seen(aircraft: TrafficCard[], t = NOW, id = ""): AtcDocument {
  const title = id === "" ? "Earth" : `Flight ${id}`;
  return { kind: "traffic", t_s: t, sky: { id, title, airspaces: [] }, aircraft };
}

export function changed(card: ClearanceCard, t = NOW): AtcDocument {
  return { kind: "clearance_changed", t_s: t, clearance: card };
}
