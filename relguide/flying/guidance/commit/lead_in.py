"""The lead-in: what is flown until an aircraft can have rolled into a plan that is made now."""

from dataclasses import dataclass
from math import ceil, hypot

import numpy as np

from relguide.flying.belief import Belief
from relguide.flying.guidance.assignment import Assignment
from relguide.flying.guidance.commit.committed import Committed
from relguide.flying.guidance.commit.segments import segments_of
from relguide.kernels.base.angles import wrap
from relguide.kernels.base.motion import advance
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.base.turn import turn_rate
from relguide.kernels.flight import path as on
from relguide.planning.aircraft import Leader, Pursuer
from relguide.planning.trajectory import Trajectory
from relguide.units import DEG, Metre, MetrePerSecond, Radian, Second

LEVEL: Radian = 1.0 * DEG
"""With less bank than this an aircraft is taken to fly straight on [rad]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class LeadIn:
    """Where a plan made now begins, and what is flown until then."""

    seconds: Second
    committed: Committed | None
    """The path that it goes on with; `None` if none is tracked."""
    pursuer: Pursuer
    """At its end, with the bank that plans use."""
    leader: Leader
    """At its end, with the rest of its intent."""
    pieces: FloatArray
    """What is flown until then: length [m] and curvature [rad/m] of each piece. shape (n, 2)"""
    start: tuple[Metre, Metre, Radian]
    """Where that begins now, over the ground: east [m], north [m], heading [rad]."""

    @property
    def separation(self) -> Metre:
        """Distance of the two at its end [m]."""
        return hypot(self.pursuer.x - self.leader.x, self.pursuer.y - self.leader.y)

    @property
    def left(self) -> Trajectory | None:
        """What is left of the committed path at its end; `None` if nothing is."""
        if self.committed is None:
            return None
        path, cut = self.committed.course.path, self.committed.s + self.pursuer.tas * self.seconds
        end = float(path[-1, on.S])
        if cut >= end:
            return None
        return self.pursuer.flying(segments_of(on.pieces_between(path, cut, end)))


def lead_time(assignment: Assignment, max_roll_rate: float) -> Second:
    """How long it takes until a turn that is asked for now can be half rolled into, whole [s]."""
    roll = 0.5 * assignment.planned_bank / (on.ROLL_SHARE * max_roll_rate)
    return float(ceil(roll + assignment.settings.lag))


def lead_in(belief: Belief, assignment: Assignment, committed: Committed | None) -> LeadIn:
    """What is flown while the aircraft rolls: the committed path, or on as it flies now."""
    own, wind = belief.own, belief.wind
    seconds = lead_time(assignment, belief.limits.max_roll_rate)
    length = assignment.planned_tas * seconds
    if committed is None:
        rate = turn_rate(own.tas, own.bank) if abs(own.bank) > LEVEL else 0.0
        pieces = np.array([[length, rate / own.tas]])
        start = own.x, own.y, own.heading
        x, y, heading = advance(own.x, own.y, own.heading, 1.0, rate / own.tas, length)
    else:
        path, s = committed.course.path, committed.s
        pieces = on.pieces_between(path, s, s + length)
        kept = _kept(pieces, assignment.planned_tas)
        if kept < len(pieces):
            pieces = pieces[:kept]
            length = float(pieces[:, 0].sum())
            seconds = length / assignment.planned_tas
        drifted, air = belief.t - committed.course.begun, committed.course.wind
        east, north = air.east * drifted, air.north * drifted
        x, y, heading = on.pose_on(path, s)
        start = x + east, y + north, heading
        x, y, heading = on.pose_on(path, s + length)
        x, y = x + east, y + north
    pursuer = Pursuer(
        x=x + wind.east * seconds,
        y=y + wind.north * seconds,
        heading=wrap(heading),
        tas=assignment.planned_tas,
        max_bank=assignment.planned_bank,
    )
    return LeadIn(
        seconds=seconds,
        committed=committed,
        pursuer=pursuer,
        leader=belief.leader_after(seconds),
        pieces=pieces,
        start=start,
    )


def _kept(pieces: FloatArray, tas: MetrePerSecond) -> int:
    """How many pieces are kept of a lead-in: not those behind a turn that ends in its last second.

    That it ends there was planned a second ago, and the next plan may go on with it. Were the end
    kept each time, a path made anew each second would put it off in steps, turning to and fro.

    Args:
        pieces: length [m] and curvature [rad/m] of each. shape (n, 2)
        tas: the pursuer's [m/s].
    """
    rows: list[list[float]] = pieces.tolist()
    kept, behind = len(rows), 0.0
    for k in range(len(rows) - 1, 0, -1):
        behind += rows[k][0]
        if behind >= tas:
            break
        before, after = rows[k - 1][1], rows[k][1]
        if before * after < 0.0 or (before != 0.0 and after == 0.0):
            kept = k
    return kept
