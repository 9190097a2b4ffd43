/** Alerts of conformance: which stand, which are silenced. */

import type { ClearanceCard, Deviation } from "../wire";
import type { Sky } from "./sky";

/** An alert that is silenced is heard again, and stands in the banner again, after so long [ms]. */
export const SILENCE = 60_000;

export interface Alert {
  /** Of which clearance, and in what it deviates. */
  readonly key: string;
  readonly sky: string;
  readonly card: ClearanceCard;
  readonly deviation: Deviation;
}

/** All deviations of all skies, alerts before cautions, the newest first. */
export function alertsOf(skies: readonly Sky[]): Alert[] {
  return skies
    .flatMap((sky) => [...sky.clearances.values()].flatMap((card) => ofCard(sky.id, card)))
    .sort((a, b) => rank(b) - rank(a) || b.deviation.since_s - a.deviation.since_s);
}

function ofCard(sky: string, card: ClearanceCard): Alert[] {
  return card.deviations
    .filter(({ level }) => level !== "none")
    .map((deviation) => ({ key: `${card.id} ${deviation.subject}`, sky, card, deviation }));
}

function rank({ deviation }: Alert): number {
  return deviation.level === "alert" ? 1 : 0;
}

/** Until when each alert is silenced, by its key [ms, wall clock]. */
export type Silenced = ReadonlyMap<string, number>;

/** Those that ask for attention now: alerts that are not silenced. */
export function loudOf(alerts: readonly Alert[], silenced: Silenced, wall: number): Alert[] {
  return alerts.filter((each) => rank(each) === 1 && (silenced.get(each.key) ?? 0) <= wall);
}
