"""Paths of one word that arrive before a given time: roots are sought only where they can be.

For maps, where a time to beat is known for nearly every word. Symbols as in `csc` and `ccc`, for
the slot itself (κ = 0, α < 1): d(τ) is the vector between the centres of the first and the
last circle. As the slot moves on, d's end runs along a straight line.

LSR. A root means τ = A + l with l² = |d(τ)|² − 4, and the course of the straight is β = arg d +
arcsin(2/|d|). Where |d| ≥ 2,

    dβ/dτ = −α (N + 2E/l) / |d|²,    d = (E, N),

does not change sign: its zeros would need E² = −N². So while τ runs through an interval, β runs
through one between its values at the ends, by less than π. In that window A(β) has a least value
A₀, and (τ − A₀)² ≥ |d(τ)|² − 4 bounds τ anew from below. After some rounds roots are
sought in the window that remains, by the equation of `csc`.

LRL. A root means |d(τ)| ≤ 4, and τ = 2m + w is the middle arc m but for a constant: a window too.
There |d|² and 8(1 − cos m) must meet.
"""

from math import acos, atan2, cos, inf, pi, sqrt
from typing import NamedTuple

import numpy as np
from numba import njit

from relguide.kernels.base.angles import TWO_PI, turn_to, wrap, wrap_signed
from relguide.kernels.base.norm import norm
from relguide.kernels.base.records import Start, Window
from relguide.kernels.base.roots import MAX_CUTS, FloatArray, all_roots, insert_cut
from relguide.kernels.base.sine import sine_and_cosine

MOST_ROOTS = 64
"""Room for the paths of one word."""
EARLY = 1e-9
"""This much before it opens the slot counts as open [R/V_P], as in `solve`."""
_ROUNDS = 2  # more do not help
_ROUNDING = 1e-6  # of angles and of times [R/V_P]: windows are wider by this


class Scratch(NamedTuple):
    """Room that the searches below work in."""

    lines: FloatArray
    """Coefficients, cuts and roots of an equation; the best path so far. shape (4, 2·MAX_CUTS)"""
    found: FloatArray
    """Takes the paths: τ, and the amounts of the three pieces. shape (MOST_ROOTS, 4)"""


class _Centres(NamedTuple):
    """What fixes the paths of LSR: d at τ = 0, the pursuer's heading, and α."""

    east: float
    north: float
    h: float
    alpha: float


@njit(cache=True, nogil=True)
def make_scratch() -> Scratch:
    """Room for one thread."""
    return Scratch(np.empty((4, 2 * MAX_CUTS)), np.empty((MOST_ROOTS, 4)))


@njit(cache=True, nogil=True)
def lsl_before(start: Start, alpha: float, window: Window, scratch: Scratch) -> int:
    """The first LSL path.

    Args:
        start: the pursuer's pose, seen from the slot.
        alpha: V_L/V_P, below 1.
        window: when it arrives.
        scratch: takes it.

    Returns:
        1 if there is one, else 0.
    """
    x, y, h, sin_h, cos_h = start
    out = scratch.found
    cx, cy = x - sin_h, y + cos_h
    one_less = 1.0 - alpha * alpha
    ey = 1.0 - cy
    turned = wrap(TWO_PI - h)
    for _ in range(2):
        ex = alpha * turned - cx
        b = alpha * ex
        gap = ex * ex + ey * ey
        root = sqrt(b * b + one_less * gap)
        # the one root that is not negative, in the form that loses no digits
        straight = (b + root) / one_less if b >= 0.0 else gap / (root - b)
        time = turned + straight
        if time >= window.beat:
            return 0
        if time >= window.earliest - EARLY:
            course = atan2(ey, alpha * straight + ex)
            first, last = turn_to(course - h), turn_to(-course)
            if straight == 0.0:
                first, last = turned, 0.0
            if abs(first + last - turned) < 1e-8:
                out[0, 0] = time
                out[0, 1] = first
                out[0, 2] = straight
                out[0, 3] = max(turned - first, 0.0)
                return 1
        turned += TWO_PI
    return 0


