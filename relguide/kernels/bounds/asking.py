"""When it is asked of a cell of first contacts whether another contact may come next.

To ask that takes about as long as to look at a few pairs of cells, and saves all of a cell's. Of
which cells it is found out differs from leader to leader: so of cells as small as those of which it
mostly was not, it is asked less and less often. See `next_contact`.
"""

from math import log2

from numba import njit

from relguide.kernels.bounds.around import is_last
from relguide.kernels.bounds.bundles import ASKS, Search
from relguide.kernels.bounds.contact_tree import Problem, cell_at, leave, reach, size_of
from relguide.kernels.bounds.joined import asked_next, may_touch_again

_LARGEST = 1.5e-2  # cells of which it is asked [rad]
_AFTER = 1_000  # bundles, in searches that take longer than that
_PIECES, _ASKING = 12, 10  # pieces are followed for each of these at most; asking is worth so many
_TRIED, _WORTH = 8, 3  # cells of a size, and how many for one of which it was found out
_SMALLEST = 1e-10  # a difference that does not count [R/V_P]


@njit(cache=True, nogil=True)
def only_touches(search: Search, problem: Problem, n: int) -> bool:
    """Whether it is found out that nobody in time touches again who touches in a cell first.

    That is asked of small cells that are not on the final leg.
    """
    tree, d_min = search.first, problem.scene.d_min
    if tree.cells[n, 0] == len(problem.scene.leader) - 1:
        return False
    known = asked_next(tree, n)
    if known >= 0:
        return known == 0
    size = size_of(tree, n, d_min)
    if size > _LARGEST or not goes_on(search, problem, n):
        return False
    if search.size[3] > _PIECES * (search.size[1] - _AFTER):
        return False
    tally = search.asks[1 if tree.spare[n] else 0, min(int(-log2(size)), ASKS - 1)]
    if tally[0] >= _TRIED and _WORTH * tally[1] < tally[0]:
        tally[2] += 1
        if 2 * tally[2] < tally[0] * tally[0]:
            return False
        tally[2] = 0
    may, pieces = may_touch_again(tree, problem, n)
    tally[0] += 1
    search.size[3] += pieces + _ASKING
    if may:
        return False
    tally[1] += 1
    return True


@njit(cache=True, nogil=True)
def goes_on(search: Search, problem: Problem, n: int) -> bool:
    """Whether who touches in a cell first may have to touch again."""
    leaves = leave(search.first, problem, n) > reach(search.first, problem, n)[1] + _SMALLEST
    return leaves and not is_last(problem.around, problem.scene, cell_at(search.first, n))
