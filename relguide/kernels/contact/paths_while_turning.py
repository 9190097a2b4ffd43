"""Words to a contact with d = d_min while the leader turns: the contact moves on a circle.

A word arrives when its length to where the contact then is equals the time for it. That is looked
at step by step, for all branches at once; for its roots between two times see
`arrivals_while_turning`.

A word is no shorter than the straight between its first and its last circle and the change of
heading, and its length changes no faster than these move, but for full turns. So most looks see at
once that it does not arrive until the next step, and often for longer.
"""

from math import asin, atan2, ceil, inf, isnan, pi, sqrt
from typing import NamedTuple

import numpy as np
from numba import njit

from relguide.kernels.base.angles import TWO_PI, turn_to, wrap, wrap_signed
from relguide.kernels.base.clock import time_is_up
from relguide.kernels.base.norm import norm
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.base.sine import sine_and_cosine
from relguide.kernels.contact.arrivals_while_turning import JUMP, Seen, append_arrivals
from relguide.kernels.contact.moving_contact import (
    Passage,
    distance_at,
    leader_heading,
    speed_of,
)
from relguide.kernels.words.branches import SIZE, TO_POINT
from relguide.kernels.words.extremals import SIGNS

_STEP = 0.15  # the leader turns by some 10° in it [R/V_P]
_BEFORE = 0.1  # so much of a step before the first time at which one may arrive it is looked at
_LONGEST_DETOUR = 24.0  # 6π + 4, rounded up
_BESIDE = 2.2  # circles so near each other turn the straight between them no faster than they move
_FARTHEST = 3.999  # circles so far from each other change the turn between them too fast to say
_QUARTER = 0.5 * pi  # the arc over a chord is no longer than so many times the chord
_PAIRS = 4  # of first and last circles, in the order of the words with a straight between them
_SEEN = SIZE + _PAIRS  # rows of one look


class _Length(NamedTuple):
    """What a look at one branch says."""

    excess: float
    """As in `Seen`; infinite if it arrives neither within a step before nor within one after."""
    first: float
    """First turn [rad] …"""
    last: float
    """… and last one [rad]."""
    free: float
    """For how long from then on it does not arrive [R/V_P], if that is a step or more."""


class _Circles(NamedTuple):
    """The first and the last circle of a word at one time."""

    first: float
    """ε of the first."""
    dx: float
    """From one centre to the other [R]."""
    dy: float
    """[R]."""
    gap: float
    """How far that is [R]."""
    swept: float
    """How far the last one moves in a step [R]."""
    sway: float
    """How much the contact's heading changes in a step [rad]."""
    course: float
    """That heading [rad]."""
    h: float
    """Heading of the start [rad]."""
    elapsed: float
    """The time there is for the word [R/V_P]."""
    step: float
    """From one look to the next [R/V_P]."""


class _Middle(NamedTuple):
    """The middle turn of a word of three turns, the shorter way round."""

    turn: float
    """[rad]."""
    bends: float
    """How much that changes in a step at most [rad] …"""
    steps: float
    """… for so many steps; 0 if nothing is known."""


@njit(cache=True, nogil=True)
def paths_while_turning(
    passage: Passage, words: int, earliest: float, beat: float, rows: FloatArray
) -> int:
    """Some words to the contact, in no order. As `paths_to_contact.paths_by_words`.

    One of three turns comes with that which has the same first and last turn.
    """
    begin, end = passage.begin, passage.end
    first = max(earliest, begin)
    if first >= min(beat, end):
        return 0
    steps = ceil((end - begin) / _STEP) + 1
    step = (end - begin) / steps
    # a word is hardly longer than three full turns more than the contact is far
    slack = _LONGEST_DETOUR + (1.0 + speed_of(passage)) * step
    # of each branch excess, first and last turn; then how fast the circles of each pair part; this
    # for the last look and this one, and the centres of the circles of each pair
    looks = np.full((2 * _SEEN + 2 * _PAIRS, 3), np.nan)
    _put_centres(passage, step, looks)
    n, last_t, follows, last, here = 0, begin, False, _SEEN, 0
    # a straight may arrive just then
    t, goes_on = max(first - _BEFORE * step, begin), True
    while goes_on:
        goes_on = t < end
        elapsed = t - passage.t_start
        if elapsed > slack and elapsed > slack + distance_at(passage, t):
            follows = False
            t = min(t + step, end)
            continue
        if time_is_up(passage.until):
            break
        free = _look(passage, words, t, step, looks, here)
        if follows:
            n = _append_between(passage, looks, last, here, last_t, t, rows, n)
        if t >= beat:
            break
        last, here, last_t, follows = here, last, t, True
        t = min(t + max(free, step), end)
    return n


