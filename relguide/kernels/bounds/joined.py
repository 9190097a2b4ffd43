"""What is known of contacts that have others after them, or before: each computed once.

Such a contact is passed as `junction` has it: straight, or in a turn away from the leader that goes
on. Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import inf, isnan
from typing import NamedTuple

from numba import njit

from relguide.kernels.bounds.cells import EDGE
from relguide.kernels.bounds.contact_bound import (
    leaving_bound,
    looped_bound,
    looped_leaving_bound,
    soon_bound,
    turned_after_bound,
    turned_before_bound,
)
from relguide.kernels.bounds.contact_tree import Problem, Tree, cell_at, leave, reach
from relguide.kernels.bounds.junction import apart_by, slide_turns
from relguide.kernels.bounds.word_bound import OUTWARD, TANGENT

_FIRST, _LAST, _APART = 0, 3, 5  # columns of what is known


class First(NamedTuple):
    """A first contact with others after it; times are infinite if there is none in time."""

    straight: float
    """How soon it can be passed straight, or with loops, or however it is passed [R/V_P]."""
    turned: float
    """How soon a turn away that passes it is over [R/V_P]."""
    goal: float
    """How soon a path with that turn can be at the goal [R/V_P]."""


class Last(NamedTuple):
    """A last contact with others before it; times are infinite if there is none in time."""

    straight: float
    """How soon the goal can be reached from it, passed as `First.straight` has it [R/V_P]."""
    turned: float
    """How soon from the beginning of a turn away that passes it [R/V_P]."""


@njit(cache=True, nogil=True)
def first_of(tree: Tree, problem: Problem, n: int) -> First:
    """A first contact in a cell, if others come after it."""
    known = tree.joined[n, _FIRST : _FIRST + 3]
    if isnan(known[0]):
        first = _first_of(tree, problem, n)
        known[0], known[1], known[2] = first.straight, first.turned, first.goal
    return First(float(known[0]), float(known[1]), float(known[2]))


@njit(cache=True, nogil=True)
def last_of(tree: Tree, problem: Problem, n: int) -> Last:
    """A last contact in a cell, if others come before it."""
    known = tree.joined[n, _LAST : _LAST + 2]
    if isnan(known[0]):
        last = _last_of(tree, problem, n)
        known[0], known[1] = last.straight, last.turned
    return Last(float(known[0]), float(known[1]))


@njit(cache=True, nogil=True)
def apart(tree: Tree, problem: Problem, n: int, pace: float) -> float:
    """For how long there is no other contact after one in a cell, or with pace −1 before it."""
    column = _APART if pace > 0.0 else _APART + 1
    if isnan(tree.joined[n, column]):
        tree.joined[n, column] = apart_by(problem.scene, cell_at(tree, n), pace)
    return float(tree.joined[n, column])


@njit(cache=True, nogil=True)
def _first_of(tree: Tree, problem: Problem, n: int) -> First:
    soon, onward = reach(tree, problem, n)
    cell, start, scene, beat = cell_at(tree, n), problem.start, problem.scene, problem.beat
    _, most = slide_turns(scene, cell)
    if soon == inf or most >= 1.0:
        return First(soon, inf, inf)
    end = min(beat - onward, cell.end + EDGE)
    if most >= 0.0:
        straight = soon_bound(start, scene, cell, end, TANGENT)
    else:
        straight = looped_bound(start, scene, cell, end)
    turned = max(soon, soon_bound(start, scene, cell, beat, OUTWARD))
    goal = inf
    if turned < inf:
        turn = max(turned - cell.end, 0.0)
        after = turned_after_bound(scene, problem.goal, cell, turn, beat - soon)
        goal = max(turned, soon + max(onward, after))
    return First(max(soon, straight), turned if goal < beat else inf, goal)


@njit(cache=True, nogil=True)
def _last_of(tree: Tree, problem: Problem, n: int) -> Last:
    leaving = leave(tree, problem, n)
    cell, scene, goal, beat = cell_at(tree, n), problem.scene, problem.goal, problem.beat
    _, most = slide_turns(scene, cell)
    if leaving == inf or most >= 1.0:
        return Last(leaving, inf)
    if most >= 0.0:
        straight = leaving_bound(scene, goal, cell, beat, TANGENT)
    else:
        straight = looped_leaving_bound(scene, goal, cell, beat)
    turned = leaving_bound(scene, goal, cell, beat, OUTWARD)
    if turned < inf and cell.end < inf:
        turn, end = max(turned - leaving, 0.0), min(cell.end, beat - leaving) + EDGE
        if turned_before_bound(problem.start, scene, cell, turn, end) == inf:
            turned = inf
    return Last(straight, turned)
