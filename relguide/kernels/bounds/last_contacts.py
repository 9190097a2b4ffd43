"""Which contacts can be the last one where a path has others after its first: asked for many.

Before a small cell of first contacts is looked at together with each cell of last ones, larger
cells that hold it are: of each, the cells of last contacts are kept from which a path may be in
time, halved until they are small beside it. A half of it need only look at these. Often none is
left, and in all of that larger cell a first contact is the only one.
"""

from math import isnan

import numpy as np
from numba import njit

from relguide.kernels.base.clock import time_is_up
from relguide.kernels.bounds.bundles import DEPTH, MOST_LASTS, Search
from relguide.kernels.bounds.contact_tree import IntArray, Problem, halve, is_buried, size_of
from relguide.kernels.bounds.pair_bound import bound_together

_BESIDE = 2.0  # than a cell of first contacts, so much larger those of last ones may remain
_SIZES = 4.0  # after a cell it is asked of one so much larger that holds it
_LARGEST = 0.2  # but of none larger than this [rad]
_BEGIN, _COUNT = 8, 9  # of `Tree.joined`: which of `Lasts.cells` are a first contact's


@njit(cache=True, nogil=True, forceinline=True)
def lasts_of(search: Search, n: int) -> IntArray:
    """Numbers of cells that hold all last contacts after first ones in a cell."""
    joined = search.first.joined
    while n >= 0:
        if not isnan(joined[n, _COUNT]):
            begin = int(joined[n, _BEGIN])
            return search.lasts.cells[begin : begin + int(joined[n, _COUNT])]
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
    while at >= 0 and count < DEPTH and isnan(first.joined[at, _COUNT]):
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
        if is_buried(last, m) or bound_together(search, problem, n, m) >= problem.beat:
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
        search.first.joined[n, _BEGIN], search.first.joined[n, _COUNT] = begin, count + left
    return count + left
