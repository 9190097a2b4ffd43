"""Guidance without a plan, to hold ours against: three ways to a slot that crews and drones fly.

All of them believe the same, fly by the same autopilot and laws of speed, and have joined in the
same gate. None knows of a leader's intent, plans, looks ahead or keeps d_min.

- slot_pursuit heads for the slot, D behind the leader on its present track.
- pronav turns Nλ̇ towards the same slot, λ its bearing: so the bearing stays, which is a collision
  course. A slot that does not come nearer, or lies behind, is headed for.
- trail closes on the leader's flown path at 30° and follows it, as capture and follow do.

Near the slot both pursuits head for a point ahead of it on the leader's track, the farther the
nearer they are: the bearing of the slot itself says nothing there.
"""

from collections.abc import Callable
from math import atan2, cos, hypot, sin
from typing import NamedTuple

from relguide.flying.belief import Belief
from relguide.flying.guidance.announcements import Event
from relguide.flying.guidance.assignment import Assignment
from relguide.flying.guidance.forecast import NO_COURSE
from relguide.flying.guidance.memory import Advice, Memory, Slot, enter
from relguide.flying.guidance.stand_by import give_up_old_data
from relguide.flying.modes import NUMBERS
from relguide.kernels.base.angles import wrap, wrap_signed
from relguide.kernels.flight import marks as at
from relguide.kernels.flight.energy import regained
from relguide.kernels.flight.flight_records import HOLD_HEADING, TURN_RATE, Control
from relguide.kernels.flight.guide import CAPTURE, FOLLOW, Act, Progress, act
from relguide.kernels.flight.laws import (
    closing_tas,
    ground_track,
    heading_for_track,
    tas_for_ground_speed,
)
from relguide.kernels.flight.marks import beside_marks, mark_at
from relguide.units import DEG, Metre, MetrePerSecond, Radian, Second

NAVIGATION = 5.0
"""N of proportional navigation; 3 to 5 are usual, and this joins the leader of Fig. 6 soonest."""
IN_FRONT: Radian = 90.0 * DEG
"""Farther off its track than this, a slot lies behind."""
NEAR: Second = 30.0
"""How long the leader flies what counts as near the slot: thrice the heading loop's lag, so that
the leader's track is closed on without overshooting."""

Steer = Callable[["Chase", Belief], Control]
"""What a chase asks of the autopilot; its speed is set for it."""


class Chase(NamedTuple):
    """A slot behind the leader's present place, seen from the pursuer over the ground."""

    east: Metre
    """Of the pursuer."""
    north: Metre
    track: Radian
    """The leader's, and the slot's [rad]."""
    speed: MetrePerSecond
    """The same [m/s]."""

    @property
    def range(self) -> Metre:
        """How far away it is."""
        return hypot(self.east, self.north)

    @property
    def in_front(self) -> Metre:
        """How far ahead of the slot the point is that is headed for; 0 if not near."""
        return max(NEAR * self.speed - self.range, 0.0)


def pursue_slot(memory: Memory, belief: Belief, assignment: Assignment) -> tuple[Memory, Advice]:
    """Head for the slot."""
    return _chase(memory, belief, assignment, _head_for)


def navigate(memory: Memory, belief: Belief, assignment: Assignment) -> tuple[Memory, Advice]:
    """Keep the bearing of the slot, as proportional navigation does."""
    return _chase(memory, belief, assignment, _keep_bearing)


def fly_trail(memory: Memory, belief: Belief, assignment: Assignment) -> tuple[Memory, Advice]:
    """Close on the leader's flown path, and follow it."""
    memory, events = give_up_old_data(memory, belief, assignment)
    done, marks = _along_trail(memory, belief, assignment), belief.track.marks
    _, x, y, heading, _ = mark_at(marks, at.S, float(marks[-1, at.S]) - assignment.slot_distance)
    slot = Slot(x, y, wrap(heading), belief.leader.tas)
    return _advised(memory, belief, assignment, done, slot, events)


