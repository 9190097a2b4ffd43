"""The least time of all paths that touch d = d_min, by halving cells of contacts: branch and bound.

A path has a first contact, and if the way on from it breaks the limit it has another one; the last
of them counts too. A node holds the paths whose first contact lies in one cell and whose last
contact lies in another. The least bound of all nodes is proved at any moment. Slot frame: lengths
in R, times in R/V_P.
"""

from math import inf

import numpy as np
from numba import njit

from relguide.kernels.base.borrowed import borrowed
from relguide.kernels.base.clock import time_is_up
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.bounds.fronts.around import is_last
from relguide.kernels.bounds.fronts.cell_fronts import begin_fronts
from relguide.kernels.bounds.hops.needed_hop import REASONS
from relguide.kernels.bounds.search.cell_facts import (
    is_buried,
    learn,
    leave,
    only_of,
    reach,
    reached,
    turned_goal,
)
from relguide.kernels.bounds.search.cell_tree import (
    Problem,
    cell_at,
    halve,
    learn_gain,
    plant,
    size_of,
)
from relguide.kernels.bounds.search.narrowing import (
    ask_lasts,
    lasts_left,
    lasts_of,
    look_at_lasts,
    narrow,
    with_around,
)
from relguide.kernels.bounds.search.nodes import (
    BESIDE,
    DEPTH,
    MAX_NODES,
    TOGETHER,
    Search,
    begin_lasts,
    bound_together,
    drop_least,
    has_room,
    push,
)
from relguide.kernels.bounds.search.probe import PROBED, Find, probe_node
from relguide.kernels.bounds.search.round_trip import hops_late_between, round_trip
from relguide.kernels.bounds.words.contact_bound import otherwise

SEARCHING, CLOSED, STUCK = 0, 1, 2
"""What a round ends with: there is more to do; no node is left; nothing more can be done."""
_SMALLEST = 1e-10  # a cell no wider than this is not halved: rounding counts for more [rad]
_EASED = 0.03  # cells narrower than this are looked at closely [rad]
_LATER = 1e-10  # less does not tell two times apart [R/V_P]
_ROOTS = 0.1  # size of the cells of last contacts that are left [rad]
_MOST_ROOTS = 256  # if there are more, they are kept larger
_NO_LAST = -1  # of a node whose last contact does not matter
_ONLY = -2  # of a node whose first contact is the last one
_BY_TURN = 0.1  # cells smaller than this are looked at by how contacts are passed [rad]


@njit(cache=True, nogil=True)
def begin(problem: Problem, first: FloatArray, exact: int, last: FloatArray) -> Search:
    """A search that has only begun.

    Args:
        problem: what is asked.
        first: cells that hold every first contact; then such as hold every contact that is come to
            with time to spare. shape (·, 6)
        exact: how many of these are of the first kind.
        last: cells that hold every last one. shape (·, 6)
    """
    search = Search(
        plant(first, MAX_NODES), plant(last, MAX_NODES), np.arange(len(last)),
        np.empty(MAX_NODES), np.empty((MAX_NODES, 4), np.int64), np.zeros(3, np.int64),
        np.zeros(REASONS, np.int64), begin_fronts(), np.full(TOGETHER, -1), np.empty(TOGETHER),
        begin_lasts(len(last)), np.zeros(len(PROBED), np.int64),
    )  # fmt: skip
    search.first.spare[exact : len(first)] = True
    for n in range(len(first)):
        _add(search, problem, n, _NO_LAST, 0.0, 0)
    return search


