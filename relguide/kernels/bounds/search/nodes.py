"""Nodes of branch and bound: paths by the cells of their first contact and of their last one.

A heap holds the nodes, the least bound first. Slot frame: lengths in R, times in R/V_P, angles
counter-clockwise.
"""

from math import inf
from typing import NamedTuple

import numpy as np
from numba import njit

from relguide.kernels.base.roots import FloatArray
from relguide.kernels.bounds.fronts.around import soonest_in
from relguide.kernels.bounds.fronts.cell_fronts import Fronts, round_between
from relguide.kernels.bounds.search.cell_facts import (
    apart,
    departed,
    leave,
    may_be_last,
    may_go_on_to,
    reach,
    reached,
    spare_between,
    turned_goal,
    turned_leave,
)
from relguide.kernels.bounds.search.cell_tree import Problem, Tree, cell_at, size_of
from relguide.kernels.bounds.words.cell_words import word_between
from relguide.kernels.bounds.words.contact_bound import otherwise
from relguide.kernels.bounds.words.sets import is_track
from relguide.kernels.contact.nodes import IntArray

MAX_NODES = 400_000
"""Most nodes kept, and cells; the search ends there."""
TOGETHER = 131_071
"""So many pairs of cells are remembered."""
DEPTH = 128
"""More than halvings of a cell."""
MOST_LASTS = 256
"""So many cells of last contacts are kept of a cell of first ones, or as many as hold all."""
_LASTS = 1_000_000  # so many in all
BESIDE = 0.5
"""A cell of first contacts so large beside one of last ones stands for all in it."""


class Lasts(NamedTuple):
    """Which contacts may be last ones after first ones, see `narrowing`."""

    cells: IntArray
    """Numbers of cells of last contacts, those of one cell of first contacts after another's …
    shape (_LASTS,)"""
    size: IntArray
    """… how many they are in all, and never more of one than this. shape (2,)"""


class Search(NamedTuple):
    """Nodes with paths that may arrive before the incumbent."""

    first: Tree
    """Of first contacts."""
    last: Tree
    """Of last contacts."""
    roots: IntArray
    """Numbers of cells that hold all last contacts. shape (·,)"""
    bounds: FloatArray
    """A heap: no path of a node arrives before this [R/V_P]. shape (MAX_NODES,)"""
    nodes: IntArray
    """Numbers of both cells, 1 where the time round was looked at closely, and the level at which
    it was last asked whether paths hop too late. shape (·, 4)"""
    size: IntArray
    """How many nodes there are, and have been looked at; and whether last contacts have been
    looked at alone. shape (3,)"""
    vain: IntArray
    """Of `needed_hop.hops_late`. shape (REASONS,)"""
    fronts: Fronts
    """From cells of first contacts."""
    pairs: IntArray
    """Which cells were looked at together, as one number … shape (TOGETHER,)"""
    together: FloatArray
    """… and the bound of their paths [R/V_P]. shape (TOGETHER,)"""
    lasts: Lasts
    """Which contacts may be last ones after first ones."""
    probes: IntArray
    """How many nodes have been probed, by their size. shape (·,)"""


@njit(cache=True, nogil=True)
def begin_lasts(roots: int) -> Lasts:
    """Nothing is known, but that so many cells hold all last contacts."""
    size = np.zeros(2, np.int64)
    size[1] = max(roots, MOST_LASTS + 1)
    return Lasts(np.empty(_LASTS, np.int64), size)


@njit(cache=True, nogil=True, forceinline=True)
def has_room(search: Search) -> bool:
    """Whether so many nodes may be added as one look adds."""
    return bool(search.size[0] + 2 * search.lasts.size[1] + DEPTH < MAX_NODES)


@njit(cache=True, nogil=True, forceinline=True)
def push(search: Search, bound: float, n: int, m: int, eased: int, asked: int) -> None:
    """Put a node into the heap."""
    at = int(search.size[0])
    search.size[0] += 1
    while at > 0:
        above = (at - 1) // 2
        if search.bounds[above] <= bound:
            break
        search.bounds[at] = search.bounds[above]
        search.nodes[at] = search.nodes[above]
        at = above
    search.bounds[at] = bound
    node = search.nodes[at]
    node[0], node[1], node[2], node[3] = n, m, eased, asked


