/** A sky as the controllers' documents tell of it: a fold, one document after the other. */

import type { AirspaceCard, AtcDocument, ClearanceCard, TrafficCard } from "../wire";

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

export function emptySky(id: string): Sky {
  return {
    id,
    title: id === "" ? "All traffic" : `Flight ${id}`,
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
      return { ...now, clearances: new Map(sky.clearances).set(clearance.id, clearance) };
    }
    case "probe_changed":
      return change(now, document.id, { validation: [document.validation] });
    case "conformance":
      return change(now, document.id, { deviations: document.deviations });
    case "expired":
      return change(now, document.id, { state: "expired" });
  }
}

function change(sky: Sky, id: string, part: Partial<ClearanceCard>): Sky {
  const before = sky.clearances.get(id);
  if (before === undefined) return sky;
  return { ...sky, clearances: new Map(sky.clearances).set(id, { ...before, ...part }) };
}

/** The aircraft of that name, if it is seen. */
export function aircraftOf(sky: Sky, ident: string): TrafficCard | null {
  return sky.aircraft.find((each) => each.ident === ident) ?? null;
}
