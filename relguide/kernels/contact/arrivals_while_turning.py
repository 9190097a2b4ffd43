"""When one branch of a word arrives at a contact while the leader turns, between two looks at it.

The excess of a branch is its length to where the contact is at a time, less the time for it: it
arrives where that is zero. Between two looks of unlike sign the zero is found by false position.
Between two of like sign there may be two, where the contact comes past: the tangents at both meet
below an excess that bends one way, so they lead to where it is least, or show that it is not zero.

Where a turn falls below 0 it is a full one, and the excess jumps by 2π. So turns are followed past
0 and past a full one, where nothing jumps, and the branch may arrive where the excess is a multiple
of 2π; whether it does is seen there. Where a branch begins or ceases to exist its circles are at a
distance, and where it exists only between two looks they are nearest or farthest: both at a time
known in closed form.
"""

from math import acos, atan2, isnan, pi
from typing import NamedTuple

from numba import njit

from relguide.kernels.base.angles import TWO_PI, wrap, wrap_signed
from relguide.kernels.base.false_position import Bracket, secant, tightened
from relguide.kernels.base.norm import norm
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.moving_contact import Passage, excess, leader_heading
from relguide.kernels.words.branches import WORD_OF
from relguide.kernels.words.extremals import MAX_ROWS, SIGNS

JUMP = 1.0
"""A word's length does not change by more within one step, unless it jumps [R]."""
_EDGE_JUMP = 1.5  # or this, where a word ceases to exist or a turn passes a full one [R]
_EDGE = 4e-9  # so near to where it does it is looked at [R/V_P]
_SWING = 2.0  # turns change by less in a step but where circles pass each other closely [rad]
_HALVINGS = 25  # of a step, to there, where rounding hides it
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


class _Follow(NamedTuple):
    """A branch whose turns are followed past 0 and past full ones."""

    branch: int
    """Number of `branches.BRANCHES`."""
    first: float
    """The first turn is within half a turn of this [rad] …"""
    last: float
    """… and the last one of this [rad]."""
    wanted: float
    """The excess is counted from here, a multiple of 2π [R/V_P]."""


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
    # it exists at most where its circles are farthest, or nearest for three turns
    at = _time_of_extreme(passage, branch, branch >= 4, before.t, after.t)
    between = _see(passage, branch, at, piece)
    if isnan(between.excess):
        return n
    n = _append_roots(passage, branch, before, between, rows, n, piece)
    return _append_roots(passage, branch, between, after, rows, n, piece)


@njit(cache=True, nogil=True)
def _time_of_extreme(
    passage: Passage, branch: int, nearest: bool, begin: float, end: float
) -> float:
    """When the circles of a branch are nearest, or else farthest, if in an interval; else its end.

    The last one's centre is then on the line from the first one's to that of the leader's turn.
    """
    to_turn, _, _ = _to_turn(passage, branch, begin)
    to_turn += pi if nearest else 0.0
    sense = 1.0 if passage.turning > 0.0 else -1.0
    return float(min(begin + wrap(sense * to_turn) / abs(passage.turning), end))


@njit(cache=True, nogil=True)
def _to_turn(passage: Passage, branch: int, t: float) -> tuple[float, float, float]:
    """How far the leader turns from t on until the circles of a branch are farthest [rad].

    And how far the centres of the first and the last one are from that of its turn [R].
    """
    word = WORD_OF[branch]
    first, last = SIGNS[word, 0], SIGNS[word, 2]
    dx, dy = passage.x + first * passage.sin_h, passage.y - first * passage.cos_h
    ahead = passage.ahead - last * passage.sin_heading
    left = passage.left + last * passage.cos_heading
    to_turn = atan2(dy, dx) - atan2(left, ahead) - leader_heading(passage, t)
    return to_turn, norm(dx, dy), norm(ahead, left)


