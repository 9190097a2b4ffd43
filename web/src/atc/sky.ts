/** A sky as the controllers' documents tell of it: a fold, one document after the other. */

import type {
  AirspaceCard,
  AtcDocument,
  ClearanceCard,
  Expired,
  StateChange,
  TrafficCard,
} from "../wire";

export interface Sky {
  /** Empty: the one on the earth; else the flight whose sky it is. */
  readonly id: string;
  readonly title: string;
  /** Its time: UTC on the earth, else flight time [s]. */
  readonly t: number;
  readonly aircraft: readonly TrafficCard[];
  readonly airspaces: readonly AirspaceCard[];
  /** By id, in the order in which they were asked for. */
  readonly clearances: ReadonlyMap<string, ClearanceCard>;
}

/** The title of a flight's sky before its aircraft are known. */
const UNNAMED = "A flight";

export function emptySky(id: string): Sky {
  return {
    id,
    title: id === "" ? "All traffic" : UNNAMED,
    t: Number.NEGATIVE_INFINITY,
    aircraft: [],
    airspaces: [],
    clearances: new Map(),
  };
}

/** The sky after a document about it. Its time never runs backward. */
export function fold(sky: Sky, document: AtcDocument): Sky {
  const now = { ...sky, t: Math.max(sky.t, document.t_s) };
  switch (document.kind) {
    case "traffic": {
      const { title, airspaces } = document.sky;
      return { ...now, title: title || sky.title, airspaces, aircraft: document.aircraft };
    }
    case "clearance_changed": {
      const { clearance } = document;
      const named = `${clearance.aircraft} behind ${clearance.traffic_id}`;
      return {
        ...now,
        title: sky.title === UNNAMED ? named : sky.title,
        clearances: new Map(sky.clearances).set(clearance.id, clearance),
      };
    }
    case "probe_changed":
      return change(now, document.id, { validation: [document.validation] });
    case "conformance":
      return change(now, document.id, { deviations: document.deviations });
    case "expired":
      return expire(now, document);
  }
}

function change(sky: Sky, id: string, part: Partial<ClearanceCard>): Sky {
  const before = sky.clearances.get(id);
  if (before === undefined) return sky;
  return { ...sky, clearances: new Map(sky.clearances).set(id, { ...before, ...part }) };
}

/** What has expired says when and why, whether or not its card was told as well. */
function expire(sky: Sky, { id, t_s, message }: Expired): Sky {
  const history = sky.clearances.get(id)?.history ?? [];
  if (history.at(-1)?.state === "expired") return change(sky, id, { state: "expired" });
  const step: StateChange = { state: "expired", t_s, at: "", by: "service", message };
  return change(sky, id, { state: "expired", history: [...history, step] });
}

/** The aircraft of that name, if it is seen. */
export function aircraftOf(sky: Sky, ident: string): TrafficCard | null {
  return sky.aircraft.find((each) => each.ident === ident) ?? null;
}
