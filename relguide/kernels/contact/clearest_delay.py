"""The best of the paths that a straight delays until the slot opens: all arrive at that time.

Of equally fast paths that one is best which has the fewest turns, then the largest separation, to
a metre, then the least turning.
"""

from typing import NamedTuple

import numpy as np
from numba import njit

from relguide.kernels.base.records import Pose
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.path_pieces import NO_TURN
from relguide.kernels.separation.approach import least_on_paths
from relguide.kernels.words.delay import DELAY_PIECES, MAX_DELAYS, straight_delays

AS_CLEAR = 1.0
"""Separations this close count as equal [m]."""
IntArray = np.ndarray[tuple[int], np.dtype[np.int64]]


class _Turning(NamedTuple):
    """How much a path turns."""

    turns: int
    """Pieces that turn to one side, one after another, are one."""
    angle: float
    """Of all of them [rad]."""


@njit(cache=True, nogil=True)
def clearest_delay(
    x: float, y: float, h: float, alpha: float, t_release: float, start: FloatArray, radius: float,
    leading: FloatArray, min_separation: float, tolerance: float, chosen: FloatArray,
) -> bool:  # fmt: skip
    """Find the best path of length exactly t_release that keeps the limit.

    Args:
        x: the pursuer ahead of the slot [R].
        y: and left of it [R].
        h: its heading, counter-clockwise from the leader's final one [rad].
        alpha: V_L/V_P.
        t_release: when the slot opens [R/V_P].
        start: the pursuer in the world frame: x, y [m], heading [rad], speed [m/s].
        radius: R [m].
        leading: what the leader flies there, as `motion_along` takes it.
        min_separation: what the proved separation has to keep [m].
        tolerance: as in `least_separation` [m].
        chosen: takes ε, 0 for straights, and turn angles [rad] or lengths [R] of the pieces. shape
            (2, DELAY_PIECES)

    Returns:
        whether there is one.
    """
    paths = np.empty((2, MAX_DELAYS, DELAY_PIECES))
    n = straight_delays(Pose(x, y, h), alpha, t_release, paths)
    order, turns = _order(paths, n)
    found, best_turns, best_least = False, 0, 0.0
    for i in order:
        if found and turns[i] > best_turns:
            break
        path = _along(start, paths[0, i], paths[1, i], radius)
        least, _, bound = least_on_paths(path, leading, tolerance)
        if bound >= min_separation and (not found or least > best_least + AS_CLEAR):
            found, best_turns, best_least = True, turns[i], least
            chosen[0], chosen[1] = paths[0, i], paths[1, i]
    return found


@njit(cache=True, nogil=True)
def _order(paths: FloatArray, n: int) -> tuple[IntArray, IntArray]:
    """The first n paths, fewest turns first, then least turning; and how many turns each has."""
    order, turns, angles = np.empty(n, np.int64), np.empty(n, np.int64), np.empty(n)
    for i in range(n):
        turns[i], angles[i] = _turning(paths[0, i], paths[1, i])
        k = i
        while k > 0 and _comes_later(order[k - 1], i, turns, angles):
            order[k] = order[k - 1]
            k -= 1
        order[k] = i
    return order, turns


@njit(cache=True, nogil=True)
def _comes_later(i: int, j: int, turns: IntArray, angles: FloatArray) -> bool:
    if turns[i] != turns[j]:
        return bool(turns[i] > turns[j])
    return bool(angles[i] > angles[j])


@njit(cache=True, nogil=True)
def _turning(signs: FloatArray, amounts: FloatArray) -> _Turning:
    turns, angle, last = 0, 0.0, 0.0
    for k in range(DELAY_PIECES):
        if amounts[k] <= NO_TURN:
            continue
        if signs[k] != 0.0:
            turns += signs[k] != last
            angle += amounts[k]
        last = signs[k]
    return _Turning(turns, angle)


@njit(cache=True, nogil=True)
def _along(start: FloatArray, signs: FloatArray, amounts: FloatArray, radius: float) -> FloatArray:
    """The path in the world frame, without what is only rounding."""
    path, n = np.empty(4 + 2 * DELAY_PIECES), 4
    path[:4] = start
    for k in range(DELAY_PIECES):
        if amounts[k] > NO_TURN:
            path[n], path[n + 1] = amounts[k] * radius, -signs[k] / radius
            n += 2
    return path[:n]