@njit(cache=True, nogil=True)
def lsr_before(start: Start, alpha: float, window: Window, every: bool, scratch: Scratch) -> int:
    """LSR paths, in no order.

    Args:
        start: as in `lsl_before`.
        alpha: above 0 and below 1.
        window: when they arrive; a few may arrive a little later.
        every: whether all of them are wanted, or only the first for sure.
        scratch: takes them.

    Returns:
        how many.
    """
    east, north = -(start.x - start.sin_h), -1.0 - (start.y + start.cos_h)
    centres = _Centres(east, north, start.h, alpha)
    earliest, latest = window.earliest, window.beat + _ROUNDING
    if abs(north) >= 2.0:
        return _lsr_within(centres, earliest, latest, scratch, 0)
    # while |d| < 2 there is no such path
    half = sqrt(4.0 - north * north)
    n = _lsr_within(centres, earliest, min((-half - east) / alpha, latest), scratch, 0)
    if n > 0 and not every:
        return n
    return _lsr_within(centres, max((half - east) / alpha, earliest), latest, scratch, n)


@njit(cache=True, nogil=True)
def _lsr_within(centres: _Centres, t_from: float, t_to: float, scratch: Scratch, n: int) -> int:
    """LSR paths that arrive between two times, |d| ≥ 2 all the while; appended to n rows."""
    (east, north, h, alpha), out = centres, scratch.found
    if t_from > t_to + _ROUNDING:
        return n
    # A(β) is least where β is h or 0
    least_turn, low, width = min(h, TWO_PI - h) - _ROUNDING, 0.0, 0.0
    course_to = 0.0  # far ahead of the slot the straight leads along its route
    for step in range(_ROUNDS):
        start = max(_earliest_meeting(centres, least_turn, t_from) - _ROUNDING, t_from)
        if start > t_to + _ROUNDING:
            return n
        if step == 0 and t_to < inf:
            course_to = _inner_course(alpha * t_to + east, north)
        swept = wrap_signed(course_to - _inner_course(alpha * start + east, north))
        low = wrap((course_to - swept if swept > 0.0 else course_to) - _ROUNDING)
        width = abs(swept) + 2.0 * _ROUNDING
        # A(β) rises except where β passes h or 0: there a turn falls from 2π to 0
        turn = wrap(low - h) + low
        if wrap(h - low) <= width:
            turn = min(turn, h)
        if low + width >= TWO_PI:
            turn = min(turn, wrap(-h))
        if turn - _ROUNDING <= least_turn:
            break
        least_turn = turn - _ROUNDING
    before = n
    n = _lsr_courses(centres, low, min(low + width, TWO_PI), scratch, n)
    if low + width > TWO_PI:
        n = _lsr_courses(centres, 0.0, low + width - TWO_PI, scratch, n)
    kept = before
    for i in range(before, n):
        # on a course of this window there may be a path of quite another time, too
        if t_from - EARLY <= out[i, 0] <= t_to + _ROUNDING:
            out[kept] = out[i]
            kept += 1
    return kept


@njit(cache=True, nogil=True)
def _inner_course(east: float, north: float) -> float:
    """β = arg d + arcsin(2/|d|), the course of the straight that touches both circles."""
    straight = sqrt(max(east * east + north * north - 4.0, 0.0))
    return atan2(north * straight + 2.0 * east, east * straight - 2.0 * north)


@njit(cache=True, nogil=True)
def _earliest_meeting(centres: _Centres, turn: float, t_from: float) -> float:
    """A time from t_from on, before which (τ − A₀)² < |d(τ)|² − 4 or τ < A₀."""
    east, north, _, alpha = centres
    start = max(turn, t_from)
    across = north * north - 4.0
    if (alpha * start + east) ** 2 + across <= (start - turn) ** 2:
        return start
    one_less = 1.0 - alpha * alpha
    half = turn + alpha * east
    gap = half * half + one_less * (east * east + across - turn * turn)
    if gap < 0.0:
        return start
    return float(max((half + sqrt(gap)) / one_less, start))


