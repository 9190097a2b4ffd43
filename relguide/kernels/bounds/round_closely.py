"""How much later than round the disc paths are that go from one contact to another: each closely.

The time round the disc is the difference of two times, one for each contact. So `round_from` and
`round_to` look at each contact alone, much more closely than both could be looked at together.
Where bank is not enough to slide a path takes longer (`excess`). The cells keep all of it. Slot
frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import inf, isnan

import numpy as np
from numba import njit

from relguide.kernels.base.roots import FloatArray
from relguide.kernels.bounds.contact_tree import (
    ROUND_FROM,
    ROUND_TO,
    TIGHT_FROM,
    TIGHT_TO,
    Problem,
    Tree,
    cell_at,
    halve,
    leave,
    reach,
)
from relguide.kernels.bounds.hop import final_leg, on_final_leg
from relguide.kernels.bounds.round_time import round_time
from relguide.kernels.bounds.tight_contact import LONGEST, tight_excess
from relguide.kernels.bounds.to_final_leg import slides_from

_CLOSELY = 50  # times a cell is halved to find what is least in it
_NARROW = 1e-6  # and how narrow its parts may become: what is left counts for some 1e-5 R/V_P [rad]
_NARROW_ELSEWHERE = 5e-6  # on other legs than the final one, where each takes 0.1 ms [rad]
_MORE, _LONGER = 1.1, 1.05  # than is asked for, is looked for at once
_SHORTER = 1.2  # than that hops must be to be asked for again
_TIMES, _STEEP = 1.5, 200.0
"""A part of a cell is hoped to have so many times its excess, and so much more for half its width
[R/V_P a radian]."""


@njit(cache=True, nogil=True)
def round_from(tree: Tree, problem: Problem, n: int, way: int) -> float:
    """How soon a first contact can be in a cell, less the time round to there, looked at closely.

    Args:
        tree: with the cell.
        problem: what is asked.
        n: number of the cell.
        way: 0 counter-clockwise round the leader, 1 clockwise.
    """
    return _least(tree, problem, n, way, False)


@njit(cache=True, nogil=True)
def round_to(tree: Tree, problem: Problem, n: int, way: int) -> float:
    """How soon the goal can be reached from a last contact in a cell, with the time round to it."""
    return _least(tree, problem, n, way, True)


@njit(cache=True, nogil=True)
def excess(
    tree: Tree, problem: Problem, n: int, last: bool, enough: float, longest: float
) -> float:
    """How much longer than round the disc it takes to a contact of a cell, or on from it.

    Args:
        tree: with the cell.
        problem: what is asked.
        n: number of the cell, on the final leg.
        last: as in `tight_excess`.
        enough: likewise; there may be more.
        longest: likewise.
    """
    column = TIGHT_TO if last else TIGHT_FROM
    kept = tree.known[n, column : column + 3]
    if isnan(kept[0]):
        known = _far_from_enough(tree, n, column, enough, longest)
        if known > 0.0:
            return known
    if not _is_known(kept, enough, longest):
        kept[1], kept[2] = _MORE * enough, _LONGER * longest
        scene, cell = final_leg(problem.scene), on_final_leg(cell_at(tree, n))
        kept[0] = tight_excess(scene, problem.table, cell, last, kept[1], kept[2])
    return float(kept[0])


@njit(cache=True, nogil=True)
def _far_from_enough(tree: Tree, n: int, column: int, enough: float, longest: float) -> float:
    """What `excess` is in a larger cell that holds this one, if there is little hope for more here.

    Args:
        tree: with the cell.
        n: number of the cell.
        column: of what is asked for.
        enough: no more than this is wanted [R/V_P].
        longest: what takes longer does not matter.

    Returns:
        0 if it must be asked for in the cell itself [R/V_P].
    """
    above = n
    while above >= 0 and isnan(tree.known[above, column]):
        above = int(tree.halves[above, 1])
    if above < 0:
        return 0.0
    kept = tree.known[above, column : column + 3]
    if kept[0] >= kept[1] or longest > kept[2]:
        return 0.0
    hoped = _TIMES * kept[0] + _STEEP * tree.cells[above, 3]
    return float(kept[0]) if enough > hoped else 0.0


@njit(cache=True, nogil=True)
def _is_known(kept: FloatArray, enough: float, longest: float) -> bool:
    """Whether what is kept of hops says as much as they would if they were asked about now.

    Args:
        kept: how much longer they take, how much was asked for, and how long they may be.
        enough: no more than this matters.
        longest: how long they may be now.
    """
    if isnan(kept[0]) or longest > kept[2]:
        return False
    return bool(
        kept[0] >= enough or (kept[0] < kept[1] and _SHORTER * longest >= min(kept[2], LONGEST))
    )


@njit(cache=True, nogil=True)
def _with_round(tree: Tree, problem: Problem, n: int, way: int, last: bool) -> float:
    sense, bearing, half = 1.0 - 2.0 * way, tree.cells[n, 2], tree.cells[n, 3]
    if last:
        edge = bearing - sense * half
        return leave(tree, problem, n) + sense * round_time(problem.table, way, edge)
    soon, _ = reach(tree, problem, n)
    if tree.cells[n, 0] + 1 < len(problem.scene.leader):
        cell = cell_at(tree, n)
        if soon == inf or not soon <= cell.end:
            return inf
        return slides_from(problem.scene, problem.table, cell, way, problem.beat)
    return soon - sense * round_time(problem.table, way, bearing + sense * half)


@njit(cache=True, nogil=True)
def _least(tree: Tree, problem: Problem, n: int, way: int, last: bool) -> float:
    """The least that `_with_round` comes to in a cell."""
    column = (ROUND_TO if last else ROUND_FROM) + way
    if not isnan(tree.known[n, column]):
        return float(tree.known[n, column])
    numbers, bounds = np.empty(_CLOSELY + 2, np.int64), np.empty(_CLOSELY + 2)
    elsewhere = not last and tree.cells[n, 0] + 1 < len(problem.scene.leader)
    numbers[0], bounds[0] = n, _with_round(tree, problem, n, way, last)
    count, at = 1, 0
    narrow = _NARROW_ELSEWHERE if elsewhere else _NARROW
    for _ in range(_CLOSELY):
        if bounds[at] == inf or tree.cells[numbers[at], 3] < narrow:
            break
        first = halve(tree, numbers[at], problem.scene.d_min)
        if first < 0:
            break
        parent = bounds[at]
        for k in range(2):
            place = at if k == 0 else count
            numbers[place] = first + k
            bounds[place] = max(parent, _with_round(tree, problem, first + k, way, last))
        count += 1
        at = int(np.argmin(bounds[:count]))
    tree.known[n, column] = bounds[at]
    return float(bounds[at])
