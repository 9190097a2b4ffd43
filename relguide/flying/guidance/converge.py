"""Which path to fly: plans are led in, flown ahead, and accepted only if what is flown keeps d_min.

The committed path stays until another is better by a margin, or the leader does something that
moves the slot away from its end. The fastest plan is discontinuous in the situation: 100 m may
change it by a minute, and move it to the other side of the leader. So while the leader turns, the
same branch is solved again from where the path leads, and left only for much.
"""

from dataclasses import dataclass, replace

from relguide.flying.belief import Belief
from relguide.flying.guidance.assignment import Assignment
from relguide.flying.guidance.committed import (
    Committed,
    LeadIn,
    course_of,
    lead_in,
    segments_of,
    situation_now,
    situation_of,
)
from relguide.flying.guidance.forecast import forecast
from relguide.flying.guidance.path_distance import distance_between, is_same_path
from relguide.kernels.flight import path as on
from relguide.kernels.flight.guide import CONVERGE, Progress
from relguide.planning.acceptance import Answer, Refusal, ask
from relguide.planning.certificate import certify
from relguide.planning.phrases import distance
from relguide.planning.plan import AS_FAST, NoPlan, Optimality, Plan, Planner, Reason
from relguide.planning.situation import Situation
from relguide.planning.trajectory import Trajectory
from relguide.planning.words import candidates
from relguide.units import Metre, Second

BRAKES_FOR: Second = 600.0
"""How long after a plan's end its forecast may go on: to brake, and to close what the path lost."""
BUFFERS = 3
"""How often a wider berth is tried where the flight would come closer than the plan."""
WIDER: Metre = 100.0
"""… by how much more than it lacked [m]."""
LIKE_BEFORE = 0.06
"""Share of its length that a path solved again may lie from the one before."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Proposal:
    """A path that may be flown, and how it would be."""

    committed: Committed
    lead: LeadIn
    fell_back: bool
    """Whether an exact plan took the place of the planner's: its own may not be flown, or the
    branch before is kept."""
    refusal: Refusal | None
    """Why the planner's own plan is not flown; `None` if it was not asked, or may be flown."""


@dataclass(frozen=True, slots=True, kw_only=True)
class NoProposal:
    """Nothing to fly, and why."""

    answer: NoPlan
    fell_back: bool
    refusal: Refusal | None