@njit(cache=True, nogil=True)
def _edge_between(
    passage: Passage, branch: int, before: Seen, after: Seen, piece: FloatArray
) -> Seen:
    """Where a branch begins or ceases to exist, between two times at one of which it exists.

    That is where its circles are 2 R apart, centre from centre, or 4 R for three turns. What is
    seen is hardly on the side where it exists.
    """
    begins = isnan(before.excess)
    inside, outside = (after.t, before.t) if begins else (before.t, after.t)
    to_turn, from_first, from_last = _to_turn(passage, branch, before.t)
    gap, both = 2.0 if branch < 4 else 4.0, 2.0 * from_first * from_last
    # gap² = d² + e² + 2 d e cos(turn from where they are farthest)
    share = gap * gap - from_first * from_first - from_last * from_last
    if abs(share) < both:
        apart, sense = acos(share / both), 1.0 if passage.turning > 0.0 else -1.0
        for side in (-1.0, 1.0):
            after_begin = wrap(sense * (to_turn + side * apart)) / abs(passage.turning)
            at = before.t + after_begin + (_EDGE if begins else -_EDGE)
            if before.t < at < after.t:
                edge = _see(passage, branch, at, piece)
                if not isnan(edge.excess):
                    return edge
    for _ in range(_HALVINGS):
        middle = 0.5 * (inside + outside)
        if isnan(excess(passage, branch, middle, piece)):
            outside = middle
        else:
            inside = middle
    return _see(passage, branch, inside, piece)


@njit(cache=True, nogil=True)
def _append_roots(
    passage: Passage, branch: int, before: Seen, after: Seen, rows: FloatArray, n: int,
    piece: FloatArray,
) -> int:  # fmt: skip
    """Append the rows of one branch that arrive between two times at one of which it exists."""
    near = JUMP
    if isnan(before.excess) or isnan(after.excess):
        if not (_may_arrive(before) or _may_arrive(after)):
            return n
        edge, near = _edge_between(passage, branch, before, after, piece), _EDGE_JUMP
        if isnan(before.excess):
            before = edge
        else:
            after = edge
    # the circles of LSR and RSL are never so near
    if branch not in (2, 3) and _may_swing(before, after):
        at = _time_of_extreme(passage, branch, True, before.t, after.t)
        between = _see(passage, branch, at, piece)
        if at < after.t and not isnan(between.excess):
            n = _append_existing(passage, branch, before, between, near, rows, n, piece)
            before = between
    return _append_existing(passage, branch, before, after, near, rows, n, piece)


@njit(cache=True, nogil=True)
def _may_swing(before: Seen, after: Seen) -> bool:
    """Whether circles may pass each other so closely that turns change by half a turn.

    Half a turn one way looks like half a turn the other way; up to where they are nearest, and from
    there on, it is half as much.
    """
    first, last = wrap_signed(after.first - before.first), wrap_signed(after.last - before.last)
    return bool(max(abs(first), abs(last)) > _SWING)


@njit(cache=True, nogil=True)
def _append_existing(
    passage: Passage, branch: int, before: Seen, after: Seen, near: float, rows: FloatArray,
    n: int, piece: FloatArray,
) -> int:  # fmt: skip
    """Append the rows of one branch that arrive between two times, if it exists all the while."""
    # by how many full turns each turn has jumped in between
    first, last = _jumped(before.first, after.first), _jumped(before.last, after.last)
    if first != 0 or last != 0:
        near = _EDGE_JUMP
    for turns in range(min(first, 0) + min(last, 0), max(first, 0) + max(last, 0) + 1):
        wanted, jumped = -TWO_PI * turns, TWO_PI * (first + last)
        begun = Seen(before.t, before.excess - wanted, before.first, before.last)
        ended = Seen(after.t, after.excess - jumped - wanted, after.first, after.last)
        follow = _Follow(branch, before.first, before.last, wanted)
        n = _append_smooth(passage, follow, begun, ended, near, rows, n, piece)
    return n


