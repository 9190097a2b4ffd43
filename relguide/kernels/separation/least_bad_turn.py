"""The least bad thing to do where d_min cannot be kept: a turn and a straight, of all sizes.

World frame; lengths in m, times in s, headings clockwise from north.
"""

from math import hypot, inf, pi

import numpy as np
from numba import njit

from relguide.kernels.base.angles import TWO_PI
from relguide.kernels.base.motion import advance
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.separation.approach import least_separation

_TURNS = 120  # sizes of the turn tried each way: every 3°
_WAYS = 18  # … and of a way out: every 10°, finer than a crew would be told
_SAME = 1.0  # separations nearer than this are one, and found to this [m]
_STEP = 0.5  # s; separations change by V_P + V_L in a second, so times are right to half of one


@njit(cache=True, nogil=True)
def soonest_apart(
    pursuer: FloatArray, rate: float, leader: FloatArray, leader_pieces: FloatArray, limit: float,
    horizon: float,
) -> tuple[float, float]:  # fmt: skip
    """The turn after which, going straight, the separation reaches the limit soonest.

    Args:
        pursuer: x, y, ψ, V at t = 0. shape (4,)
        rate: |r| of a full turn [rad/s].
        leader: as `pursuer`.
        leader_pieces: duration and turn rate of each of its pieces. shape (n, 2)
        limit: d_min [m].
        horizon: how far ahead to look [s].

    Returns:
        signed turn angle [rad], positive to the right, and when [s]; infinite if it never is.
    """
    best, best_angle = inf, 0.0
    for k in range(2 * _TURNS + 1):
        angle = TWO_PI * (k - _TURNS) / _TURNS
        turning = abs(angle) / rate
        px, py, psi = pursuer[0], pursuer[1], pursuer[2]
        lx, ly, lpsi = leader[0], leader[1], leader[2]
        t, piece, left = 0.0, 0, leader_pieces[0, 0] if len(leader_pieces) > 0 else inf
        while t < min(best, horizon):
            r = 0.0
            if t < turning:
                r = rate if angle > 0.0 else -rate
            lr = leader_pieces[piece, 1] if piece < len(leader_pieces) else 0.0
            step = min(_STEP, left)
            if t < turning:
                step = min(step, turning - t)
            px, py, psi = advance(px, py, psi, pursuer[3], r, step)
            lx, ly, lpsi = advance(lx, ly, lpsi, leader[3], lr, step)
            t += step
            left -= step
            if left <= 0.0:
                piece += 1
                left = leader_pieces[piece, 0] if piece < len(leader_pieces) else inf
            if hypot(px - lx, py - ly) >= limit:
                if t < best:
                    best, best_angle = t, angle
                break
    return best_angle, best


@njit(cache=True, nogil=True)
def widest_miss(
    pursuer: FloatArray, rate: float, leader: FloatArray, leader_pieces: FloatArray, horizon: float
) -> tuple[float, float, float]:
    """The turn after which, going straight, the least separation is largest.

    Often it is least at once, whatever is turned later: of turns that are worth the same the
    smallest is given.

    Returns:
        signed turn angle [rad], positive to the right; that least separation [m]; when [s].
    """
    best, best_angle, best_at = -inf, 0.0, 0.0
    pieces = np.empty((1, 2))
    for k in range(2 * _TURNS + 1):
        # none, then to the right and to the left by more and more
        angle = TWO_PI * ((k + 1) // 2) / _TURNS * (1.0 if k % 2 == 1 else -1.0)
        pieces[0, 0] = abs(angle) / rate
        pieces[0, 1] = rate if angle > 0.0 else -rate
        least, at, _ = least_separation(pursuer, pieces, leader, leader_pieces, horizon, _SAME)
        if least > best + _SAME:
            best, best_angle, best_at = least, angle, at
    return best_angle, best, best_at


@njit(cache=True, nogil=True)
def escape_path(
    pursuer: FloatArray, rate: float, before: FloatArray, leader: FloatArray,
    leaders_pieces: FloatArray, limit: float, horizon: float,
) -> tuple[int, float, float]:  # fmt: skip
    """The smallest turn after which, going straight, a limit is kept whatever the leader does.

    Args:
        pursuer: x, y, ψ, V at t = 0. shape (4,)
        rate: |r| of a full turn [rad/s].
        before: how it goes on until it turns left, flies straight or turns right, a row each:
            duration [s] and turn rate [rad/s]. shape (3, 2)
        leader: as `pursuer`.
        leaders_pieces: duration and turn rate of each of its pieces, for all that it may do; where
            there are fewer pieces the last have a duration of 0. shape (k, n, 2)
        limit: what is to be kept [m].
        horizon: how far ahead to look [s].

    Returns:
        the side, −1 left, 0 straight, +1 right; the turn angle [rad], ≥ 0; the least separation
        [m]. If no turn keeps the limit, those of the one whose least separation is largest.
    """
    best, best_side, best_angle = -1.0, 0, 0.0
    pieces = np.empty((2, 2))
    for k in range(_WAYS + 1):
        angle = pi * k / _WAYS
        for side in (-1, 1) if k > 0 else (0, 0):
            pieces[0] = before[side + 1]
            pieces[1, 0], pieces[1, 1] = angle / rate, side * rate
            kept = inf
            for i in range(len(leaders_pieces)):
                least, _, _ = least_separation(
                    pursuer, pieces, leader, leaders_pieces[i], horizon, _SAME
                )
                kept = min(kept, least)
                if kept <= best:
                    break
            if kept > best:
                best, best_side, best_angle = kept, side, angle
            if best >= limit:
                return best_side, best_angle, best
    return best_side, best_angle, best
