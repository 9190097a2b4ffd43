"""Words to a contact with d = d_min while the leader turns: the contact moves on a circle.

A word arrives when its length to where the contact then is equals the time for it. That is looked
at on a grid of times, for all branches at once; between two times its roots are found by false
position. Where a turn passes a full one, or a branch begins to exist, the edge is bisected first.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import ceil, cos, hypot, inf, isnan, pi, sin
from typing import NamedTuple

import numpy as np
from numba import njit

from relguide.kernels.base.clock import time_is_up
from relguide.kernels.base.false_position import Bracket, secant, tightened
from relguide.kernels.base.records import Contact, Pose, Scene, Start
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.contact import contact_distance, contact_heading
from relguide.kernels.words.branches import SIZE, TO_POINT, WORD_OF
from relguide.kernels.words.extremals import MAX_ROWS
from relguide.kernels.words.to_point import every_word, word_from

_STEP = 0.15  # the leader turns by some 10° in it [R/V_P]
_LONGEST_DETOUR = 24.0  # 6π + 4, rounded up
_JUMP = 1.0  # a word's length does not change by more within one step, unless it jumps [R]
_CLOSER = 8  # steps toward the first time at which a contact is in reach
_HALVINGS = 25  # of a step, to where a turn jumps or a word ceases to exist
_MOST_STEPS = 60  # of false position
_MET = 1e-9  # a length farther off than this has jumped [R]
_EXACT = 1e-12  # a length so near is met: 0.01 µm at R = 12 km, and above rounding [R]


class Passage(NamedTuple):
    """From a start to one contact on a turn of the leader's, and the circle that this moves on."""

    pose: Pose
    """The start."""
    t_start: float
    """When [R/V_P]."""
    scene: Scene
    contact: Contact
    begin: float
    """When it can be there first, as far as the leader goes [R/V_P] …"""
    end: float
    """… and last."""
    turning: float
    """The leader's turn rate ω [V_P/R]."""
    x: float
    """The centre of the leader's turn, seen from the start's place, but not turned [R]."""
    y: float
    ahead: float
    """From there to the contact while the leader heads 0 [R] …"""
    left: float
    """… and to the left."""
    heading: float
    """On which it is met, relative to the leader's [rad]."""


class _Look(NamedTuple):
    """All branches of words to where a contact is at one time."""

    excess: FloatArray
    """How much longer each is than the time for it; NaN if it does not reach. shape (SIZE,)"""
    turns: FloatArray
    """First and last turn of each [rad]. shape (SIZE, 2)"""


@njit(cache=True, nogil=True)
def passage_to(pose: Pose, t: float, scene: Scene, contact: Contact) -> Passage:
    """From a pose at time t to a contact on a piece on which the leader turns."""
    begin, x, y, h, turning = scene.leader[contact.piece]
    distance, radius = contact_distance(scene.d_min), scene.alpha / turning
    return Passage(
        pose, t, scene, contact, max(begin, t), scene.leader[contact.piece + 1, 0], turning,
        x - radius * sin(h) - pose.x, y + radius * cos(h) - pose.y,
        distance * cos(contact.bearing), distance * sin(contact.bearing) - radius,
        contact_heading(contact.bearing, contact.side, scene.alpha),
    )  # fmt: skip


@njit(cache=True, nogil=True)
def _seen_from(passage: Passage, t: float) -> Start:
    """The start as seen from where the contact is at t."""
    leader, i = passage.scene.leader, passage.contact.piece
    lh = leader[i, 3] + passage.turning * (t - leader[i, 0])
    s, c = sin(lh), cos(lh)
    dx = -passage.x - passage.ahead * c + passage.left * s
    dy = -passage.y - passage.ahead * s - passage.left * c
    course = lh + passage.heading
    s, c = sin(course), cos(course)
    h = passage.pose.h - course
    return Start(dx * c + dy * s, dy * c - dx * s, h, sin(h), cos(h))


@njit(cache=True, nogil=True)
def _distance_at(passage: Passage, t: float) -> float:
    """How far the contact is from the start at t [R]."""
    leader, i = passage.scene.leader, passage.contact.piece
    lh = leader[i, 3] + passage.turning * (t - leader[i, 0])
    s, c = sin(lh), cos(lh)
    return hypot(
        passage.x + passage.ahead * c - passage.left * s,
        passage.y + passage.ahead * s + passage.left * c,
    )


@njit(cache=True, nogil=True)
def _speed(passage: Passage) -> float:
    """How fast the contact moves [V_P]."""
    return abs(passage.turning) * hypot(passage.ahead, passage.left)


@njit(cache=True, nogil=True)
def earliest_while_turning(passage: Passage) -> float:
    """No path reaches the contact before this time [R/V_P]; infinite if none does on this turn.

    The pursuer and the contact close in no faster than at the sum of their speeds.
    """
    at, closing = passage.begin, 1.0 + _speed(passage)
    for _ in range(_CLOSER):
        lack = _distance_at(passage, at) - (at - passage.t_start)
        if lack <= 0.0:
            break
        at += lack / closing
        if at > passage.end:
            return inf
    return float(at)


