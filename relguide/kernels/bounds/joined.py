"""What is known of a contact that is the only one, or has others after it, or before: once each.

The turn goes on through a contact, as λ_ψ does. Where there are other contacts after it, or before,
a turn away from the leader goes on for a while as well: see `junction`. Slot frame: lengths in R,
times in R/V_P, angles counter-clockwise.
"""

from math import inf, isnan

from numba import njit

from relguide.kernels.bounds.after_spare import before_touching
from relguide.kernels.bounds.around import soonest_in
from relguide.kernels.bounds.as_long import can_go_on_to
from relguide.kernels.bounds.between import word_from
from relguide.kernels.bounds.cell_words import turned_after_bound, turned_before_bound
from relguide.kernels.bounds.cells import EDGE, Cell, poses_of
from relguide.kernels.bounds.contact_bound import otherwise
from relguide.kernels.bounds.contact_tree import (
    Problem,
    Tree,
    bury,
    cell_at,
    departed,
    leave,
    reach,
    reached,
    spare_onward,
)
from relguide.kernels.bounds.junction import apart_by

_ONLY, _TURNED, _BEFORE, _APART = 0, 1, 2, 3  # columns of what is known


@njit(cache=True, nogil=True)
def only_of(tree: Tree, problem: Problem, n: int) -> float:
    """How soon a path can be at the goal whose only contact lies in a cell [R/V_P]."""
    if isnan(tree.joined[n, _ONLY]):
        soon, onward = reach(tree, problem, n)
        only = soon + onward
        if tree.spare[n] and only < problem.beat:
            # where that path leads is known already
            only = max(only, soon + spare_onward(tree, problem, n).goal)
        if only < problem.beat:
            leaving = leave(tree, problem, n)
            only = max(only, soon + leaving)
        if only < problem.beat:
            first, last = reached(tree, problem, n), departed(tree, problem, n)
            # a turn goes on as it was
            turned = min(first.inward + last.inward, first.outward + last.outward)
            looped = min(first.looped + leaving, soon + last.looped)
            only = max(only, min(turned, looped, soon + last.tangent))
        tree.joined[n, _ONLY] = only
    return float(tree.joined[n, _ONLY])


@njit(cache=True, nogil=True)
def spare_between(
    tree: Tree, problem: Problem, n: int, other: Cell, beat: float, before: float, enough: float
) -> float:
    """As `between.word_between`, from contacts of a cell that are come to with time to spare."""
    scene, cell = problem.scene, cell_at(tree, n)
    begin, until = before_touching(scene, cell, spare_onward(tree, problem, n).contact)
    on = word_from(scene, begin, cell.piece, other, beat - until, before, enough - until)
    return until + on


@njit(cache=True, nogil=True)
def may_go_on_to(tree: Tree, problem: Problem, n: int, other: Cell) -> bool:
    """Whether any path from a first contact in a cell is at one of another just when it is there.

    See `as_long`.
    """
    scene, cell = problem.scene, cell_at(tree, n)
    if cell.end == inf:
        return True
    if tree.spare[n]:
        begin, _ = before_touching(scene, cell, spare_onward(tree, problem, n).contact)
    else:
        begin = poses_of(scene, cell)
    return can_go_on_to(scene, begin, other)


@njit(cache=True, nogil=True)
def turned_goal(tree: Tree, problem: Problem, n: int) -> float:
    """How soon at the goal, if a first contact in a cell is passed in a turn away from the leader.

    That is when others come after it [R/V_P].
    """
    if isnan(tree.joined[n, _TURNED]):
        soon, onward = reach(tree, problem, n)
        first, beat = reached(tree, problem, n), problem.beat
        goal = inf
        if max(first.turned, first.outward + onward) < beat:
            cell = cell_at(tree, n)
            if tree.spare[n]:
                after = spare_onward(tree, problem, n).again
            else:
                turn = max(first.turned - min(beat - onward, cell.end + EDGE), 0.0)
                after = turned_after_bound(problem.scene, problem.goal, cell, turn, beat - soon)
            goal = max(first.turned, first.outward + max(onward, after))
        tree.joined[n, _TURNED] = goal
    return float(tree.joined[n, _TURNED])


@njit(cache=True, nogil=True)
def turned_leave(tree: Tree, problem: Problem, n: int) -> float:
    """How soon at the goal from the beginning of a turn away from the leader.

    It passes a last contact in a cell that has others before it [R/V_P].
    """
    if isnan(tree.joined[n, _BEFORE]):
        leaving, turned = leave(tree, problem, n), departed(tree, problem, n).turned
        cell, beat = cell_at(tree, n), problem.beat
        if turned < inf and cell.end < inf:
            # the goal is not reached later than in time, nor the contact sooner than this
            since = max(cell.start, soonest_in(problem.around, problem.scene, cell))
            turn, end = max(turned - (beat - since), 0.0), min(cell.end, beat - leaving) + EDGE
            if turned_before_bound(problem.start, problem.scene, cell, turn, end) == inf:
                turned = inf
        tree.joined[n, _BEFORE] = turned
    return float(tree.joined[n, _BEFORE])


@njit(cache=True, nogil=True)
def may_be_last(tree: Tree, problem: Problem, n: int) -> bool:
    """Whether a path in time may have its last contact in a cell; if not, that is put down."""
    leaving, cell, beat = leave(tree, problem, n), cell_at(tree, n), problem.beat
    since = max(cell.start, soonest_in(problem.around, problem.scene, cell))
    may_be = since <= cell.end and since + leaving < beat
    if may_be:
        last = departed(tree, problem, n)
        away = since + last.outward < beat and turned_leave(tree, problem, n) < inf
        may_be = away or since + otherwise(last) < beat
    if not may_be:
        bury(tree, n)
    return may_be


@njit(cache=True, nogil=True, forceinline=True)
def apart(tree: Tree, problem: Problem, n: int, pace: float) -> float:
    """For how long there is no other contact after one in a cell, or with pace −1 before it."""
    column = _APART if pace > 0.0 else _APART + 1
    if isnan(tree.joined[n, column]):
        took = apart_by(problem.scene, cell_at(tree, n), pace)
        if pace > 0.0 and tree.spare[n]:
            took = max(took, spare_onward(tree, problem, n).contact)
        tree.joined[n, column] = took
    return float(tree.joined[n, column])
