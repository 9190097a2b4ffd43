"""Which contacts can be first ones and last ones, from what is known of each other.

Fronts begin at the soonest of all contacts that can be first ones, and backward in time at the
latest of all that can be last ones. Cells are halved only where they matter for that: where no
front has been before.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from heapq import heappop, heappush
from math import inf

import numpy as np
from numba import njit

from relguide.kernels.base.clock import time_is_up
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.bounds.around import (
    Around,
    is_behind,
    no_fronts,
    soonest_in,
    sweep_from,
    times_of,
)
from relguide.kernels.bounds.contact_bound import otherwise
from relguide.kernels.bounds.contact_tree import (
    IntArray,
    Problem,
    Tree,
    cell_at,
    departed,
    halve,
    leave,
    reach,
    reached,
    size_of,
)
from relguide.kernels.bounds.joined import turned_goal, turned_leave
from relguide.kernels.bounds.round_turning import FAST


@njit(cache=True, nogil=True)
def narrow(
    problem: Problem, first: Tree, last: Tree, firsts: IntArray, lasts: IntArray, size: float,
    until: float,
) -> Around:  # fmt: skip
    """Better times around the leader.

    Args:
        problem: what is asked, with what is known around the leader.
        first: of first contacts.
        last: of last ones.
        firsts: numbers of cells that hold all first contacts.
        lasts: numbers of cells that hold all last ones.
        size: of the cells at which fronts begin [rad].
        until: when to end, with no better times, by `clock.now` [s].
    """
    if problem.scene.alpha > FAST:
        return problem.around
    swept = no_fronts()
    if not _sweep_all(problem, last, lasts, size, True, until, swept):
        return problem.around
    around = Around(problem.around.soonest, -times_of(swept))
    problem = with_around(problem, around)
    swept = no_fronts()
    if not _sweep_all(problem, first, firsts, size, False, until, swept):
        return problem.around
    return Around(times_of(swept), around.latest)


@njit(cache=True, nogil=True)
def with_around(problem: Problem, around: Around) -> Problem:
    """The same question, with better times around the leader."""
    return Problem(
        problem.start, problem.scene, problem.goal, problem.table, problem.beat, problem.paired,
        around, problem.tangents,
    )  # fmt: skip


@njit(cache=True, nogil=True)
def lasts_left(problem: Problem, tree: Tree, roots: IntArray, size: float, most: int) -> IntArray:
    """Numbers of cells that hold all last contacts, no larger than a size.

    The roots are given back if there are more than so many.
    """
    stack, kept = [int(n) for n in roots], np.empty(most, np.int64)
    count = 0
    while len(stack) > 0:
        n = stack.pop()
        if _begins(problem, tree, n, True) == inf:
            continue
        half = -1
        if size_of(tree, n, problem.scene.d_min) > size:
            half = halve(tree, n, problem.scene.d_min)
        if half >= 0:
            stack.append(half)
            stack.append(half + 1)
        elif count == most:
            return roots
        else:
            kept[count] = n
            count += 1
    return kept[:count]


@njit(cache=True, nogil=True)
def _begins(problem: Problem, tree: Tree, n: int, last: bool) -> float:
    """When fronts begin in a cell; infinite if nothing in it can be in time."""
    if not last:
        soon, onward = reach(tree, problem, n)
        if soon + onward >= problem.beat:
            return inf
        if turned_goal(tree, problem, n) < problem.beat:
            return soon
        straight = otherwise(reached(tree, problem, n))
        return straight if straight + onward < problem.beat else inf
    cell = cell_at(tree, n)
    since = max(cell.start, soonest_in(problem.around, problem.scene, cell))
    if since > cell.end:
        return inf
    leaving = leave(tree, problem, n)
    if since + leaving >= problem.beat:
        return inf
    passed, latest = departed(tree, problem, n), -inf
    if since + otherwise(passed) < problem.beat:
        latest = min(cell.end, problem.beat - otherwise(passed))
    # a turn away begins after a first contact
    turned = np.min(problem.around.soonest) + turned_leave(tree, problem, n)
    if max(since + passed.outward, turned) < problem.beat:
        latest = max(latest, min(cell.end, problem.beat - passed.outward))
    return -latest


@njit(cache=True, nogil=True)
def _sweep_all(
    problem: Problem, tree: Tree, roots: IntArray, size: float, last: bool, until: float,
    swept: FloatArray,
) -> bool:  # fmt: skip
    """Let fronts go round from all cells that can be in time, the soonest first.

    Returns:
        whether it ended in time.
    """
    scene = problem.scene
    pace, horizon = (-1.0, 0.0) if last else (1.0, problem.beat)
    heap = [(0.0, -1)]
    heap.pop()
    for n in roots:
        begun = _begins(problem, tree, int(n), last)
        if begun < inf:
            heappush(heap, (begun, int(n)))
    while len(heap) > 0:
        if time_is_up(until):
            return False
        begun, n = heappop(heap)
        cell = cell_at(tree, n)
        if is_behind(swept, scene, cell, begun):
            continue
        half = halve(tree, n, scene.d_min) if size_of(tree, n, scene.d_min) > size else -1
        if half < 0:
            sweep_from(swept, scene, cell, begun, pace, horizon)
            continue
        for k in range(2):
            if is_behind(swept, scene, cell_at(tree, half + k), begun):
                continue
            child = _begins(problem, tree, half + k, last)
            if child < inf:
                heappush(heap, (max(begun, child), half + k))
    return True
