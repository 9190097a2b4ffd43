"""Words to a contact with d = d_min, all of them, and before what none gets there.

A contact keeps its place relative to the leader, so while the leader keeps straight it is a slot
like any other; while he turns it moves on a circle, and the times are roots of the words' lengths.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise; the leader is a table as in
`clearance`.
"""

from math import ceil, cos, hypot, inf, isnan, pi, sin, sqrt

import numpy as np
from numba import njit

from relguide.kernels.base.angles import wrap, wrap_signed
from relguide.kernels.base.records import Pose, Velocity
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.contact import contact_on
from relguide.kernels.words.branches import TO_POINT, WORD_OF
from relguide.kernels.words.delay import word_to_point
from relguide.kernels.words.extremals import MAX_ROWS, solve_toward

_TURNING_STEP = 0.15  # the leader turns by some 10° in it [R/V_P]
_LONGEST_DETOUR = 24.0  # 6π + 4, rounded up
_JUMP = 1.0  # a word's length does not change by more within one step, unless it jumps [R]


@njit(cache=True, nogil=True)
def intercept(dx: float, dy: float, ax: float, ay: float) -> float:
    """Least time to a point at (dx, dy) that moves at a, by the straight way; 0 where unknown."""
    closing = dx * ax + dy * ay
    one_less = 1.0 - ax * ax - ay * ay
    if one_less <= 1e-9:
        return 0.0
    return float((closing + sqrt(closing * closing + one_less * (dx * dx + dy * dy))) / one_less)


@njit(cache=True, nogil=True)
def not_before(
    x: float, y: float, h: float, t: float, leader: FloatArray, i: int, alpha: float, delta: float,
    bearing: float, side: float,
) -> float:  # fmt: skip
    """Before this time no way from a pose at time t reaches a contact on the leader's piece i."""
    start = max(leader[i, 0], t)
    if leader[i, 4] != 0.0:
        return float(start)
    lh = leader[i, 3]
    cx, cy, course = contact_on(leader, i, t, bearing, side, alpha, delta)
    straight = intercept(cx - x, cy - y, alpha * cos(lh), alpha * sin(lh))
    return float(max(t + max(straight, abs(wrap_signed(course - h))), start))


@njit(cache=True, nogil=True)
def not_before_slot(
    x: float, y: float, h: float, t: float, alpha: float, t_release: float
) -> float:
    """Before this time no way from a pose at time t reaches the slot."""
    onward = max(intercept(alpha * t - x, -y, alpha, 0.0), abs(wrap_signed(h)))
    return float(max(t + onward, t_release))


@njit(cache=True, nogil=True)
def paths_to_contact(
    x: float, y: float, h: float, t: float, leader: FloatArray, i: int, alpha: float, delta: float,
    bearing: float, side: float, rows: FloatArray,
) -> int:  # fmt: skip
    """All words from (x, y, h) at time t to a contact while the leader is on its piece i.

    Returns:
        how many rows, with the time of arrival in place of how long they take; those of a straight
        piece come in order of time.
    """
    start, rate = leader[i, 0], leader[i, 4]
    end = leader[i + 1, 0] if i + 1 < len(leader) else inf
    if end <= t:
        return 0
    if rate != 0.0:
        return _paths_while_turning(x, y, h, t, leader, i, alpha, delta, bearing, side, rows)
    lh = leader[i, 3]
    cx, cy, course = contact_on(leader, i, t, bearing, side, alpha, delta)
    left = end - t
    if left < inf and (
        hypot(cx + alpha * left * cos(lh) - x, cy + alpha * left * sin(lh) - y) > left
    ):
        return 0  # not even straight there
    c, s = cos(course), sin(course)
    dx, dy = x - cx, y - cy
    seen = Pose(dx * c + dy * s, dy * c - dx * s, wrap(h - course))
    drift = Velocity(alpha * cos(lh - course), alpha * sin(lh - course))
    n = solve_toward(seen, drift, max(start - t, 0.0), rows)
    while n > 0 and rows[n - 1, 0] > left:
        n -= 1
    rows[:n, 0] += t
    return n


