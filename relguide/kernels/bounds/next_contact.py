"""Which contact can be the next one after a first contact: often none, and then it is the only one.

Who passes a contact where λ_ψ does not vanish (see `junction`) flies one word from there to the
next contact. It begins in the turn that goes on, and is there just when the contact is. So only
contacts on a few curves can be the next one, and often the goal is not reached in time from any of
them.

Of a cell of first contacts it is asked which cells may hold the next one. These are halved until
they are small beside it; its halves need only look at those that are left. The answer takes as long
as hundreds of other looks. So it is asked where halving a cell hardly raises its bound any more,
and of cells of such a size that the answer often is: none. Then it pays to look at larger cells
that hold these, once for all in them.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import inf, isnan
from typing import NamedTuple

import numpy as np
from numba import njit

from relguide.kernels.base.angles import TWO_PI
from relguide.kernels.base.records import Scene, Window
from relguide.kernels.bounds.around import is_last, soonest_in
from relguide.kernels.bounds.between import moved_with, seen_from_end, word_toward
from relguide.kernels.bounds.breach import no_sieve
from relguide.kernels.bounds.cell_words import onward_bound, turned_away
from relguide.kernels.bounds.cells import EDGE, Cell, Poses, level_of, poses_of, taken_later
from relguide.kernels.bounds.contact_tree import (
    IntArray,
    Problem,
    Tree,
    cell_at,
    halve,
    leave,
    reach,
    reached,
    size_of,
)
from relguide.kernels.bounds.joined import apart
from relguide.kernels.bounds.junction import can_touch
from relguide.kernels.bounds.rest import no_rest
from relguide.kernels.bounds.word_bound import is_met_turning

_MOST = 128  # so many cells of next contacts are told from each other; if there are more, larger
_BESIDE = 4.0  # than a cell of first contacts, so much larger those of next ones may remain
_SIZES = 4.0  # of a cell it is asked what was left of one so much larger that holds it
_LARGEST = 0.2  # but of none larger than this [rad]
_DEPTH = 128  # more than halvings of a cell
_ROOM = 1_000_000  # for all that are kept
_LEVELS = 40  # more than the halvings of a radian to the smallest cell that is asked about
_LEVEL, _LOOKS = 6, 1_000  # asked after so many halvings, in a search that has looked so often …
_STAYS = 0.6  # … if this part of what a bound lacks would be left, were the cell halved for ever
_TRIED, _SOME, _WORTH = 8, 32, 2  # first so often, then if one in so many helps, or now and then
_MAY_BE, _ASKED, _HELPED = 0, 1, 2  # columns of `Following.tried`
_BEGIN, _COUNT = 8, 9  # of `Tree.joined`: which of `Following.cells` are a first contact's, …
_ONWARD = 10  # … and how soon at the goal from any contact of a cell of last ones


class Following(NamedTuple):
    """What is known of the contacts after first ones."""

    cells: IntArray
    """Numbers of the cells of last contacts that may hold the next one, those of one cell of first
    contacts after another's … shape (_ROOM,)"""
    size: IntArray
    """… how many they are in all, and how many cells of last contacts hold all that there are.
    shape (2,)"""
    tried: IntArray
    """For cells of a size: of how many it might have been asked, was, and with success.
    shape (_LEVELS, 3)"""


class _Passing(NamedTuple):
    """How the contacts of a cell are passed."""

    cell: Cell
    """The cell."""
    begin: Poses
    """At the contacts."""
    inward: bool
    """Whether they may be passed in a turn toward the leader …"""
    outward: bool
    """… and in a turn away from it …"""
    hand: int
    """… which is to the left, 0, or to the right, 1 …"""
    after: float
    """… and goes on for so long at least [rad]."""
    turned: Poses
    """Then."""
    apart: float
    """For so long there is no other contact [R/V_P]."""


@njit(cache=True, nogil=True)
def begin_following(roots: int) -> Following:
    """Nothing is known, but that the first so many cells of last contacts hold all contacts."""
    size = np.zeros(2, np.int64)
    size[1] = roots
    return Following(np.empty(_ROOM, np.int64), size, np.zeros((_LEVELS, 3), np.int64))


