"""How soon paths can arrive that go round the leader from one cell of contacts to another.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import inf

from numba import njit

from relguide.kernels.bounds.bundles import Search
from relguide.kernels.bounds.contact_tree import Problem, cell_at, leave, reach
from relguide.kernels.bounds.round_closely import excess, round_from, round_to
from relguide.kernels.bounds.round_time import ROUND_SLACK
from relguide.kernels.bounds.round_turning import whole_rounds
from relguide.kernels.bounds.tight_contact import LONGEST

_HOPS = 1.2e-2  # cells narrower than this are looked at by hops to and from them [rad]
_OPEN = 2_000  # but only in searches that have looked at so many bundles


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
    first, last, enough = search.first.cells[n], search.last.cells[m], problem.beat - trip
    closely = max(first[3], last[3]) < _HOPS and is_final(search, problem, n, m)
    if enough <= 0.0 or not closely or search.size[1] < _OPEN:
        return trip
    sense, more = 1.0 - 2.0 * way, 0.0
    others = reach(search.first, problem, n)[0] + leave(search.last, problem, m)
    room = problem.beat - others
    if last[1] == sense:
        more = excess(search.last, problem, m, True, enough, room)
    if first[1] == sense and more < enough:
        # by only one of them, since both may be the same hop
        more = max(more, excess(search.first, problem, n, False, enough, room))
    return min(trip + more, max(trip, others + min(room, LONGEST)))
