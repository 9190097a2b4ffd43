"""How soon paths can arrive that go round the leader from one cell of contacts to another: closely.

The time round the disc is the difference of two times, one for each contact. So `round_from` and
`round_to` look at each contact alone, much more closely than both could be looked at together.
Where bank is not enough to slide a path takes longer (`excess`). The cells keep all of it.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import inf, isnan, log2

import numpy as np
from numba import njit

from relguide.kernels.base.roots import FloatArray
from relguide.kernels.bounds.fronts.around import ROUND_SLACK, round_time
from relguide.kernels.bounds.fronts.cell_fronts import slides_from
from relguide.kernels.bounds.fronts.front import whole_rounds
from relguide.kernels.bounds.hops.hop import final_leg, on_final_leg
from relguide.kernels.bounds.hops.needed_hop import hops_late
from relguide.kernels.bounds.hops.tight_contact import LONGEST, tight_excess
from relguide.kernels.bounds.search.cell_facts import leave, reach
from relguide.kernels.bounds.search.cell_tree import (
    ROUND_FROM,
    ROUND_TO,
    TIGHT_FROM,
    TIGHT_TO,
    Problem,
    Tree,
    cell_at,
    halve,
)
from relguide.kernels.bounds.search.nodes import MAX_NODES, Search

_CLOSELY = 50  # times a cell is halved to find what is least in it
_NARROW = 1e-6  # and how narrow its parts may become: what is left counts for some 1e-5 R/V_P [rad]
_NARROW_ELSEWHERE = 5e-6  # on other legs than the final one, where each takes 0.1 ms [rad]
_MORE, _LONGER = 1.1, 1.05  # than is asked for, is looked for at once
_SHORTER = 1.2  # than that hops must be to be asked for again
_TIMES, _STEEP = 1.5, 200.0
"""A part of a cell is hoped to have so many times its excess, and so much more for half its width
[R/V_P a radian]."""
_HOPS = 1.2e-2  # cells narrower than this are looked at by hops to and from them [rad]
_OPEN = 2_000  # but only in searches that have looked at so many nodes
_HOPS_AFTER = 1_000  # looks it is asked whether paths that hop between two cells are late,
_HOP_LEVEL, _DEEP = 5, 9  # from so many halvings of a radian on; and before that from so many on,
_HOP_LEVELS = 2  # and whenever there are so many more
_MOST_VAIN = 20  # but no longer when so much was in vain,
_DEEPER, _DEEPEST = 13, 21  # or three times as much, or anything, after so many halvings


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
        return slides_from(problem.scene, problem.table, cell, way, problem.incumbent)
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


@njit(cache=True, nogil=True)
def round_trip(search: Search, problem: Problem, n: int, m: int) -> float:
    """How soon paths can arrive that go round from one cell to another, on the final leg."""
    first, last = search.first.cells[n], search.last.cells[m]
    cell, other = cell_at(search.first, n), cell_at(search.last, m)
    closest = inf
    for way in range(2):
        apart = (1.0 - 2.0 * way) * (first[2] - last[2])
        rounds = 1.0 if apart >= first[3] + last[3] else 0.0
        if first[0] < last[0]:
            rounds = whole_rounds(problem.scene, cell, other, way)
        whole = problem.table[way, -1] * (rounds - 2.0 * ROUND_SLACK)
        trip = round_from(search.first, problem, n, way) + whole
        trip += round_to(search.last, problem, m, way)
        closest = min(closest, _with_hops(search, problem, n, m, way, trip))
    return closest


@njit(cache=True, nogil=True)
def is_final(search: Search, problem: Problem, n: int, m: int) -> bool:
    """Whether two cells, and all contacts between theirs, lie on the final leg."""
    final = len(problem.scene.leader) - 1
    return bool(min(search.first.cells[n, 0], search.last.cells[m, 0]) == final)


@njit(cache=True, nogil=True)
def _with_hops(search: Search, problem: Problem, n: int, m: int, way: int, trip: float) -> float:
    """A bound of paths that go round from one cell to another, where no bank is enough to slide."""
    first, last, enough = search.first.cells[n], search.last.cells[m], problem.incumbent - trip
    closely = max(first[3], last[3]) < _HOPS and is_final(search, problem, n, m)
    if enough <= 0.0 or not closely or search.size[1] < _OPEN:
        return trip
    sense, more = 1.0 - 2.0 * way, 0.0
    others = reach(search.first, problem, n)[0] + leave(search.last, problem, m)
    slack = problem.incumbent - others
    if last[1] == sense:
        more = excess(search.last, problem, m, True, enough, slack)
    if first[1] == sense and more < enough:
        # by only one of them, since both may be the same hop
        more = max(more, excess(search.first, problem, n, False, enough, slack))
    return min(trip + more, max(trip, others + min(slack, LONGEST)))


@njit(cache=True, nogil=True)
def hops_late_between(
    search: Search, problem: Problem, n: int, m: int, asked: int
) -> tuple[bool, int]:
    """Whether paths that hop between two cells are late, and when that was last asked."""
    level = _level(max(search.first.cells[n, 3], search.last.cells[m, 3]))
    least = _HOP_LEVEL if search.size[1] >= _HOPS_AFTER else _DEEP
    if level < max(asked + _HOP_LEVELS, least) or not is_final(search, problem, n, m):
        return False, asked
    slack = problem.incumbent - reach(search.first, problem, n)[0] - leave(search.last, problem, m)
    cell, other = on_final_leg(cell_at(search.first, n)), on_final_leg(cell_at(search.last, m))
    most = _MOST_VAIN if level < _DEEPER else 3 * _MOST_VAIN
    if level >= _DEEPEST:
        most = MAX_NODES
    scene = final_leg(problem.scene)
    return hops_late(scene, problem.table, cell, other, slack, search.vain, most), level


@njit(cache=True, nogil=True)
def _level(size: float) -> int:
    """How often a radian is halved to so large a cell."""
    return int(-log2(size))
