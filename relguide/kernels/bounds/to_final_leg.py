"""How soon a path that goes round from a cell on another leg is on the final leg.

A front goes round the disc from the cell until the leader keeps straight: see `round_turning`. On
the final leg `round_time` says what follows. Slot frame: lengths in R, times in R/V_P, angles
counter-clockwise.
"""

from math import inf

from numba import njit

from relguide.kernels.base.records import Scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.bounds.breach import INSIDE
from relguide.kernels.bounds.cells import Cell
from relguide.kernels.bounds.round_time import round_anywhere
from relguide.kernels.bounds.round_turning import (
    ANY,
    ARRIVED,
    FAST,
    FREE,
    LATE,
    ROUNDING,
    UNKNOWN,
    bearings_of,
    begins,
    follow,
    step_of,
)

_PARTS = 4  # a front keeps its direction for such a part of a step
_CLOSER, _FINER = 2e-3, 16  # and for such a part from cells narrower than this [rad]


@njit(cache=True, nogil=True)
def slides_from(scene: Scene, table: FloatArray, cell: Cell, way: int, latest: float) -> float:
    """How soon a path that starts in a cell on another leg can be anywhere on the final leg.

    It is at a bearing y no sooner than this and sense · `round_time(table, way, y)`, and as long as
    `whole_rounds` take. So the cell and y can each be looked at alone.

    Args:
        scene: the leader and d_min.
        table: of `round_time.times_round`.
        cell: of contacts on another leg.
        way: 0 counter-clockwise round the leader, 1 clockwise.
        latest: arrivals on the final leg from here on do not matter, and come back as infinite.

    Returns:
        `UNKNOWN` if a front leaves the disc.
    """
    if scene.alpha > FAST:
        return UNKNOWN
    step = step_of(scene) / (_FINER if cell.half < _CLOSER else _PARTS)
    sense, (low, high) = 1.0 - 2.0 * way, bearings_of(scene, cell)
    place = begins(cell.start, high if way == 0 else low)
    place, fate = follow(scene, place, sense, step, ANY, inf, latest, FREE, True)
    if fate == ARRIVED:
        return UNKNOWN
    if fate == LATE and place.t < scene.leader[-1, 0]:
        return inf
    # a front that may not slide yet is faster, so it has gained most at last
    since = sense * round_anywhere(table, way, place.bearing - scene.leader[-1, 3])
    # fronts go round inside the edge
    slack = ROUNDING + table[way, -1] * INSIDE / scene.d_min
    return float(place.t - slack - since)
