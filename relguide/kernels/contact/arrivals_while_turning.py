"""When one branch of a word arrives at a contact while the leader turns, between two looks at it.

The excess of a branch is its length to where the contact is at a time, less the time for it: it
arrives where that is zero. Between two looks of unlike sign the zero is found by false position.
Between two of like sign there may be two, where the contact comes past: the tangents at both meet
below an excess that bends one way, so they lead to where it is least, or show that it is not zero.
Where a turn passes a full one, or a branch begins to exist, the edge is bisected first; where it
exists only between two looks, its circles are nearest or farthest there, at a time known in closed
form.
"""

from math import atan2, isnan, pi, sqrt
from typing import NamedTuple

from numba import njit

from relguide.kernels.base.angles import wrap, wrap_signed
from relguide.kernels.base.false_position import Bracket, secant, tightened
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.moving_contact import Passage, excess, leader_heading, speed_of
from relguide.kernels.words.branches import WORD_OF
from relguide.kernels.words.extremals import MAX_ROWS, SIGNS

JUMP = 1.0
"""A word's length does not change by more within one step, unless it jumps [R]."""
_EDGE_JUMP = 1.5  # or this, where a word ceases to exist [R]
_MOST_EDGES = 4  # between two looks: each turn may pass 0, and the word begin and cease to exist
_HALVINGS = 25  # of a step, to where a turn jumps or a word ceases to exist
_MOST_STEPS = 60  # of false position
_MOST_TANGENTS = 12  # pairs of them
_MOMENT = 1e-6  # over which a slope is taken [R/V_P]
_MET = 1e-9  # a length farther off than this has jumped [R]
_EXACT = 1e-12  # a length so near is met: 0.01 µm at R = 12 km, and above rounding [R]


class Seen(NamedTuple):
    """One branch at one time."""

    t: float
    """[R/V_P]."""
    excess: float
    """How much longer it is than the time for it [R/V_P]; NaN if it does not reach."""
    first: float
    """Its first turn [rad] …"""
    last: float
    """… and its last one [rad]."""


@njit(cache=True, nogil=True)
def append_arrivals(
    passage: Passage, branch: int, before: Seen, after: Seen, rows: FloatArray, n: int,
    piece: FloatArray,
) -> int:  # fmt: skip
    """Append the rows of one branch that arrive between two looks.

    Args:
        passage: to the contact.
        branch: number of `branches.BRANCHES`.
        before: the earlier look.
        after: the later one, a step of less than `JUMP` later.
        rows: take the words, with the time of arrival in place of how long they take. shape
            (MAX_ROWS, 5)
        n: how many rows there are.
        piece: room for the amounts of one. shape (3,)

    Returns:
        how many rows there are then.
    """
    if not (isnan(before.excess) and isnan(after.excess)):
        return _append_roots(passage, branch, before, after, rows, n, piece)
    between = _see(passage, branch, _time_of_extreme(passage, branch, before.t, after.t), piece)
    if isnan(between.excess):
        return n
    n = _append_roots(passage, branch, before, between, rows, n, piece)
    return _append_roots(passage, branch, between, after, rows, n, piece)


@njit(cache=True, nogil=True)
def _time_of_extreme(passage: Passage, branch: int, begin: float, end: float) -> float:
    """When the circles of a branch are farthest, or nearest for three turns, if in an interval."""
    word = WORD_OF[branch]
    first, last = SIGNS[word, 0], SIGNS[word, 2]
    dx, dy = passage.x + first * passage.sin_h, passage.y - first * passage.cos_h
    ahead = passage.ahead - last * passage.sin_heading
    left = passage.left + last * passage.cos_heading
    # the last one's centre is then on the line from the first one's to that of the leader's turn
    to_turn = atan2(dy, dx) - atan2(left, ahead) - leader_heading(passage, begin)
    to_turn += 0.0 if branch < 4 else pi
    sense = 1.0 if passage.turning > 0.0 else -1.0
    return float(min(begin + wrap(sense * to_turn) / abs(passage.turning), end))


@njit(cache=True, nogil=True)
def _append_roots(
    passage: Passage, branch: int, before: Seen, after: Seen, rows: FloatArray, n: int,
    piece: FloatArray,
) -> int:  # fmt: skip
    """Append the rows of one branch that arrive between two times at one of which it exists."""
    for _ in range(_MOST_EDGES):
        if _is_smooth(before, after):
            return _append_smooth(passage, branch, before, after, rows, n, piece)
        if not (_may_arrive(before) or _may_arrive(after)):
            break
        # a turn passes 0, or the word ceases to exist: there may be a root on either side
        low, high = before, after
        for _ in range(_HALVINGS):
            if not (_may_meet(passage, low, high) or _may_meet(passage, high, low)):
                break
            middle = _see(passage, branch, 0.5 * (low.t + high.t), piece)
            if (isnan(middle.excess) and isnan(before.excess)) or _is_smooth(before, middle):
                low = middle
            else:
                high = middle
        n = _append_smooth(passage, branch, before, low, rows, n, piece)
        before = high
    return n


