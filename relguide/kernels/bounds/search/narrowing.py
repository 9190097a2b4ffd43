"""Which contacts can be first ones and last ones.

Fronts begin at the soonest of all contacts that can be first ones, and backward in time at the
latest of all that can be last ones (`narrow`). Cells are halved only where they matter for that:
where no front has been before.

A small cell of first contacts would have to be paired with each cell of last ones. Before that,
larger cells that hold it are paired (`ask_lasts`). Each of these keeps the cells of last contacts
from which a path may be in time, halved until they are small beside it; its halves need only pair
with these. Often none is left: then in all of that larger cell a first contact is the only one.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from heapq import heappop, heappush
from math import inf, isnan

import numpy as np
from numba import njit

from relguide.kernels.base.clock import time_is_up
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.bounds.fronts.around import (
    Around,
    is_behind,
    no_fronts,
    soonest_in,
    sweep_from,
    times_of,
)
from relguide.kernels.bounds.fronts.front import FAST
from relguide.kernels.bounds.search.cell_facts import (
    departed,
    is_buried,
    learn,
    leave,
    may_be_last,
    reach,
    reached,
    turned_goal,
    turned_leave,
)
from relguide.kernels.bounds.search.cell_tree import Problem, Tree, cell_at, halve, size_of
from relguide.kernels.bounds.search.nodes import DEPTH, MOST_LASTS, Search, bound_together
from relguide.kernels.bounds.words.contact_bound import otherwise
from relguide.kernels.contact.nodes import IntArray

_BESIDE = 2.0  # than a cell of first contacts, so much larger those of last ones may remain
_SIZES = 4.0  # after a cell it is asked of one so much larger that holds it
_LARGEST = 0.2  # but of none larger than this [rad]
_BEGIN, _COUNT = 8, 9  # of `Tree.facts`: which of `Lasts.cells` are a first contact's
_SMALL_LASTS, _MOST_LASTS = (
    0.02,
    4_000,
)  # cells of last contacts, looked at alone: size [rad], number


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
        problem.start, problem.scene, problem.goal, problem.table, problem.incumbent,
        problem.paired, around, problem.tangents,
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
        if soon + onward >= problem.incumbent:
            return inf
        if turned_goal(tree, problem, n) < problem.incumbent:
            return soon
        straight = otherwise(reached(tree, problem, n))
        return straight if straight + onward < problem.incumbent else inf
    cell = cell_at(tree, n)
    since = max(cell.start, soonest_in(problem.around, problem.scene, cell))
    if since > cell.end:
        return inf
    leaving = leave(tree, problem, n)
    if since + leaving >= problem.incumbent:
        return inf
    passed, latest = departed(tree, problem, n), -inf
    if since + otherwise(passed) < problem.incumbent:
        latest = min(cell.end, problem.incumbent - otherwise(passed))
    # a turn away begins after a first contact
    turned = np.min(problem.around.soonest) + turned_leave(tree, problem, n)
    if max(since + passed.outward, turned) < problem.incumbent:
        latest = max(latest, min(cell.end, problem.incumbent - passed.outward))
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
    pace, horizon = (-1.0, 0.0) if last else (1.0, problem.incumbent)
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


@njit(cache=True, nogil=True, forceinline=True)
def lasts_of(search: Search, n: int) -> IntArray:
    """Numbers of cells that hold all last contacts after first ones in a cell."""
    facts = search.first.facts
    while n >= 0:
        if not isnan(facts[n, _COUNT]):
            begin = int(facts[n, _BEGIN])
            return search.lasts.cells[begin : begin + int(facts[n, _COUNT])]
        n = int(search.first.halves[n, 1])
    return search.roots


@njit(cache=True, nogil=True)
def ask_lasts(search: Search, problem: Problem, n: int, until: float) -> None:
    """Find out which cells may hold last contacts: after larger cells that hold one, and after it.

    Args:
        search: takes what turns out.
        problem: what is asked.
        n: number of the cell of first contacts.
        until: when to end with what is known by then, by `clock.now` [s].
    """
    first, d_min = search.first, problem.scene.d_min
    asked, count = np.empty(DEPTH, np.int64), 0
    size, at = size_of(first, n, d_min), n
    while at >= 0 and count < DEPTH and isnan(first.facts[at, _COUNT]):
        if size <= size_of(first, at, d_min) < _LARGEST:
            asked[count], size = at, _SIZES * size_of(first, at, d_min)
            count += 1
        at = int(first.halves[at, 1])
    while count > 0:
        count -= 1
        if _keep_lasts(search, problem, int(asked[count]), until) == 0:
            break


@njit(cache=True, nogil=True)
def _keep_lasts(search: Search, problem: Problem, n: int, until: float) -> int:
    """Keep the cells that may hold a last contact after a cell of first ones; how many they are."""
    last, lasts, d_min = search.last, search.lasts, problem.scene.d_min
    most = _BESIDE * size_of(search.first, n, d_min)
    known = lasts_of(search, n)
    count, left = len(known), 0
    room = max(count, MOST_LASTS) + 2
    stack, kept = np.empty(room, np.int64), np.empty(room, np.int64)
    stack[:count] = known
    while count > 0 and not time_is_up(until):
        count -= 1
        m = int(stack[count])
        if is_buried(last, m) or bound_together(search, problem, n, m) >= problem.incumbent:
            continue
        half = -1
        if size_of(last, m, d_min) > most and count + left < MOST_LASTS:
            half = halve(last, m, d_min)
        if half >= 0:
            stack[count], stack[count + 1] = half, half + 1
            count += 2
        else:
            kept[left] = m
            left += 1
    begin = int(lasts.size[0])
    end = begin + count + left
    if end <= len(lasts.cells):
        lasts.cells[begin : begin + count] = stack[:count]
        lasts.cells[begin + count : end] = kept[:left]
        lasts.size[0] = end
        search.first.facts[n, _BEGIN], search.first.facts[n, _COUNT] = begin, count + left
    return count + left


@njit(cache=True, nogil=True)
def look_at_lasts(search: Search, problem: Problem, until: float) -> None:
    """Find out where no contact can be a last one, before it is asked with each first one."""
    tree, d_min = search.last, problem.scene.d_min
    cells = np.empty(max(_MOST_LASTS, len(search.roots)), np.int64)
    count = len(search.roots)
    cells[:count] = search.roots
    at = 0
    while at < count and not time_is_up(until):
        n = cells[at]
        at += 1
        if not may_be_last(tree, problem, n) or size_of(tree, n, d_min) < _SMALL_LASTS:
            continue
        half = halve(tree, n, d_min) if count + 2 <= len(cells) else -1
        if half >= 0:
            cells[count], cells[count + 1] = half, half + 1
            count += 2
    for k in range(at):
        learn(tree, cells[at - 1 - k])
    search.size[2] = 1
