"""A plan with its lead-in as one path, and that path flown ahead."""

import numpy as np

from relguide.flying.belief import Belief
from relguide.flying.guidance.assignment import Assignment
from relguide.flying.guidance.commit.committed import BRAKES_FOR, Committed
from relguide.flying.guidance.commit.lead_in import LeadIn
from relguide.flying.guidance.forecast import forecast
from relguide.kernels.flight import path as on
from relguide.kernels.flight.guide import CONVERGE, Course, Progress
from relguide.planning.outcome import Plan
from relguide.units import Metre


def commit(plan: Plan, lead: LeadIn, belief: Belief, assignment: Assignment) -> Committed:
    """A plan as it would be flown from now on."""
    course, s = _course_of(plan, lead, belief, assignment)
    begins = belief.t + lead.seconds
    ahead = forecast(
        belief,
        assignment,
        Progress(CONVERGE, s, 0.0, 0.0),
        course,
        until=begins + plan.time_to_converge + BRAKES_FOR,
    )
    return Committed(plan=plan, begins=begins, course=course, s=s, forecast=ahead)


def _course_of(
    plan: Plan, lead: LeadIn, belief: Belief, assignment: Assignment
) -> tuple[Course, Metre]:
    """The path of a plan with its lead-in, and how much of it has been flown [m]."""
    bends = np.array(
        [bend for segment in plan.trajectory.segments for bend in segment.bends]
    ).reshape(-1, 2)
    tas, roll_rate = assignment.planned_tas, belief.limits.max_roll_rate
    if lead.committed is None:
        own = belief.own
        pieces = np.vstack([lead.pieces, bends])
        path = on.lay_path(own.x, own.y, own.heading, pieces, tas, own.bank, roll_rate)
        begun, s = belief.t, 0.0
    else:
        old, s = in_the_air_of_now(lead.committed.course, belief), lead.committed.s
        path = on.splice(old.path, s, s + tas * lead.seconds, bends, tas, roll_rate)
        begun = old.begun
    slot_tas = plan.situation.leader.tas
    arrives = belief.t + lead.seconds + plan.time_to_converge
    slot = float(path[-1, on.S]) - slot_tas * (arrives - begun)
    return Course(path, begun, slot, slot_tas, belief.drift, arrives), s


def in_the_air_of_now(course: Course, belief: Belief) -> Course:
    """A course where it lies over the ground now, in the air mass that moves as is now believed."""
    if course.wind == belief.drift:
        return course
    since = belief.t - course.begun
    path = course.path.copy()
    path[:, on.X] += course.wind.east * since
    path[:, on.Y] += course.wind.north * since
    return course._replace(
        path=path,
        begun=belief.t,
        slot=course.slot + course.slot_tas * since,
        wind=belief.drift,
    )
