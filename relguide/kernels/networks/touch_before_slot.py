"""Constrained paths whose last two pieces touch the disc, behind a leader who turns.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import cos, inf, pi, sin, sqrt

import numpy as np
from numba import njit

from relguide.kernels.base.angles import TWO_PI
from relguide.kernels.base.records import Pose, start_at
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.chain import WORD
from relguide.kernels.contact.clear_words import EARLY, word_clears
from relguide.kernels.contact.contact import to_frame_of
from relguide.kernels.networks.near_guess import ON_LR, ON_RL, Task
from relguide.kernels.networks.template_legs import two_turns
from relguide.kernels.networks.turn_templates import QUARTER
from relguide.kernels.separation.clearance import leader_at, piece_at
from relguide.kernels.words.branches import WORD_OF
from relguide.kernels.words.extremals import fly_piece
from relguide.kernels.words.to_point import word_from

_STEPS = 16  # of Newton's method
_DIFFERENCE = 1e-6  # by which its slopes are measured [rad or R]
_MET = 1e-11  # where it ends [R]


@njit(cache=True, nogil=True)
def solve_before_touch(
    task: Task, guess: FloatArray, beat: float, legs: FloatArray
) -> tuple[float, int]:
    """By a branch to a contact, and on by two turns of which the first touches there: Newton.

    Unknown are both turns, flown back from the slot, and when the contact is.

    Args:
        task: its entry says which branch, its exit which turns.
        guess: of its numbers. shape (GUESS,)
        beat: later arrivals do not matter [R/V_P].
        legs: takes the legs. shape (≥ 2, 6)

    Returns:
        arrival time [R/V_P] and the number of legs; infinite and 0 if there is no such path.
    """
    scene, row, last = task.scene, np.zeros(5), np.zeros(5)
    x, off = np.empty(3), np.empty(3)
    x[0], x[1], x[2] = guess[0] / QUARTER, pi * (guess[1] + 1.0), guess[2] / QUARTER
    beside, slopes = np.empty(3), np.empty((3, 3))
    for step in range(_STEPS + 1):
        if step == _STEPS or not _miss_before(task, x, off, row):
            return inf, 0
        if abs(off[0]) + abs(off[1]) + abs(off[2]) < _MET:
            break
        for k in range(3):
            x[k] += _DIFFERENCE
            if not _miss_before(task, x, beside, row):
                return inf, 0
            x[k] -= _DIFFERENCE
            for j in range(3):
                slopes[j, k] = (beside[j] - off[j]) / _DIFFERENCE
        if not _newton_step(slopes, off, x):
            return inf, 0
    first, turn, t = x
    if not (0.0 <= first <= TWO_PI and 0.0 <= turn <= TWO_PI and t > 0.0):
        return inf, 0
    time = t + first + turn
    if time >= beat or time < scene.t_release - EARLY:
        return inf, 0
    _miss_before(task, x, off, row)
    row[0], row[1] = t, WORD_OF[task.entry]
    two_turns(1.0 if task.on == ON_LR else -1.0, first, turn, 0.0, last)
    if not word_clears(task.start, 0.0, row, scene):
        return inf, 0
    if not word_clears(_before_slot(task, first, turn, time), t, last, scene):
        return inf, 0
    legs[0, 0], legs[1, 0] = WORD, WORD
    legs[0, 1:6], legs[1, 1:6] = row, last
    return time, 2


@njit(cache=True, nogil=True)
def _before_slot(task: Task, first: float, turn: float, time: float) -> Pose:
    """Where two pieces begin that end in the slot at that time."""
    sign = 1.0 if task.on == ON_RL else -1.0
    # backward a turn is one to the other side, of the opposite heading
    pose = fly_piece(Pose(task.scene.alpha * time, 0.0, pi), -sign, turn)
    pose = fly_piece(pose, sign, first)
    return Pose(pose.x, pose.y, pose.h - pi)


@njit(cache=True, nogil=True)
def _miss_before(task: Task, x: FloatArray, off: FloatArray, row: FloatArray) -> bool:
    """By how much two pieces before the slot miss their contact, and the entry its time.

    Args:
        task: what is solved.
        x: first piece, last turn, time of the contact. shape (3,)
        off: takes what would be 0. shape (3,)
        row: takes the entry's pieces. shape (5,)

    Returns:
        whether the entry's branch leads there.
    """
    scene, disc, t = task.scene, task.disc, x[2]
    pose = _before_slot(task, x[0], x[1], t + x[0] + x[1])
    at = leader_at(scene, piece_at(scene.leader, t), t)
    dx, dy = pose.x - at.x, pose.y - at.y
    vx, vy = cos(pose.h) - disc.alpha * cos(at.h), sin(pose.h) - disc.alpha * sin(at.h)
    off[0] = dx * vx + dy * vy
    off[1] = dx * vy - dy * vx - disc.side * disc.distance * sqrt(vx * vx + vy * vy)
    length = word_from(start_at(to_frame_of(task.start, pose)), 0.0, task.entry, row[2:5])
    off[2] = length - t
    return bool(length >= 0.0)


@njit(cache=True, nogil=True)
def _newton_step(slopes: FloatArray, off: FloatArray, x: FloatArray) -> bool:
    """One step of Newton's method in three unknowns, not too far; whether there is one."""
    a, b, c = slopes[0], slopes[1], slopes[2]
    cofactors = np.empty((3, 3))
    for k in range(3):
        i, j = (k + 1) % 3, (k + 2) % 3
        cofactors[0, k] = b[i] * c[j] - b[j] * c[i]
        cofactors[1, k] = c[i] * a[j] - c[j] * a[i]
        cofactors[2, k] = a[i] * b[j] - a[j] * b[i]
    determinant = a[0] * cofactors[0, 0] + a[1] * cofactors[0, 1] + a[2] * cofactors[0, 2]
    if not abs(determinant) > 1e-12:
        return False
    steps, longest = np.zeros(3), 1e-12
    for k in range(3):
        for j in range(3):
            steps[k] += cofactors[j, k] * off[j] / determinant
        longest = max(longest, abs(steps[k]))
    for k in range(3):
        x[k] -= min(1.0, 0.5 / longest) * steps[k]
    return True
