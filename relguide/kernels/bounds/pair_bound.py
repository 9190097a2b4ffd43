"""How soon a path can arrive with its first contact in one cell, and its last one in another."""

from math import inf

from numba import njit

from relguide.kernels.bounds.around import soonest_in
from relguide.kernels.bounds.between import round_between, word_between
from relguide.kernels.bounds.bundles import MAX_BUNDLES, TOGETHER, Search
from relguide.kernels.bounds.contact_bound import otherwise
from relguide.kernels.bounds.contact_tree import (
    Problem,
    cell_at,
    departed,
    leave,
    reach,
    reached,
    size_of,
)
from relguide.kernels.bounds.goal import is_track
from relguide.kernels.bounds.joined import (
    apart,
    may_be_last,
    may_go_on_to,
    spare_between,
    turned_goal,
    turned_leave,
)

BESIDE = 0.5
"""A cell of first contacts so large beside one of last ones stands for all in it."""


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
    pair = whole * MAX_BUNDLES + m
    at = pair % TOGETHER
    if search.pairs[at] != pair:
        search.pairs[at], search.together[at] = pair, _pair_bound(search, problem, whole, m)
    return float(search.together[at])


@njit(cache=True, nogil=True)
def _pair_bound(search: Search, problem: Problem, n: int, m: int) -> float:
    """How soon a path can arrive with its first contact in a cell, and another last one."""
    scene, table, beat = problem.scene, problem.table, problem.beat
    if not may_be_last(search.last, problem, m):
        return inf
    soon, leaving = reach(search.first, problem, n)[0], leave(search.last, problem, m)
    cell, other = cell_at(search.first, n), cell_at(search.last, m)
    at_last = max(other.start, soonest_in(problem.around, scene, other))
    first, last = reached(search.first, problem, n), departed(search.last, problem, m)
    straight, passed = otherwise(first), otherwise(last)
    turned, turn_on = turned_goal(search.first, problem, n), turned_leave(search.last, problem, m)
    on = first.outward if turned < beat else inf
    if min(straight, on) + min(passed, turn_on) >= beat:
        return inf
    room = beat - soon - leaving
    between = max(apart(search.first, problem, n, 1.0), apart(search.last, problem, m, -1.0))
    if between < room:
        on_edge = round_between(search.fronts, n, scene, table, cell, other, room)
        between = max(between, on_edge)
    if between < room:
        between = max(between, word_between(scene, cell, other, room, 0.0, 0.0, between))
    if between >= room or soon + between > other.end:
        return inf
    # each contact is passed straight or turning away
    there = max(straight + between, at_last)
    bound = there + passed if there <= other.end else inf
    # for how long they turn away at least: what is not in time does not matter
    after = max(first.turned - min(cell.end, beat - between - leaving), 0.0)
    before = max(last.turned - (beat - max(soon + between, at_last)), 0.0)
    # where a turn passes both, a word leads on from the first or to the last: as from an only one
    if on < inf:
        took = between
        if search.first.spare[n]:
            took = max(took, spare_between(search.first, problem, n, other, room, 0.0, took))
        elif after > 0.0:
            took = max(took, word_between(scene, cell, other, room, after, 0.0, took))
        there = max(on + took, first.turned, at_last)
        if there <= other.end:
            bound = min(bound, max(there + passed, turned))
        if turn_on < inf:
            if before > 0.0 and search.first.spare[n]:
                took = max(took, spare_between(search.first, problem, n, other, room, before, took))
            elif before > 0.0:
                took = max(took, word_between(scene, cell, other, room, 0.0, before, took))
                if cell.side != other.side and after > 0.0:
                    took = max(took, word_between(scene, cell, other, room, after, before, took))
            there = max(on + took, first.turned, at_last)
            if there <= other.end:
                bound = min(bound, max(there + last.outward, on + turn_on, turned))
    if turn_on < inf and straight < inf:
        took = between
        if before > 0.0:
            took = max(took, word_between(scene, cell, other, room, 0.0, before, took))
        there = max(straight + took, at_last)
        if there <= other.end:
            bound = min(bound, max(there + last.outward, straight + turn_on))
    asked = bound < beat and is_track(problem.goal, scene.alpha)
    if asked and not may_go_on_to(search.first, problem, n, other):
        return inf
    return bound
