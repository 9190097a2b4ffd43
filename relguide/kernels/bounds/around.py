"""How soon any path can be at a bearing from a leader that turns, and how late it can leave it.

A path has a first contact and a last one. By fronts that go round the disc from the cells of all
first contacts (see `round_turning`) nobody is at a bearing before a time; by fronts that go back in
time from those of all last contacts, nobody who leaves a bearing after a time still gets to one of
them. So fewer contacts can be first ones and last ones, hence the times become better, and so on.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import floor, inf
from typing import NamedTuple

import numpy as np
from numba import njit

from relguide.kernels.base.angles import TWO_PI
from relguide.kernels.base.records import Scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.bounds.cells import Cell
from relguide.kernels.bounds.round_turning import (
    ROUNDING,
    bearings_of,
    front_from,
    leader_then,
    reached_by,
    step_of,
    swept_by,
    time_to,
)

_PARTS = 512
"""Of a whole round: every 0.7°."""


class Around(NamedTuple):
    """When contacts at a bearing can be reached and left, for parts of a whole round."""

    soonest: FloatArray
    """No path is at one sooner [R/V_P]. shape (_PARTS,)"""
    latest: FloatArray
    """No path that is at one later, or just then, has yet to come to its last contact [R/V_P].
    shape (_PARTS,)"""


@njit(cache=True, nogil=True)
def unknown_around() -> Around:
    """Nothing is known."""
    return Around(np.full(_PARTS, -inf), np.full(_PARTS, inf))


@njit(cache=True, nogil=True)
def soonest_in(around: Around, scene: Scene, cell: Cell) -> float:
    """No path is at a contact of the cell before this time [R/V_P]."""
    first, count = _parts_of(scene, cell)
    soonest = inf
    for k in range(count):
        soonest = min(soonest, around.soonest[(first + k) % _PARTS])
    return soonest


@njit(cache=True, nogil=True)
def is_last(around: Around, scene: Scene, cell: Cell) -> bool:
    """Whether who touches in the cell has no other contact to come."""
    first, count = _parts_of(scene, cell)
    for k in range(count):
        if around.latest[(first + k) % _PARTS] >= cell.start:
            return False
    return True


@njit(cache=True, nogil=True)
def _parts_of(scene: Scene, cell: Cell) -> tuple[int, int]:
    """The first of the parts that hold the bearings of a cell, and how many."""
    low, high = bearings_of(scene, cell)
    first = floor(low / TWO_PI * _PARTS - ROUNDING)
    count = floor(high / TWO_PI * _PARTS + ROUNDING) - first + 1
    return first, min(count, _PARTS)


@njit(cache=True, nogil=True)
def no_fronts() -> FloatArray:
    """Since when something can be in a part, one way or the other round: never.

    shape (2, _PARTS)
    """
    return np.full((2, _PARTS), inf)


@njit(cache=True, nogil=True)
def is_behind(swept: FloatArray, scene: Scene, cell: Cell, begun: float) -> bool:
    """Whether whatever begins in a cell at a time is no sooner anywhere than fronts that began.

    Args:
        swept: of `sweep_from`.
        scene: the leader and d_min.
        cell: of contacts.
        begun: as in `sweep_from`.
    """
    first, count = _parts_of(scene, cell)
    for j in range(count):
        at = (first + j) % _PARTS
        if min(swept[0, at], swept[1, at]) > begun:
            return False
    before, beyond = swept[1, (first - 1) % _PARTS], swept[0, (first + count) % _PARTS]
    return bool(count == _PARTS or max(before, beyond) + 2.0 * ROUNDING <= begun)


@njit(cache=True, nogil=True)
def sweep_from(
    swept: FloatArray, scene: Scene, cell: Cell, begun: float, pace: float, horizon: float
) -> None:
    """Let fronts go round from a cell, both ways.

    Args:
        swept: takes since when they can have been in each part. shape (2, _PARTS)
        scene: the leader and d_min.
        cell: of contacts.
        begun: when they begin; with pace −1 the time is counted backward, and this is less than 0.
        pace: as in `Front`.
        horizon: when they end, counted likewise.
    """
    first, count = _parts_of(scene, cell)
    for way in range(2):
        for j in range(count):
            at = (first + j) % _PARTS
            swept[way, at] = min(swept[way, at], begun)
        if count < _PARTS:
            _mark(scene, swept[way], begun, first, count, 1.0 - 2.0 * way, pace, horizon)


@njit(cache=True, nogil=True)
def times_of(swept: FloatArray) -> FloatArray:
    """Since when something can be in a part, whichever way round it has come.

    shape (2, _PARTS) to (_PARTS,)
    """
    times: FloatArray = np.minimum(swept[0], swept[1])
    return times


@njit(cache=True, nogil=True)
def _mark(
    scene: Scene, since: FloatArray, begun: float, first: int, count: int, sense: float,
    pace: float, horizon: float,
) -> None:  # fmt: skip
    """Put down since when a front has been in each part, beyond those in which it began.

    It ends where another one going the same way round has been before: what is behind that stays
    behind it.
    """
    part = TWO_PI / _PARTS
    bearing = part * (first + count if sense > 0.0 else first)
    at = (first + count) % _PARTS if sense > 0.0 else (first - 1) % _PARTS
    left = _PARTS - count
    step, course, t, angle = step_of(scene), bearing, begun, 0.0
    there = leader_then(scene, pace * t)
    while t < horizon and left > 0:
        front = front_from(scene, pace * t, there, bearing, course, sense, pace, step)
        there = leader_then(scene, pace * (t + step))
        reached = reached_by(scene, front, there, step)
        swept = swept_by(front, reached)
        while angle <= swept and left > 0:
            took = 0.0
            if angle > 0.0:
                took = time_to(scene, front, pace * t, pace, angle, step, reached)
            if since[at] + 2.0 * ROUNDING <= t + took:
                return
            since[at] = min(since[at], t + took - ROUNDING)
            at = (at + int(sense)) % _PARTS
            angle += part
            left -= 1
        angle -= swept
        bearing, course = bearing + sense * swept, front.course
        t += step
