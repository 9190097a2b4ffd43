"""How long it takes at least to go round the disc, for something that needs no time to turn.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import cos, floor, pi, sqrt

import numpy as np
from numba import njit

from relguide.kernels.base.angles import TWO_PI, wrap, wrap_signed
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.bounds.cells import Cell

_FAST = 0.999  # for a leader faster than this the time round the disc is not bounded
_ROUND = 16_384
"""Points of `times_round`: every 0.02°."""
ROUND_SLACK = 3e-8
"""What differences between any two bearings may be wrong by, as part of a whole round. Between two
points of the table d²t/db² is less than 2 α d/(1 − α²), and a whole round takes no less than twice
2 d/(1 − α²): so it is less than an eighth of the square of the step, beside which nothing counts.
"""
_TOUCHING = 1e-9  # of a gap so small nothing is said [rad]


@njit(cache=True, nogil=True)
def times_round(alpha: float, d_min: float) -> FloatArray:
    """How long it takes at least to go round the disc, by bearing from −π on.

    For something that needs no time to turn. Outside the disc it is fastest along its edge, since
    that is convex and the leader's motion is the same everywhere: as a boundary arc (see
    `contact`), so

        dt/db = d / (√(1 − α² cos² b) + s α sin b) = d (√(1 − α² cos² b) − s α sin b) / (1 − α²)

    with d = d_min.

    Row 0 is counter-clockwise (s = 1), row 1 clockwise, both growing with b. shape (2, ·)
    """
    table = np.zeros((2, _ROUND + 1))
    if alpha > _FAST:
        return table
    step = TWO_PI / _ROUND
    scale = d_min / (1.0 - alpha * alpha)
    arc, last = 0.0, sqrt(1.0 - alpha * alpha)
    for k in range(1, _ROUND + 1):
        b = k * step - pi
        middle = sqrt(1.0 - (alpha * cos(b - 0.5 * step)) ** 2)
        here = sqrt(1.0 - (alpha * cos(b)) ** 2)
        arc += step * (last + 4.0 * middle + here) / 6.0
        last = here
        table[0, k] = scale * (arc + alpha * (cos(b) + 1.0))
        table[1, k] = scale * (arc - alpha * (cos(b) + 1.0))
    return table


@njit(cache=True, nogil=True)
def round_time(table: FloatArray, way: int, bearing: float) -> float:
    """A row of `times_round` at any bearing of [−π, π]; differences are right to `ROUND_SLACK`."""
    place = min(max((bearing + pi) / TWO_PI, 0.0), 1.0) * _ROUND
    k = min(int(place), _ROUND - 1)
    return float(table[way, k] + (place - k) * (table[way, k + 1] - table[way, k]))


@njit(cache=True, nogil=True)
def round_anywhere(table: FloatArray, way: int, bearing: float) -> float:
    """As `round_time`, on beyond [−π, π]: each whole round adds what it takes."""
    within = wrap_signed(bearing)
    rounds = floor((bearing - within) / TWO_PI + 0.5)
    return round_time(table, way, within) + rounds * float(table[way, _ROUND])


@njit(cache=True, nogil=True)
def round_bound(table: FloatArray, way: int, cell: Cell, other: Cell) -> float:
    """The least time from any bearing of one cell to any of another, outside the disc.

    Args:
        table: of `times_round`.
        way: 0 counter-clockwise round the leader, 1 clockwise.
        cell: its bearing in [−π, π].
        other: its bearing in [−π, π].
    """
    sign = 1.0 - 2.0 * way
    gap = wrap(sign * (other.bearing - cell.bearing)) - cell.half - other.half
    if gap <= 0.0 or gap + 2.0 * (cell.half + other.half) >= TWO_PI:
        return 0.0
    return round_over(table, way, cell.bearing + sign * cell.half, gap)


@njit(cache=True, nogil=True)
def round_over(table: FloatArray, way: int, bearing: float, gap: float) -> float:
    """The least time from a bearing over a gap of (0, 2π), outside the disc.

    Args:
        table: of `times_round`.
        way: 0 counter-clockwise round the leader, 1 clockwise.
        bearing: in [−π, π].
        gap: how far round [rad].
    """
    if gap < _TOUCHING:
        return 0.0  # where rounding might make a whole round of it
    sign = 1.0 - 2.0 * way
    end = wrap_signed(bearing + sign * gap)
    took = sign * (round_time(table, way, end) - round_time(table, way, bearing))
    if sign * (end - bearing) < 0.0:
        took += table[way, _ROUND]
    return float(max(took - ROUND_SLACK * table[way, _ROUND], 0.0))


@njit(cache=True, nogil=True)
def round_most(table: FloatArray, bearing: float, gap: float) -> float:
    """No less than the time counter-clockwise round from a bearing over a gap of [0, 2π)."""
    begin = bearing if bearing >= -pi else bearing + TWO_PI
    end = begin + gap
    whole, past = float(table[0, _ROUND]), end > pi
    took = round_time(table, 0, end - TWO_PI if past else end) - round_time(table, 0, begin)
    return took + (whole if past else 0.0) + ROUND_SLACK * whole
