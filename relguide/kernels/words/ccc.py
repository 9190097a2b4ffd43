"""Three turns to a moving target: all of LRL, both middle arcs. RLR is its mirror image.

Frame and target as in `csc`. Both end circles are left ones; the vector between their centres is
d = aτ + (0, 1) − c₁. A middle arc of angle m between them means |d| = 4 sin(m/2), for m below and
above π alike, and d points along the mean heading of the middle arc. The turns add up to
τ = 2m + w, w = 2πk − h, hence one equation in m, in the form of `roots`:

    |a (2m + w) + (0, 1) − c₁|² = 8 (1 − cos m).

Its second derivative 8(α² − cos m) has its zeros at cos m = α²: those are the cuts. As |d| ≤ 4, and
as τ grows with m, roots are sought only where the centres are that near, and in time.
"""

from math import acos, atan2, inf, sqrt

import numpy as np
from numba import njit

from relguide.kernels.base.angles import TWO_PI, turn_to
from relguide.kernels.base.records import Pose, Velocity
from relguide.kernels.base.roots import MAX_CUTS, FloatArray, all_roots, insert_cut
from relguide.kernels.base.sine import sine_and_cosine

_ROUNDING = 1e-6  # windows are wider by this [R/V_P]


@njit(cache=True, nogil=True)
def lrl(pose: Pose, target: Velocity, beat: float, out: FloatArray, n: int) -> int:
    """All LRL paths; rows (τ, first, middle, last turn). Otherwise as `csc.lsl`."""
    (x, y, h), (ax, ay) = pose, target
    s, c = sine_and_cosine(h)
    ex, ey = -(x - s), 1.0 - (y + c)
    alpha_squared = ax * ax + ay * ay
    closing = ax * ex + ay * ey
    # the target never comes within reach of the middle circle
    if ex * ex + ey * ey - closing * closing / max(alpha_squared, 1e-12) > 16.0 + 1e-9:
        return n
    t_from, t_to = -inf, inf
    if beat < inf:
        # the centres come within reach of the middle circle, and part again
        near = alpha_squared * (16.0 - ex * ex - ey * ey) + closing * closing
        half, scale = sqrt(max(near, 0.0)) + _ROUNDING, max(alpha_squared, 1e-12)
        t_from = (-closing - half) / scale - _ROUNDING
        t_to = min((half - closing) / scale, beat) + _ROUNDING
        if t_from > t_to or t_to < 0.0:
            return n
    k = np.empty(6)
    cuts = np.empty(MAX_CUTS)
    roots = np.empty(2 * MAX_CUTS)
    k[0] = 4.0 * alpha_squared
    k[3] = 0.0
    k[4] = 0.0
    k[5] = 8.0
    for loops in range(3):
        around = TWO_PI * loops - h
        low = max(0.0 if loops > 0 else h, 0.5 * (t_from - around))
        high = min(h if loops == 2 else TWO_PI, 0.5 * (t_to - around))
        if high - low < 1e-12:
            continue
        k[1] = 4.0 * (alpha_squared * around + closing)
        k[2] = (alpha_squared * around + 2.0 * closing) * around + ex * ex + ey * ey - 8.0
        cuts[0] = low
        cuts[1] = high
        n_cuts = 2
        if alpha_squared < 1.0:
            bend = acos(alpha_squared)
            n_cuts = insert_cut(cuts, n_cuts, bend)
            n_cuts = insert_cut(cuts, n_cuts, TWO_PI - bend)
        n_roots = all_roots(k, cuts, n_cuts, roots)
        for i in range(n_roots):
            middle = roots[i]
            turned = middle + around
            time = turned + middle
            crossing = atan2(ay * time + ey, ax * time + ex) + 0.5 * middle
            first, last = turn_to(crossing - h), turn_to(middle - crossing)
            if abs(first + last - turned) < 1e-7:
                out[n, 0] = time
                out[n, 1] = first
                out[n, 2] = middle
                out[n, 3] = max(turned - first, 0.0)
                n += 1
    return n
