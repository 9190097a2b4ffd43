"""Closest approach of two aircraft on arcs and straights: bracketed, with a proved lower bound.

Two straights have it in closed form, eqs. (21)–(24) corrected:

    t_cpa = −(Δp·Δv)/|Δv|²  held to [0, l];   d² = |Δp|² − (Δp·Δv)²/|Δv|² in between.

The paper lays arcs out as straights, which is no bound during a turn. Here, over a window of
half-width w about its middle, the relative motion differs from its tangent there by at most
½ A w², A = V_P|r_P| + V_L|r_L| being the largest relative acceleration. So the closed form for the
tangent, less ½ A w², is a lower bound; windows whose bound is not above the best value seen are
halved. It closes quadratically, and is exact where both fly straight.

Along d = d_min that takes thousands of windows. There the square of the distance is nearly
constant, and another bound is closer: with p, v, a, j the relative motion in the middle and its
derivatives,

    d²(τ) ≥ |p|² + 2 p·v τ + (|v|² + p·a) τ² − |v·a + p·j/3| |τ|³ − (8|v|J + 6A² + 2|p|S) τ⁴/24,

J = V_P r_P² + V_L r_L² and S = V_P|r_P|³ + V_L|r_L|³ being the largest of the next derivatives, |v|
and |p| in the last term at their largest in the window. It closes with w⁴. The larger of the two
bounds counts. The work is bounded too: windows are not halved for less than rounding, and their
number is limited.
"""

from math import inf, sqrt

import numpy as np
from numba import njit

from relguide.kernels.base.motion import Motion, motion_along
from relguide.kernels.base.norm import norm
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.base.sine import sine_and_cosine

ROUNDING = 1e-6
"""Taken off every proved bound for rounding [m]: coordinates of 1e6 m carry 1e-10 m each."""
_SHARE = 1e-14  # of the distance flown, also taken off: some 50 roundings of the coordinates
_MOST_WINDOWS = 131_072  # after these, pending windows keep the bound they have
_DEPTH = 64  # windows pending at once: halving leaves one behind, so this is 2⁻⁶⁴ of a piece


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
    return t, norm(dx + t * dvx, dy + t * dvy)


@njit(cache=True, nogil=True)
def least_by_squares(
    dx: float, dy: float, dvx: float, dvy: float, dax: float, day: float, djx: float, djy: float,
    bend: float, jerk: float, snap: float, half: float,
) -> float:  # fmt: skip
    """Lower bound on the distance in a window, from the relative motion in its middle.

    Args:
        dx: pursuer minus leader in the middle, east [m].
        dy: the same, north [m].
        dvx: rate of dx [m/s].
        dvy: rate of dy [m/s].
        dax: rate of dvx [m/s²].
        day: rate of dvy [m/s²].
        djx: rate of dax [m/s³].
        djy: rate of day [m/s³].
        bend: A, the largest relative acceleration [m/s²].
        jerk: J, the largest relative jerk [m/s³].
        snap: S, its largest rate [m/s⁴].
        half: half the window [s].
    """
    square, slope = dx * dx + dy * dy, 2.0 * (dx * dvx + dy * dvy)
    speed_squared = dvx * dvx + dvy * dvy
    growth = speed_squared + dx * dax + dy * day
    least = square - abs(slope) * half + growth * half * half
    if growth > 0.0 and abs(slope) < 2.0 * growth * half:
        least = square - slope * slope / (4.0 * growth)
    twist = dvx * dax + dvy * day + (dx * djx + dy * djy) / 3.0
    fastest = sqrt(speed_squared) + bend * half
    farthest = sqrt(square) + fastest * half
    rest = (8.0 * fastest * jerk + 6.0 * bend * bend + 2.0 * farthest * snap) / 24.0
    least -= (abs(twist) + rest * half) * half * half * half
    # some twenty roundings of the largest term, which near 0 would count for much
    least -= 4e-15 * (square + abs(slope) * half + abs(growth) * half * half)
    return sqrt(max(least, 0.0))


@njit(cache=True, nogil=True)
def _advance(
    x: float, y: float, s: float, c: float, speed: float, rate: float, t: float
) -> tuple[float, float, float, float]:
    """As `motion.advance`, with sine and cosine in place of the heading: a third of the work."""
    if rate == 0.0:
        return x + speed * t * s, y + speed * t * c, s, c
    half = 0.5 * rate * t
    a, b = sine_and_cosine(half)
    chord = speed * t * (a / half if half != 0.0 else 1.0)
    mean_s, mean_c = s * b + c * a, c * b - s * a
    return x + chord * mean_s, y + chord * mean_c, mean_s * b + mean_c * a, mean_c * b - mean_s * a


