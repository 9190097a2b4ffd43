"""The plan as a crew sees it: from where it begins now, its lead-in included, certified anew."""

from dataclasses import replace

from relguide.flying.belief import Belief
from relguide.flying.guidance.assignment import Assignment
from relguide.flying.guidance.commit.committed import Committed
from relguide.flying.guidance.commit.lead_in import LeadIn, lead_in
from relguide.flying.guidance.commit.segments import join_segments, segments_of
from relguide.flying.guidance.situations import situation_now
from relguide.kernels.base.angles import wrap
from relguide.planning.certificate import certify
from relguide.planning.outcome import Plan


def shown_plan(plan: Plan, lead: LeadIn, belief: Belief, assignment: Assignment) -> Plan:
    """A new plan with its lead-in."""
    now = situation_now(belief, assignment)
    x, y, heading = lead.start
    now = replace(now, pursuer=replace(now.pursuer, x=x, y=y, heading=wrap(heading)))
    segments = join_segments(segments_of(lead.pieces), plan.trajectory.segments)
    trajectory = now.pursuer.flying(segments)
    return replace(
        plan,
        situation=now,
        trajectory=trajectory,
        certificate=certify(trajectory, now),
        optimality=replace(plan.optimality, lower_bound=plan.optimality.lower_bound + lead.seconds),
    )


def shown_rest(committed: Committed, belief: Belief, assignment: Assignment) -> Plan:
    """What is left of a committed plan."""
    lead = lead_in(belief, assignment, committed)
    left = committed.remaining(belief.t, assignment.planned_tas)
    now = situation_now(belief, assignment)
    now = replace(now, pursuer=replace(now.pursuer, x=left.x, y=left.y, heading=left.heading))
    plan = committed.plan
    return replace(
        plan,
        situation=now,
        trajectory=left,
        word=left.letters,
        certificate=certify(left, now),
        optimality=replace(
            plan.optimality,
            lower_bound=min(plan.optimality.lower_bound + lead.seconds, left.duration),
            proof="none",
        ),
    )
