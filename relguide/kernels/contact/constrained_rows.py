"""Exact answers where the limit binds, for many situations behind a leader that keeps straight.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise; the leader is at (D/R, 0) at
t = 0 and keeps heading 0.
"""

from math import inf

import numpy as np
from numba import njit

from relguide.kernels.base.records import Pose, Scene, straight_scene, with_limit
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.chain import MAX_LEGS, WORD
from relguide.kernels.contact.clear_words import word_clears
from relguide.kernels.contact.constrained_search import best_constrained_path
from relguide.kernels.contact.contact import GRAZE
from relguide.kernels.contact.tangent import tangents
from relguide.kernels.words.extremals import MAX_ROWS, solve
from relguide.kernels.words.fastest import fastest
from relguide.kernels.words.sooner import make_scratch


@njit(cache=True, nogil=True)
def breaks_limit(pose: Pose, scene: Scene, free: FloatArray) -> bool:
    """Whether the fastest path without the limit breaks it, and what that path is.

    Args:
        pose: the pursuer's, seen from the slot; its heading in [0, 2π).
        scene: a leader that keeps straight, and d_min.
        free: takes the path, a row of `solve`; nothing where the slot is out of reach. shape (5,)
    """
    if not fastest(pose, scene.alpha, 0.0, 0, make_scratch(), free):
        return False
    return not word_clears(pose, 0.0, free, scene)


@njit(cache=True, nogil=True)
def limit_binds(x: float, y: float, h: float, alpha: float, slot: float, d_min: float) -> bool:
    """Whether the fastest path without the limit breaks it.

    Args:
        x: pursuer ahead of the slot [R].
        y: and left of it [R].
        h: its heading [rad], in [0, 2π).
        alpha: V_L/V_P.
        slot: the leader ahead of the slot [R].
        d_min: the limit [R].
    """
    return breaks_limit(Pose(x, y, h), straight_scene(alpha, slot, d_min), np.empty(5))


@njit(cache=True, nogil=True)
def limit_binds_rows(situations: FloatArray, binds: FloatArray) -> None:
    """`limit_binds` of many.

    Args:
        situations: x, y, h in [0, 2π), α, D/R, d_min/R. shape (n, 6)
        binds: takes 1 where it does, 0 where it does not. shape (n,)
    """
    for n in range(len(situations)):
        x, y, h, alpha, slot, d_min = situations[n]
        binds[n] = limit_binds(x, y, h, alpha, slot, d_min)


@njit(cache=True, nogil=True)
def solve_constrained_rows(
    situations: FloatArray, bearings: int, longest: float, times: FloatArray, counts: FloatArray,
    legs: FloatArray,
) -> None:  # fmt: skip
    """The fastest path that keeps the limit, as `plan` searches it.

    Args:
        situations: as in `limit_binds_rows`. shape (n, 6)
        bearings: how finely the disc is scanned.
        longest: paths that take longer do not count [R/V_P].
        times: takes the time without the limit, that of the fastest extremal that keeps it, and
            that of the fastest path; infinite where there is none [R/V_P]. shape (n, 3)
        counts: takes how many legs the path has; 0 where there is none. shape (n,)
        legs: takes them, as `chain.Chain`. shape (n, MAX_LEGS, 6)
    """
    rows = np.empty((MAX_ROWS, 5))
    for n in range(len(situations)):
        x, y, h, alpha, slot, d_min = situations[n]
        pose, scene = Pose(x, y, h), straight_scene(alpha, slot, d_min)
        eased = with_limit(scene, d_min - GRAZE)
        found = solve(pose, alpha, 0.0, rows)
        times[n, 0] = rows[0, 0] if found > 0 else inf
        times[n, 1] = inf
        counts[n] = 0.0
        for k in range(found):
            if rows[k, 0] <= longest and word_clears(pose, 0.0, rows[k], eased):
                times[n, 1] = rows[k, 0]
                legs[n, 0, 0] = WORD
                legs[n, 0, 1:6] = rows[k]
                counts[n] = 1.0
                break
        around = np.zeros((MAX_LEGS, 6))
        time, count = best_constrained_path(
            pose, scene, bearings, tangents(pose, scene), min(times[n, 1], longest), around
        )
        times[n, 2] = times[n, 1]
        if count > 0:
            times[n, 2] = time
            counts[n] = count
            legs[n] = around
