"""Cells of contacts as a tree: each knows its halves, and what is known of it is computed once.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import inf, isnan
from typing import NamedTuple

import numpy as np
from numba import njit

from relguide.kernels.base.records import Pose, Scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.bounds.after_spare import Onward, after_spare
from relguide.kernels.bounds.around import Around, is_last
from relguide.kernels.bounds.as_long import can_be_at
from relguide.kernels.bounds.cells import EDGE, Cell
from relguide.kernels.bounds.contact_bound import (
    NEVER,
    Passed,
    anyhow,
    cell_bound,
    leaving_bound,
    until_again,
)
from relguide.kernels.bounds.cutting import begin_cuts, cuts_times, learn_cut, length_of
from relguide.kernels.bounds.goal import Goal, is_track
from relguide.kernels.bounds.junction import beyond_outward, can_touch
from relguide.kernels.bounds.rest import COLUMNS, MOST, UNKNOWN, Rest
from relguide.kernels.bounds.spare_bound import spare_bound
from relguide.kernels.bounds.tangent_contacts import may_be_tangent

IntArray = np.ndarray[tuple[int, ...], np.dtype[np.int64]]
BoolArray = np.ndarray[tuple[int, ...], np.dtype[np.bool_]]

_BY_TURN = 0.1  # how contacts are passed matters in cells smaller than this [rad]
_TO, _ON, _AWAY = 0, 1, 2  # words to a first contact, on from it, and on from a last one
_RESTS = 5  # rows kept, for each cell: if there is no more room, those of larger cells serve
_SOON, _ONWARD, _LEAVING = 0, 1, 2  # columns of what is known
ROUND_FROM, ROUND_TO, TIGHT_TO, TIGHT_FROM = 3, 5, 17, 20
"""And those of `round_closely`."""
_REACHED, _LEFT, _LEFT_END, _COLUMNS = 7, 12, 17, 23
JOINED = 10
"""Columns of `Tree.joined`: those of `joined`, of `spare_onward` and of `last_contacts`."""
_TO_GOAL, _TO_NEXT, _AGAIN = 5, 6, 7


class Tree(NamedTuple):
    """Cells, and what is known of them."""

    cells: FloatArray
    """The fields of each `Cell`. shape (n, 6)"""
    halves: IntArray
    """The first of its two halves, the other being the next, −1 if it has not been halved; and the
    cell of which it is one, −1 if of none. In the last row how many cells there are.
    shape (n + 1, 2)"""
    joined: FloatArray
    """What is known of it as one of several contacts: see `joined`. shape (n, JOINED)"""
    known: FloatArray
    """How soon a first contact can be there, the goal from it, and the goal from a last one; bounds
    of both with the time round, either way; the first and the last of these by how the contact
    is passed; and how much longer than round the disc hops take to a last contact, and from a first
    one, how much was asked for, and how long they may be. NaN while it is not known.
    shape (n, 23)"""
    rests: FloatArray
    """Intervals of the words' unknown that were left, one cell's after another's: see `rest`.
    shape (·, 5)"""
    spare: BoolArray
    """Whether its contacts are those that are come to with time to spare: see `junction`.
    shape (n,)"""
    rest_of: IntArray
    """Where those of a cell begin, or of a larger one that holds it: of words to a first contact,
    on from it, and on from a last one; in the last place how many rows there are.
    shape (n + 1, 3)"""
    cuts: FloatArray
    """How they are cut in two: see `cutting`. shape (2, 3)"""


class Problem(NamedTuple):
    """How soon can a path that keeps d_min be at a goal?"""

    start: Pose
    """Where they begin, at t = 0."""
    scene: Scene
    """The leader, d_min, and the time before which arrivals do not count."""
    goal: Goal
    """Where they arrive."""
    table: FloatArray
    """Of `times_round`."""
    beat: float
    """Arrivals from here on do not matter [R/V_P]."""
    paired: float
    """How small a cell of first contacts, not on the final leg, must be before the last contacts
    that go with it are looked at, one by one [rad]."""
    around: Around
    """When contacts at a bearing can be reached and left."""
    tangents: FloatArray
    """First contacts at which λ_ψ vanishes, of `tangent_contacts`."""


@njit(cache=True, nogil=True)
def plant(cells: FloatArray, room: int) -> Tree:
    """A tree of these cells, shape (n, 6), with room for so many in all."""
    count = len(cells)
    tree = Tree(
        np.empty((room, 6)), np.empty((room + 1, 2), np.int64), np.empty((room, JOINED)),
        np.empty((room, _COLUMNS)), np.empty((_RESTS * room, COLUMNS)),
        np.empty(room, np.bool_), np.empty((room + 1, 3), np.int64), begin_cuts(),
    )  # fmt: skip
    tree.cells[:count] = cells
    tree.halves[:count], tree.known[:count], tree.joined[:count] = -1, np.nan, np.nan
    tree.halves[room, 0], tree.spare[:count] = count, False
    tree.rest_of[:count], tree.rest_of[room] = UNKNOWN, 0
    return tree


@njit(cache=True, nogil=True, forceinline=True)
def cell_at(tree: Tree, n: int) -> Cell:
    """A cell by its number."""
    piece, side, bearing, half, start, end = tree.cells[n]
    return Cell(int(piece), side, bearing, half, start, end)


@njit(cache=True, nogil=True)
def halve(tree: Tree, n: int, d_min: float) -> int:
    """The number of the first half of a cell, the other's being one more; −1 if there is no room.

    It is cut across its bearings or its times, see `cutting`.
    """
    room = len(tree.cells)
    if tree.halves[n, 0] >= 0:
        return int(tree.halves[n, 0])
    first = int(tree.halves[room, 0])
    if first + 2 > room:
        return -1
    tree.halves[room, 0] += 2
    tree.halves[n, 0] = first
    cell = cell_at(tree, n)
    tree.halves[first : first + 2, 0], tree.halves[first : first + 2, 1] = -1, n
    tree.known[first : first + 2] = np.nan
    tree.joined[first : first + 2], tree.spare[first : first + 2] = np.nan, tree.spare[n]
    for child in (first, first + 1):
        for which in range(3):
            tree.rest_of[child, which] = tree.rest_of[n, which]
        if not isnan(tree.known[n, _LEAVING]):
            tree.rest_of[child, _ON] = tree.rest_of[n, _AWAY]
    tree.cells[first] = tree.cells[first + 1] = tree.cells[n]
    span = 0.5 * (cell.end - cell.start)
    if cuts_times(tree.cuts, tree.spare[n], cell.half, span, d_min):
        tree.cells[first, 5] = tree.cells[first + 1, 4] = cell.start + span
    else:
        half = 0.5 * cell.half
        tree.cells[first, 3] = tree.cells[first + 1, 3] = half
        tree.cells[first, 2], tree.cells[first + 1, 2] = cell.bearing - half, cell.bearing + half
    return first


@njit(cache=True, nogil=True, forceinline=True)
def size_of(tree: Tree, n: int, d_min: float) -> float:
    """The longer side of a cell [rad]."""
    span = 0.5 * (tree.cells[n, 5] - tree.cells[n, 4])
    return float(max(tree.cells[n, 3], length_of(span, d_min)))


@njit(cache=True, nogil=True)
def learn_gain(tree: Tree, n: int, gain: float) -> None:
    """Put down what it has gained to halve a cell, see `cutting.learn_cut`."""
    if tree.cells[n, 5] < inf:  # else there was no choice
        times = bool(tree.cells[tree.halves[n, 0], 3] == tree.cells[n, 3])
        learn_cut(tree.cuts, tree.spare[n], times, gain)


@njit(cache=True, nogil=True)
def reach(tree: Tree, problem: Problem, n: int) -> tuple[float, float]:
    """How soon a first contact can be in the cell, and how soon the goal from there.

    Its window of time is narrowed to when contacts are reached that lead to the goal in time.
    """
    known = tree.known[n]
    if isnan(known[_SOON]):
        cell = cell_at(tree, n)
        soon, onward, latest, passed = inf, inf, inf, NEVER
        if can_touch(problem.scene, cell):
            start, scene, goal = problem.start, problem.scene, problem.goal
            closely = size_of(tree, n, scene.d_min) < _BY_TURN
            if tree.spare[n]:
                on = _rest_of(tree, n, _ON, 0)
                soon, onward = spare_bound(start, scene, goal, cell, problem.beat, on)
            else:
                to, on = _rest_of(tree, n, _TO, 0), _rest_of(tree, n, _ON, 1)
                switch = not closely or may_be_tangent(problem.tangents, cell)
                passed, onward, latest = cell_bound(
                    start, scene, goal, cell, problem.beat, closely, switch, to, on
                )
                passed = until_again(scene, cell, 1.0, passed)
                soon = anyhow(passed)
                _keep_rest(tree, n, _TO, to)
            _keep_rest(tree, n, _ON, on)
        known[_SOON], known[_ONWARD] = soon, onward
        if soon < inf and cell.end < inf:
            tree.cells[n, 4] = soon
            tree.cells[n, 5] = min(cell.end, max(min(problem.beat - onward, latest + EDGE), soon))
        if tree.spare[n] and soon < inf:
            lasts = 0.0
            if soon + onward < problem.beat:
                lasts = spare_onward(tree, problem, n).contact
                lasts = min(lasts, beyond_outward(problem.scene, cell, 1.0))
            passed = Passed(inf, inf, inf, soon, soon + lasts)
        _keep(known[_REACHED:], passed)
    soon, onward = float(known[_SOON]), float(known[_ONWARD])
    if soon < inf and is_last(problem.around, problem.scene, cell_at(tree, n)):
        onward = max(onward, leave(tree, problem, n))
    return soon, onward


@njit(cache=True, nogil=True)
def spare_onward(tree: Tree, problem: Problem, n: int) -> Onward:
    """How long it takes from a contact in a cell, come to with time to spare, to the next or goal.

    See `after_spare` [R/V_P]. How soon one can be there is known, see `reach`.
    """
    joined = tree.joined[n]
    if isnan(joined[_TO_GOAL]):
        left = problem.beat - float(tree.known[n, _SOON])
        onward = after_spare(problem.scene, problem.goal, cell_at(tree, n), left)
        joined[_TO_GOAL], joined[_TO_NEXT] = onward.goal, onward.contact
        joined[_AGAIN] = onward.again
    return Onward(float(joined[_TO_GOAL]), float(joined[_TO_NEXT]), float(joined[_AGAIN]))


@njit(cache=True, nogil=True)
def leave(tree: Tree, problem: Problem, n: int) -> float:
    """How soon the goal can be reached from a last contact in the cell."""
    known = tree.known[n]
    if isnan(known[_LEAVING]):
        passed, cell = NEVER, cell_at(tree, n)
        scene, left = problem.scene, problem.beat - cell.start
        # elsewhere than as the slot opens that takes as much time as it saves
        asked = isnan(known[_SOON]) and is_track(problem.goal, scene.alpha)
        if can_touch(scene, cell) and (not asked or can_be_at(problem.start, scene, cell)):
            closely = size_of(tree, n, scene.d_min) < _BY_TURN
            # words on from the cell itself are known more closely
            on = _rest_of(tree, n, _AWAY if isnan(known[_SOON]) else _ON, 0)
            passed = leaving_bound(scene, problem.goal, cell, left, closely, on)
            passed = until_again(scene, cell, -1.0, passed)
            _keep_rest(tree, n, _AWAY, on)
        known[_LEAVING] = anyhow(passed)
        _keep(known[_LEFT:], passed)
    return float(known[_LEAVING])


@njit(cache=True, nogil=True)
def bury(tree: Tree, n: int) -> None:
    """Put down that no path in time has its last contact in a cell."""
    known = tree.known[n]
    known[_LEAVING] = inf
    _keep(known[_LEFT:], NEVER)


@njit(cache=True, nogil=True, forceinline=True)
def is_buried(tree: Tree, n: int) -> bool:
    """Whether it is known that no path in time has its last contact in a cell."""
    return bool(tree.known[n, _LEAVING] == inf)


@njit(cache=True, nogil=True)
def learn(tree: Tree, n: int) -> None:
    """Let a cell know of leaving it what both its halves know, and so the cell that it is half of.

    Args:
        tree: with the cell.
        n: its number, or −1.
    """
    while n >= 0:
        half = tree.halves[n, 0]
        if half < 0:
            break
        known, one, other = tree.known[n], tree.known[half], tree.known[half + 1]
        if isnan(one[_LEAVING]) or isnan(other[_LEAVING]):
            break
        raised = False
        for k in range(_LEFT_END - _LEFT + 1):
            at = _LEAVING if k == 0 else _LEFT + k - 1
            least = min(one[at], other[at])
            if least > known[at]:
                known[at], raised = least, True
        if not raised:
            break
        n = tree.halves[n, 1]


@njit(cache=True, nogil=True, forceinline=True)
def reached(tree: Tree, problem: Problem, n: int) -> Passed:
    """How soon a first contact can be in the cell, by how it is passed."""
    reach(tree, problem, n)
    known = tree.known[n, _REACHED:]
    return Passed(known[0], known[1], known[2], known[3], known[4])


@njit(cache=True, nogil=True, forceinline=True)
def departed(tree: Tree, problem: Problem, n: int) -> Passed:
    """How soon the goal can be reached from a last contact in the cell, by how it is passed."""
    leave(tree, problem, n)
    known = tree.known[n, _LEFT:]
    return Passed(known[0], known[1], known[2], known[3], known[4])


@njit(cache=True, nogil=True)
def _rest_of(tree: Tree, n: int, which: int, place: int) -> Rest:
    """What is known to be left of the words of a cell, and room for what is left now."""
    # two may be under way
    room = int(tree.rest_of[len(tree.cells), 0]) + place * (MOST + 1)
    if room + MOST < len(tree.rests):
        tree.rests[room, 0] = UNKNOWN  # as long as no words are looked at
    else:
        room = UNKNOWN
    return Rest(tree.rests, int(tree.rest_of[n, which]), room)


@njit(cache=True, nogil=True)
def _keep_rest(tree: Tree, n: int, which: int, rest: Rest) -> None:
    """Keep what is left of the words of a cell, if all of it is there."""
    if rest.room < 0 or not 0.0 <= tree.rests[rest.room, 0] <= MOST:
        return
    room, rows = int(tree.rest_of[len(tree.cells), 0]), int(tree.rests[rest.room, 0]) + 1
    if room < rest.room:
        for k in range(rows):
            for column in range(COLUMNS):
                tree.rests[room + k, column] = tree.rests[rest.room + k, column]
    tree.rest_of[n, which] = room
    tree.rest_of[len(tree.cells), 0] = room + rows


@njit(cache=True, nogil=True)
def _keep(known: FloatArray, passed: Passed) -> None:
    for k in range(len(passed)):
        known[k] = passed[k]
