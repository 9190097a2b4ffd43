/** A flight in each state of guidance, as the display gets it. */

import type { PairSample } from "../../src/store/pair";
import type { Guidance } from "../../src/store/states";
import type { Flight } from "../../src/store/types";
import type { PlanProposed } from "../../src/wire";
import { aircraft, amend, noPlan, unable } from "../samples";
import { documentsOf, flightAt } from "./fixture";

/** When each is shown [s, flight time]. */
export const T = 200;

export function proposal(): PlanProposed {
  const { plan } = documentsOf("fig_6b");
  const other = { word: "LSR", time_to_converge_s: 900, segments: plan.plan.segments, why: "" };
  return {
    kind: "plan_proposed",
    t_s: 0,
    ident: plan.ident,
    message: "",
    plan: plan.plan,
    leader_at_closest: plan.leader_at_closest,
    pursuer_at_closest: plan.pursuer_at_closest,
    promised_s: plan.plan.time_to_converge_s + 5,
    flown_least_m: 11_000,
    others: [other],
  };
}

/** One more aircraft, 5 NM north of own ship. */
function bringTraffic(flight: Flight): void {
  const { now } = flight.moment.value;
  if (now === null) throw new Error("An empty flight.");
  const { x_m, y_m } = now.pursuer;
  const others = [aircraft({ ident: "BAW12", x_m, y_m: y_m + 9260 })];
  amend(flight, { sample: { ...now, others }, now: { ...now, others } });
}

/** A flight in a state, `t` [s] after its plan was made. */
export function flightIn(state: Guidance, t = state === "follow" ? 900 : T): Flight {
  const mode =
    state === "converge" || state === "capture" || state === "follow" || state === "escape";
  const flight = flightAt("fig_6b", t, mode ? state : "heading");
  bringTraffic(flight);
  const change = (sample: Partial<PairSample>) => {
    if (flight.moment.value.sample === null) throw new Error("An empty flight.");
    const changed = { ...flight.moment.value.sample, ...sample };
    amend(flight, { sample: changed, now: changed });
  };
  if (!mode && state !== "unable") amend(flight, { plan: null });
  switch (state) {
    case "off":
      change({ engagement: "off", time_to_go_s: 0 });
      break;
    case "designated":
      change({ engagement: "designated", time_to_go_s: 0 });
      break;
    case "proposed":
    case "armed":
      change({ engagement: state === "armed" ? "armed" : "designated", time_to_go_s: 0 });
      amend(flight, { proposal: proposal() });
      break;
    case "infeasible":
      change({ engagement: "designated", time_to_go_s: 0 });
      amend(flight, { unavailable: noPlan(t) });
      break;
    case "unable":
      amend(flight, { unavailable: noPlan(t) });
      break;
    case "data_lost":
      change({ engagement: "designated", leader_age_s: 15, time_to_go_s: 0 });
      amend(flight, { unable: { ...unable(t), reason: "data" } });
      break;
  }
  return flight;
}