@njit(cache=True, nogil=True)
def _may_arrive(seen: Seen) -> bool:
    """Whether a branch may arrive a step before or after, its turns counted past full ones too."""
    return bool(abs(wrap_signed(seen.excess)) < _EDGE_JUMP)


@njit(cache=True, nogil=True)
def _jumped(before: float, after: float) -> int:
    """By how many full turns a turn has jumped between two times, within a step."""
    if after - before > pi:
        return 1
    return -1 if before - after > pi else 0


@njit(cache=True, nogil=True)
def _append_smooth(
    passage: Passage, follow: _Follow, before: Seen, after: Seen, near: float, rows: FloatArray,
    n: int, piece: FloatArray,
) -> int:  # fmt: skip
    """Append the rows of a branch that arrive between two times between which it is smooth.

    Two of them only if the excess is less than `near` in the mean of both.
    """
    if not before.excess * after.excess > 0.0:
        return _append_root(passage, follow, before, after, rows, n, piece)
    if abs(before.excess + after.excess) > near:
        return n
    turn = _turning_point(passage, follow, before, after, piece)
    if not before.excess * turn.excess < 0.0:
        return n
    n = _append_root(passage, follow, before, turn, rows, n, piece)
    return _append_root(passage, follow, turn, after, rows, n, piece)


@njit(cache=True, nogil=True)
def _turning_point(
    passage: Passage, follow: _Follow, before: Seen, after: Seen, piece: FloatArray
) -> Seen:
    """A time between two at which the excess has the other sign; one of them if it keeps it."""
    sign = 1.0 if before.excess > 0.0 else -1.0
    low, high = before, after
    fall = sign * _slope(passage, follow, low, _MOMENT, piece)
    rise = sign * _slope(passage, follow, high, -_MOMENT, piece)
    for _ in range(_MOST_TANGENTS):
        if not fall < 0.0 < rise:
            break
        at = (sign * (high.excess - low.excess) - rise * high.t + fall * low.t) / (fall - rise)
        lowest = sign * low.excess + fall * (at - low.t)
        if not (lowest < 0.0 and low.t < at < high.t):
            break
        between = _see_on(passage, follow, at, piece)
        if isnan(between.excess) or sign * between.excess < 0.0:
            return between
        slope = sign * _slope(passage, follow, between, _MOMENT, piece)
        if slope < 0.0:
            low, fall = between, slope
        else:
            high, rise = between, slope
    return low


@njit(cache=True, nogil=True)
def _slope(
    passage: Passage, follow: _Follow, seen: Seen, moment: float, piece: FloatArray
) -> float:
    """How fast the excess rises, over a moment after a time, or before it."""
    return (_see_on(passage, follow, seen.t + moment, piece).excess - seen.excess) / moment


@njit(cache=True, nogil=True)
def _see(passage: Passage, branch: int, t: float, piece: FloatArray) -> Seen:
    """Look at one branch at one time."""
    value = excess(passage, branch, t, piece)
    return Seen(t, value, piece[0], piece[2])


@njit(cache=True, nogil=True)
def _see_on(passage: Passage, follow: _Follow, t: float, piece: FloatArray) -> Seen:
    """Look at one branch at one time, its turns followed past 0 and past full ones."""
    value = excess(passage, follow.branch, t, piece)
    jumped = _jumped(follow.first, piece[0]) + _jumped(follow.last, piece[2])
    return Seen(t, value - TWO_PI * jumped - follow.wanted, piece[0], piece[2])


@njit(cache=True, nogil=True)
def _append_root(
    passage: Passage, follow: _Follow, before: Seen, after: Seen, rows: FloatArray, n: int,
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
        value = _see_on(passage, follow, at, piece).excess
        times = tightened(times, at, rising * value)
    value = excess(passage, follow.branch, at, piece)
    if not abs(value) < _MET:
        return n
    rows[n, 0] = at
    rows[n, 1] = WORD_OF[follow.branch]
    rows[n, 2:5] = piece
    return n + 1
