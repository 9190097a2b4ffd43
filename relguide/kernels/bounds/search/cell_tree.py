"""Cells of contacts as a tree: each cell knows its halves, and the branching rule cuts it in two.

A cell is worth cutting where that raises the bound most, and the better side differs. Where a word
leads to a contact its time is known once its bearing is, while a contact that a path comes to with
time to spare may be at any time. So the rule weighs a radian of bearing against the time as long as
it. The weights follow from what cuts of either kind have gained of late in the same search: both
shall gain alike.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import exp, inf, isnan
from typing import NamedTuple

import numpy as np
from numba import njit

from relguide.kernels.base.records import Pose, Scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.bounds.fronts.around import Around
from relguide.kernels.bounds.words.cells import Cell
from relguide.kernels.bounds.words.found_word import COLUMNS, UNKNOWN
from relguide.kernels.bounds.words.sets import Goal
from relguide.kernels.contact.nodes import IntArray

BoolArray = np.ndarray[tuple[int, ...], np.dtype[np.bool_]]
TO, ON, AWAY = 0, 1, 2  # words to a first contact, on from it, and on from a last one
_OPEN_ROWS = 5  # rows kept, for each cell: if there is no more room, those of larger cells serve
SOON, ONWARD, LEAVING = 0, 1, 2  # columns of what is known
ROUND_FROM, ROUND_TO, TIGHT_TO, TIGHT_FROM = 3, 5, 17, 20
"""And those of `round_trip`."""
REACHED, LEFT, LEFT_END, _COLUMNS = 7, 12, 17, 23
FACTS = 10
"""Columns of `Tree.facts`: those of `cell_facts` and of `narrowing`."""
_WEIGHT, _OF_BEARINGS, _OF_TIMES = 0, 1, 2
_FIRST = ((0.5, 0.25, 1.0), (1.0, 0.125, 8.0))
"""The weight to begin with, the least one and the largest: where a word leads to the contact, and
where there is time to spare."""
_RECENT = 0.02  # the share of the latest cut in what is held to be gained
_PACE = 0.02  # how fast weights follow


class Tree(NamedTuple):
    """Cells, and what is known of them."""

    cells: FloatArray
    """The fields of each `Cell`. shape (n, 6)"""
    halves: IntArray
    """The first of its two halves, the other being the next, −1 if it has not been halved; and the
    cell of which it is one, −1 if of none. In the last row how many cells there are.
    shape (n + 1, 2)"""
    facts: FloatArray
    """What is known of it as one of several contacts: see `cell_facts`. shape (n, FACTS)"""
    known: FloatArray
    """How soon a first contact can be there, the goal from it, and the goal from a last one; bounds
    of both with the time round, either way; the first and the last of these by how the contact
    is passed; and how much longer than round the disc hops take to a last contact, and from a first
    one, how much was asked for, and how long they may be. NaN while it is not known.
    shape (n, 23)"""
    open_rows: FloatArray
    """Open intervals of the words' unknown, one cell's after another's: see `found_word`.
    shape (·, 5)"""
    spare: BoolArray
    """Whether its contacts are those that are come to with time to spare: see `junction`.
    shape (n,)"""
    open_of: IntArray
    """Where those of a cell begin, or of a larger one that holds it: of words to a first contact,
    on from it, and on from a last one; in the last place how many rows there are.
    shape (n + 1, 3)"""
    cuts: FloatArray
    """What the branching rule has learned, of `begin_cuts`. shape (2, 3)"""


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
    incumbent: float
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
        np.empty((room, 6)), np.empty((room + 1, 2), np.int64), np.empty((room, FACTS)),
        np.empty((room, _COLUMNS)), np.empty((_OPEN_ROWS * room, COLUMNS)),
        np.empty(room, np.bool_), np.empty((room + 1, 3), np.int64), begin_cuts(),
    )  # fmt: skip
    tree.cells[:count] = cells
    tree.halves[:count], tree.known[:count], tree.facts[:count] = -1, np.nan, np.nan
    tree.halves[room, 0], tree.spare[:count] = count, False
    tree.open_of[:count], tree.open_of[room] = UNKNOWN, 0
    return tree


@njit(cache=True, nogil=True, forceinline=True)
def cell_at(tree: Tree, n: int) -> Cell:
    """A cell by its number."""
    piece, side, bearing, half, start, end = tree.cells[n]
    return Cell(int(piece), side, bearing, half, start, end)


@njit(cache=True, nogil=True)
def halve(tree: Tree, n: int, d_min: float) -> int:
    """The number of the first half of a cell, the other's being one more; −1 if there is no room.

    The branching rule cuts it across its bearings or its times.
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
    tree.facts[first : first + 2], tree.spare[first : first + 2] = np.nan, tree.spare[n]
    for child in (first, first + 1):
        for which in range(3):
            tree.open_of[child, which] = tree.open_of[n, which]
        if not isnan(tree.known[n, LEAVING]):
            tree.open_of[child, ON] = tree.open_of[n, AWAY]
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
    """Put down what it has gained to halve a cell, see `learn_cut`."""
    if tree.cells[n, 5] < inf:  # else there was no choice
        times = bool(tree.cells[tree.halves[n, 0], 3] == tree.cells[n, 3])
        learn_cut(tree.cuts, tree.spare[n], times, gain)


@njit(cache=True, nogil=True)
def begin_cuts() -> FloatArray:
    """How cells are cut before anything has been learned.

    Returns:
        the weight, and what cuts across bearings and across times have gained of late; of contacts
        to which a word leads, and of those with time to spare. shape (2, 3)
    """
    cuts = np.zeros((2, 3))
    for k in range(2):
        cuts[k, _WEIGHT] = _FIRST[k][0]
    return cuts


@njit(cache=True, nogil=True, forceinline=True)
def length_of(span: float, d_min: float) -> float:
    """How many radians weigh as much as half a window of time, before what has been learned.

    In a time t a contact moves by some t (the leader's way), and one on its circle by d_min for
    each radian of bearing; a radian turns the heading at it, too.
    """
    return span / (d_min + 1.0) if span < inf else 0.0


@njit(cache=True, nogil=True, forceinline=True)
def cuts_times(cuts: FloatArray, spare: bool, half: float, span: float, d_min: float) -> bool:
    """Whether a cell is cut across its times.

    Args:
        cuts: of `begin_cuts`.
        spare: whether contacts are come to with time to spare.
        half: half of what its bearings differ by [rad].
        span: half of what its times differ by [R/V_P]; infinite windows are not cut.
        d_min: the least separation [R].
    """
    return bool(length_of(span, d_min) > cuts[1 if spare else 0, _WEIGHT] * half)


@njit(cache=True, nogil=True)
def learn_cut(cuts: FloatArray, spare: bool, times: bool, gain: float) -> None:
    """Put down what a cut has gained.

    Args:
        cuts: of `begin_cuts`; takes it.
        spare: whether the cell's contacts are come to with time to spare.
        times: whether it was cut across its times.
        gain: the share of what its bound lacked that its halves' bounds lack no longer, 0 to 1.
    """
    k = 1 if spare else 0
    which = _OF_TIMES if times else _OF_BEARINGS
    cuts[k, which] += _RECENT * (gain - cuts[k, which])
    weight = cuts[k, _WEIGHT] * exp(_PACE * (cuts[k, _OF_BEARINGS] - cuts[k, _OF_TIMES]))
    cuts[k, _WEIGHT] = min(max(weight, _FIRST[k][1]), _FIRST[k][2])