@njit(cache=True, nogil=True)
def least_separation(
    pursuer: Motion, leader: Motion, begin: float, horizon: float, tolerance: float
) -> tuple[float, float, float]:
    """Least separation of two aircraft on [begin, horizon], with a proved lower bound on it.

    Args:
        pursuer: how one of them moves.
        leader: and the other.
        begin: from when on [s], ≥ 0.
        horizon: until when [s], ≥ begin.
        tolerance: how far below the least separation found the bound may stay [m], > 0.

    Returns:
        least separation found [m], when [s], proved lower bound [m].
    """
    px, py, ppsi, pv, pursuer_pieces = pursuer
    lx, ly, lpsi, lv, leader_pieces = leader
    best, best_at = norm(px - lx, py - ly) if begin <= 0.0 else inf, 0.0
    proved = best
    reach = abs(px) + abs(py) + abs(lx) + abs(ly) + (pv + lv) * horizon
    rounding = ROUNDING + _SHARE * reach
    looked = 0
    mids = np.empty(_DEPTH)
    halves = np.empty(_DEPTH)
    psin, pcos = sine_and_cosine(ppsi)
    lsin, lcos = sine_and_cosine(lpsi)
    t, i, j = 0.0, 0, 0
    p_left = pursuer_pieces[0, 0] if len(pursuer_pieces) > 0 else inf
    l_left = leader_pieces[0, 0] if len(leader_pieces) > 0 else inf
    while t < horizon:
        p_rate = pursuer_pieces[i, 1] if i < len(pursuer_pieces) else 0.0
        l_rate = leader_pieces[j, 1] if j < len(leader_pieces) else 0.0
        counts = t >= begin
        span = min(p_left, l_left, horizon - t if counts else begin - t)
        bend = pv * abs(p_rate) + lv * abs(l_rate)
        p_squared, l_squared = p_rate * p_rate, l_rate * l_rate
        jerk = pv * p_squared + lv * l_squared
        snap = pv * abs(p_rate) * p_squared + lv * abs(l_rate) * l_squared
        mids[0] = 0.5 * span
        halves[0] = 0.5 * span
        n = 1 if counts else 0
        while n > 0:
            n -= 1
            looked += 1
            mid, half = mids[n], halves[n]
            ax, ay, ps, pc = _advance(px, py, psin, pcos, pv, p_rate, mid)
            bx, by, ls, lc = _advance(lx, ly, lsin, lcos, lv, l_rate, mid)
            ps, pc, ls, lc = pv * ps, pv * pc, lv * ls, lv * lc
            dx, dy, dvx, dvy = ax - bx, ay - by, ps - ls, pc - lc
            tangent_at, tangent = closest_of_straights(dx, dy, dvx, dvy, -half, half)
            bound = tangent - 0.5 * bend * half * half
            if bound < best and bend > 0.0:
                dax, day = p_rate * pc - l_rate * lc, l_rate * ls - p_rate * ps
                djx, djy = l_squared * ls - p_squared * ps, l_squared * lc - p_squared * pc
                by_squares = least_by_squares(
                    dx, dy, dvx, dvy, dax, day, djx, djy, bend, jerk, snap, half
                )
                bound = max(bound, by_squares)
            if bound < best:
                at = mid + tangent_at
                ax, ay, _, _ = _advance(px, py, psin, pcos, pv, p_rate, at)
                bx, by, _, _ = _advance(lx, ly, lsin, lcos, lv, l_rate, at)
                reached = norm(ax - bx, ay - by)
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
        px, py, _, _ = _advance(px, py, psin, pcos, pv, p_rate, span)
        lx, ly, _, _ = _advance(lx, ly, lsin, lcos, lv, l_rate, span)
        # rounding must not add up from piece to piece
        if p_rate != 0.0:
            ppsi += p_rate * span
            psin, pcos = sine_and_cosine(ppsi)
        if l_rate != 0.0:
            lpsi += l_rate * span
            lsin, lcos = sine_and_cosine(lpsi)
        # a sum would miss `begin` by rounding
        t = t + span if counts or t + span < begin else begin
        p_left -= span
        l_left -= span
        while p_left <= 0.0:
            i += 1
            p_left = pursuer_pieces[i, 0] if i < len(pursuer_pieces) else inf
        while l_left <= 0.0:
            j += 1
            l_left = leader_pieces[j, 0] if j < len(leader_pieces) else inf
    last = norm(px - lx, py - ly)
    if last < best:
        best, best_at = last, horizon
    return best, best_at, min(proved, best) - rounding


@njit(cache=True, nogil=True)
def least_on_paths(
    path: FloatArray, leader_path: FloatArray, tolerance: float
) -> tuple[float, float, float]:
    """`least_separation` until the end of the pursuer's path.

    Args:
        path: the pursuer's, as `motion_along` takes it.
        leader_path: the leader's; past its end it goes on straight.
        tolerance: as in `least_separation` [m].
    """
    pursuer, leader = motion_along(path), motion_along(leader_path)
    return least_separation(pursuer, leader, 0.0, pursuer.pieces[:, 0].sum(), tolerance)


@njit(cache=True, nogil=True)
def least_on_paths_within(
    path: FloatArray, other_path: FloatArray, begin: float, end: float, tolerance: float
) -> tuple[float, float, float]:
    """`least_separation` of two paths from one time to another; past their ends both fly straight.

    Args:
        path: the pursuer's, as `motion_along` takes it.
        other_path: the other aircraft's.
        begin: from when on [s].
        end: until when [s].
        tolerance: as in `least_separation` [m].
    """
    return least_separation(motion_along(path), motion_along(other_path), begin, end, tolerance)