@njit(cache=True, nogil=True)
def is_alone(
    following: Following, first: Tree, last: Tree, problem: Problem, n: int, looks: int
) -> bool:
    """Whether it is known, or turns out, that first contacts in a cell have no other one after.

    Or none from which the goal is reached in time.

    Args:
        following: takes what turns out.
        first: of first contacts, with the cell.
        last: of last contacts, with cells that hold all contacts.
        problem: what is asked.
        n: number of the cell.
        looks: how often the search has looked at bundles.
    """
    # pairs are many before the final leg, and only there
    if first.cells[n, 0] + 1 == len(problem.scene.leader) or not is_passed_turning(
        first, problem, n
    ):
        return False
    if _left_above(following, first, n)[1] == 0:
        return True
    level = min(level_of(size_of(first, n, problem.scene.d_min)), _LEVELS - 1)
    if (
        level < _LEVEL
        or looks < _LOOKS
        or not isnan(first.joined[n, _COUNT])
        or not _stays(first, problem, n)
    ):
        return False
    tried = following.tried[level]
    tried[_MAY_BE] += 1
    helps = 0 < tried[_ASKED] <= _WORTH * tried[_HELPED]
    if tried[_MAY_BE] > _TRIED and tried[_MAY_BE] % _SOME != 0 and not helps:
        return False
    tried[_ASKED] += 1
    if helps:
        _look_above(following, first, last, problem, n)
    alone = ask_next(following, first, last, problem, n)
    tried[_HELPED] += alone
    return alone


@njit(cache=True, nogil=True)
def is_passed_turning(first: Tree, problem: Problem, n: int) -> bool:
    """Whether first contacts in a cell are all passed in a turn in which λ_ψ does not vanish.

    So it is if they have no time to spare before, and no full loop either.
    """
    if first.spare[n]:
        return False
    passed, onward = reached(first, problem, n), reach(first, problem, n)[1]
    return min(passed.tangent, passed.looped) + onward >= problem.beat


@njit(cache=True, nogil=True)
def ask_next(following: Following, first: Tree, last: Tree, problem: Problem, n: int) -> bool:
    """Find out which cells may hold the next contact; whether there are none.

    Arguments as `is_alone`, of a cell before the final leg of which `is_passed_turning` holds.
    """
    return _left_above(following, first, n)[1] == 0 or _look_at(
        following, first, last, problem, n, False
    )


@njit(cache=True, nogil=True)
def _look_above(following: Following, first: Tree, last: Tree, problem: Problem, n: int) -> None:
    """Look closely at larger cells that hold this one, so that it takes less to look at many."""
    d_min = problem.scene.d_min
    larger, count = np.empty(_DEPTH, np.int64), 0
    size, at = _SIZES * size_of(first, n, d_min), int(first.halves[n, 1])
    while at >= 0 and count < _DEPTH and isnan(first.joined[at, _COUNT]):
        if size <= size_of(first, at, d_min) < _LARGEST:
            larger[count], size = at, _SIZES * size_of(first, at, d_min)
            count += 1
        at = int(first.halves[at, 1])
    for k in range(count):
        if _look_at(following, first, last, problem, int(larger[count - 1 - k]), True):
            break


@njit(cache=True, nogil=True)
def _stays(first: Tree, problem: Problem, n: int) -> bool:
    """Whether a cell would stay open however often it is halved, as far as can be told."""
    d_min, above = problem.scene.d_min, n
    size = 2.0 * size_of(first, n, d_min) * (1.0 - EDGE)
    while above >= 0 and size_of(first, above, d_min) < size:
        above = int(first.halves[above, 1])
    if above < 0:
        return False
    soon, onward = reach(first, problem, n)
    soon_above, onward_above = reach(first, problem, above)
    lacks = problem.beat - soon - onward
    lacked = problem.beat - soon_above - onward_above
    return 2.0 * lacks - lacked > _STAYS * lacks


@njit(cache=True, nogil=True)
def _look_at(
    following: Following, first: Tree, last: Tree, problem: Problem, n: int, closely: bool
) -> bool:
    """Keep the cells that may hold the next contact; whether there are none.

    Those that are passed where λ_ψ vanishes do not count. Unless closely, it ends with the first
    small cell that may hold one.
    """
    passing, d_min = _passing_of(first, problem, n), problem.scene.d_min
    most = _BESIDE * size_of(first, n, d_min)
    at, count = _left_above(following, first, n)
    room = max(count, _MOST) + 2
    stack, kept, left = np.empty(room, np.int64), np.empty(room, np.int64), 0
    for k in range(count):
        stack[k] = following.cells[at + k] if at >= 0 else k
    while count > 0:
        m = int(stack[count - 1])
        if not _may_follow(passing, last, problem, m):
            count -= 1
            continue
        half = -1
        if size_of(last, m, d_min) > most and count + left < _MOST:
            half = halve(last, m, d_min)
        if half >= 0:
            stack[count - 1], stack[count] = half, half + 1
            count += 1
        elif closely:
            count -= 1
            kept[left] = m
            left += 1
        else:
            break
    begin = int(following.size[0])
    end = begin + count + left
    if end <= len(following.cells):
        following.cells[begin : begin + count] = stack[:count]
        following.cells[begin + count : end] = kept[:left]
        following.size[0] = end
        first.joined[n, _BEGIN], first.joined[n, _COUNT] = begin, count + left
    return count + left == 0


