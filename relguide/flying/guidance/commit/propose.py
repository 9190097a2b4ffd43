"""propose(belief, …) → Proposal: a path to fly from now on, whatever was flown before."""

from dataclasses import replace
from math import inf

from relguide.flying.belief import Belief
from relguide.flying.guidance.amid import Nearing, keeps_clear
from relguide.flying.guidance.assignment import Assignment
from relguide.flying.guidance.commit.committed import Committed
from relguide.flying.guidance.commit.course import commit
from relguide.flying.guidance.commit.lead_in import LeadIn, lead_in
from relguide.flying.guidance.commit.preference import begun_now, nearest, turns_like
from relguide.flying.guidance.commit.proposal import NoProposal, Proposal
from relguide.flying.guidance.commit.shown_plan import shown_plan
from relguide.flying.guidance.situations import situation_now, situation_of
from relguide.planning.acceptance import FlyableAnswer, ask
from relguide.planning.outcome import Conflict, NoPlan, Planner, Reason
from relguide.planning.phrases import distance
from relguide.planning.situation import Situation
from relguide.planning.trajectory import Trajectory
from relguide.units import KT, Metre, Second

BUFFERS = 3
"""How often a wider berth is tried where the flight would come closer than the plan."""
WIDER: Metre = 100.0
"""… by how much more than it lacked [m]."""


def propose(
    belief: Belief,
    assignment: Assignment,
    committed: Committed | None,
    planner: Planner,
    *,
    like: Trajectory | None = None,
    stay: Second = 0.0,
) -> Proposal | NoProposal:
    """A path to fly from now on, whatever was flown before.

    Args:
        belief: what is known now.
        assignment: what was asked.
        committed: what is tracked now, which the lead-in goes on with; `None` if nothing is.
        planner: makes plans; they are judged before they are flown, whoever made them.
        like: a path that a crew has accepted and that is not flown yet: another way round is none
            of it; `None` if there is no such path.
        stay: the path nearest to the committed one, or else to `like`, is preferred unless the
            planner's is faster by more than this [s].
    """
    lead = lead_in(belief, assignment, committed)
    apart = lead.separation if belief.counted_separation < inf else inf
    limit = assignment.buffered_separation
    wanted = limit if apart >= limit else assignment.min_separation
    tries = BUFFERS if apart >= limit else BUFFERS + 1
    aside = wanted - assignment.min_separation
    before = lead.left if like is None or committed is not None else begun_now(like, belief)
    fell_back, refusal = False, None
    closest: Metre = 0.0
    in_the_way: Nearing | None = None
    for _ in range(tries):
        situation = _situation(lead, belief, assignment, wanted, aside)
        answer = ask(planner, situation)
        fell_back, refusal = fell_back or answer.fell_back, refusal or answer.refusal
        plan = answer.plan
        if isinstance(plan, NoPlan):
            if max(wanted, assignment.min_separation + aside) > assignment.kept_separation:
                return _propose_without_buffer(belief, assignment, planner, lead, answer)
            if plan.reason == Reason.SEPARATION_ALREADY_LOST:
                plan = _refuse_lost(plan, belief, assignment, planner, lead)
            return NoProposal(answer=plan, fell_back=fell_back, refusal=refusal)
        as_accepted = like is not None and turns_like(plan, like)
        if before is not None and stay > 0.0 and not as_accepted:
            kept = nearest(plan, before, stay)
            if kept.planner != plan.planner:
                kept, fell_back = replace(kept, fell_back=True), True
            plan = kept
        found = commit(plan, lead, belief, assignment)
        least = found.kept(found.forecast, belief.t, assignment)
        in_the_way = keeps_clear(found.forecast, belief, assignment)
        if least >= assignment.kept_separation and in_the_way is None:
            shown = shown_plan(plan, lead, belief, assignment)
            return Proposal(committed=found, shown=shown, fell_back=fell_back, refusal=refusal)
        if in_the_way is not None:
            aside += in_the_way.margin - in_the_way.spare + WIDER
        if least < assignment.kept_separation:
            closest = max(closest, least)
            wider = min(wanted + assignment.kept_separation - least + WIDER, assignment.aim)
            if apart < wider or wanted >= assignment.aim:
                break
            wanted = wider
    no_plan = (
        _too_close(closest, assignment)
        if in_the_way is None or closest > 0.0
        else _in_the_way(in_the_way, belief)
    )
    return NoProposal(answer=no_plan, fell_back=fell_back, refusal=refusal)