@njit(cache=True, nogil=True)
def _paths_while_turning(
    x: float, y: float, h: float, t_start: float, leader: FloatArray, i: int, alpha: float,
    delta: float, bearing: float, side: float, rows: FloatArray,
) -> int:  # fmt: skip
    """As `paths_to_contact` while the leader turns: the contact moves on a circle, so roots in t."""
    start, end = max(leader[i, 0], t_start), leader[i + 1, 0]
    steps = ceil((end - start) / _TURNING_STEP) + 1
    # a word is at least as long as the way is far, and hardly longer than three full turns more
    most = (1.0 + alpha + delta * abs(leader[i, 4])) * (end - start) / steps
    earliest, latest = steps + 1, -1
    for k in range(steps + 1):
        t = start + (end - start) * k / steps
        cx, cy, _ = contact_on(leader, i, t, bearing, side, alpha, delta)
        away = hypot(cx - x, cy - y)
        if -most <= t - t_start - away <= _LONGEST_DETOUR + most:
            earliest, latest = min(earliest, k), k
    piece = np.empty(3)
    turns = np.empty((3, 2))  # first and last turn at the last time, at this one, and between
    n = 0
    for branch in TO_POINT:
        word = t_start, leader, i, alpha, delta, bearing, side, branch
        last, last_t = np.nan, start
        for k in range(earliest, latest + 1):
            t = start + (end - start) * k / steps
            gap = _excess(x, y, h, *word, t, piece)
            turns[1, 0], turns[1, 1] = piece[0], piece[2]
            if k > earliest and _unbroken(last, turns[0], gap, turns[1]):
                n = _root(x, y, h, *word, last_t, last, t, gap, piece, rows, n)
            elif k > earliest and (abs(last) < _JUMP or abs(gap) < _JUMP):
                # a turn passes 0, or the word ceases to exist: there may be a root on either side
                low, high, at_low, at_high = last_t, t, last, gap
                for _ in range(25):
                    middle = 0.5 * (low + high)
                    value = _excess(x, y, h, *word, middle, piece)
                    turns[2, 0], turns[2, 1] = piece[0], piece[2]
                    if (isnan(value) and isnan(last)) or _unbroken(last, turns[0], value, turns[2]):
                        low, at_low = middle, value
                    else:
                        high, at_high = middle, value
                n = _root(x, y, h, *word, last_t, last, low, at_low, piece, rows, n)
                n = _root(x, y, h, *word, high, at_high, t, gap, piece, rows, n)
            last, last_t = gap, t
            turns[0] = turns[1]
    return n


@njit(cache=True, nogil=True)
def _unbroken(value: float, turns: FloatArray, other: float, others: FloatArray) -> bool:
    """Whether a word's length goes on smoothly: it exists at both times, and no turn jumps."""
    return bool(
        not isnan(value)
        and not isnan(other)
        and abs(turns[0] - others[0]) < pi
        and abs(turns[1] - others[1]) < pi
    )


@njit(cache=True, nogil=True)
def _root(
    x: float, y: float, h: float, t_start: float, leader: FloatArray, i: int, alpha: float,
    delta: float, bearing: float, side: float, branch: int, low: float, at_low: float,
    high: float, at_high: float, piece: FloatArray, rows: FloatArray, n: int,
) -> int:  # fmt: skip
    """Append the row of a word that arrives between two times, if there is one (Illinois)."""
    if not at_low * at_high <= 0.0 or n == MAX_ROWS:
        return n
    at, value = (low, at_low) if abs(at_low) < abs(at_high) else (high, at_high)
    for k in range(60):
        if abs(value) < 1e-13 or high - low < 1e-14:
            break
        share = 0.5 if k % 4 == 3 else at_high / (at_high - at_low)
        at = high - share * (high - low)
        value = _excess(x, y, h, t_start, leader, i, alpha, delta, bearing, side, branch, at, piece)
        if (value < 0.0) == (at_low < 0.0):
            low, at_low = at, value
            at_high *= 0.5
        else:
            high, at_high = at, value
            at_low *= 0.5
    value = _excess(x, y, h, t_start, leader, i, alpha, delta, bearing, side, branch, at, piece)
    if not abs(value) < 1e-9:
        return n
    rows[n, 0] = at
    rows[n, 1] = WORD_OF[branch]
    rows[n, 2:5] = piece
    return n + 1


@njit(cache=True, nogil=True)
def _excess(
    x: float, y: float, h: float, t_start: float, leader: FloatArray, i: int, alpha: float,
    delta: float, bearing: float, side: float, branch: int, t: float, piece: FloatArray,
) -> float:  # fmt: skip
    """Length of a word to where the contact is at t, less the time for it; NaN if out of reach."""
    cx, cy, course = contact_on(leader, i, t, bearing, side, alpha, delta)
    c, s = cos(course), sin(course)
    dx, dy = x - cx, y - cy
    length = word_to_point(Pose(dx * c + dy * s, dy * c - dx * s, h - course), 0.0, branch, piece)
    return length - (t - t_start) if length >= 0.0 else np.nan