@njit(cache=True, nogil=True)
def go_on(search: Search, problem: Problem, find: Find, until: float) -> tuple[float, int]:
    """Halve the nodes with the least bounds, and look for paths in small ones.

    Args:
        search: goes on.
        problem: as it began with, or with an earlier `incumbent`.
        find: the fastest path known; takes a faster one.
        until: when to end, by `clock.now` [s].

    Returns:
        the least bound, or `incumbent`, and what it ended with.
    """
    final = len(problem.scene.leader) - 1
    search, problem, find = borrowed(search), borrowed(problem), borrowed(find)
    while search.size[0] > 0:
        bound = search.bounds[0]
        if bound >= problem.incumbent:
            break
        if not has_room(search):
            return bound, STUCK
        if time_is_up(until):
            return bound, SEARCHING
        n, m, eased, asked = search.nodes[0]
        if m >= 0 and is_buried(search.last, m):
            drop_least(search)
            continue
        half = search.first.cells[n, 3]
        if max(half, search.last.cells[m, 3] if m >= 0 else 0.0) < _SMALLEST:
            return bound, STUCK
        search.size[1] += 1
        if eased == 0 and find.best[0] > bound:
            probe_node(search, problem, find, n, m)
        drop_least(search)
        if m == _NO_LAST:
            only = len(lasts_of(search, n)) == 0
            # elsewhere than on the final leg the cells of last contacts are very many
            small = (
                search.first.cells[n, 0] == final
                or size_of(search.first, n, problem.scene.d_min) < problem.paired
            )
            paired = not only and small and _goes_on(search, problem, n)
            if only or paired:
                _add(search, problem, n, _ONLY, bound, 0)
            if only:
                continue
            if paired:
                _pair(search, problem, find, n, bound, until)
                continue
        elif m >= 0 and eased == 0:
            size = max(half, search.last.cells[m, 3])
            if size < _EASED and search.last.cells[m, 0] == final:
                closer = round_trip(search, problem, n, m)
                if closer > bound:
                    if closer < problem.incumbent:
                        push(search, closer, n, m, 1, asked)
                    continue
            late, asked = hops_late_between(search, problem, n, m, asked)
            if late:
                continue
        if not _halve(search, problem, find, n, m, bound, asked, until):
            return bound, STUCK
    return problem.incumbent, CLOSED


@njit(cache=True, nogil=True)
def look_around(
    search: Search, problem: Problem, firsts: int, size: float, until: float
) -> tuple[Search, Problem]:
    """Learn when contacts can be reached and left, and which can be last ones.

    Args:
        search: goes on with what is learned.
        problem: likewise.
        firsts: how many cells of first contacts it began with.
        size: see `narrowing.narrow` [rad].
        until: when to end without having learned anything, by `clock.now` [s].
    """
    first, last, roots = borrowed(search.first), borrowed(search.last), search.roots
    around = narrow(problem, first, last, np.arange(firsts), roots, size, until)
    problem = with_around(problem, around)
    roots = lasts_left(borrowed(problem), last, roots, _ROOTS, _MOST_ROOTS)
    return Search(search.first, search.last, roots, *search[3:]), problem


@njit(cache=True, nogil=True)
def _add(search: Search, problem: Problem, n: int, m: int, least: float, asked: int) -> float:
    """Keep the paths through these cells, known to arrive no sooner than `least`; their bound."""
    soon, onward = reach(search.first, problem, n)
    if soon == inf:
        return inf
    bound = soon + onward
    if m >= 0:
        bound = bound_together(search, problem, n, m)
    elif size_of(search.first, n, problem.scene.d_min) < _BY_TURN and bound < problem.incumbent:
        bound = only_of(search.first, problem, n)
        if m == _NO_LAST and bound > soon + onward:
            first = reached(search.first, problem, n)
            turned = turned_goal(search.first, problem, n)
            bound = min(bound, otherwise(first) + onward, turned)
    elif m == _ONLY:
        bound = soon + max(leave(search.first, problem, n), onward)
    bound = max(bound, least, problem.scene.t_release)
    if bound < problem.incumbent:
        push(search, bound, n, m, 0, asked)
    return bound