def _situation(
    lead: LeadIn, belief: Belief, assignment: Assignment, wanted: Metre, aside: Metre
) -> Situation:
    """What is asked of a planner, from where a lead-in ends."""
    return situation_of(
        assignment,
        lead.pursuer,
        lead.leader,
        belief,
        wanted,
        seconds=lead.seconds,
        aside=aside,
    )


def _propose_without_buffer(
    belief: Belief, assignment: Assignment, planner: Planner, lead: LeadIn, wide: FlyableAnswer
) -> Proposal | NoProposal:
    """With d_min and what is uncertain, where nothing keeps the buffer as well."""
    limit = assignment.kept_separation
    aside = limit - assignment.min_separation
    answer = ask(planner, _situation(lead, belief, assignment, limit, aside))
    fell_back = wide.fell_back or answer.fell_back
    refusal = answer.refusal or wide.refusal
    if isinstance(answer.plan, NoPlan):
        no_plan = answer.plan
        if no_plan.reason == Reason.SEPARATION_ALREADY_LOST:
            no_plan = _refuse_lost(no_plan, belief, assignment, planner, lead)
        return NoProposal(answer=no_plan, fell_back=fell_back, refusal=refusal)
    found = commit(answer.plan, lead, belief, assignment)
    least = found.kept(found.forecast, belief.t, assignment)
    if least < limit:
        too_close = _too_close(least, assignment)
        return NoProposal(answer=too_close, fell_back=fell_back, refusal=refusal)
    in_the_way = keeps_clear(found.forecast, belief, assignment)
    if in_the_way is not None:
        no_plan = _in_the_way(in_the_way, belief)
        return NoProposal(answer=no_plan, fell_back=fell_back, refusal=refusal)
    shown = shown_plan(answer.plan, lead, belief, assignment)
    return Proposal(committed=found, shown=shown, fell_back=fell_back, refusal=refusal)


def _lost_to_another(later: NoPlan, lead: LeadIn) -> NoPlan | None:
    """The refusal if another is too close where the lead-in ends; else `None`."""
    conflict = later.conflict
    if later.reason != Reason.SEPARATION_ALREADY_LOST or conflict is None:
        return None
    least, limit = conflict.least_separation, conflict.min_separation
    how = (
        f"{distance(least)} from {conflict.ident}, closer than {distance(limit)}"
        if limit > 0.0
        else f"{distance(-least)} inside {conflict.ident}"
    )
    message = f"In {lead.seconds:.0f} s, before another path can begin, the pursuer is {how}."
    return replace(later, message=message)


def _refuse_lost(
    later: NoPlan, belief: Belief, assignment: Assignment, planner: Planner, lead: LeadIn
) -> NoPlan:
    """Why no plan can begin where the lead-in ends, in figures of now."""
    to_another = _lost_to_another(later, lead)
    if to_another is not None:
        return to_another
    if belief.counted_separation < assignment.min_separation:
        now = ask(planner, situation_now(belief, assignment)).plan
        return now if isinstance(now, NoPlan) else later
    return NoPlan(
        reason=Reason.SEPARATION_UNAVOIDABLE,
        message=f"In {lead.seconds:.0f} s at {lead.pursuer.tas / KT:.0f} kt, before another path "
        f"can begin, the aircraft would be {distance(lead.separation)} apart, closer than "
        f"{distance(assignment.min_separation)}.",
    )


def _too_close(least: Metre, assignment: Assignment) -> NoPlan:
    """Why a plan that exists is not flown."""
    limit, kept = assignment.min_separation, assignment.kept_separation
    beside = f" and the {distance(kept - limit)} kept beside it" if least >= limit else ""
    return NoPlan(
        reason=Reason.SEPARATION_UNAVOIDABLE,
        message=f"A path exists, but an aircraft that has to roll and brake would come within "
        f"{distance(least)} of the leader on it, closer than {distance(limit)}{beside}.",
    )


def _in_the_way(other: Nearing, belief: Belief) -> NoPlan:
    """Why a plan that exists is not flown amid others."""
    return NoPlan(
        reason=Reason.TRAFFIC,
        message=f"A path exists, but on it, as an aircraft flies it, {other.sentence}.",
        conflict=Conflict(
            ident=other.ident,
            at_time=other.at - belief.t,
            least_separation=other.least,
            min_separation=other.limit,
        ),
    )
