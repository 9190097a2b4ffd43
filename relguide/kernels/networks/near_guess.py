"""Constrained paths of a given template, solved next to a guess: what a network is asked for.

The search of `constrained_search` looks at all bearings and all words. Where it is known which word
leads to the contact, on which side, and what follows it, one unknown is left, the bearing b of the
contact; and behind a leader that keeps straight nothing depends on time. So with the time t₁(b) to
the contact, and t₂(b) on from there,

    t₁(b) + t₂(b)

is minimised near the guess. Where simple pieces touch the disc by themselves, b is no unknown
either (see `touch_points`). A branch is a word, those of three turns by their middle arc: one of
`branches`.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise; the leader is at (D/R, 0) at
t = 0 and keeps heading 0.
"""

from math import cos, inf, pi, sin
from typing import NamedTuple

import numpy as np
from numba import njit

from relguide.kernels.base.angles import wrap
from relguide.kernels.base.records import Disc, Pose, Scene, Velocity, Window
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.contact import contact_heading
from relguide.kernels.contact.touch_points import mirror_disc, next_contact, slide_between
from relguide.kernels.words.branches import WORD_OF
from relguide.kernels.words.extremals import MAX_ROWS, solve_word

LS, RS, LR, RL = 8, 9, 10, 11
"""Entries that touch the disc by themselves; before them come the branches, as `branches`."""
ON_B, ON_LR, ON_RL, ON_TOUCH_B, ON_B_TOUCH = 8, 9, 10, 11, 12
"""How a path goes on: along the disc; by two turns that touch it; by a turn and a straight to a
boundary arc; by a boundary arc, a straight and a turn to one more contact. Before them come the
branches."""
_STRIDE = 0.03  # of the first look beside a guess: 2°, about as good as guesses are [rad]
_PROBES = np.array((0.02, 0.04, 0.06, 0.09, 0.18, 0.27))  # where it is looked again, either way
_MOST = 60  # evaluations of t₁ + t₂ at one go
_FINEST = 1e-6  # bearing steps end here: 1 cm at R = 12 km
_GAIN = 1e-9  # or where a parabola promises less [R/V_P]


class Task(NamedTuple):
    """What a constrained path of one template is solved for."""

    start: Pose
    """Slot frame, its heading in [0, 2π)."""
    scene: Scene
    """A leader that keeps straight, and how far from it words must stay: d_min less a graze."""
    disc: Disc
    """Where contacts and boundary arcs are, and the side on which the leader is passed."""
    entry: int
    """How the disc is reached: a branch, or one of `LS` … `RL`."""
    on: int
    """How the path goes on: a branch, or one of `ON_B` … `ON_B_TOUCH`."""


class Room(NamedTuple):
    """Where a path is put together."""

    found: FloatArray
    """Roots of a word. shape (MAX_ROWS, 4)"""
    rows: FloatArray
    """Paths of a word. shape (MAX_ROWS, 5)"""
    path: FloatArray
    """The words before and after the contact. shape (2, 5)"""
    link: FloatArray
    """What lies between them: bearing, turn and straight of the boundary arc's end on the solved
    contact's side, the bearing of its other end, unwrapped, and how long it takes. shape (5,)"""


@njit(cache=True, nogil=True)
def empty_room() -> Room:
    """Room without a path."""
    return Room(np.empty((MAX_ROWS, 4)), np.empty((MAX_ROWS, 5)), np.zeros((2, 5)), np.zeros(5))


@njit(cache=True, nogil=True)
def room_beside(room: Room) -> Room:
    """Room for another path, with the same scratch."""
    return Room(room.found, room.rows, np.zeros((2, 5)), np.zeros(5))


@njit(cache=True, nogil=True)
def keep_path(trial: Room, room: Room) -> None:
    """Copy the path of one room into another."""
    room.path[:], room.link[:] = trial.path, trial.link


@njit(cache=True, nogil=True)
def slot_of(scene: Scene) -> float:
    """How far ahead of the slot the leader is [R]."""
    return float(scene.leader[0, 1])


@njit(cache=True, nogil=True)
def from_leader(pose: Pose, scene: Scene) -> Pose:
    """A pose at t = 0, seen from the leader."""
    return Pose(pose.x - slot_of(scene), pose.y, pose.h)


@njit(cache=True, nogil=True)
def _soonest_row(pose: Pose, target: Velocity, branch: int, room: Room) -> int:
    """The soonest path of a branch to a moving target, as its row number; −1 if there is none."""
    word = WORD_OF[branch]
    n = solve_word(pose, target, Window(0.0, inf), word, room.found, room.rows, 0)
    for i in range(n):
        if branch < 4 or (room.rows[i, 3] > pi) == (branch % 2 == 1):
            return i
    return -1


@njit(cache=True, nogil=True)
def enter(task: Task, bearing: float, room: Room) -> bool:
    """Put the soonest path of the entry's branch to a contact first in `room.path`, if any."""
    disc, start = task.disc, from_leader(task.start, task.scene)
    course = contact_heading(bearing, disc.side, disc.alpha)
    c, s = cos(course), sin(course)
    dx, dy = start.x - disc.distance * cos(bearing), start.y - disc.distance * sin(bearing)
    seen = Pose(dx * c + dy * s, dy * c - dx * s, wrap(start.h - course))
    i = _soonest_row(seen, Velocity(disc.alpha * c, -disc.alpha * s), task.entry, room)
    if i < 0:
        return False
    room.path[0] = room.rows[i]
    return True


