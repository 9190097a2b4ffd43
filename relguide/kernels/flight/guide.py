"""One act of guidance, once a second, without planning: what is flown now, and what is asked next.

converge tracks the committed path over the ground: a path in an air mass that moves with the wind
that was believed when it was laid. What the wind is otherwise is made good by the heading. Where
nothing of it turns any more, capture closes onto the leader's flown path over the ground, and so
does follow once joined: both track the marks, so an aircraft turns where its leader turned. Speed
closes the spacing in all three. In the other modes a heading is held.
"""

from math import cos, hypot, sin, sqrt, tan
from typing import NamedTuple

from numba import njit

from relguide.kernels.base.angles import wrap_signed
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.flight import marks as at
from relguide.kernels.flight.energy import regained
from relguide.kernels.flight.flight_records import (
    HOLD_HEADING,
    Body,
    Control,
    Drift,
    Limits,
    move_to,
)
from relguide.kernels.flight.laws import (
    Gains,
    Way,
    closing_tas,
    ground_track,
    heading_for_track,
    look_ahead,
    tas_for_ground_speed,
    track,
)
from relguide.kernels.flight.marks import (
    beside_marks,
    mark_at,
    sharpest_bend,
    speed_when,
    straight_for,
)
from relguide.kernels.flight.path import heading_on, project, turning_after
from relguide.units import G0

HOLD, CONVERGE, CAPTURE, FOLLOW, ESCAPE = 0, 1, 2, 3, 4
"""Modes; in the first and the last a heading is held."""
BENDS_AHEAD = 45.0
"""How far ahead a bend of the leader's path is slowed down for [s]: 30 m/s at 0.7 m/s²."""
BEND_BANK = 0.95
"""Share of its bank that an aircraft plans to need in it."""


class Task(NamedTuple):
    """What the pursuer was asked to do."""

    tas: float
    """V_P, kept until the spacing closes [m/s]."""
    slot_distance: float
    """D [m]."""
    aim: float
    """Where in the gate it goes: D or a little more [m]."""
    spacing: float
    """Time behind the leader to keep [s]; 0 where a distance is kept."""
    min_separation: float
    """d_min and what is kept beyond it [m]."""


class Gate(NamedTuple):
    """When it has joined, and when it captures."""

    along: float
    """Farthest from the slot along the route [m]."""
    across: float
    """Farthest beside it [m]."""
    heading: float
    """Largest difference from the leader's heading [rad]."""
    capture_turn: float
    """A path that turns less is captured from [rad]."""
    capture_near: float
    """… once it has come so near to the leader's path [m], or …"""
    capture_slot: float
    """… with no more than this to close [m], if it ends no farther beside that path than …"""
    capture_across: float
    """… this [m], or …"""
    capture_late: float
    """… once it should have been flown to its end, no farther beside it than this [m]."""


class Course(NamedTuple):
    """A committed path, and where the slot is along it."""

    path: FloatArray
    """Rows of `path.py`, in the air mass, which was the world frame at `begun`."""
    begun: float
    """Flight time [s]."""
    slot: float
    """Place of the slot on the path's last straight, laid back to `begun` [m]."""
    slot_tas: float
    """How fast it moves along it [m/s]."""
    wind: Drift
    """That moves the air mass in which it was laid, as it was believed then."""
    due: float
    """When it ends at the slot, flight time [s]."""


class Progress(NamedTuple):
    """How far guidance has come."""

    mode: int
    s: float
    """On the path [m]; in capture and follow on the leader's flown path."""
    heading: float
    """Held where a heading is held [rad]."""
    tas: float
    """Held with it [m/s]."""


class Act(NamedTuple):
    """What is asked of the pursuer for a second, and how it stands."""

    control: Control
    progress: Progress
    right: float
    """How far to the right of what it tracks it is [m]."""
    to_slot: float
    """Distance still to close [m]."""
    joined: bool
    """In the gate, the slot open."""


@njit(cache=True, nogil=True)
def act(
    progress: Progress, body: Body, limits: Limits, course: Course, marks: FloatArray,
    turn_to_come: bool, task: Task, gate: Gate, gains: Gains, wind: Drift, t: float,
) -> Act:  # fmt: skip
    """What to ask of the pursuer at flight time t [s].

    Args:
        progress: as the second before left it.
        body: the pursuer.
        limits: what it can do.
        course: what it converges by; not looked at in other modes.
        marks: the leader's flown path, the last one now.
        turn_to_come: whether the leader has declared a turn that is not over.
        task: what the pursuer was asked to do.
        gate: when it has joined.
        gains: of the laws.
        wind: as it is believed.
        t: flight time [s].
    """
    mode = progress.mode
    if mode == CONVERGE:
        since = t - course.begun
        x, y = body.x - course.wind.east * since, body.y - course.wind.north * since
        rest = Drift(wind.east - course.wind.east, wind.north - course.wind.north)
        s, right = project(course.path, x, y, progress.s + body.tas)
        to_slot = course.slot + course.slot_tas * since - s
        if turning_after(course.path, s) > gate.capture_turn or not _is_near_marks(
            marks, body, task, gate, to_slot, t >= course.due
        ):
            tas = task.tas
            keeping = course.slot_tas - rest.east * sin(body.heading)
            keeping -= rest.north * cos(body.heading)
            if task.tas > keeping:
                tas = closing_tas(to_slot, keeping, tas, regained(limits, body), gains)
            aloft = move_to(body, x, y)
            control = _along_path(course.path, s, right, aloft, limits, gains, tas, rest)
            return Act(control, Progress(CONVERGE, s, 0.0, 0.0), right, to_slot, False)
        mode = CAPTURE
        progress = Progress(CAPTURE, _slot_on(marks, task) - to_slot - body.tas, 0.0, 0.0)
    if mode in (CAPTURE, FOLLOW):
        return _along_marks(
            mode, progress, body, limits, marks, turn_to_come, task, gate, gains, wind
        )
    asked = Control(HOLD_HEADING, progress.heading, progress.tas)
    return Act(asked, progress, 0.0, 0.0, False)