@njit(cache=True, nogil=True)
def _left_above(following: Following, first: Tree, n: int) -> tuple[int, int]:
    """Where the cells begin that are left of the smallest cell that holds this one, and how many.

    The first is −1 where all cells are left.
    """
    while n >= 0:
        if not isnan(first.joined[n, _COUNT]):
            return int(first.joined[n, _BEGIN]), int(first.joined[n, _COUNT])
        n = int(first.halves[n, 1])
    return -1, int(following.size[1])


@njit(cache=True, nogil=True)
def _passing_of(first: Tree, problem: Problem, n: int) -> _Passing:
    """How the contacts of a cell are passed, if in a turn."""
    cell, passed, beat = cell_at(first, n), reached(first, problem, n), problem.beat
    onward, begin = reach(first, problem, n)[1], poses_of(problem.scene, cell)
    inward = passed.inward + onward < beat
    outward = max(passed.outward + onward, passed.turned) < beat
    after = max(passed.turned - min(cell.end + EDGE, beat - onward), 0.0) if outward else 0.0
    turned = turned_away(begin, cell.side, after)
    hand = 0 if cell.side < 0.0 else 1
    return _Passing(
        cell, begin, inward, outward, hand, after, turned, apart(first, problem, n, 1.0)
    )


@njit(cache=True, nogil=True)
def _may_follow(passing: _Passing, last: Tree, problem: Problem, m: int) -> bool:
    """Whether a contact in a cell may be the next one, and lead to the goal in time."""
    scene, cell, other, beat = problem.scene, passing.cell, cell_at(last, m), problem.beat
    since = max(other.start, soonest_in(problem.around, scene, other))
    latest = min(other.end, beat - _onward_from(last, problem, m))
    least, end = max(since - cell.end - EDGE, passing.apart), latest - cell.start + EDGE
    if least >= end:
        return False
    there = poses_of(scene, other)
    if there.differs == inf:
        return False
    hand, after = passing.hand, passing.after
    if passing.inward and _is_met(passing.begin, there, Window(least, end), 1 - hand, scene):
        return True
    if passing.outward and end > after:
        window = Window(max(least - after, 0.0), end - after)
        if _is_met(passing.turned, there, window, hand, scene):
            return True
    return end > TWO_PI and _is_met_with_loop(passing.begin, there, end - TWO_PI, scene)


@njit(cache=True, nogil=True)
def _is_met(begin: Poses, there: Poses, window: Window, hand: int, scene: Scene) -> bool:
    """Whether a word may be there just then that begins with a turn to that side, or with none."""
    seen, blur, target = seen_from_end(begin, moved_with(there, begin, True))
    return is_met_turning(seen, blur, target, window, no_sieve(scene), hand)


@njit(cache=True, nogil=True)
def _is_met_with_loop(begin: Poses, there: Poses, left: float, scene: Scene) -> bool:
    """Whether a path may be there in time with a full loop, or more: see `looped_bound`.

    Args:
        begin: where it begins.
        there: where it is to be.
        left: time for all of it but one loop [R/V_P].
        scene: the leader and d_min.
    """
    later = taken_later(begin, TWO_PI)
    return word_toward(scene, later, moved_with(there, later, True), left, 0.0) < left


@njit(cache=True, nogil=True)
def _onward_from(last: Tree, problem: Problem, m: int) -> float:
    """How soon at the goal from any contact in a cell that is reached in time [R/V_P]."""
    known, scene, cell = last.joined[m], problem.scene, cell_at(last, m)
    if isnan(known[_ONWARD]):
        known[_ONWARD] = inf
        since = max(cell.start, soonest_in(problem.around, scene, cell))
        if can_touch(scene, cell) and since <= cell.end:
            poses, left = poses_of(scene, cell), problem.beat - since
            if poses.differs < inf:
                known[_ONWARD] = onward_bound(scene, problem.goal, cell, poses, left, no_rest())
    onward = float(known[_ONWARD])
    if onward < inf and is_last(problem.around, scene, cell):
        onward = max(onward, leave(last, problem, m))
    return onward
