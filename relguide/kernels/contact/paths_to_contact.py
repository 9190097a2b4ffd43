"""Words to a contact with d = d_min, all of them, and times before which no path gets there.

A contact keeps its place relative to the leader, so while the leader keeps straight it is a slot
like any other; while the leader turns it moves on a circle, and the times are roots of the words'
lengths.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import ceil, cos, hypot, inf, isnan, pi, sin, sqrt
from typing import NamedTuple

import numpy as np
from numba import njit

from relguide.kernels.base.angles import wrap, wrap_signed
from relguide.kernels.base.clock import time_is_up
from relguide.kernels.base.records import Bracket, Contact, Pose, Scene, Velocity
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.contact import contact_distance, contact_on, to_frame_of
from relguide.kernels.words.branches import SIZE, TO_POINT, WORD_OF
from relguide.kernels.words.delay import word_to_point
from relguide.kernels.words.extremals import MAX_ROWS, solve_toward

_TURNING_STEP = 0.15  # the leader turns by some 10° in it [R/V_P]
_LONGEST_DETOUR = 24.0  # 6π + 4, rounded up
_JUMP = 1.0  # a word's length does not change by more within one step, unless it jumps [R]


class _Passage(NamedTuple):
    """One branch of a word to one contact, whose time of arrival is to be found."""

    start: Pose
    t_start: float
    scene: Scene
    contact: Contact
    branch: int


@njit(cache=True, nogil=True)
def intercept(dx: float, dy: float, target: Velocity) -> float:
    """Least time to a moving point, now at (dx, dy), along a straight; 0 where unknown."""
    closing = dx * target.ahead + dy * target.left
    one_less = 1.0 - target.ahead * target.ahead - target.left * target.left
    if one_less <= 1e-9:
        return 0.0
    return float((closing + sqrt(closing * closing + one_less * (dx * dx + dy * dy))) / one_less)


@njit(cache=True, nogil=True)
def earliest_arrival(pose: Pose, t: float, scene: Scene, contact: Contact) -> float:
    """No path from a pose at time t reaches the contact before this time."""
    start, rate = max(scene.leader[contact.piece, 0], t), scene.leader[contact.piece, 4]
    if rate != 0.0:
        return float(start)
    lh = scene.leader[contact.piece, 3]
    cx, cy, course = contact_on(scene, contact, t)
    toward = Velocity(scene.alpha * cos(lh), scene.alpha * sin(lh))
    straight = intercept(cx - pose.x, cy - pose.y, toward)
    return float(max(t + max(straight, abs(wrap_signed(course - pose.h))), start))


@njit(cache=True, nogil=True)
def not_before_slot(pose: Pose, t: float, scene: Scene) -> float:
    """No path from a pose at time t reaches the slot before this time."""
    straight = intercept(scene.alpha * t - pose.x, -pose.y, Velocity(scene.alpha, 0.0))
    return float(max(t + max(straight, abs(wrap_signed(pose.h))), scene.t_release))


@njit(cache=True, nogil=True)
def paths_to_contact(pose: Pose, t: float, scene: Scene, contact: Contact, rows: FloatArray) -> int:
    """All words from a pose at time t to a contact while the leader is on the contact's piece.

    Returns:
        how many rows, with the time of arrival in place of how long they take; those of a straight
        piece come in order of time. Fewer if the time for the search is up.
    """
    leader, i = scene.leader, contact.piece
    end = leader[i + 1, 0] if i + 1 < len(leader) else inf
    if end <= t:
        return 0
    if leader[i, 4] != 0.0:
        return _paths_while_turning(pose, t, scene, contact, rows)
    lh = leader[i, 3]
    cx, cy, course = contact_on(scene, contact, t)
    left = end - t
    if left < inf and (
        hypot(
            cx + scene.alpha * left * cos(lh) - pose.x, cy + scene.alpha * left * sin(lh) - pose.y
        )
        > left
    ):
        return 0  # not even straight there
    toward = Velocity(scene.alpha * cos(lh - course), scene.alpha * sin(lh - course))
    seen = to_frame_of(pose, Pose(cx, cy, course))
    n = solve_toward(Pose(seen.x, seen.y, wrap(seen.h)), toward, max(leader[i, 0] - t, 0.0), rows)
    while n > 0 and rows[n - 1, 0] > left:
        n -= 1
    rows[:n, 0] += t
    return n


@njit(cache=True, nogil=True)
def _paths_while_turning(
    pose: Pose, t_start: float, scene: Scene, contact: Contact, rows: FloatArray
) -> int:
    """The same while the leader turns: the contact moves on a circle, so roots in t."""
    leader, i = scene.leader, contact.piece
    start, end = max(leader[i, 0], t_start), leader[i + 1, 0]
    steps = ceil((end - start) / _TURNING_STEP) + 1
    # a word is at least as long as the contact is far, and hardly longer than three full turns more
    most = (1.0 + scene.alpha + contact_distance(scene.d_min) * abs(leader[i, 4])) * (
        (end - start) / steps
    )
    earliest, latest = steps + 1, -1
    for k in range(steps + 1):
        t = start + (end - start) * k / steps
        there = contact_on(scene, contact, t)
        away = hypot(there.x - pose.x, there.y - pose.y)
        if -most <= t - t_start - away <= _LONGEST_DETOUR + most:
            earliest, latest = min(earliest, k), k
    piece = np.empty(3)
    turns = np.empty((3, 2))  # first and last turn at the last time, at this one, and between
    n = 0
    for j in range(SIZE):
        if time_is_up(scene.until):
            break
        passage = _Passage(pose, t_start, scene, contact, TO_POINT[j])
        last, last_t = np.nan, start
        for k in range(earliest, latest + 1):
            t = start + (end - start) * k / steps
            gap = _excess(passage, t, piece)
            turns[1, 0], turns[1, 1] = piece[0], piece[2]
            if k > earliest and _is_smooth(last, turns[0], gap, turns[1]):
                n = _append_root(passage, Bracket(last_t, t, last, gap), piece, rows, n)
            elif k > earliest and (abs(last) < _JUMP or abs(gap) < _JUMP):
                # a turn passes 0, or the word ceases to exist: there may be a root on either side
                low, high, at_low, at_high = last_t, t, last, gap
                for _ in range(25):
                    middle = 0.5 * (low + high)
                    value = _excess(passage, middle, piece)
                    turns[2, 0], turns[2, 1] = piece[0], piece[2]
                    if (isnan(value) and isnan(last)) or _is_smooth(
                        last, turns[0], value, turns[2]
                    ):
                        low, at_low = middle, value
                    else:
                        high, at_high = middle, value
                n = _append_root(passage, Bracket(last_t, low, last, at_low), piece, rows, n)
                n = _append_root(passage, Bracket(high, t, at_high, gap), piece, rows, n)
            last, last_t = gap, t
            turns[0] = turns[1]
    return n


@njit(cache=True, nogil=True)
def _is_smooth(value: float, turns: FloatArray, other: float, others: FloatArray) -> bool:
    """Whether a word's length goes on smoothly: it exists at both times, and no turn jumps."""
    return bool(
        not isnan(value)
        and not isnan(other)
        and abs(turns[0] - others[0]) < pi
        and abs(turns[1] - others[1]) < pi
    )


