"""Turn, straight, turn to a moving target: all of LSL and LSR. RSR and RSL are their mirror images.

The start is (x, y, h); the target sets out from the origin with velocity a = α (cos κ, sin κ) and
is to be met at τ on heading 0, by a path of length τ. Angles count counter-clockwise. For the slot
itself κ = 0. c₁ = (x − sin h, y + cos h) is the centre of the first left turn.

LSL. The end circle's centre is aτ + (0, 1). The turns add up to A = −h (mod 2π), once or twice
round. With e = aA + (0, 1) − c₁ and the straight l = τ − A,

    l² = |al + e|²      ⇔      (1 − α²) l² − 2(a·e) l − |e|² = 0.

LSR. The end circle's centre is aτ − (0, 1). Let β be the course of the straight and d = aτ − (0, 1)
− c₁ the vector between the centres. The straight touches both circles, and all three pieces
together take τ:

    dₓ sin β − dᵧ cos β = 2,    l = dₓ cos β + dᵧ sin β,    τ = A(β) + l,    A = 2β − h + 2πk.

Turn the axes so that the first lies along a: u = β − κ, and (−c, Δ) is d at τ = 0 there.
Eliminating l and τ leaves one equation in the form of `roots`:

    (αA − c) sin u + (2α − Δ) cos u + (αΔ − 2) = 0.

Its slope over cos u is Δ tan u + 2αu + const, monotone between the poles of tan and the points with
cos²u = −Δ/2α: those are the cuts.

Where a time to beat is known roots are sought only for courses with A before it; and not at all if
even with the least of turns A₀, the change of heading, (τ − A₀)² < |d|² − 4 from A₀ to then.
"""

from math import acos, atan2, inf, pi, sqrt

import numpy as np
from numba import njit

from relguide.kernels.base.angles import TWO_PI, turn_to, wrap
from relguide.kernels.base.norm import norm
from relguide.kernels.base.records import Pose, Velocity
from relguide.kernels.base.roots import MAX_CUTS, FloatArray, all_roots, insert_cut
from relguide.kernels.base.sine import sine_and_cosine

_ROUNDING = 1e-6  # windows are wider by this [R/V_P]


@njit(cache=True, nogil=True)
def lsl(pose: Pose, target: Velocity, beat: float, out: FloatArray, n: int) -> int:
    """All LSL paths to the target that arrive before a time.

    Args:
        pose: the start; its heading in [0, 2π).
        target: how the target moves.
        beat: paths that arrive later may be left out [R/V_P].
        out: rows (τ, first turn, straight, last turn) from row n on. shape (·, ≥ 4)
        n: rows filled so far.

    Returns:
        rows filled now.
    """
    (x, y, h), (ax, ay) = pose, target
    s, c = sine_and_cosine(h)
    cx, cy = x - s, y + c
    one_less = 1.0 - ax * ax - ay * ay
    around = wrap(TWO_PI - h)
    for k in range(2):
        turned = around + TWO_PI * k
        ex, ey = ax * turned - cx, ay * turned + 1.0 - cy
        b = ax * ex + ay * ey
        gap = ex * ex + ey * ey
        discriminant = b * b + one_less * gap
        if discriminant < 0.0:
            continue
        q = b + sqrt(discriminant) if b >= 0.0 else b - sqrt(discriminant)
        for root in range(2):
            # the two roots in the form that loses no digits; α = 1 leaves only the second
            if root == 0:
                if one_less == 0.0:
                    continue
                straight = q / one_less
            elif q == 0.0:
                if one_less != 0.0:
                    continue
                straight = 0.0
            else:
                straight = -gap / q
            if straight < 0.0 or turned + straight > beat + _ROUNDING:
                continue
            course = atan2(ay * straight + ey, ax * straight + ex)
            first, last = turn_to(course - h), turn_to(-course)
            if straight == 0.0:
                first, last = turned, 0.0
            if abs(first + last - turned) < 1e-8:
                out[n, 0] = turned + straight
                out[n, 1] = first
                out[n, 2] = straight
                out[n, 3] = max(turned - first, 0.0)
                n += 1
    return n