@njit(cache=True, nogil=True)
def _may_arrive(seen: Seen) -> bool:
    """Whether a branch may arrive a step before or after, its turns counted past full ones too."""
    return bool(abs(wrap_signed(seen.excess)) < _EDGE_JUMP)


@njit(cache=True, nogil=True)
def _may_meet(passage: Passage, seen: Seen, other: Seen) -> bool:
    """Whether a branch may arrive from one time on to another, but for full turns.

    No gap between circles changes faster than these move, nor a heading faster than the contact's;
    where a word ceases to exist its length bends like a root: LSR by 4 √(gap − 2), LRL by less.
    """
    moved = 1.0 + speed_of(passage) + 2.0 * abs(passage.turning)
    moved *= abs(other.t - seen.t)
    return bool(abs(wrap_signed(seen.excess)) < 4.0 * sqrt(moved) + 2.0 * moved)


@njit(cache=True, nogil=True)
def _append_smooth(
    passage: Passage, branch: int, before: Seen, after: Seen, rows: FloatArray, n: int,
    piece: FloatArray,
) -> int:  # fmt: skip
    """Append the rows of one branch that arrive between two times between which it is smooth."""
    if not before.excess * after.excess > 0.0:
        return _append_root(passage, branch, before, after, rows, n, piece)
    turn = _turning_point(passage, branch, before, after, piece)
    if not before.excess * turn.excess < 0.0:
        return n
    n = _append_root(passage, branch, before, turn, rows, n, piece)
    return _append_root(passage, branch, turn, after, rows, n, piece)


@njit(cache=True, nogil=True)
def _turning_point(
    passage: Passage, branch: int, before: Seen, after: Seen, piece: FloatArray
) -> Seen:
    """A time between two at which the excess has the other sign; one of them if it keeps it."""
    sign = 1.0 if before.excess > 0.0 else -1.0
    low, high = before, after
    if sign * (low.excess + high.excess) > JUMP:
        return low
    fall = sign * _slope(passage, branch, low, _MOMENT, piece)
    rise = sign * _slope(passage, branch, high, -_MOMENT, piece)
    for _ in range(_MOST_TANGENTS):
        if not fall < 0.0 < rise:
            break
        at = (sign * (high.excess - low.excess) - rise * high.t + fall * low.t) / (fall - rise)
        lowest = sign * low.excess + fall * (at - low.t)
        if not (lowest < 0.0 and low.t < at < high.t):
            break
        between = _see(passage, branch, at, piece)
        if not _is_smooth(low, between) or sign * between.excess < 0.0:
            return between
        slope = sign * _slope(passage, branch, between, _MOMENT, piece)
        if slope < 0.0:
            low, fall = between, slope
        else:
            high, rise = between, slope
    return low


@njit(cache=True, nogil=True)
def _slope(passage: Passage, branch: int, seen: Seen, moment: float, piece: FloatArray) -> float:
    """How fast the excess rises, over a moment after a time, or before it."""
    return (_see(passage, branch, seen.t + moment, piece).excess - seen.excess) / moment


@njit(cache=True, nogil=True)
def _see(passage: Passage, branch: int, t: float, piece: FloatArray) -> Seen:
    """Look at one branch at one time."""
    value = excess(passage, branch, t, piece)
    return Seen(t, value, piece[0], piece[2])


@njit(cache=True, nogil=True)
def _is_smooth(before: Seen, after: Seen) -> bool:
    """Whether a word's length goes on smoothly: it exists at both times, and no turn jumps."""
    return bool(
        not isnan(before.excess)
        and not isnan(after.excess)
        and abs(before.first - after.first) < pi
        and abs(before.last - after.last) < pi
    )


@njit(cache=True, nogil=True)
def _append_root(
    passage: Passage, branch: int, before: Seen, after: Seen, rows: FloatArray, n: int,
    piece: FloatArray,
) -> int:  # fmt: skip
    """Append the row of a word that arrives between two times, if there is one."""
    if not before.excess * after.excess <= 0.0 or n == MAX_ROWS:
        return n
    rising = 1.0 if before.excess < after.excess else -1.0
    times = Bracket(before.t, after.t, rising * before.excess, rising * after.excess, 0)
    nearer = before if abs(before.excess) < abs(after.excess) else after
    at, value = nearer.t, nearer.excess
    for k in range(_MOST_STEPS):
        if abs(value) < _EXACT or times.high - times.low < _EXACT:
            break
        # every fourth step halves: a jump is then found out soon, too
        at = 0.5 * (times.low + times.high) if k % 4 == 3 else secant(times)
        value = excess(passage, branch, at, piece)
        times = tightened(times, at, rising * value)
    value = excess(passage, branch, at, piece)
    if not abs(value) < _MET:
        return n
    rows[n, 0] = at
    rows[n, 1] = WORD_OF[branch]
    rows[n, 2:5] = piece
    return n + 1