@njit(cache=True, nogil=True)
def _append_root(
    passage: _Passage, times: Bracket, piece: FloatArray, rows: FloatArray, n: int
) -> int:
    """Append the row of a word that arrives between two times, if there is one (Illinois)."""
    low, high, at_low, at_high = times
    if not at_low * at_high <= 0.0 or n == MAX_ROWS:
        return n
    at, value = (low, at_low) if abs(at_low) < abs(at_high) else (high, at_high)
    for k in range(60):
        if abs(value) < 1e-13 or high - low < 1e-14:
            break
        share = 0.5 if k % 4 == 3 else at_high / (at_high - at_low)
        at = high - share * (high - low)
        value = _excess(passage, at, piece)
        if (value < 0.0) == (at_low < 0.0):
            low, at_low = at, value
            at_high *= 0.5
        else:
            high, at_high = at, value
            at_low *= 0.5
    value = _excess(passage, at, piece)
    if not abs(value) < 1e-9:
        return n
    rows[n, 0] = at
    rows[n, 1] = WORD_OF[passage.branch]
    rows[n, 2:5] = piece
    return n + 1


@njit(cache=True, nogil=True)
def _excess(passage: _Passage, t: float, piece: FloatArray) -> float:
    """Length of a word to where the contact is at t, less the time for it; NaN if out of reach."""
    there = contact_on(passage.scene, passage.contact, t)
    length = word_to_point(to_frame_of(passage.start, there), 0.0, passage.branch, piece)
    return length - (t - passage.t_start) if length >= 0.0 else np.nan
