/** The fastest path there was: what the exact planner flies from the same instant, knowing all the leader flew. */

import { signal } from "@preact/signals";
import { planSituation } from "../api";
import { samplePath, windVector } from "../geometry";
import { situationOf } from "../map/from-flight";
import { bodyOf, MOST_PIECES } from "../map/situation";
import { type History, momentAt } from "../store/history";
import { formatClock, inPageUnits } from "../units";
import type { PathPoint, PathSegment } from "../wire";
import { intentFlown } from "./leader-flown";
import { type Flown, plansOf } from "./seconds";

/** A path to compare with, and what it is. */
export interface Fastest {
  readonly path: readonly PathPoint[];
  /** When it is at the slot [s, flight time]; null where that is not comparable. */
  readonly joins: number | null;
  /** What is drawn, in a sentence or two. */
  readonly sentence: string;
}

/** The service plans for so long at most [ms]. */
const PATIENCE = 2000;
const AIRCRAFT_NEED =
  "It banks at once and keeps its speed to the slot; an aircraft needs some seconds more.";

/** The path, or in its place the plan that was flown first, and why. */
export async function fastestOf(history: History, flown: Flown): Promise<Fastest> {
  const moment = momentAt(history, flown.from);
  const { started } = moment;
  if (started === null) return { path: [], joins: null, sentence: "" };
  if (started.others.length + started.cells.length > 0)
    return first(history, flown, "Others were in the way, and what they flew is not known here.");
  const leader = flown.seconds.map(({ t, sample }) => ({ t, leader: sample.leader }));
  const intent = intentFlown(leader);
  const situation = situationOf({ moment: signal(moment) });
  if (situation === null || intent === null || intent.length > MOST_PIECES)
    return first(history, flown, "What the leader flew is no chain of turns at one speed.");
  const known = { ...situation, leader: { ...situation.leader, intent } };
  const answer = await planSituation(bodyOf(known), PATIENCE);
  if (answer.kind === "refused") return first(history, flown, inPageUnits(answer.sentence));
  const plan = answer.value;
  if (plan.status === "no_plan")
    return first(history, flown, "Knowing all, the exact planner has no path from there.");
  const when = formatClock(flown.from);
  const knew = intent.length > 0 ? ", for who had known what the leader would fly" : "";
  const takes = formatClock(plan.time_to_converge_s);
  return {
    path: pointsOf(plan.segments, flown.from, moment),
    joins: flown.from + plan.time_to_converge_s,
    sentence: `Dashed: the fastest path from ${when} on${knew}; it takes ${takes}. ${AIRCRAFT_NEED}`,
  };
}

/** The plan as it was when the time began to count. */
function first(history: History, { from }: Flown, why: string): Fastest {
  const plans = plansOf(history);
  const plan = plans.findLast(({ t_s }) => t_s <= from + 1) ?? plans[0];
  if (plan === undefined) return { path: [], joins: null, sentence: why };
  return {
    path: pointsOf(plan.plan.segments, plan.t_s, momentAt(history, from)),
    joins: null,
    sentence: `Dashed: the plan of ${formatClock(plan.t_s)}, not the fastest path there was. ${why}`,
  };
}

function pointsOf(
  segments: readonly PathSegment[],
  from: number,
  { started }: ReturnType<typeof momentAt>,
): PathPoint[] {
  const wind = windVector(started?.wind ?? { from_deg: 0, speed_mps: 0 });
  return samplePath(segments, wind).map((each) => ({ ...each, t_s: each.t_s + from }));
}
