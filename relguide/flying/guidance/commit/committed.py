"""The committed path: a plan with its lead-in, tracked as one path, and flown ahead."""

from math import hypot, inf
from typing import NamedTuple

import numpy as np

from relguide.flying.belief import Belief
from relguide.flying.guidance.assignment import Assignment
from relguide.flying.guidance.commit.segments import segments_of
from relguide.flying.guidance.forecast import Forecast
from relguide.kernels.base.angles import wrap
from relguide.kernels.flight import path as on
from relguide.kernels.flight.guide import Course
from relguide.planning.outcome import Plan
from relguide.planning.trajectory import Trajectory
from relguide.units import Metre, Second

BRAKES_FOR: Second = 600.0
"""How long after a plan's end its forecast may go on: to brake, and to close what the path lost."""


class Committed(NamedTuple):
    """What is flown now."""

    plan: Plan
    """As it was made: its t = 0 is the end of the lead-in, its air mass the world frame then."""
    begins: Second
    """Flight time of that t = 0 [s]."""
    course: Course
    """The whole path, lead-in included."""
    s: Metre
    """How much of it has been flown [m]."""
    forecast: Forecast
    """The closed loop flown ahead when it was committed, or looked at anew since."""
    accepted: Metre = 0.0
    """How far off the slot may be, by what the leader did since: no other path joins sooner [m]."""

    @property
    def due(self) -> Second:
        """When the ideal path arrives, flight time [s]; braking comes later."""
        return self.begins + self.plan.time_to_converge

    def joins_at(self, ahead: Forecast) -> Second:
        """When it joins by a forecast, or would at best if that does not, flight time [s]."""
        return ahead.join_time if ahead.joins else self.due

    def kept(self, ahead: Forecast, t: Second, assignment: Assignment) -> Metre:
        """The separation that it keeps by a forecast, from flight time t on [m].

        At a speed that the crew has selected it flies past the slot: that is no fault of the path,
        which counts until it is there.
        """
        until = self.joins_at(ahead) - t if assignment.selected_tas > 0.0 else inf
        return ahead.least(t, until)[0]

    def remaining(self, t: Second, tas: float) -> Trajectory:
        """What is left of the ideal path at flight time t [s], in the air mass of then."""
        path, since = self.course.path, t - self.course.begun
        x, y, heading = on.pose_on(path, self.s)
        end = float(path[-1, on.S])
        pieces = on.pieces_between(path, self.s, end) if self.s < end else np.zeros((0, 2))
        wind = self.course.wind
        return Trajectory(
            x=x + wind.east * since,
            y=y + wind.north * since,
            heading=wrap(heading),
            tas=tas,
            segments=segments_of(pieces),
        )


def place_on(committed: Committed, belief: Belief, before: Metre) -> tuple[Committed, Metre]:
    """The committed path as it has been flown until now.

    Args:
        committed: what is tracked.
        belief: gives the aircraft.
        before: how much of it had been flown a second ago [m].

    Returns:
        the same with its `s` of now, and how far to the right of it the aircraft is [m].
    """
    own, course = belief.own, committed.course
    wind, since = course.wind, belief.t - course.begun
    x, y = own.x - wind.east * since, own.y - wind.north * since
    s, right = on.project(course.path, x, y, before + own.tas)
    return committed._replace(s=s), right


def slot_mismatch(belief: Belief, committed: Committed) -> Metre:
    """How far the slot will be from where the committed plan has it when it arrives [m].

    By what the leader does otherwise than was expected: its place, its heading and its speed.
    """
    expected, now = committed.plan.situation.leader, belief.leader_after(0.0)
    left = max(committed.due - belief.t, 0.0)
    end, wind = now.trajectory.pose_at(left), belief.wind
    was, then = expected.trajectory.pose_at(committed.plan.time_to_converge), committed.course.wind
    elapsed = belief.t + left - committed.begins
    return hypot(
        end.x - was.x + wind.east * left - then.east * elapsed,
        end.y - was.y + wind.north * left - then.north * elapsed,
    )