def _chase(
    memory: Memory, belief: Belief, assignment: Assignment, steer: Steer
) -> tuple[Memory, Advice]:
    memory, events = give_up_old_data(memory, belief, assignment)
    leader = belief.track.marks[-1]
    track, speed = float(leader[at.TRACK]), float(leader[at.SPEED])
    x = float(leader[at.X]) - assignment.slot_distance * sin(track)
    y = float(leader[at.Y]) - assignment.slot_distance * cos(track)
    chase = Chase(x - belief.own.x, y - belief.own.y, track, speed)
    done = _along_trail(memory, belief, assignment)
    if memory.engagement == "engaged":
        asked = steer(chase, belief)
        done = done._replace(control=asked._replace(tas=_tas(chase, belief, assignment)))
    slot = Slot(x, y, wrap(belief.leader.heading), belief.leader.tas)
    return _advised(memory, belief, assignment, done, slot, events)


def _head_for(chase: Chase, belief: Belief) -> Control:
    """The heading to the slot, or to a point in front of it."""
    x = chase.east + chase.in_front * sin(chase.track)
    y = chase.north + chase.in_front * cos(chase.track)
    heading = heading_for_track(atan2(x, y), belief.own.tas, belief.drift)
    return Control(HOLD_HEADING, heading, 0.0)


def _keep_bearing(chase: Chase, belief: Belief) -> Control:
    """The turn rate Nλ̇ while the slot is far, ahead, and comes nearer."""
    track, speed = ground_track(belief.own, belief.drift)
    east = chase.speed * sin(chase.track) - speed * sin(track)
    north = chase.speed * cos(chase.track) - speed * cos(track)
    off = abs(wrap_signed(atan2(chase.east, chase.north) - track))
    nears = chase.east * east + chase.north * north < 0.0
    if chase.in_front > 0.0 or off > IN_FRONT or not nears:
        return _head_for(chase, belief)
    rate = (east * chase.north - north * chase.east) / chase.range**2
    return Control(TURN_RATE, NAVIGATION * rate, 0.0)


def _tas(chase: Chase, belief: Belief, assignment: Assignment) -> MetrePerSecond:
    """The speed that closes the way to the slot: its range, and near it what lies in front."""
    own, gains = belief.own, assignment.gains
    to_slot = chase.range
    if chase.in_front > 0.0:
        to_slot = chase.east * sin(own.heading) + chase.north * cos(own.heading)
    keeping = tas_for_ground_speed(own.heading, chase.speed, belief.drift)
    return closing_tas(
        to_slot, keeping, assignment.planned_tas, regained(belief.limits, own), gains
    )


def _along_trail(memory: Memory, belief: Belief, assignment: Assignment) -> Act:
    """One act of the laws along the leader's flown path, which also says what has joined."""
    marks, own, progress = belief.track.marks, belief.own, memory.progress
    if memory.engagement == "engaged":
        expected = progress.s + own.tas
        if memory.mode == "heading":
            expected = float(marks[-1, at.S]) - assignment.slot_distance
        s, _ = beside_marks(marks, own.x, own.y, expected)
        mode = FOLLOW if memory.mode == "follow" else CAPTURE
        progress = Progress(mode, s - own.tas, 0.0, 0.0)
    return act(
        progress, own, belief.limits, NO_COURSE, marks, belief.turn_to_come, assignment.task,
        assignment.gate, assignment.gains, belief.drift, belief.t,
    )  # fmt: skip


def _advised(
    memory: Memory,
    belief: Belief,
    assignment: Assignment,
    done: Act,
    slot: Slot,
    events: list[Event],
) -> tuple[Memory, Advice]:
    if memory.engagement == "engaged":
        if memory.mode == "heading":
            memory, news = enter(memory, belief, "converge", "Flying to the slot, without a plan.")
            events = [*events, *news]
        if done.joined:
            memory, news = enter(memory, belief, "follow", "Joined.")
            events = [*events, *news]
        memory = memory._replace(progress=done.progress._replace(mode=NUMBERS[memory.mode]))
    tas = min(max(done.control.tas, belief.limits.min_tas), belief.limits.max_tas)
    return memory, Advice(
        control=done.control._replace(tas=tas),
        engagement=memory.engagement,
        leader_age=belief.leader_age,
        mode=memory.mode,
        slot=slot,
        slot_open=belief.slot_open(assignment.slot_distance),
        to_slot=done.to_slot,
        wind=belief.wind,
        margin=assignment.margin,
        along=done.to_slot + assignment.aim - assignment.slot_distance,
        across=done.right,
        time_to_go=0.0,
        joined=done.joined,
        alert="none",
        forecast=None,
        events=tuple(events),
    )