@njit(cache=True, nogil=True)
def _append_between(
    passage: Passage, looks: FloatArray, last: int, here: int, last_t: float, t: float,
    rows: FloatArray, n: int,
) -> int:  # fmt: skip
    """Append the words that arrive between two looks, which begin at these rows of `looks`.

    Returns:
        how many rows there are then.
    """
    for branch in TO_POINT:
        before, after = looks[last + branch, 0], looks[here + branch, 0]
        if before == inf or after == inf:
            continue
        if isnan(before) and isnan(after):
            # it may exist between them where its circles are farthest, or, for three turns,
            # nearest
            pair = SIZE + (branch if branch < 4 else (branch - 4) // 2)
            begun, ended = looks[last + pair, 0], looks[here + pair, 0]
            if not (begun > 0.0 > ended if branch < 4 else begun < 0.0 < ended):
                continue
        elif (
            before * after > 0.0
            and abs(before + after) > JUMP
            and abs(looks[last + branch, 1] - looks[here + branch, 1]) < pi
            and abs(looks[last + branch, 2] - looks[here + branch, 2]) < pi
        ):
            continue
        begun = Seen(last_t, before, looks[last + branch, 1], looks[last + branch, 2])
        ended = Seen(t, after, looks[here + branch, 1], looks[here + branch, 2])
        n = append_arrivals(passage, branch, begun, ended, rows, n, np.empty(3))
    return n


@njit(cache=True, nogil=True)
def _put_centres(passage: Passage, step: float, looks: FloatArray) -> None:
    """Put down where the centres of first and last circles are, two rows for each pair.

    The first one from the centre of the leader's turn [R], and how far the last one moves in a step
    [R]; then the last one from that centre ahead and to the left as the leader heads [R].
    """
    s, c = passage.sin_h, passage.cos_h
    end_s, end_c = passage.sin_heading, passage.cos_heading
    for pair in range(_PAIRS):
        first, last = SIGNS[pair, 0], SIGNS[pair, 2]
        row = 2 * (_SEEN + pair)
        ahead, left = passage.ahead - last * end_s, passage.left + last * end_c
        looks[row, 0], looks[row, 1] = -passage.x - first * s, first * c - passage.y
        looks[row, 2] = abs(passage.turning) * step * norm(ahead, left)
        looks[row + 1, 0], looks[row + 1, 1] = ahead, left


@njit(cache=True, nogil=True)
def _look(
    passage: Passage, words: int, t: float, step: float, looks: FloatArray, here: int
) -> float:
    """Look at all branches of some words at one time.

    Args:
        passage: to the contact.
        words: as in `passing`.
        t: when [R/V_P].
        step: from one look to the next [R/V_P].
        looks: takes what is seen, as `paths_while_turning` keeps it, from this row on.
        here: the row.

    Returns:
        for how long from then on none of them arrives [R/V_P], if that is a step or more.
    """
    h, elapsed = passage.pose.h, t - passage.t_start
    lh = leader_heading(passage, t)
    s, c = sine_and_cosine(lh)
    course, sway = lh + passage.heading, abs(passage.turning) * step
    free = inf
    for pair in range(_PAIRS):
        if not words & (1 << pair):
            continue
        row = 2 * (_SEEN + pair)
        ahead, left = looks[row + 1, 0], looks[row + 1, 1]
        ex, ey = ahead * c - left * s, ahead * s + left * c
        dx, dy = ex - looks[row, 0], ey - looks[row, 1]
        looks[here + SIZE + pair, 0] = passage.turning * (dy * ex - dx * ey)
        gap, first = sqrt(dx * dx + dy * dy), SIGNS[pair, 0]
        circles = _Circles(first, dx, dy, gap, looks[row, 2], sway, course, h, elapsed, step)
        if pair >= 2:
            free = min(free, _put_down(looks, here + pair, _look_at_opposite(circles)))
            continue
        change = wrap(first * (course - h))
        free = min(free, _put_down(looks, here + pair, _look_at_same(circles, change)))
        middle = _middle_of(circles)
        for way in range(2):
            seen = _look_at_middle(circles, change, way, middle)
            free = min(free, _put_down(looks, here + 4 + 2 * pair + way, seen))
    return free


@njit(cache=True, nogil=True)
def _put_down(looks: FloatArray, row: int, seen: _Length) -> float:
    """Put down what a look at one branch says; for how long it does not arrive [R/V_P]."""
    looks[row, 0], looks[row, 1], looks[row, 2] = seen.excess, seen.first, seen.last
    return seen.free


@njit(cache=True, nogil=True)
def _middle_of(circles: _Circles) -> _Middle:
    """The shorter middle turn of LRL or RLR, whose circles are 4 R apart at most."""
    gap, swept = circles.gap, circles.swept
    turn = 2.0 * asin(0.25 * min(gap, 4.0))
    if gap > _FARTHEST or swept == 0.0:
        return _Middle(turn, 0.0, 0.0)
    # until they are half as far from 4 R it changes no faster than there
    there = 0.125 * (gap + 4.0)
    return _Middle(turn, 0.5 * swept / sqrt(1.0 - there * there), 0.5 * (4.0 - gap) / swept)


@njit(cache=True, nogil=True)
def _look_at_same(circles: _Circles, change: float) -> _Length:
    """Look at LSL or RSR; `change` is that of the heading, in [0, 2π).

    The turns add up to that, or to a full turn more: so the length changes no faster than the
    circles part and the heading changes, but for full turns.
    """
    gap, step = circles.gap, circles.step
    late, fastest = gap + change - circles.elapsed, step + circles.swept + circles.sway
    free = abs(wrap_signed(late)) / fastest
    if late > 0.0:
        free = max(free, min(late / fastest, (TWO_PI - change) / circles.sway))
    if free > 1.0:
        return _Length(inf, 0.0, 0.0, free * step)
    bearing = atan2(circles.dy, circles.dx)
    seen = _length_of(circles, circles.first, bearing, bearing, gap)
    return _if_it_may_arrive(circles, seen, fastest, 0.0, gap)


@njit(cache=True, nogil=True)
def _look_at_middle(circles: _Circles, change: float, way: int, middle: _Middle) -> _Length:
    """Look at LRL or RLR, one way round the middle circle, 1 the longer; `change` as before.

    The first and the last turn less the middle one add up to the change of heading, but for full
    turns.
    """
    gap, swept, step, away = circles.gap, circles.swept, circles.step, 1.0 if way == 0 else -1.0
    if gap - swept > 4.0:
        return _Length(inf, 0.0, 0.0, (gap - 4.0) / swept * step if swept > 0.0 else inf)
    fastest = step + circles.sway + 2.0 * middle.bends
    late = change - circles.elapsed + 2.0 * away * middle.turn
    steps = min(abs(wrap_signed(late)) / fastest, middle.steps)
    if steps > 1.0:
        return _Length(inf, 0.0, 0.0, steps * step)
    if middle.steps <= 1.0:
        # at nearly 4 R it changes fast
        least = 2.0 * asin(0.25 * max(gap - swept, 0.0))
        most = 2.0 * asin(0.25 * min(gap + swept, 4.0))
        apart = abs(wrap_signed(change - circles.elapsed + away * (least + most)))
        if apart > most - least + circles.sway + step:
            return _Length(inf, 0.0, 0.0, step)
    if gap > 4.0:
        return _Length(np.nan, 0.0, 0.0, 0.0)
    bearing, turned = atan2(circles.dy, circles.dx), middle.turn
    half = 0.5 * circles.first * turned
    if way == 1:
        turned, half = TWO_PI - turned, circles.first * pi - half
    seen = _length_of(circles, circles.first, bearing + half, bearing - half, turned)
    lasts = min(middle.steps * swept, gap)
    return _if_it_may_arrive(circles, seen, fastest, 0.5 * middle.bends, lasts)


@njit(cache=True, nogil=True)
def _look_at_opposite(circles: _Circles) -> _Length:
    """Look at LSR or RSL.

    One turn less the other is the change of heading, but for full turns.
    """
    gap, step, first = circles.gap, circles.step, circles.first
    change, nearest = abs(wrap_signed(circles.course - circles.h)), gap - circles.swept
    straight = sqrt(nearest * nearest - 4.0) if nearest > 2.0 else 0.0
    if straight + max(change - circles.sway, 0.0) > circles.elapsed + step:
        late = (gap - 2.0 + change - circles.elapsed) / (step + circles.swept + circles.sway)
        return _Length(inf, 0.0, 0.0, step * max(late, 1.0))
    if gap < 2.0 - circles.swept:
        steps = (2.0 - gap) / circles.swept if circles.swept > 0.0 else inf
        return _Length(inf, 0.0, 0.0, steps * step)
    if gap < 2.0:
        return _Length(np.nan, 0.0, 0.0, 0.0)
    bearing = atan2(circles.dy, circles.dx) + first * asin(2.0 / gap)
    seen = _length_of(circles, -first, bearing, bearing, sqrt(gap * gap - 4.0))
    # as long as it exists its length changes no faster than the last circle moves and the heading
    # changes, but for full turns
    fastest, lasts = step + circles.swept + circles.sway, gap - 2.0
    steps = abs(wrap_signed(seen.excess)) / fastest
    if steps > 1.0 and lasts > circles.swept:
        return _Length(inf, 0.0, 0.0, step * min(steps, lasts / circles.swept))
    return _if_it_may_arrive(circles, seen, fastest, circles.swept, gap - _BESIDE)


@njit(cache=True, nogil=True)
def _if_it_may_arrive(
    circles: _Circles, seen: _Length, fastest: float, turning: float, lasts: float
) -> _Length:
    """A word as it was seen, but that it does not arrive if neither turn can jump before it might.

    Args:
        circles: of the word.
        seen: the word.
        fastest: how much its excess changes in a step at most, but where a turn jumps [R/V_P].
        turning: how much the heading between first and last turn does, in a step and beside the
            bearing of the last circle from the first one [rad].
        lasts: how far the last circle has to move until these may no longer hold; less than how far
            the two are from each other [R].
    """
    swept, sway = circles.swept, circles.sway
    if lasts <= swept or swept == 0.0:
        return seen
    turning += _QUARTER * swept / circles.gap + sway
    room = min(seen.first, TWO_PI - seen.first, seen.last, TWO_PI - seen.last)
    steps = min(abs(seen.excess) / fastest, room / turning, lasts / swept)
    return _Length(inf, 0.0, 0.0, steps * circles.step) if steps > 1.0 else seen


@njit(cache=True, nogil=True)
def _length_of(
    circles: _Circles, last: float, begun: float, ended: float, middle: float
) -> _Length:
    """A word whose middle piece begins and ends on these headings; `last` is ε of its last turn."""
    first_turn = turn_to(circles.first * (begun - circles.h))
    last_turn = turn_to(last * (circles.course - ended))
    excess = first_turn + middle + last_turn - circles.elapsed
    return _Length(excess, first_turn, last_turn, 0.0)