@dataclass(frozen=True, slots=True, kw_only=True)
class NotBetter:
    """What was committed to stays."""

    fell_back: bool
    refusal: Refusal | None


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
        like: a path that a crew has accepted and that is not flown yet, begun now: another way
            round is none of it; `None` if there is no such path.
        stay: the path nearest to the committed one, or else to `like`, is preferred unless the
            planner's is faster by more than this [s].
    """
    lead = lead_in(belief, assignment, committed)
    pursuer, leader, apart = lead.pursuer, lead.leader, lead.separation
    limit = assignment.buffered_separation
    limits = [limit] if apart >= limit else []
    before = like if committed is None else _left_of(committed, lead, assignment)
    fell_back, refusal = False, None
    closest: Metre = 0.0
    while len(limits) <= BUFFERS:
        wanted = limits[-1] if limits else assignment.min_separation
        situation = situation_of(assignment, pursuer, leader, belief, wanted)
        answer = ask(planner, situation)
        fell_back, refusal = fell_back or answer.fell_back, refusal or answer.refusal
        plan = answer.plan
        if isinstance(plan, Plan) and before is not None and stay > 0.0:
            kept = plan if _turns_like(plan, like) else _nearest(plan, before, stay)
            if kept.planner != plan.planner:
                kept, fell_back = replace(kept, fell_back=True), True
            plan = kept
        if isinstance(plan, NoPlan):
            if limits and wanted > assignment.min_separation:
                return _propose_without_buffer(belief, assignment, committed, planner, lead, answer)
            if plan.reason == Reason.SEPARATION_ALREADY_LOST:
                plan = _refuse_lost(plan, belief, assignment, planner, lead)
            return NoProposal(answer=plan, fell_back=fell_back, refusal=refusal)
        found = commit(plan, lead, belief, assignment, committed)
        least, _ = found.forecast.least(belief.t)
        if least >= assignment.min_separation:
            return Proposal(committed=found, lead=lead, fell_back=fell_back, refusal=refusal)
        closest = max(closest, least)
        limits.append(min(wanted + assignment.min_separation - least + WIDER, assignment.aim))
        if apart < limits[-1] or wanted >= assignment.aim:
            break
    return NoProposal(answer=_too_close(closest, assignment), fell_back=fell_back, refusal=refusal)


def _propose_without_buffer(
    belief: Belief,
    assignment: Assignment,
    committed: Committed | None,
    planner: Planner,
    lead: LeadIn,
    wide: Answer,
) -> Proposal | NoProposal:
    """With d_min alone, where nothing keeps the buffer as well."""
    limit = assignment.min_separation
    answer = ask(planner, situation_of(assignment, lead.pursuer, lead.leader, belief, limit))
    fell_back = wide.fell_back or answer.fell_back
    refusal = answer.refusal or wide.refusal
    if isinstance(answer.plan, NoPlan):
        return NoProposal(answer=answer.plan, fell_back=fell_back, refusal=refusal)
    found = commit(answer.plan, lead, belief, assignment, committed)
    least, _ = found.forecast.least(belief.t)
    if least < limit:
        too_close = _too_close(least, assignment)
        return NoProposal(answer=too_close, fell_back=fell_back, refusal=refusal)
    return Proposal(committed=found, lead=lead, fell_back=fell_back, refusal=refusal)


def _refuse_lost(
    later: NoPlan, belief: Belief, assignment: Assignment, planner: Planner, lead: LeadIn
) -> NoPlan:
    """Why no plan can begin where the lead-in ends, in figures of now."""
    if belief.separation < assignment.min_separation:
        now = ask(planner, situation_now(belief, assignment)).plan
        return now if isinstance(now, NoPlan) else later
    return NoPlan(
        reason=Reason.SEPARATION_UNAVOIDABLE,
        message=f"In {lead.seconds:.0f} s, before another path can begin, the aircraft are "
        f"{distance(lead.separation)} apart, closer than {distance(assignment.min_separation)}.",
    )


def _too_close(least: Metre, assignment: Assignment) -> NoPlan:
    """Why a plan that exists is not flown."""
    limit = assignment.min_separation
    return NoPlan(
        reason=Reason.SEPARATION_UNAVOIDABLE,
        message=f"A path exists, but an aircraft that has to roll and brake would come within "
        f"{distance(least)} of the leader on it, closer than {distance(limit)}.",
    )


def better(
    belief: Belief, assignment: Assignment, committed: Committed, planner: Planner
) -> Proposal | NotBetter:
    """A path that is faster than the committed one by a margin, if there is one."""
    settings = assignment.settings
    left = committed.due - belief.t
    margin = max(settings.better, settings.better_share * left)
    lead = lead_in(belief, assignment, committed)
    limit = assignment.buffered_separation
    if lead.separation < limit:
        return NotBetter(fell_back=False, refusal=None)
    answer = ask(planner, situation_of(assignment, lead.pursuer, lead.leader, belief, limit))
    stays = NotBetter(fell_back=answer.fell_back, refusal=answer.refusal)
    if isinstance(answer.plan, NoPlan):
        return stays
    if lead.seconds + answer.plan.time_to_converge > left - margin:
        return stays
    found = commit(answer.plan, lead, belief, assignment, committed)
    least, _ = found.forecast.least(belief.t)
    sooner = not committed.forecast.joins or (
        found.forecast.joins and found.forecast.join_time < committed.forecast.join_time - margin
    )
    if least < assignment.min_separation or not sooner:
        return stays
    return Proposal(committed=found, lead=lead, fell_back=answer.fell_back, refusal=answer.refusal)


def commit(
    plan: Plan,
    lead: LeadIn,
    belief: Belief,
    assignment: Assignment,
    committed: Committed | None,
) -> Committed:
    """A plan with its lead-in as one path, and that path flown ahead."""
    course, s = course_of(plan, lead, belief, assignment, committed)
    begins = belief.t + lead.seconds
    ahead = forecast(
        belief,
        assignment,
        Progress(CONVERGE, s, 0.0, 0.0),
        course,
        until=begins + plan.time_to_converge + BRAKES_FOR,
    )
    return Committed(plan=plan, begins=begins, course=course, s=s, forecast=ahead)


def may_be_improved(committed: Committed, t: Second, assignment: Assignment) -> bool:
    """Whether any path could be faster than the committed one by the margin, by what is proved."""
    settings = assignment.settings
    bound = committed.plan.optimality.lower_bound
    margin = max(settings.better, settings.better_share * (committed.due - t))
    return committed.plan.time_to_converge - bound > margin


def _left_of(committed: Committed, lead: LeadIn, assignment: Assignment) -> Trajectory | None:
    """What is left of the committed path where the lead-in ends; `None` if nothing is."""
    path, cut = committed.course.path, committed.s + assignment.tas * lead.seconds
    end = float(path[-1, on.S])
    if cut >= end:
        return None
    return lead.pursuer.flying(segments_of(on.pieces_between(path, cut, end)))


def _turns_like(plan: Plan, like: Trajectory | None) -> bool:
    """Whether a plan turns to the same sides as an accepted path, one after the other."""
    return like is not None and _sides(plan.trajectory) == _sides(like)


def _sides(path: Trajectory) -> str:
    return path.letters.replace("S", "")


def _nearest(plan: Plan, before: Trajectory, stay: Second) -> Plan:
    """The plan, or the extremal nearest to the path before if it is little slower."""
    if is_same_path(before, plan.trajectory):
        return plan
    found = candidates(plan.situation)
    near: list[Trajectory] = [
        candidate.trajectory
        for candidate in (*found.at_release, *found.later)
        if is_same_path(before, candidate.trajectory, share=LIKE_BEFORE)
        and candidate.time_to_converge < plan.time_to_converge + stay
    ]
    near.sort(key=lambda trajectory: distance_between(before, trajectory))
    for trajectory in near:
        kept = _as_plan(trajectory, plan.situation, found.bound)
        if kept.certificate.holds:
            return kept
    return plan


def _as_plan(trajectory: Trajectory, situation: Situation, bound: Second) -> Plan:
    fastest = trajectory.duration <= bound + AS_FAST  # the same root, rounded
    return Plan(
        situation=situation,
        trajectory=trajectory,
        word=trajectory.letters,
        certificate=certify(trajectory, situation),
        optimality=Optimality(proof="relaxation" if fastest else "none", lower_bound=bound),
        planner="exact",
        compute_time=0.0,
    )
