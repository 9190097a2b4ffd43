/** Strips of what Pontryagin's conditions say along a plan: σ(t), H(t) and the costates, from the service. */

import { signal } from "@preact/signals";
import { checkSituation } from "../api";
import { situationOf } from "../map/from-flight";
import { bodyOf } from "../map/situation";
import type { Planned } from "../store/committed";
import { type History, momentAt } from "../store/history";
import { formatClock, inPageUnits, NM } from "../units";
import type { CostatesCard, PlanCard } from "../wire";
import type { Level, Line, Strip } from "./strips";

/** What is known of the costates of a plan. */
export type Costates =
  | { readonly kind: "missing"; readonly sentence: string }
  | { readonly kind: "known"; readonly sentence: string; readonly strips: readonly Strip[] };

export const NO_PLAN: Costates = {
  kind: "missing",
  sentence: "No plan is flown or proposed at this instant, so there are no costates.",
};

/** Costates of a plan of a flight: those it came with, or what the service finds for its situation. */
export async function costatesOf(history: History, plan: Planned): Promise<Costates> {
  const came = plan.plan.optimality.costates;
  if (came !== undefined) return known(plan.t_s, plan.plan, came, "");
  const moment = signal(momentAt(history, plan.t_s));
  const situation = situationOf({ moment });
  const when = formatClock(plan.t_s);
  if (situation === null)
    return missing(`Nothing is known of where the two were at ${when}, when this was planned.`);
  const answer = await checkSituation(bodyOf(situation));
  if (answer.kind === "refused") return missing(inPageUnits(answer.sentence));
  const found = answer.value;
  if (found.status === "no_plan")
    return missing(`From where the two were at ${when} the exact planner has no plan.`);
  const { costates } = found.optimality;
  if (costates === undefined) return missing("The service sent no costates.");
  const same = found.word === plan.plan.word ? "" : ` Flown is ${plan.plan.word}, not this word.`;
  return known(plan.t_s, found, costates, same);
}

function missing(sentence: string): Costates {
  return { kind: "missing", sentence };
}

function known(start: number, plan: PlanCard, costates: CostatesCard, more: string): Costates {
  const { stationary, arrival, hamiltonian_residual: residual } = plan.optimality;
  const about = `Exact plan ${plan.word} from ${formatClock(start)}, ${formatClock(plan.time_to_converge_s)} long.`;
  const verdict =
    arrival === "release"
      ? "It arrives as the slot opens: λ = 0, H = 1 meets all conditions on any path."
      : stationary === true
        ? `The conditions of eqs. (9)–(16) hold; |H − H due| ≤ ${(residual ?? 0).toExponential(0)}.`
        : "The conditions do not hold: a small change makes it faster.";
  return {
    kind: "known",
    sentence: `${about} ${verdict}${more}`,
    strips: stripsOf(start, costates),
  };
}

const ZERO: Level = { label: "0", value: 0, colour: "label" };

function stripsOf(start: number, card: CostatesCard): Strip[] {
  const times = card.t_s.map((t) => start + t);
  const strip = (
    name: string,
    title: string,
    unit: string,
    line: Pick<Line, "label" | "values">,
    decimals: number,
  ): Strip => ({
    name,
    title,
    unit,
    times,
    lines: [{ ...line, colour: "managed", dash: "", isFaint: false }],
    levels: [ZERO],
    format: (value) => value.toFixed(decimals).replace("-", "−"),
  });
  return [
    strip(
      "switching",
      "Switching function σ = λψ: above 0 left, below 0 right",
      "s/°",
      { label: "σ", values: card.switching_s_per_deg },
      2,
    ),
    strip("hamiltonian", "Hamiltonian", "1", { label: "H", values: card.hamiltonian }, 3),
    strip(
      "lambda-d",
      "Costate of the separation λd",
      "s/NM",
      { label: "λd", values: card.separation_costate_s_per_m.map((value) => value * NM) },
      2,
    ),
    strip(
      "lambda-theta",
      "Costate of the bearing λθ",
      "s/°",
      { label: "λθ", values: card.bearing_costate_s_per_deg },
      2,
    ),
  ];
}
