"""Three turns to a moving slot: all of LRL, both middle arcs. RLR is its mirror image.

Slot frame as in `csc`. Both end circles are left ones, so their centres differ by d = (X, Δ) with
X = ατ − c₁ₓ and Δ = 1 − c₁ᵧ constant. A middle arc of angle m between them means |d| = 4 sin(m/2),
for m below and above π alike, and d points along the mean heading of the middle arc. The turns add
up to τ = 2m − h + 2πk, hence one equation in m, in the form of `roots`:

    (2αm + e)² + Δ² = 8 (1 − cos m),      e = α(2πk − h) − c₁ₓ.

Its second derivative 8(α² − cos m) has its zeros at cos m = α²: those are the cuts.
"""

from math import acos, atan2, cos, sin

import numpy as np
from numba import njit

from relguide.kernels.angles import TWO_PI, turn_to
from relguide.kernels.roots import MAX_CUTS, FloatArray, all_roots, insert_cut


@njit(cache=True, nogil=True)
def lrl(x: float, y: float, h: float, alpha: float, out: FloatArray, n: int) -> int:
    """All LRL paths to the slot; rows (τ, first, middle, last turn). Otherwise as `csc.lsl`."""
    cx, delta = x - sin(h), 1.0 - (y + cos(h))
    if abs(delta) > 4.0:
        return n
    k = np.empty(6)
    cuts = np.empty(MAX_CUTS)
    roots = np.empty(2 * MAX_CUTS)
    k[0] = 4.0 * alpha * alpha
    k[3] = 0.0
    k[4] = 0.0
    k[5] = 8.0
    for loops in range(3):
        around = TWO_PI * loops - h
        e = alpha * around - cx
        # 2αm + e must lie within ±4: outside it no middle circle spans the gap
        low = 0.0 if loops > 0 else h
        high = h if loops == 2 else TWO_PI
        if high - low < 1e-12 or 2.0 * alpha * low + e > 4.0 or 2.0 * alpha * high + e < -4.0:
            continue
        k[1] = 4.0 * alpha * e
        k[2] = e * e + delta * delta - 8.0
        cuts[0] = low
        cuts[1] = high
        n_cuts = 2
        if alpha < 1.0:
            bend = acos(alpha * alpha)
            n_cuts = insert_cut(cuts, n_cuts, bend)
            n_cuts = insert_cut(cuts, n_cuts, TWO_PI - bend)
        n_roots = all_roots(k, cuts, n_cuts, roots)
        for i in range(n_roots):
            middle = roots[i]
            turned = middle + around
            crossing = atan2(delta, 2.0 * alpha * middle + e) + 0.5 * middle
            first, last = turn_to(crossing - h), turn_to(middle - crossing)
            if abs(first + last - turned) < 1e-7:
                out[n, 0] = turned + middle
                out[n, 1] = first
                out[n, 2] = middle
                out[n, 3] = max(turned - first, 0.0)
                n += 1
    return n
