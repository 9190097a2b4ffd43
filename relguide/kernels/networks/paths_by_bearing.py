"""Constrained paths through one contact next to a bearing, behind a leader who turns.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import inf, pi

import numpy as np
from numba import njit

from relguide.kernels.base.records import start_at
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.chain import DELAY, WORD
from relguide.kernels.contact.clear_delay import delay_until_release
from relguide.kernels.contact.clear_words import word_clears
from relguide.kernels.contact.contact import to_frame_of
from relguide.kernels.networks.near_guess import (
    Room,
    Task,
    contact_of,
    descend,
    enter,
    time_through,
)
from relguide.kernels.networks.template_edges import time_at_edge
from relguide.kernels.networks.template_legs import clears, write_legs
from relguide.kernels.words.delay import DELAY_PIECES
from relguide.kernels.words.to_point import word_from

_LOOKS, _APART = 12, 0.045  # bearings where it is looked anew, on either side [rad]
_ROUND = 60  # of these, on either side, for paths that arrive as the slot opens
_MOST_TIMES = 8  # at which a branch is at a contact
_LOOK, _LATER = 0.25, 2.0  # times: from one to the next, and so much later than guessed [R/V_P]
_JUMP = 2.5  # what is less is no jump of a turn, which are full circles


@njit(cache=True, nogil=True)
def solve_next_to(
    task: Task, bearing: float, beat: float, room: Room, legs: FloatArray
) -> tuple[float, int]:
    """By a word to a contact next to a bearing, and on by a word.

    Args:
        task: its entry and its exit say by which words.
        bearing: a guess [rad].
        beat: later arrivals do not matter [R/V_P].
        room: to work in; its `about` says about when the contact is reached [R/V_P].
        legs: takes the legs. shape (≥ 2, 6)

    Returns:
        arrival time [R/V_P] and the number of legs; infinite and 0 if there is no such path.
    """
    about = room.about[0]
    time, least_at = descend(bearing, task, np.zeros(2), room)
    if time < inf:
        if time >= beat:
            return inf, 0
        count = write_legs(task, least_at, room, legs)
        if clears(task, legs[:count]):
            return time, count
    room.about[0] = about
    time = time_at_edge(bearing, task, room, legs)
    return (time, 2) if time < beat else (inf, 0)


@njit(cache=True, nogil=True)
def begin_anew(task: Task, bearing: float, beat: float, room: Room) -> float:
    """A bearing through which a path leads that keeps the limit: the soonest that is seen.

    At each, all times at which the entry's branch may be there are looked at. Arguments as of
    `solve_next_to`. NaN if none is seen; `room` takes when it is there.
    """
    best, found, when = beat, np.nan, 0.0
    legs, none, times = np.zeros((3, 6)), np.zeros(2), np.empty(_MOST_TIMES)
    latest = room.about[0] + _LATER
    for j in range(2 * _LOOKS + 1):
        there = bearing + _APART * (j - _LOOKS)
        for i in range(_times_of(task, there, latest, times)):
            room.about[0] = times[i]
            time = time_through(there, task, none, room)
            if time < best:
                begun = room.about[0]
                count = write_legs(task, there, room, legs)
                if clears(task, legs[:count]):
                    best, found, when = time, there, begun
    room.about[0] = when
    return found


@njit(cache=True, nogil=True)
def delay_from(task: Task, bearing: float, room: Room, legs: FloatArray) -> bool:
    """Whether a word to a contact at a bearing leads on to the slot just as it opens.

    All such paths are equally fast: any contact that leads to one will do. `legs` takes it; other
    arguments as of `solve_next_to`.
    """
    scene = task.scene
    if not enter(task, bearing, room):
        return False
    t, pieces = room.path[0, 0], np.empty((DELAY_PIECES, 2))
    if t >= scene.t_release or not word_clears(task.start, 0.0, room.path[0], scene):
        return False
    there = contact_of(task, bearing, t)
    if not delay_until_release(there, t, scene, pieces):
        return False
    legs[0, 0], legs[1, 0] = WORD, DELAY
    legs[0, 1:6] = room.path[0]
    return True


@njit(cache=True, nogil=True)
def delay_anew(task: Task, bearing: float, room: Room, legs: FloatArray) -> bool:
    """As `delay_from`, from contacts at all bearings and times: those near this one first."""
    times = np.empty(_MOST_TIMES)
    for j in range(2 * _ROUND):
        there = bearing + pi / _ROUND * ((j + 1) // 2) * (1.0 - 2.0 * (j % 2))
        for i in range(_times_of(task, there, task.scene.t_release, times)):
            room.about[0] = times[i]
            if delay_from(task, there, room, legs):
                return True
    return False


@njit(cache=True, nogil=True)
def _times_of(task: Task, bearing: float, latest: float, times: FloatArray) -> int:
    """About when an entry's branch may be at a contact, up to a time; how many there are."""
    n, last, piece = 0, np.nan, np.empty(3)
    for k in range(int(latest / _LOOK) + 1):
        t = _LOOK * k
        seen = to_frame_of(task.start, contact_of(task, bearing, t))
        length = word_from(start_at(seen), 0.0, task.entry, piece)
        excess = length - t if length >= 0.0 else np.nan
        # a root, and no jump of a turn
        if last * excess <= 0.0 and abs(last - excess) < _JUMP and n < len(times):
            times[n] = t - _LOOK * abs(excess) / (abs(excess) + abs(last) + 1e-12)
            n += 1
        last = excess
    return n