@njit(cache=True, nogil=True)
def lsr(pose: Pose, target: Velocity, beat: float, out: FloatArray, n: int) -> int:
    """All LSR paths to the target. Arguments and result as `lsl`."""
    (x, y, h), (ax, ay) = pose, target
    s, c = sine_and_cosine(h)
    east, north = -(x - s), -1.0 - (y + c)
    if beat < inf and not _may_be_before(east, north, h, target, beat + _ROUNDING):
        return n
    alpha, kappa = norm(ax, ay), atan2(ay, ax)
    sin_kappa, cos_kappa = sine_and_cosine(kappa)
    c = -(east * cos_kappa + north * sin_kappa)
    delta = north * cos_kappa - east * sin_kappa
    k = np.empty(6)
    cuts = np.empty(MAX_CUTS)
    roots = np.empty(2 * MAX_CUTS)
    k[0] = 0.0
    k[1] = 0.0
    k[2] = alpha * delta - 2.0
    k[3] = 2.0 * alpha
    k[5] = 2.0 * alpha - delta
    crest = acos(sqrt(-delta / (2.0 * alpha))) if -2.0 * alpha < delta < 0.0 else 0.0
    for piece in range(2):
        # below h the first turn goes once more round
        low, high, around = (0.0, h, TWO_PI - h) if piece == 0 else (h, TWO_PI, -h)
        high = min(high, 0.5 * (beat + _ROUNDING - around))
        if high - low < 1e-12:
            continue
        k[4] = alpha * (around + 2.0 * kappa) - c
        cuts[0] = low - kappa
        cuts[1] = high - kappa
        n_cuts = 2
        # u runs within (−π, 3π]: the cuts repeat every π
        for half_turn in range(-1, 4):
            n_cuts = insert_cut(cuts, n_cuts, (half_turn + 0.5) * pi)
            if crest > 0.0:
                n_cuts = insert_cut(cuts, n_cuts, half_turn * pi + crest)
                n_cuts = insert_cut(cuts, n_cuts, half_turn * pi - crest)
        n_roots = all_roots(k, cuts, n_cuts, roots)
        for i in range(n_roots):
            u = roots[i]
            sin_u, cos_u = sine_and_cosine(u)
            gain = 1.0 - alpha * cos_u
            if abs(gain) < 1e-12:  # the equation was multiplied by this: no path, but its own zero
                continue
            course = u + kappa
            turned = 2.0 * course + around
            reach = (alpha * (turned + delta * sin_u) - c) / gain
            straight = reach * cos_u + delta * sin_u
            if straight < -1e-9:  # ≈ 1e-5 m at R = 12 km: rounding of a straight of no length
                continue
            out[n, 0] = turned + max(straight, 0.0)
            out[n, 1] = max(course + around, 0.0)
            out[n, 2] = max(straight, 0.0)
            out[n, 3] = max(course, 0.0)
            n += 1
    return n


@njit(cache=True, nogil=True)
def _may_be_before(east: float, north: float, h: float, target: Velocity, beat: float) -> bool:
    """Whether an LSR path may arrive by a time.

    Args:
        east: dₓ at τ = 0 [R].
        north: dᵧ at τ = 0 [R].
        h: heading of the start, in [0, 2π) [rad].
        target: how the target moves.
        beat: the time [R/V_P].
    """
    turned = min(h, TWO_PI - h)
    if beat < turned:
        return False
    ax, ay = target
    if ax * ax + ay * ay >= 1.0:
        return True
    # (τ − A₀)² + 4 − |d|² bends upward: below zero at both ends, it is so between them
    at_first = 4.0 - (ax * turned + east) ** 2 - (ay * turned + north) ** 2
    at_last = (beat - turned) ** 2 + 4.0 - (ax * beat + east) ** 2 - (ay * beat + north) ** 2
    return at_first >= -_ROUNDING or at_last >= -_ROUNDING