@njit(cache=True, nogil=True)
def _halve(
    search: Search, problem: Problem, find: Find, n: int, m: int, bound: float, asked: int,
    until: float,
) -> bool:  # fmt: skip
    """Keep both halves of the larger cell; whether there was room for them."""
    d_min = problem.scene.d_min
    of_last = m >= 0 and size_of(search.last, m, d_min) >= size_of(search.first, n, d_min)
    half = halve(search.last, m, d_min) if of_last else halve(search.first, n, d_min)
    if half < 0:
        return False
    gain = 0.0
    for child in (half, half + 1):
        if of_last or m < 0:
            first, last = (n, child) if of_last else (child, m)
            closer = _add(search, problem, first, last, bound, asked)
            if m < 0:
                # cells of last contacts do not learn: cuts of times part pairs that no path
                # connects anyway, which seems to gain much
                gain += 0.5 * min((closer - bound) / (problem.incumbent - bound), 1.0)
        else:
            _add_pairs(search, problem, find, child, m, bound, asked, until)
    if m < 0:
        learn_gain(search.first, n, gain)
    if of_last:
        learn(search.last, m)
    return True


@njit(cache=True, nogil=True)
def _goes_on(search: Search, problem: Problem, n: int) -> bool:
    """Whether a path may have to touch again after a first contact in a cell."""
    leaves = leave(search.first, problem, n) > reach(search.first, problem, n)[1] + _LATER
    return leaves and not is_last(problem.around, problem.scene, cell_at(search.first, n))


@njit(cache=True, nogil=True)
def _pair(search: Search, problem: Problem, find: Find, n: int, bound: float, until: float) -> None:
    """Keep the paths whose first contact lies in a cell, by the cells of their last ones."""
    if search.size[2] == 0:
        look_at_lasts(search, problem, until)
    if search.first.cells[n, 0] != len(problem.scene.leader) - 1:
        ask_lasts(search, problem, n, until)
    for k in lasts_of(search, n):
        if not is_buried(search.last, k):
            _add_pairs(search, problem, find, n, k, bound, 0, until)


@njit(cache=True, nogil=True)
def _add_pairs(
    search: Search, problem: Problem, find: Find, n: int, m: int, least: float, asked: int,
    until: float,
) -> None:  # fmt: skip
    """As `_add`, of two cells. One of last contacts that is large beside the other is halved first.

    So it is not kept for each of many first contacts beside each other, see `bound_together`.
    """
    if reach(search.first, problem, n)[0] == inf:
        return
    least = max(least, problem.scene.t_release)
    stack, bounds, count = np.empty(DEPTH, np.int64), np.empty(DEPTH), 1
    stack[0], bounds[0] = m, max(bound_together(search, problem, n, m), least)
    while count > 0:
        count -= 1
        m, bound = int(stack[count]), bounds[count]
        if bound >= problem.incumbent or is_buried(search.last, m):
            continue
        half, goes_on = -1, count + 2 <= DEPTH and has_room(search) and not time_is_up(until)
        if goes_on and _is_wide(search, problem, n, m):
            half = halve(search.last, m, problem.scene.d_min)
        if half < 0:
            push(search, bound, n, m, 0, asked)
            continue
        search.size[1] += 1
        if find.best[0] > bound:
            probe_node(search, problem, find, n, m)
        for child in (half, half + 1):
            stack[count] = child
            bounds[count] = max(bound_together(search, problem, n, child), bound)
            count += 1
        learn(search.last, m)


@njit(cache=True, nogil=True)
def _is_wide(search: Search, problem: Problem, n: int, m: int) -> bool:
    """Whether a cell of last contacts is large beside one of first ones, and nothing else is asked.

    Round a leader that keeps straight much else is, of small cells.
    """
    pieces, d_min = len(problem.scene.leader), problem.scene.d_min
    size = size_of(search.last, m, d_min)
    if pieces == 1 or (search.last.cells[m, 0] == pieces - 1 and size < _EASED):
        return False
    return bool(BESIDE * size >= size_of(search.first, n, d_min))