@njit(cache=True, nogil=True)
def paths_while_turning(passage: Passage, words: int, beat: float, rows: FloatArray) -> int:
    """Some words to the contact, in no order. As `paths_to_contact.paths_by_words`."""
    begin, end = passage.begin, passage.end
    first = earliest_while_turning(passage)
    if first >= beat:
        return 0
    steps = ceil((end - begin) / _STEP) + 1
    step = (end - begin) / steps
    # a word is hardly longer than three full turns more than the contact is far
    slack = _LONGEST_DETOUR + (1.0 + _speed(passage)) * step
    last, here = _look(), _look()
    n, last_t, follows = 0, begin, False
    for k in range(int((first - begin) / step), steps + 1):
        t = begin + step * k
        if t - passage.t_start > slack + _distance_at(passage, t):
            follows = False
            continue
        if time_is_up(passage.scene.until):
            break
        every_word(_seen_from(passage, t), words, here.excess, here.turns)
        here.excess[:] -= t - passage.t_start
        for branch in TO_POINT:
            if follows and not _goes_on(last, here, branch):
                n = _roots_between(passage, branch, last_t, last, t, here, rows, n)
        if t >= beat:
            break
        last, here, last_t, follows = here, last, t, True
    return n


@njit(cache=True, nogil=True)
def _look() -> _Look:
    """Room for one, in which no word reaches."""
    return _Look(np.full(SIZE, np.nan), np.zeros((SIZE, 2)))


@njit(cache=True, nogil=True)
def _goes_on(last: _Look, here: _Look, branch: int) -> bool:
    """Whether a branch has no root between two looks, as most have none."""
    before, gap, turns, others = last.excess, here.excess, last.turns, here.turns
    if before[branch] * gap[branch] > 0.0:
        return bool(
            abs(turns[branch, 0] - others[branch, 0]) < pi
            and abs(turns[branch, 1] - others[branch, 1]) < pi
        )
    return isnan(before[branch]) and isnan(gap[branch])


@njit(cache=True, nogil=True)
def _roots_between(
    passage: Passage, branch: int, last_t: float, last: _Look, t: float, here: _Look,
    rows: FloatArray, n: int,
) -> int:  # fmt: skip
    """Append the rows of one branch that arrive between two looks."""
    before, gap = last.excess[branch], here.excess[branch]
    turns, others = last.turns[branch], here.turns[branch]
    if _is_smooth(before, turns, gap, others):
        return _append_root(passage, branch, last_t, before, t, gap, rows, n)
    if not (abs(before) < _JUMP or abs(gap) < _JUMP):
        return n
    # a turn passes 0, or the word ceases to exist: there may be a root on either side
    low, high, at_low, at_high = last_t, t, before, gap
    piece, between = np.empty(3), np.empty(2)
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        value = _excess(passage, branch, middle, piece)
        between[0], between[1] = piece[0], piece[2]
        if (isnan(value) and isnan(before)) or _is_smooth(before, turns, value, between):
            low, at_low = middle, value
        else:
            high, at_high = middle, value
    n = _append_root(passage, branch, last_t, before, low, at_low, rows, n)
    return _append_root(passage, branch, high, at_high, t, gap, rows, n)


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
    passage: Passage, branch: int, low: float, at_low: float, high: float, at_high: float,
    rows: FloatArray, n: int,
) -> int:  # fmt: skip
    """Append the row of a word that arrives between two times, if there is one."""
    if not at_low * at_high <= 0.0 or n == MAX_ROWS:
        return n
    piece, rising = np.empty(3), 1.0 if at_low < at_high else -1.0
    times = Bracket(low, high, rising * at_low, rising * at_high, 0)
    at, value = (low, at_low) if abs(at_low) < abs(at_high) else (high, at_high)
    for k in range(_MOST_STEPS):
        if abs(value) < _EXACT or times.high - times.low < _EXACT:
            break
        # every fourth step halves: a jump is then found out soon, too
        at = 0.5 * (times.low + times.high) if k % 4 == 3 else secant(times)
        value = _excess(passage, branch, at, piece)
        times = tightened(times, at, rising * value)
    value = _excess(passage, branch, at, piece)
    if not abs(value) < _MET:
        return n
    rows[n, 0] = at
    rows[n, 1] = WORD_OF[branch]
    rows[n, 2:5] = piece
    return n + 1


@njit(cache=True, nogil=True)
def _excess(passage: Passage, branch: int, t: float, piece: FloatArray) -> float:
    """Length of a word to where the contact is at t, less the time for it; NaN if out of reach."""
    length = word_from(_seen_from(passage, t), 0.0, branch, piece)
    return length - (t - passage.t_start) if length >= 0.0 else np.nan
