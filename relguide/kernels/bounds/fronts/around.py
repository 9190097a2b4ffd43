"""When a path can be at a bearing from the leader, without time to turn.

Behind a leader that keeps straight the time round the disc has a closed form: see `times_round`.
Round one that turns, fronts bound it (see `front`). A path has a first contact and a last one.
Fronts that go round from the cells of all first contacts say when a path can be at a bearing at the
soonest. Fronts that go back in time from the cells of all last contacts say how late a path can
leave a bearing and still get to one of them. So fewer contacts can be first ones and last ones,
hence the times become better, and so on.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import cos, floor, inf, pi, sqrt
from typing import NamedTuple

import numpy as np
from numba import njit

from relguide.kernels.base.angles import TWO_PI, wrap, wrap_signed
from relguide.kernels.base.records import Scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.bounds.fronts.front import (
    FAST,
    ROUNDING,
    bearings_of,
    front_from,
    leader_then,
    reached_by,
    step_of,
    swept_by,
    time_to,
)
from relguide.kernels.bounds.words.cells import Cell

_ROUND = 16_384
"""Points of `times_round`: every 0.02°."""
ROUND_SLACK = 3e-8
"""What differences between any two bearings may be wrong by, as part of a whole round. Between two
points of the table d²t/db² is less than 2 α d/(1 − α²), and a whole round takes no less than twice
2 d/(1 − α²): so it is less than an eighth of the square of the step, beside which nothing counts.
"""
_TOUCHING = 1e-9  # of a gap so small nothing is said [rad]
_PARTS = 512
"""Of a whole round: every 0.7°."""


@njit(cache=True, nogil=True)
def times_round(alpha: float, d_min: float) -> FloatArray:
    """How long it takes at least to go round the disc, by bearing from −π on.

    For something that needs no time to turn. Outside the disc it is fastest along its edge, since
    that is convex and the leader's motion is the same everywhere: as a boundary arc (see
    `contact`), so

        dt/db = d / (√(1 − α² cos² b) + s α sin b) = d (√(1 − α² cos² b) − s α sin b) / (1 − α²)

    with d = d_min.

    Row 0 is counter-clockwise (s = 1), row 1 clockwise, both growing with b. shape (2, ·)
    """
    table = np.zeros((2, _ROUND + 1))
    if alpha > FAST:
        return table
    step = TWO_PI / _ROUND
    scale = d_min / (1.0 - alpha * alpha)
    arc, last = 0.0, sqrt(1.0 - alpha * alpha)
    for k in range(1, _ROUND + 1):
        b = k * step - pi
        middle = sqrt(1.0 - (alpha * cos(b - 0.5 * step)) ** 2)
        here = sqrt(1.0 - (alpha * cos(b)) ** 2)
        arc += step * (last + 4.0 * middle + here) / 6.0
        last = here
        table[0, k] = scale * (arc + alpha * (cos(b) + 1.0))
        table[1, k] = scale * (arc - alpha * (cos(b) + 1.0))
    return table


@njit(cache=True, nogil=True)
def round_time(table: FloatArray, way: int, bearing: float) -> float:
    """A row of `times_round` at any bearing of [−π, π]; differences are right to `ROUND_SLACK`."""
    place = min(max((bearing + pi) / TWO_PI, 0.0), 1.0) * _ROUND
    k = min(int(place), _ROUND - 1)
    return float(table[way, k] + (place - k) * (table[way, k + 1] - table[way, k]))


@njit(cache=True, nogil=True)
def round_anywhere(table: FloatArray, way: int, bearing: float) -> float:
    """As `round_time`, on beyond [−π, π]: each whole round adds what it takes."""
    within = wrap_signed(bearing)
    rounds = floor((bearing - within) / TWO_PI + 0.5)
    return round_time(table, way, within) + rounds * float(table[way, _ROUND])


@njit(cache=True, nogil=True)
def round_bound(table: FloatArray, way: int, cell: Cell, other: Cell) -> float:
    """The least time from any bearing of one cell to any of another, outside the disc.

    Args:
        table: of `times_round`.
        way: 0 counter-clockwise round the leader, 1 clockwise.
        cell: its bearing in [−π, π].
        other: its bearing in [−π, π].
    """
    sign = 1.0 - 2.0 * way
    gap = wrap(sign * (other.bearing - cell.bearing)) - cell.half - other.half
    if gap <= 0.0 or gap + 2.0 * (cell.half + other.half) >= TWO_PI:
        return 0.0
    return round_over(table, way, cell.bearing + sign * cell.half, gap)


@njit(cache=True, nogil=True)
def round_over(table: FloatArray, way: int, bearing: float, gap: float) -> float:
    """The least time from a bearing over a gap of (0, 2π), outside the disc.

    Args:
        table: of `times_round`.
        way: 0 counter-clockwise round the leader, 1 clockwise.
        bearing: in [−π, π].
        gap: how far round [rad].
    """
    if gap < _TOUCHING:
        return 0.0  # where rounding might make a whole round of it
    sign = 1.0 - 2.0 * way
    end = wrap_signed(bearing + sign * gap)
    took = sign * (round_time(table, way, end) - round_time(table, way, bearing))
    if sign * (end - bearing) < 0.0:
        took += table[way, _ROUND]
    return float(max(took - ROUND_SLACK * table[way, _ROUND], 0.0))


@njit(cache=True, nogil=True)
def round_most(table: FloatArray, bearing: float, gap: float) -> float:
    """No less than the time counter-clockwise round from a bearing over a gap of [0, 2π)."""
    begin = bearing if bearing >= -pi else bearing + TWO_PI
    end = begin + gap
    whole, past = float(table[0, _ROUND]), end > pi
    took = round_time(table, 0, end - TWO_PI if past else end) - round_time(table, 0, begin)
    return took + (whole if past else 0.0) + ROUND_SLACK * whole


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
    """Whether a path that touches in the cell has no other contact to come."""
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
