"""better(belief, …) → Proposal | NotBetter: the committed path stays until another is faster.

Faster by a margin, since a change of plan costs roll reversals, and what is far ahead is uncertain.
"""

from math import inf

from relguide.flying.belief import Belief
from relguide.flying.guidance.amid import keeps_clear
from relguide.flying.guidance.assignment import Assignment
from relguide.flying.guidance.commit.committed import Committed
from relguide.flying.guidance.commit.course import commit
from relguide.flying.guidance.commit.lead_in import lead_in
from relguide.flying.guidance.commit.proposal import NotBetter, Proposal
from relguide.flying.guidance.commit.shown_plan import shown_plan
from relguide.flying.guidance.situations import situation_of
from relguide.planning.acceptance import ask
from relguide.planning.outcome import NoPlan, Planner
from relguide.units import Second


def may_be_improved(committed: Committed, t: Second, assignment: Assignment) -> bool:
    """Whether any path could be faster than the committed one by the margin, by what is proved."""
    plan = committed.plan
    bound = plan.optimality.lower_bound
    return plan.time_to_converge - bound > change_margin(committed, t, assignment)


def better(
    belief: Belief, assignment: Assignment, committed: Committed, planner: Planner
) -> Proposal | NotBetter:
    """A path that is faster than the committed one by a margin, if there is one."""
    left, margin = committed.due - belief.t, change_margin(committed, belief.t, assignment)
    lead = lead_in(belief, assignment, committed)
    limit = assignment.buffered_separation
    if lead.separation < limit and belief.counted_separation < inf:
        return NotBetter(fell_back=False, refusal=None)
    situation = situation_of(
        assignment, lead.pursuer, lead.leader, belief, limit,
        seconds=lead.seconds, aside=limit - assignment.min_separation,
    )  # fmt: skip
    answer = ask(planner, situation)
    plan = answer.plan
    stays = NotBetter(fell_back=answer.fell_back, refusal=answer.refusal)
    if isinstance(plan, NoPlan) or lead.seconds + plan.time_to_converge > left - margin:
        return stays
    found = commit(plan, lead, belief, assignment)
    least = found.kept(found.forecast, belief.t, assignment)
    sooner = not committed.forecast.joins or (
        found.forecast.joins and found.forecast.join_time < committed.forecast.join_time - margin
    )
    if least < assignment.kept_separation or not sooner:
        return stays
    if keeps_clear(found.forecast, belief, assignment) is not None:
        return stays
    shown = shown_plan(plan, lead, belief, assignment)
    return Proposal(
        committed=found, shown=shown, fell_back=answer.fell_back, refusal=answer.refusal
    )


def change_margin(committed: Committed, t: Second, assignment: Assignment) -> Second:
    """By how much another path must be faster at flight time t [s]."""
    settings = assignment.settings
    return max(settings.better, settings.better_share * (committed.due - t))
