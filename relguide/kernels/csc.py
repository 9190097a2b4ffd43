"""Turn, straight, turn to a moving slot: all of LSL and LSR. RSR and RSL are their mirror images.

Slot frame: start (x, y, h), slot at (ατ, 0) with heading 0, path length = τ. Angles count
counter-clockwise; c₁ = (x − sin h, y + cos h) is the centre of the first left turn.

LSL. The end circle's centre is (ατ, 1). The turns add up to A = −h (mod 2π), once or twice round.
With e = αA − c₁ₓ, Δ = 1 − c₁ᵧ and the straight l = τ − A,

    l² = (αl + e)² + Δ²      ⇔      (1 − α²) l² − 2αe l − (e² + Δ²) = 0.

LSR. The end circle's centre is (ατ, −1); Δ = −1 − c₁ᵧ. Let β be the course of the straight and
X = ατ − c₁ₓ. That the straight touches both circles, and that it is as long as what τ leaves, is

    X sin β = Δ cos β + 2,      l = X cos β + Δ sin β,      τ = A(β) + l,    A = 2β − h + 2πk.

X(1 − α cos β) = α(A + Δ sin β) − c₁ₓ makes the first one equation in β, in the form of `roots`:

    (αA − c₁ₓ) sin β + (2α − Δ) cos β + (αΔ − 2) = 0.

Its slope over cos β is Δ tan β + 2αβ + const, monotone between the poles of tan and the points with
cos²β = −Δ/2α: those are the cuts.
"""

from math import acos, atan2, cos, pi, sin, sqrt

import numpy as np
from numba import njit

from relguide.kernels.angles import TWO_PI, turn_to
from relguide.kernels.roots import MAX_CUTS, FloatArray, all_roots, insert_cut


@njit(cache=True, nogil=True)
def lsl(x: float, y: float, h: float, alpha: float, out: FloatArray, n: int) -> int:
    """All LSL paths to the slot.

    Args:
        x: start [R].
        y: start [R].
        h: start heading [rad], in [0, 2π).
        alpha: V_L/V_P, ≥ 0.
        out: rows (τ, first turn, straight, last turn) from row n on. shape (·, ≥ 4)
        n: rows filled so far.

    Returns:
        rows filled now.
    """
    cx, delta = x - sin(h), 1.0 - (y + cos(h))
    one_less = 1.0 - alpha * alpha
    around = (TWO_PI - h) % TWO_PI
    for k in range(2):
        turned = around + TWO_PI * k
        e = alpha * turned - cx
        discriminant = e * e + one_less * delta * delta
        if discriminant < 0.0:
            continue
        b = alpha * e
        q = b + sqrt(discriminant) if b >= 0.0 else b - sqrt(discriminant)
        for root in range(2):
            # the two roots in the form that loses no digits; α = 1 leaves only the second
            if root == 0:
                if one_less == 0.0:
                    continue
                straight = q / one_less
            elif q == 0.0:
                if root == 1 and one_less != 0.0:
                    continue
                straight = 0.0
            else:
                straight = -(e * e + delta * delta) / q
            if straight < 0.0:
                continue
            course = atan2(delta, alpha * straight + e)
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
def lsr(x: float, y: float, h: float, alpha: float, out: FloatArray, n: int) -> int:
    """All LSR paths to the slot. Arguments and result as `lsl`."""
    cx, delta = x - sin(h), -1.0 - (y + cos(h))
    k = np.empty(6)
    cuts = np.empty(MAX_CUTS)
    roots = np.empty(2 * MAX_CUTS)
    k[0] = 0.0
    k[1] = 0.0
    k[2] = alpha * delta - 2.0
    k[3] = 2.0 * alpha
    k[5] = 2.0 * alpha - delta
    for piece in range(2):
        # below h the first turn goes once more round
        low, high, around = (0.0, h, TWO_PI - h) if piece == 0 else (h, TWO_PI, -h)
        if high - low < 1e-12:
            continue
        k[4] = alpha * around - cx
        cuts[0] = low
        cuts[1] = high
        n_cuts = insert_cut(cuts, 2, 0.5 * pi)
        n_cuts = insert_cut(cuts, n_cuts, 1.5 * pi)
        if -2.0 * alpha < delta < 0.0:
            crest = acos(sqrt(-delta / (2.0 * alpha)))
            n_cuts = insert_cut(cuts, n_cuts, crest)
            n_cuts = insert_cut(cuts, n_cuts, pi - crest)
            n_cuts = insert_cut(cuts, n_cuts, pi + crest)
            n_cuts = insert_cut(cuts, n_cuts, TWO_PI - crest)
        n_roots = all_roots(k, cuts, n_cuts, roots)
        for i in range(n_roots):
            course = roots[i]
            gain = 1.0 - alpha * cos(course)
            if abs(gain) < 1e-12:  # the equation was multiplied by this: no path, but its own zero
                continue
            turned = 2.0 * course + around
            reach = (alpha * (turned + delta * sin(course)) - cx) / gain
            straight = reach * cos(course) + delta * sin(course)
            if straight < -1e-9:  # ≈ 1e-5 m at R = 12 km: rounding of a straight of no length
                continue
            out[n, 0] = turned + max(straight, 0.0)
            out[n, 1] = max(course + around, 0.0)
            out[n, 2] = max(straight, 0.0)
            out[n, 3] = course
            n += 1
    return n
