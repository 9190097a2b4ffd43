"""How who slides along the edge of the disc turns, point by point.

So fast, at V_P, that it keeps to the edge, whatever bank that takes: as a front does, see
`round_turning`. Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import acos, cos, sqrt

import numpy as np
from numba import njit

from relguide.kernels.base.records import Scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.base.sine import sine_and_cosine
from relguide.kernels.bounds.round_turning import Place, leader_then
from relguide.kernels.separation.clearance import piece_at, piece_end

STEP = 0.012
"""From one point to the next, or less where the leader begins or ends a turn [R/V_P]."""
AT, BEARING, AHEAD, TURNED, SINE, COSINE = 0, 1, 2, 3, 4, 5
"""Rows of `slide_of`."""
_ROWS = 6
_POINTS = 500  # at most
_SHORTEST = 1e-9  # step [R/V_P]


@njit(cache=True, nogil=True)
def slide_of(
    scene: Scene, place: Place, sense: float, latest: float, furthest: float
) -> FloatArray:
    """A slide along the edge, as long as that does not turn away from the leader.

    Args:
        scene: the leader and d_min.
        place: of a front, where it begins.
        sense: +1 counter-clockwise, −1 clockwise.
        latest: when it ends [R/V_P].
        furthest: its heading is not turned beyond this, as `Hold` counts [rad].

    Returns:
        of each point the time, the bearing as `Place` counts, how far the heading is ahead of that,
        how far it has turned toward the leader, and the sine and the cosine of that, integrated
        over time. shape (6, ·)
    """
    rows, count = np.zeros((_ROWS, _POINTS)), 1
    alpha, d_min = scene.alpha, scene.d_min
    t, bearing = place.t, place.bearing
    heading = leader_then(scene, t).h
    rows[AT, 0], rows[BEARING, 0] = t, bearing
    rows[AHEAD, 0] = acos(alpha * cos(bearing - heading))
    first = sense * bearing + rows[AHEAD, 0]
    while count < _POINTS and t < latest:
        piece = piece_at(scene.leader, t)
        rate = float(scene.leader[piece, 4])
        step = min(STEP, max(piece_end(scene.leader, piece) - t, _SHORTEST))
        b = bearing - heading
        one = _swept(alpha, d_min, sense, b) - rate
        two = _swept(alpha, d_min, sense, b + 0.5 * step * one) - rate
        three = _swept(alpha, d_min, sense, b + 0.5 * step * two) - rate
        four = _swept(alpha, d_min, sense, b + step * three) - rate
        b += step * (one + 2.0 * (two + three) + four) / 6.0
        t += step
        heading += rate * step
        bearing = b + heading
        ahead = acos(alpha * cos(b))
        turned = sense * bearing + ahead - first
        before = rows[:, count - 1]
        if turned < before[TURNED] or first + turned > furthest:
            break
        _put_point(rows[:, count], before, t, bearing, ahead, turned)
        count += 1
    return rows[:, :count]


@njit(cache=True, nogil=True)
def turns_at(rows: FloatArray, i: int) -> float:
    """How fast it turns toward the leader from a point to the next [V_P/R]."""
    return float((rows[TURNED, i + 1] - rows[TURNED, i]) / (rows[AT, i + 1] - rows[AT, i]))


@njit(cache=True, nogil=True)
def _swept(alpha: float, d_min: float, sense: float, bearing: float) -> float:
    """How fast who slides goes round, seen from a leader that keeps straight [V_P/R]."""
    s, c = sine_and_cosine(bearing)
    along = alpha * c
    return (sense * sqrt(1.0 - along * along) + alpha * s) / d_min


@njit(cache=True, nogil=True)
def _put_point(
    row: FloatArray, before: FloatArray, t: float, bearing: float, ahead: float, turned: float
) -> None:
    """Put down a point, with the integrals from the one before."""
    row[AT], row[BEARING], row[AHEAD], row[TURNED] = t, bearing, ahead, turned
    s, c = sine_and_cosine(before[TURNED])
    end_s, end_c = sine_and_cosine(turned)
    # by the trapezoidal rule, with what the slopes at both ends say
    step = t - before[AT]
    slopes = step * (turned - before[TURNED]) / 12.0
    row[SINE] = before[SINE] + 0.5 * step * (s + end_s) + slopes * (c - end_c)
    row[COSINE] = before[COSINE] + 0.5 * step * (c + end_c) - slopes * (s - end_s)
