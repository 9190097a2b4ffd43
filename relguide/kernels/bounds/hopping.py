"""Whether paths between two cells of contacts, which cannot slide all the way, are late.

There are three reasons why they cannot (see `needed_hop`), and each has its own bound. These cost
as much as some twenty looks at a pair of cells, so none is asked for as long as it seldom helps.
Lengths in R, times in R/V_P.
"""

from numba import njit

from relguide.kernels.base.records import Scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.bounds.cells import Cell
from relguide.kernels.bounds.contact_tree import IntArray
from relguide.kernels.bounds.needed_hop import BESIDE, hop_is_late, needs_hop
from relguide.kernels.bounds.past_bearing import passes_late
from relguide.kernels.bounds.round_time import round_bound

REASONS = 3
"""How many reasons there are."""
_CHANGE, _TURN_BACK, _PASS = 0, 1, 2  # sides; to go the other way; beside, where nobody can slide
_VAIN = 2  # what a look in vain counts, where one that helps makes up for 1


@njit(cache=True, nogil=True)
def hops_late(
    scene: Scene, table: FloatArray, cell: Cell, other: Cell, room: float, vain: IntArray,
    most: int,
) -> bool:  # fmt: skip
    """Whether certainly no path leads from any contact of a cell to one of another within a time.

    Args:
        scene: a leader that keeps straight, and d_min.
        table: of `times_round`.
        cell: of contacts.
        other: likewise.
        room: the time [R/V_P].
        vain: how much has been looked for each reason in vain, which changes. shape (REASONS,)
        most: how far that may come.
    """
    changes = cell.side != other.side
    for way in range(2):
        if round_bound(table, way, cell, other) >= room:
            continue
        if not needs_hop(scene, cell, other, way):
            return False
        slides_on = cell.side == 1.0 - 2.0 * way
        reason = _CHANGE if changes else (_PASS if slides_on else _TURN_BACK)
        if vain[reason] >= most:
            return False
        if reason == _PASS:
            late = passes_late(scene, cell, other, way, cell.side * BESIDE, room)
        else:
            late = hop_is_late(scene, table, cell, other, way, room)
        vain[reason] = max(vain[reason] + (-1 if late else _VAIN), 0)
        if not late or changes:
            return late
    return True