@njit(cache=True, nogil=True)
def leave(task: Task, bearing: float, branch: int, room: Room) -> bool:
    """Put the soonest path of a branch from a contact to the slot last in `room.path`, if any."""
    disc = task.disc
    course = wrap(contact_heading(bearing, disc.side, disc.alpha))
    x, y = slot_of(task.scene) + disc.distance * cos(bearing), disc.distance * sin(bearing)
    i = _soonest_row(Pose(x, y, course), Velocity(disc.alpha, 0.0), branch, room)
    if i < 0:
        return False
    room.path[1] = room.rows[i]
    return True


@njit(cache=True, nogil=True)
def time_through(bearing: float, task: Task, fixed: FloatArray, room: Room) -> float:
    """Time through the contact that is not fixed by itself: to it, and on from there.

    Args:
        bearing: of the contact from the leader [rad].
        task: the template and where it is solved; the entry does not count with `ON_B_TOUCH`, by
            which the path comes to this contact.
        fixed: bearing of the boundary arc's other end, and time from the start to there, or on
            from there. shape (2,)
        room: takes the path.

    Returns:
        time; infinite if there is no such path.
    """
    if task.on == ON_B_TOUCH:
        return _time_through_second(bearing, task, fixed, room)
    if not enter(task, bearing, room):
        return inf
    disc, link, time = task.disc, room.link, room.path[0, 0]
    if task.on == ON_TOUCH_B:
        course = contact_heading(bearing, disc.side, disc.alpha)
        if not next_contact(bearing, disc, course, link):
            return inf
        link[3], link[4] = slide_between(link[0], fixed[0], disc)
        return float(time + link[1] + link[2] + link[4] + fixed[1])
    if not leave(task, bearing, task.on, room):
        return inf
    return float(time + room.path[1, 0])


@njit(cache=True, nogil=True)
def _time_through_second(bearing: float, task: Task, fixed: FloatArray, room: Room) -> float:
    """As `time_through`, where a boundary arc, a straight and a turn lead to the contact."""
    disc, link = task.disc, room.link
    if not leave(task, bearing, 0 if disc.side > 0.0 else 1, room):
        return inf
    # backward in time, with the world turned by π, the straight and the turn come after
    course = contact_heading(bearing, disc.side, disc.alpha)
    if not next_contact(bearing + pi, mirror_disc(disc), course, link):
        return inf
    link[0] += pi
    link[3], link[4] = slide_between(fixed[0], link[0], disc)
    time = fixed[1] + link[4] + link[2] + link[1]
    return float(time + room.path[1, 0])


@njit(cache=True, nogil=True)
def descend(bearing: float, task: Task, fixed: FloatArray, room: Room) -> tuple[float, float]:
    """The least time of `time_through` next to a bearing, and where; infinite if there is none.

    Where a word begins or ends, a guess may lie on the wrong side, and what is least there is an
    edge, minutes later: then it is looked for a little farther away.
    """
    time, least_at, settled = _descend_from(bearing, task, fixed, room)
    if settled:
        return time, least_at
    least = inf
    for probe in _PROBES:
        for direction in range(2):
            there = bearing + probe * (2.0 * direction - 1.0)
            value = time_through(there, task, fixed, room)
            if value < least:
                least, least_at = value, there
    if least == inf:
        return inf, bearing
    time, least_at, settled = _descend_from(least_at, task, fixed, room)
    return (time, least_at) if settled else (inf, bearing)


@njit(cache=True, nogil=True)
def _descend_from(
    bearing: float, task: Task, fixed: FloatArray, room: Room
) -> tuple[float, float, bool]:
    """Downhill from a bearing by parabolas: the time reached, where, and whether it is a valley."""
    trial = room_beside(room)
    stride, count = _STRIDE, 1
    here = time_through(bearing, task, fixed, trial)
    if here == inf:
        return inf, bearing, False
    keep_path(trial, room)
    while stride > _FINEST and count < _MOST:
        beside = (inf, inf)
        for k in range(2):
            step = stride * (2.0 * k - 1.0)
            value = time_through(bearing + step, task, fixed, trial)
            count += 1
            behind = inf
            while value < here and count < _MOST:
                keep_path(trial, room)
                behind, here, bearing = here, value, bearing + step
                value = time_through(bearing + step, task, fixed, trial)
                count += 1
            if behind < inf:
                # on the other side lies where it came from
                beside = (value, behind) if k == 0 else (behind, value)
                break
            beside = (beside[1], value)
        below, above = beside
        bend = below - 2.0 * here + above
        smooth = False
        if 0.0 < bend < inf:
            shift = 0.5 * stride * (below - above) / bend
            promised = 0.5 * shift * shift * bend / (stride * stride)
            if promised < _GAIN:
                return here, bearing, True
            value = time_through(bearing + shift, task, fixed, trial)
            count += 1
            smooth = abs(here - value - promised) <= 0.1 * promised + _GAIN
            if value < here:
                keep_path(trial, room)
                here, bearing = value, bearing + shift
            if smooth and promised < 1e3 * _GAIN:
                return here, bearing, True
        stride *= 0.1 if smooth else 0.3
    return here, bearing, False