@njit(cache=True, nogil=True)
def _along_path(
    path: FloatArray, s: float, right: float, body: Body, limits: Limits, gains: Gains, tas: float,
    wind: Drift,
) -> Control:  # fmt: skip
    """Track the committed path; the body's place, and the wind, are those in its air mass."""
    x, y, heading = look_ahead(body, wind, gains.look_ahead)
    s_later, right_later = project(path, x, y, s + body.tas * gains.look_ahead)
    felt = s + body.tas * gains.lag
    way = Way(
        heading_for_track(heading_on(path, s), body.tas, wind),
        heading_for_track(heading_on(path, s_later), body.tas, wind),
        heading_for_track(heading_on(path, felt), body.tas, wind),
        heading_for_track(heading_on(path, felt + body.tas), body.tas, wind),
        right, right_later,
    )  # fmt: skip
    asked = track(way, heading, body, limits.max_bank, gains.path_bandwidth, gains)
    return Control(asked.kind, asked.value, tas)


@njit(cache=True, nogil=True)
def _slot_on(marks: FloatArray, task: Task) -> float:
    """Where on the leader's flown path the pursuer should be [m]."""
    last = marks[len(marks) - 1]
    if task.spacing > 0.0:
        behind = mark_at(marks, at.T, last[at.T] - task.spacing)[0]
        return min(behind, float(last[at.S] - task.min_separation))
    return float(last[at.S] - task.aim)


@njit(cache=True, nogil=True)
def _is_near_marks(
    marks: FloatArray, body: Body, task: Task, gate: Gate, to_slot: float, late: bool
) -> bool:
    """Whether the leader's flown path is near enough to be captured from here."""
    s, _ = beside_marks(marks, body.x, body.y, _slot_on(marks, task) - to_slot)
    _, x, y, heading, _ = mark_at(marks, at.S, s)
    # far from the path no place is next to it, and the nearest may lie ahead or behind
    across = hypot(body.x - x, body.y - y)
    off = abs(wrap_signed(body.heading - heading))
    if off > gate.capture_turn + gate.heading:
        return False
    # in wind its straight in the air mass leads to the slot, and not along the leader's ground path
    most = gate.capture_near if to_slot > gate.capture_slot else gate.capture_across
    return across < (gate.capture_late if late else most)


@njit(cache=True, nogil=True)
def _along_marks(
    mode: int, progress: Progress, body: Body, limits: Limits, marks: FloatArray,
    turn_to_come: bool, task: Task, gate: Gate, gains: Gains, wind: Drift,
) -> Act:  # fmt: skip
    s, right = beside_marks(marks, body.x, body.y, progress.s + body.tas)
    _, speed = ground_track(body, wind)
    leader = marks[len(marks) - 1]
    x, y, heading = look_ahead(body, wind, gains.look_ahead)
    s_later, right_later = beside_marks(marks, x, y, s + speed * gains.look_ahead)
    felt = s + speed * gains.lag
    way = Way(
        heading_for_track(mark_at(marks, at.S, s)[4], body.tas, wind),
        heading_for_track(mark_at(marks, at.S, s_later)[4], body.tas, wind),
        heading_for_track(mark_at(marks, at.S, felt)[4], body.tas, wind),
        heading_for_track(mark_at(marks, at.S, felt + speed)[4], body.tas, wind),
        right, right_later,
    )  # fmt: skip
    asked = track(way, heading, body, limits.max_bank, gains.follow_bandwidth, gains)
    to_slot = _slot_on(marks, task) - s
    # on a bend the leader is nearer than along its path: the shorter distance sets the speed
    room = hypot(body.x - leader[at.X], body.y - leader[at.Y]) - task.min_separation
    closing = min(to_slot, room) if room < 0.0 else to_slot
    speed_there = leader[at.SPEED]
    if task.spacing > 0.0:  # as fast as the leader was there, asked for a lag before
        speed_there = speed_when(marks, leader[at.T] - task.spacing + limits.speed_time)
    keeping = tas_for_ground_speed(body.heading, speed_there, wind)
    tas = closing_tas(closing, keeping, task.tas, regained(limits, body), gains)
    bend = sharpest_bend(marks, s, s + speed * BENDS_AHEAD, speed)
    if bend > 0.0:  # no faster than what can be banked for where the leader turned
        slow = sqrt(G0 * tan(BEND_BANK * limits.max_bank) / bend)
        tas = min(tas, max(tas_for_ground_speed(body.heading, slow, wind), limits.min_tas))
    ahead_of_slot = s - (leader[at.S] - task.slot_distance)
    if task.spacing > 0.0:
        ahead_of_slot = -to_slot
    joined = (
        not turn_to_come
        and abs(ahead_of_slot) <= gate.along
        and abs(right) <= gate.across
        and abs(wrap_signed(body.heading - leader[at.HEADING])) <= gate.heading
        and straight_for(marks, task.slot_distance)
    )
    if joined:
        mode = FOLLOW
    control = Control(asked.kind, asked.value, tas)
    return Act(control, Progress(mode, s, 0.0, 0.0), right, to_slot, joined)
