"""A plan that is flown: led in, tracked as one path, and flown ahead before it is accepted."""

from dataclasses import dataclass, replace
from math import ceil, hypot
from typing import NamedTuple

import numpy as np

from relguide.flying.belief import Belief
from relguide.flying.guidance.assignment import Assignment
from relguide.flying.guidance.forecast import Forecast
from relguide.kernels.base.angles import wrap
from relguide.kernels.base.motion import advance
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.base.turn import turn_rate
from relguide.kernels.flight import path as on
from relguide.kernels.flight.guide import Course
from relguide.planning.certificate import certify
from relguide.planning.plan import Plan
from relguide.planning.situation import Leader, Pursuer, Situation
from relguide.planning.trajectory import (
    LEFT,
    RIGHT,
    Arc,
    Segment,
    Straight,
    Trajectory,
)
from relguide.units import DEG, Metre, MetrePerSecond, Radian, Second

LEVEL: Radian = 1.0 * DEG
"""With less bank than this an aircraft is taken to fly straight on [rad]."""
NOTHING: Metre = 1e-3
"""A piece shorter than this is where two others meet [m]."""


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

    @property
    def due(self) -> Second:
        """When the ideal path arrives, flight time [s]; braking comes later."""
        return self.begins + self.plan.time_to_converge

    def joins_at(self, ahead: Forecast) -> Second:
        """When it joins by a forecast, or would at best if that does not, flight time [s]."""
        return ahead.join_time if ahead.joins else self.due

    def remaining(self, t: Second, tas: float) -> Trajectory:
        """What is left of the ideal path at flight time t [s], in the air mass of then."""
        path, since = self.course.path, t - self.course.begun
        x, y, heading = on.pose_on(path, self.s)
        end = float(path[-1, on.S])
        pieces = on.pieces_between(path, self.s, end) if self.s < end else np.zeros((0, 2))
        wind = self.plan.situation.wind
        return Trajectory(
            x=x + wind.east * since,
            y=y + wind.north * since,
            heading=wrap(heading),
            tas=tas,
            segments=segments_of(pieces),
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class LeadIn:
    """Where a plan made now begins: what is flown until the aircraft can have rolled into it."""

    seconds: Second
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


def lead_time(assignment: Assignment, max_roll_rate: float) -> Second:
    """How long it takes until a turn that is asked for now can be half rolled into, whole [s]."""
    roll = 0.5 * assignment.planned_bank / (on.ROLL_SHARE * max_roll_rate)
    return float(ceil(roll + assignment.settings.lag))


def lead_in(belief: Belief, assignment: Assignment, committed: Committed | None) -> LeadIn:
    """What is flown while the aircraft rolls: the committed path, or on as it flies now."""
    own, wind = belief.own, belief.wind
    seconds = lead_time(assignment, belief.limits.max_roll_rate)
    length = assignment.tas * seconds
    if committed is None:
        rate = turn_rate(own.tas, own.bank) if abs(own.bank) > LEVEL else 0.0
        pieces = np.array([[length, rate / own.tas]])
        start = own.x, own.y, own.heading
        x, y, heading = advance(own.x, own.y, own.heading, 1.0, rate / own.tas, length)
    else:
        path, s = committed.course.path, committed.s
        pieces = on.pieces_between(path, s, s + length)
        kept = _kept(pieces, assignment.tas)
        if kept < len(pieces):
            pieces = pieces[:kept]
            length = float(pieces[:, 0].sum())
            seconds = length / assignment.tas
        drifted = belief.t - committed.course.begun
        east, north = wind.east * drifted, wind.north * drifted
        x, y, heading = on.pose_on(path, s)
        start = x + east, y + north, heading
        x, y, heading = on.pose_on(path, s + length)
        x, y = x + east, y + north
    pursuer = Pursuer(
        x=x + wind.east * seconds,
        y=y + wind.north * seconds,
        heading=wrap(heading),
        tas=assignment.tas,
        max_bank=assignment.planned_bank,
    )
    leader = belief.leader_after(seconds)
    return LeadIn(seconds=seconds, pursuer=pursuer, leader=leader, pieces=pieces, start=start)


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


def begun_now(path: Trajectory, belief: Belief) -> Trajectory:
    """A path with the same turns and lengths, from where the aircraft is."""
    own = belief.own
    return replace(path, x=own.x, y=own.y, heading=wrap(own.heading))


def situation_now(belief: Belief, assignment: Assignment) -> Situation:
    """The situation as it is, with V_P and the bank of the plans."""
    own = belief.own
    pursuer = Pursuer(
        x=own.x,
        y=own.y,
        heading=wrap(own.heading),
        tas=assignment.tas,
        max_bank=assignment.planned_bank,
    )
    leader = belief.leader_after(0.0)
    return situation_of(assignment, pursuer, leader, belief, assignment.min_separation)


def situation_of(
    assignment: Assignment,
    pursuer: Pursuer,
    leader: Leader,
    belief: Belief,
    min_separation: Metre,
) -> Situation:
    """Both aircraft with what the assignment asks, aimed at the place in the gate."""
    return Situation(
        pursuer=pursuer,
        leader=leader,
        slot_distance=assignment.aim,
        min_separation=min_separation,
        wind=belief.wind,
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
    own, wind, since = belief.own, belief.wind, belief.t - committed.course.begun
    x, y = own.x - wind.east * since, own.y - wind.north * since
    s, right = on.project(committed.course.path, x, y, before + own.tas)
    return committed._replace(s=s), right


def course_of(
    plan: Plan, lead: LeadIn, belief: Belief, assignment: Assignment, committed: Committed | None
) -> tuple[Course, Metre]:
    """The path of a plan with its lead-in, and how much of it has been flown [m]."""
    bends = np.array(
        [bend for segment in plan.trajectory.segments for bend in segment.bends]
    ).reshape(-1, 2)
    tas, roll_rate = assignment.tas, belief.limits.max_roll_rate
    if committed is None:
        own = belief.own
        pieces = np.vstack([lead.pieces, bends])
        path = on.lay_path(own.x, own.y, own.heading, pieces, tas, own.bank, roll_rate)
        begun, s = belief.t, 0.0
    else:
        old, s = committed.course, committed.s
        path = on.splice(old.path, s, s + tas * lead.seconds, bends, tas, roll_rate)
        begun = old.begun
    slot_tas = plan.situation.leader.tas
    arrives = belief.t + lead.seconds + plan.time_to_converge
    slot = float(path[-1, on.S]) - slot_tas * (arrives - begun)
    return Course(path, begun, slot, slot_tas), s


def shown_plan(plan: Plan, lead: LeadIn, belief: Belief, assignment: Assignment) -> Plan:
    """The plan as people see it: with its lead-in, from where it begins now, certified anew."""
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


def segments_of(pieces: FloatArray) -> tuple[Segment, ...]:
    """Pieces of constant curvature as segments; boundary arcs come as their arcs.

    A course is laid in parts: what goes on across their ends is one segment.
    """
    segments: tuple[Segment, ...] = ()
    for length, curvature in pieces.tolist():
        if length < NOTHING:
            continue
        piece: Segment = Straight(length=length)
        if curvature != 0.0:
            turn = RIGHT if curvature > 0.0 else LEFT
            angle = length * abs(curvature)
            piece = Arc(turn=turn, turn_angle=angle, radius=1.0 / abs(curvature))
        segments = join_segments(segments, (piece,))
    return segments


def join_segments(first: tuple[Segment, ...], then: tuple[Segment, ...]) -> tuple[Segment, ...]:
    """Two runs of segments as one, where they meet made one segment if they are alike."""
    if first and then:
        match first[-1], then[0]:
            case Straight(length=one), Straight(length=other):
                return (*first[:-1], Straight(length=one + other), *then[1:])
            case (
                Arc(turn=turn, turn_angle=one, radius=radius),
                Arc(turn=same, turn_angle=other, radius=like),
            ) if turn == same and abs(radius - like) < 1.0:
                arc = Arc(turn=turn, turn_angle=one + other, radius=radius)
                return (*first[:-1], arc, *then[1:])
            case _:
                pass
    return (*first, *then)


def slot_mismatch(belief: Belief, committed: Committed) -> Metre:
    """How far the slot will be from where the committed plan has it when it arrives [m].

    By what the leader does otherwise than was expected: its place, its heading and its speed.
    """
    expected, now = committed.plan.situation.leader, belief.leader_after(0.0)
    end = now.trajectory.pose_at(max(committed.due - belief.t, 0.0))
    was = expected.trajectory.pose_at(committed.plan.time_to_converge)
    elapsed, wind = belief.t - committed.begins, belief.wind
    return hypot(end.x - was.x - wind.east * elapsed, end.y - was.y - wind.north * elapsed)
