"""Whether a path from one contact to another, that goes past a bearing, comes in time: disproved.

Behind a leader that keeps straight. Who goes past a bearing m does so in some pose X: at a distance
ρ ≥ d_min from the leader and on a heading η with which the bearing does not change the other way,

    s (sin(η − m) + α sin m) ≥ 0,    s = +1 counter-clockwise.

From the one contact to X, and from X to the other, it takes no less than the soonest word, whatever
the limit. Where k > 1 (see `junction`) that says much: who passes close by, and neither comes from
inside the disc nor goes there, has to turn away before it, and again after it. The poses X are put
into cells of ρ and η, which are halved.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import inf, pi, sin

import numpy as np
from numba import njit

from relguide.kernels.base.records import Pose, Scene
from relguide.kernels.base.sine import sine_and_cosine
from relguide.kernels.bounds.between import word_toward
from relguide.kernels.bounds.cells import Cell, Poses, poses_of
from relguide.kernels.bounds.hop import standing
from relguide.kernels.bounds.ways import no_ways
from relguide.kernels.separation.clearance import leader_at

_HEADINGS = 8  # cells a whole turn is cut into at first
_MOST = 1_000  # cells are looked at
_STACK = 128
_SMALLEST = 3e-5  # of a cell [R or rad]


@njit(cache=True, nogil=True)
def passes_late(
    scene: Scene, cell: Cell, other: Cell, way: int, bearing: float, beat: float
) -> bool:
    """Whether certainly nobody who goes past a bearing comes from one cell to another in time.

    Args:
        scene: a leader that keeps straight, and d_min.
        cell: of contacts.
        other: likewise.
        way: 0 counter-clockwise round the leader, 1 clockwise.
        bearing: between them.
        beat: the time [R/V_P].
    """
    begin = poses_of(scene, standing(cell.piece, cell.side, cell.bearing, cell.half))
    end = poses_of(scene, standing(other.piece, other.side, other.bearing, other.half))
    if begin.differs == inf or end.differs == inf:
        return False
    there, (s, c) = leader_at(scene, cell.piece, 0.0), sine_and_cosine(bearing)
    # who is further away is late for coming there, or for going on
    reach = 0.25 * (1.0 + scene.alpha) * beat
    stack = np.empty((_STACK, 4))
    count, half = 0, pi / _HEADINGS
    for k in range(_HEADINGS):
        stack[count] = scene.d_min + reach, reach, (2 * k + 1) * half, half
        count += 1
    for _ in range(_MOST):
        if count == 0:
            return True
        count -= 1
        rho, wide, heading, half = stack[count]
        pace = (1.0 - 2.0 * way) * (sin(heading - bearing) + scene.alpha * s)
        if pace + half < 0.0:
            continue
        middle = Pose(there.x + rho * c, there.y + rho * s, heading)
        at = Poses(0.0, 0.0, middle, scene.alpha, 0.0, half, wide + half, wide + half, no_ways())
        took = word_toward(scene, begin, at, beat, 0.0)
        if took >= beat or took + word_toward(scene, at, end, beat - took, 0.0) >= beat:
            continue
        if max(wide, half) < _SMALLEST or count + 2 > _STACK:
            return False
        for k in range(2):
            stack[count] = rho, wide, heading, half
            column = 0 if wide >= half else 2
            stack[count, column + 1] *= 0.5
            stack[count, column] += (2 * k - 1) * stack[count, column + 1]
            count += 1
    return False