@njit(cache=True, nogil=True, forceinline=True)
def drop_least(search: Search) -> None:
    """Take the least node from the heap."""
    bounds, nodes = search.bounds, search.nodes
    search.size[0] -= 1
    count, at = int(search.size[0]), 0
    bound = bounds[count]
    while 2 * at + 1 < count:
        below = 2 * at + 1
        if below + 1 < count and bounds[below + 1] < bounds[below]:
            below += 1
        if bounds[below] >= bound:
            break
        bounds[at] = bounds[below]
        nodes[at] = nodes[below]
        at = below
    bounds[at] = bound
    nodes[at] = nodes[count]


@njit(cache=True, nogil=True, forceinline=True)
def bound_together(search: Search, problem: Problem, n: int, m: int) -> float:
    """As `_pair_bound`, for many cells of first contacts at once where last ones lie further apart.

    That is asked of the largest that holds this one and is small beside the cell of last contacts.
    """
    tree, d_min, whole = search.first, problem.scene.d_min, n
    most = BESIDE * size_of(search.last, m, d_min)
    above = tree.halves[n, 1]
    while above >= 0 and size_of(tree, above, d_min) <= most:
        whole = above
        above = tree.halves[whole, 1]
    if whole == n:
        return _pair_bound(search, problem, n, m)
    pair = whole * MAX_NODES + m
    at = pair % TOGETHER
    if search.pairs[at] != pair:
        search.pairs[at], search.together[at] = pair, _pair_bound(search, problem, whole, m)
    return float(search.together[at])


@njit(cache=True, nogil=True)
def _pair_bound(search: Search, problem: Problem, n: int, m: int) -> float:
    """How soon a path can arrive with its first contact in a cell, and another last one."""
    scene, table, incumbent = problem.scene, problem.table, problem.incumbent
    if not may_be_last(search.last, problem, m):
        return inf
    soon, leaving = reach(search.first, problem, n)[0], leave(search.last, problem, m)
    cell, other = cell_at(search.first, n), cell_at(search.last, m)
    at_last = max(other.start, soonest_in(problem.around, scene, other))
    first, last = reached(search.first, problem, n), departed(search.last, problem, m)
    straight, passed = otherwise(first), otherwise(last)
    turned, turn_on = turned_goal(search.first, problem, n), turned_leave(search.last, problem, m)
    on = first.outward if turned < incumbent else inf
    if min(straight, on) + min(passed, turn_on) >= incumbent:
        return inf
    slack = incumbent - soon - leaving
    between = max(apart(search.first, problem, n, 1.0), apart(search.last, problem, m, -1.0))
    if between < slack:
        on_edge = round_between(search.fronts, n, scene, table, cell, other, slack)
        between = max(between, on_edge)
    if between < slack:
        between = max(between, word_between(scene, cell, other, slack, 0.0, 0.0, between))
    if between >= slack or soon + between > other.end:
        return inf
    # each contact is passed straight or turning away
    there = max(straight + between, at_last)
    bound = there + passed if there <= other.end else inf
    # for how long they turn away at least: what is not in time does not matter
    after = max(first.turned - min(cell.end, incumbent - between - leaving), 0.0)
    before = max(last.turned - (incumbent - max(soon + between, at_last)), 0.0)
    # where a turn passes both, a word leads on from the first or to the last: as from an only one
    if on < inf:
        took = between
        if search.first.spare[n]:
            took = max(took, spare_between(search.first, problem, n, other, slack, 0.0, took))
        elif after > 0.0:
            took = max(took, word_between(scene, cell, other, slack, after, 0.0, took))
        there = max(on + took, first.turned, at_last)
        if there <= other.end:
            bound = min(bound, max(there + passed, turned))
        if turn_on < inf:
            if before > 0.0 and search.first.spare[n]:
                took = max(
                    took, spare_between(search.first, problem, n, other, slack, before, took)
                )
            elif before > 0.0:
                took = max(took, word_between(scene, cell, other, slack, 0.0, before, took))
                if cell.side != other.side and after > 0.0:
                    took = max(took, word_between(scene, cell, other, slack, after, before, took))
            there = max(on + took, first.turned, at_last)
            if there <= other.end:
                bound = min(bound, max(there + last.outward, on + turn_on, turned))
    if turn_on < inf and straight < inf:
        took = between
        if before > 0.0:
            took = max(took, word_between(scene, cell, other, slack, 0.0, before, took))
        there = max(straight + took, at_last)
        if there <= other.end:
            bound = min(bound, max(there + last.outward, straight + turn_on))
    asked = bound < incumbent and is_track(problem.goal, scene.alpha)
    if asked and not may_go_on_to(search.first, problem, n, other):
        return inf
    return bound