@njit(cache=True, nogil=True)
def _lsr_courses(centres: _Centres, low: float, high: float, scratch: Scratch, n: int) -> int:
    """LSR paths with the straight on a course between two, 0 ≤ low ≤ high ≤ 2π."""
    (east, north, h, alpha), out = centres, scratch.found
    k, cuts, roots = scratch.lines[0], scratch.lines[1], scratch.lines[2]
    k[0] = 0.0
    k[1] = 0.0
    k[2] = alpha * north - 2.0
    k[3] = 2.0 * alpha
    k[5] = 2.0 * alpha - north
    for piece in range(2):
        # below h the first turn goes once more round
        around = TWO_PI - h if piece == 0 else -h
        start = low if piece == 0 else max(low, h)
        end = min(high, h) if piece == 0 else high
        if end - start < 1e-12:
            continue
        k[4] = alpha * around + east
        cuts[0] = start
        cuts[1] = end
        n_cuts = 2
        # tan has its poles at π/2 and 3π/2, the crests lie round 0, π and 2π
        n_cuts = insert_cut(cuts, n_cuts, 0.5 * pi)
        n_cuts = insert_cut(cuts, n_cuts, 1.5 * pi)
        if -2.0 * alpha < north < 0.0:
            crest = acos(sqrt(-north / (2.0 * alpha)))
            n_cuts = insert_cut(cuts, n_cuts, crest)
            n_cuts = insert_cut(cuts, n_cuts, pi - crest)
            n_cuts = insert_cut(cuts, n_cuts, pi + crest)
            n_cuts = insert_cut(cuts, n_cuts, TWO_PI - crest)
        for i in range(all_roots(k, cuts, n_cuts, roots)):
            course = roots[i]
            s, c = sine_and_cosine(course)
            turned = 2.0 * course + around
            reach = (alpha * (turned + north * s) + east) / (1.0 - alpha * c)
            straight = reach * c + north * s
            if straight < -1e-9:  # ≈ 1e-5 m at R = 12 km: rounding of a straight of no length
                continue
            out[n, 0] = turned + max(straight, 0.0)
            out[n, 1] = max(course + around, 0.0)
            out[n, 2] = max(straight, 0.0)
            out[n, 3] = course
            n += 1
    return n


@njit(cache=True, nogil=True)
def lrl_before(start: Start, alpha: float, window: Window, scratch: Scratch) -> int:
    """LRL paths, in no order. Arguments and result as in `lsr_before`; all of them are given."""
    x, y, h, sin_h, cos_h = start
    ex, ey = -(x - sin_h), 1.0 - (y + cos_h)
    within = 16.0 + _ROUNDING - ey * ey
    if within < 0.0:
        return 0
    # d comes within reach at −half, and leaves it at +half
    half = sqrt(within)
    t_from = max((-half - ex) / alpha, window.earliest) - _ROUNDING
    t_to = min((half - ex) / alpha, window.beat) + _ROUNDING
    n = 0
    if t_from > t_to:
        return n
    out = scratch.found
    k, cuts, roots = scratch.lines[0], scratch.lines[1], scratch.lines[2]
    k[0] = 4.0 * alpha * alpha
    k[3] = 0.0
    k[4] = 0.0
    k[5] = 8.0
    bend = 0.0
    for loops in range(3):
        around = TWO_PI * loops - h
        low = max(0.0 if loops > 0 else h, 0.5 * (t_from - around))
        high = min(h if loops == 2 else TWO_PI, 0.5 * (t_to - around))
        if high - low < 1e-12 or not _may_meet(ex, ey, alpha, around, low, high):
            continue
        if bend == 0.0:
            bend = acos(alpha * alpha)
        closing = alpha * around + ex
        k[1] = 4.0 * alpha * closing
        k[2] = closing * closing + ey * ey - 8.0
        cuts[0] = low
        cuts[1] = high
        n_cuts = insert_cut(cuts, 2, bend)
        n_cuts = insert_cut(cuts, n_cuts, TWO_PI - bend)
        for i in range(all_roots(k, cuts, n_cuts, roots)):
            middle = roots[i]
            turned = middle + around
            time = turned + middle
            crossing = atan2(ey, alpha * time + ex) + 0.5 * middle
            first, last = turn_to(crossing - h), turn_to(middle - crossing)
            if abs(first + last - turned) < 1e-7:
                out[n, 0] = time
                out[n, 1] = first
                out[n, 2] = middle
                out[n, 3] = max(turned - first, 0.0)
                n += 1
    return n


@njit(cache=True, nogil=True)
def _may_meet(ex: float, ey: float, alpha: float, around: float, low: float, high: float) -> bool:
    """Whether |d|² and 8(1 − cos m) have values in common while m runs from low to high."""
    near, far = alpha * (2.0 * low + around) + ex, alpha * (2.0 * high + around) + ex
    least = 0.0 if near < 0.0 < far else min(near * near, far * far)
    at_low, at_high = 8.0 * (1.0 - cos(low)), 8.0 * (1.0 - cos(high))
    most = 16.0 if low < pi < high else max(at_low, at_high)
    return bool(
        least + ey * ey <= most + _ROUNDING
        and norm(max(abs(near), abs(far)), ey) ** 2 >= min(at_low, at_high) - _ROUNDING
    )
