"""Branches: the words, those of three turns split by their middle arc; and a network's features.

A word of three turns has two branches of solutions, with a middle arc below and above π. They begin
to exist together; taken separately, the time of each is smooth.

Slot frame as in `extremals`: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import asin, atan2, cos, hypot, inf, log1p, pi, sin, sqrt

import numpy as np
from numba import njit

from relguide.kernels.base.angles import TWO_PI, wrap
from relguide.kernels.base.records import Pose
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.words.extremals import MAX_ROWS, solve

BRANCHES = ("LSL", "RSR", "LSR", "RSL", "LRL", "LRL long", "RLR", "RLR long")
"""The branches by their number; "long" has a middle arc above π."""
WORD_OF = np.array((0, 1, 2, 3, 4, 4, 5, 5))
"""Number of each branch's word in `extremals`."""
MIRROR_OF = np.array((1, 0, 3, 2, 6, 7, 4, 5))
"""Each branch with left and right exchanged."""
TO_POINT = (0, 1, 2, 3, 5, 7, 4, 6)
"""The branches as they are tried toward a point at rest: the first six may be the shortest path
[Dubins57], one with a middle arc below π never is."""
SIZE = len(BRANCHES)
FEATURES = 34
"""How many numbers `features` gives."""


@njit(cache=True, nogil=True)
def branch_of(row: FloatArray) -> int:
    """The branch of a row (τ, word number, first, middle, last) of `solve`."""
    word = int(row[1])
    if word < 4:
        return word
    return 2 * word - 4 + (1 if row[3] > pi else 0)


@njit(cache=True, nogil=True)
def branch_times(situations: FloatArray, first: int, last: int, times: FloatArray) -> None:
    """The least time of every branch, in situations first … last − 1.

    Args:
        situations: x, y, h, α. shape (n, 4)
        first: from this row on.
        last: up to this row.
        times: takes τ of each branch [R/V_P], infinite where it does not exist. shape (n, SIZE)
    """
    rows = np.empty((MAX_ROWS, 5))
    for n in range(first, last):
        x, y, h, alpha = situations[n]
        times[n] = inf
        for k in range(solve(Pose(x, y, wrap(h)), alpha, 0.0, rows)):
            branch = branch_of(rows[k])
            times[n, branch] = min(times[n, branch], rows[k, 0])


@njit(cache=True, nogil=True)
def needs_mirror(y: float, h: float) -> bool:
    """Whether a situation is replaced by its mirror image, which has y > 0, or y = 0 and h ≤ π."""
    return y < 0.0 or (y == 0.0 and h > pi)


@njit(cache=True, nogil=True)
def direct_time(x: float, y: float, alpha: float) -> float:
    """When a pursuer that need not turn would reach the slot: no path is faster [R/V_P].

        |(αT₀ − x, −y)| = T₀

    Args:
        x: pursuer ahead of the slot [R].
        y: and left of it [R].
        alpha: V_L/V_P, below 1.
    """
    along, r = alpha * x, hypot(x, y)
    root = sqrt(along * along + (1.0 - alpha * alpha) * r * r)
    # of two forms of the root the one that loses no digits
    return r * r / (along + root) if along > 0.0 else (root - along) / (1.0 - alpha * alpha)


@njit(cache=True, nogil=True)
def features(x: float, y: float, h: float, alpha: float, out: FloatArray) -> None:
    """What a network is given: where the slot is, and where simple turns would lead.

    Circles at the slot are taken where they are at T₀ (`direct_time`), except for two turns to the
    same side, where the straight between them is known in closed form (see `csc`).

    Args:
        x: pursuer ahead of the slot [R].
        y: and left of it [R]; not `needs_mirror`.
        h: its heading [rad], in [0, 2π).
        alpha: V_L/V_P, below 1.
        out: takes them. shape (FEATURES,)
    """
    r = hypot(x, y)
    one_less = 1.0 - alpha * alpha
    direct = direct_time(x, y, alpha)
    course = atan2(-y, alpha * direct - x) if direct > 0.0 else 0.0
    out[0] = x / (1.0 + r)
    out[1] = y / (1.0 + r)
    out[2] = log1p(r)
    out[3] = cos(h)
    out[4] = sin(h)
    out[5] = h / TWO_PI
    out[6] = alpha
    out[7] = log1p(direct)
    out[8] = cos(course)
    out[9] = sin(course)
    out[10] = cos(course - h)
    out[11] = sin(course - h)
    for side in range(2):
        # the right turns are the left ones of the mirror image
        sy, sh = (y, h) if side == 0 else (-y, wrap(TWO_PI - h))
        at = 12 + 11 * side
        cx, cy = x - sin(sh), sy + cos(sh)
        turned = wrap(TWO_PI - sh)
        ex, ey = alpha * turned - cx, 1.0 - cy
        b = alpha * ex
        straight = (b + sqrt(b * b + one_less * (ex * ex + ey * ey))) / one_less
        same = atan2(ey, alpha * straight + ex)
        first = wrap(same - sh)
        out[at] = log1p(max(straight, 0.0))
        out[at + 1] = first / TWO_PI
        out[at + 2] = (turned - first) / TWO_PI
        out[at + 3] = cos(same)
        out[at + 4] = sin(same)
        dx, dy = alpha * direct - cx, -1.0 - cy
        d = hypot(dx, dy)
        inner = atan2(dy, dx) + asin(min(1.0, 2.0 / max(d, 1e-12)))
        out[at + 5] = log1p(d)
        out[at + 6] = wrap(inner - sh) / TWO_PI
        out[at + 7] = wrap(inner) / TWO_PI
        out[at + 8] = cos(inner)
        out[at + 9] = sin(inner)
        out[at + 10] = log1p(hypot(dx, dy + 2.0))
