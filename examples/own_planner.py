"""A planner of one's own, flown, recorded and replayed: the exact plan with a mile to spare.

Needs `pip install 'relguide[serve]'`; writes careful.jsonl. What a planner answers is judged before
it is flown: where it does not join or keep d_min, the exact plan is flown and the flight says so.
"""

from dataclasses import replace

import relguide as rg
from relguide.units import NM


def careful(situation: rg.Situation) -> rg.Plan | rg.NoPlan:
    """Plan with a mile more separation, as far as the slot allows."""
    wide = min(situation.min_separation + 1.0 * NM, situation.slot_distance)
    answer = rg.plan(replace(situation, min_separation=wide))
    if isinstance(answer, rg.NoPlan):
        return answer
    return rg.Plan.from_trajectory(answer.trajectory, situation, planner="careful")


for document in rg.record(rg.fly(rg.scenario("fig_6b"), careful), "careful.jsonl"):
    if isinstance(document, rg.FlightEnded):
        result = document.results[0]
        print(f"joined after {result.join_time:.0f} s, {result.fallbacks} fallbacks")

for document in rg.replay("careful.jsonl"):
    if isinstance(document, rg.PlanChanged):
        print(f"{document.t:4.0f} s: {document.message} (planner {document.plan.planner})")
