"""Closest approach of two aircraft on arcs and straights: bracketed, with a proved lower bound.

Two straights have it in closed form, eqs. (21)–(24) corrected:

    t_cpa = −(Δp·Δv)/|Δv|²  held to [0, l];   d² = |Δp|² − (Δp·Δv)²/|Δv|² in between.

The paper lays arcs out as straights; that bounds nothing during a turn. Here, over a window of
half-width w about its middle, the relative motion differs from its tangent there by at most
½ A w², A = V_P|r_P| + V_L|r_L| being the largest relative acceleration. So the closed form for the
tangent, less ½ A w², is a lower bound; windows whose bound is not above the best value seen are
halved. The bound closes quadratically, and it is exact where both fly straight. The work is bounded
too: windows are not halved for less than rounding, and only so many are looked at.
"""

from math import cos, hypot, inf, sin

import numpy as np
from numba import njit

from relguide.kernels.motion import advance
from relguide.kernels.roots import FloatArray

ROUNDING = 1e-6
"""Taken off every proved bound for rounding [m]: coordinates of 1e6 m carry 1e-10 m each."""
_SHARE = 1e-14  # of the way flown, taken off besides: some 50 roundings of its largest coordinate
_MOST_WINDOWS = 131_072  # looked at; what is pending then keeps the bound it has
_DEPTH = (
    64  # windows pending at once; a halved window leaves one behind, so this is 2⁻⁶⁴ of a piece
)


@njit(cache=True, nogil=True)
def closest_of_straights(
    dx: float, dy: float, dvx: float, dvy: float, low: float, high: float
) -> tuple[float, float]:
    """Least distance of two points in uniform straight motion, eqs. (21)–(24).

    Args:
        dx: pursuer minus leader at time 0, east [m].
        dy: the same, north [m].
        dvx: rate of dx [m/s].
        dvy: rate of dy [m/s]; both zero is allowed.
        low: from when [s].
        high: until when [s].

    Returns:
        t_cpa in [low, high] [s], d_cpa [m].

    Paper: as printed, (21) adds m²/s to m and (24) lacks the square on the projection;
        this form follows from d|Δp + tΔv|²/dt = 0.   tests/test_paper.py::test_eq_21
    """
    speed_squared = dvx * dvx + dvy * dvy
    t = 0.0
    if speed_squared > 0.0:
        t = -(dx * dvx + dy * dvy) / speed_squared
    t = min(max(t, low), high)
    return t, hypot(dx + t * dvx, dy + t * dvy)


@njit(cache=True, nogil=True)
def least_separation(
    pursuer: FloatArray, pursuer_pieces: FloatArray, leader: FloatArray, leader_pieces: FloatArray,
    horizon: float, tolerance: float,
) -> tuple[float, float, float]:  # fmt: skip
    """Least separation of two aircraft on [0, horizon], with a proved lower bound on it.

    Args:
        pursuer: x, y [m], ψ [rad], V [m/s] at t = 0. shape (4,)
        pursuer_pieces: duration [s], turn rate [rad/s, right positive] of each. shape (n, 2)
        leader: as `pursuer`.
        leader_pieces: as `pursuer_pieces`; past the last piece both go on straight.
        horizon: until when [s].
        tolerance: how far below the least separation found the bound may stay [m], > 0.

    Returns:
        least separation found [m], when [s], proved lower bound [m].
    """
    px, py, ppsi, pv = pursuer[0], pursuer[1], pursuer[2], pursuer[3]
    lx, ly, lpsi, lv = leader[0], leader[1], leader[2], leader[3]
    best, best_at = hypot(px - lx, py - ly), 0.0
    proved = best
    reach = abs(px) + abs(py) + abs(lx) + abs(ly) + (pv + lv) * horizon
    rounding = ROUNDING + _SHARE * reach
    looked = 0
    mids = np.empty(_DEPTH)
    halves = np.empty(_DEPTH)
    t, i, j = 0.0, 0, 0
    p_left = pursuer_pieces[0, 0] if len(pursuer_pieces) > 0 else inf
    l_left = leader_pieces[0, 0] if len(leader_pieces) > 0 else inf
    while t < horizon:
        p_rate = pursuer_pieces[i, 1] if i < len(pursuer_pieces) else 0.0
        l_rate = leader_pieces[j, 1] if j < len(leader_pieces) else 0.0
        span = min(p_left, l_left, horizon - t)
        bend = pv * abs(p_rate) + lv * abs(l_rate)
        mids[0] = 0.5 * span
        halves[0] = 0.5 * span
        n = 1
        while n > 0:
            n -= 1
            looked += 1
            mid, half = mids[n], halves[n]
            ax, ay, apsi = advance(px, py, ppsi, pv, p_rate, mid)
            bx, by, bpsi = advance(lx, ly, lpsi, lv, l_rate, mid)
            tangent_at, tangent = closest_of_straights(
                ax - bx, ay - by, pv * sin(apsi) - lv * sin(bpsi),
                pv * cos(apsi) - lv * cos(bpsi), -half, half,
            )  # fmt: skip
            bound = tangent - 0.5 * bend * half * half
            if bound < best:
                at = mid + tangent_at
                ax, ay, apsi = advance(px, py, ppsi, pv, p_rate, at)
                bx, by, bpsi = advance(lx, ly, lpsi, lv, l_rate, at)
                reached = hypot(ax - bx, ay - by)
                if reached < best:
                    best, best_at = reached, t + at
            if bound >= best - max(tolerance, rounding) or n + 2 > _DEPTH or looked > _MOST_WINDOWS:
                proved = min(proved, bound)
            else:
                # the nearer half first: it lowers `best` soonest
                near = 0.5 * half if tangent_at >= 0.0 else -0.5 * half
                mids[n], halves[n] = mid - near, 0.5 * half
                mids[n + 1], halves[n + 1] = mid + near, 0.5 * half
                n += 2
        px, py, ppsi = advance(px, py, ppsi, pv, p_rate, span)
        lx, ly, lpsi = advance(lx, ly, lpsi, lv, l_rate, span)
        t += span
        p_left -= span
        l_left -= span
        while p_left <= 0.0:
            i += 1
            p_left = pursuer_pieces[i, 0] if i < len(pursuer_pieces) else inf
        while l_left <= 0.0:
            j += 1
            l_left = leader_pieces[j, 0] if j < len(leader_pieces) else inf
    last = hypot(px - lx, py - ly)
    if last < best:
        best, best_at = last, horizon
    return best, best_at, min(proved, best) - rounding
