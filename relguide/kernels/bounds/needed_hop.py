"""Whether a path from one contact to another, which cannot slide all the way, comes in time.

Behind a leader that keeps straight. The time round the disc knows nothing of sides, nor of where no
bank is enough to follow it (see `junction`). But on the way from a contact F to a contact L there
are a contact P and the next one, N,

- if F and L are on different sides: P on the side of F, and N on the other;
- if they are on the same side, but the path goes round the leader the other way: as before; or the
  path has contacts on that one side only, and from P to N it goes past the bearing midway.

Beside the leader, where nobody may be able to slide the right way either, see `past_bearing`.

From F to P, and from N to L, it takes no less than round the disc, the one way or the other, and
no less than the soonest word; and from P to N as long as a word that begins and ends as it must
(see `hop`), and no less than round the disc.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import inf, pi

import numpy as np
from numba import njit

from relguide.kernels.base.angles import TWO_PI, wrap, wrap_signed
from relguide.kernels.base.records import Scene, Window
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.bounds.between import word_between
from relguide.kernels.bounds.cells import Cell
from relguide.kernels.bounds.hop import hops_within, standing
from relguide.kernels.bounds.round_time import round_bound, round_over

BESIDE = 0.5 * pi
"""The bearing where who passes counter-clockwise must bank most to slide [rad]."""
_CELLS = 8  # of each side, at first
_MOST = 3_000  # pairs of cells are looked at
_STACK = 256
_SMALLEST = 1e-3  # of a cell [rad]
_LARGEST = 0.1  # of one of which words are looked at [rad]
_ROUNDING = 1e-9  # of a time, as part of it
_ANYHOW = -1  # instead of a way round


@njit(cache=True, nogil=True)
def needs_hop(scene: Scene, cell: Cell, other: Cell, way: int) -> bool:
    """Whether nobody can slide all the way from any contact of a cell to any of another one.

    Args:
        scene: a leader that keeps straight, and d_min.
        cell: of contacts.
        other: likewise.
        way: 0 counter-clockwise round the leader, 1 clockwise.
    """
    if cell.side != other.side:
        return True
    sense, reach = 1.0 - 2.0 * way, cell.half + other.half
    over = wrap(sense * (other.bearing - cell.bearing))
    if over <= reach or over + reach >= TWO_PI:
        return False
    if cell.side != sense:
        return True
    beside = wrap(sense * (sense * BESIDE - cell.bearing))
    between = cell.half < beside < over - other.half
    return between and (1.0 + scene.alpha) ** 2 > scene.d_min


@njit(cache=True, nogil=True)
def hop_is_late(
    scene: Scene, table: FloatArray, cell: Cell, other: Cell, way: int, beat: float
) -> bool:
    """Whether certainly no path leads from any contact of a cell to one of another within a time.

    Args:
        scene: a leader that keeps straight, and d_min.
        table: of `times_round`.
        cell: of contacts.
        other: of contacts on the other side, or reached the other way round.
        way: which way round, where both are on one side.
        beat: the time [R/V_P].
    """
    if not _is_late(scene, table, cell, other, -cell.side, _ANYHOW, 0.0, beat):
        return False
    if cell.side != other.side:
        return True
    if table[way, -1] <= beat:
        return False
    sense = 1.0 - 2.0 * way
    past = cell.bearing + 0.5 * sense * wrap(sense * (other.bearing - cell.bearing))
    return _is_late(scene, table, cell, other, cell.side, way, past, beat)


@njit(cache=True, nogil=True)
def _is_late(
    scene: Scene, table: FloatArray, cell: Cell, other: Cell, side: float, way: int, past: float,
    beat: float,
) -> bool:  # fmt: skip
    """Whether that is so of paths with P on the side of the cell, and N on this side.

    If a way is given, N is reached that way past a bearing.
    """
    first = standing(cell.piece, cell.side, cell.bearing, cell.half)
    last = standing(other.piece, other.side, other.bearing, other.half)
    stack = np.empty((_STACK, 4))
    count, half = 0, pi / _CELLS
    for i in range(_CELLS):
        for j in range(_CELLS):
            stack[count, 0], stack[count, 1] = (2 * i + 1) * half - pi, half
            stack[count, 2], stack[count, 3] = (2 * j + 1) * half - pi, half
            count += 1
    for _ in range(_MOST):
        if count == 0:
            return True
        count -= 1
        p, p_half, n, n_half = stack[count]
        here = standing(cell.piece, cell.side, p, p_half)
        there = standing(cell.piece, side, n, n_half)
        before, after = _either_way(table, first, here), _either_way(table, there, last)
        if way == _ANYHOW:
            between = _either_way(table, here, there)
        elif _may_pass(table, here, there, way, past, beat):
            between = round_bound(table, way, here, there)
        else:
            continue
        if before + between + after >= beat:
            continue
        size = max(p_half, n_half)
        if size < _LARGEST:
            room = beat - between - after
            before = max(before, word_between(scene, first, here, room, 0.0, 0.0, before))
            room = beat - before - between
            if before < inf:
                after = max(after, word_between(scene, there, last, room, 0.0, 0.0, after))
            window = Window(between * (1.0 - _ROUNDING), beat - before - after)
            if between >= window.beat or not hops_within(scene, here, there, window):
                continue
        if size < _SMALLEST or count + 2 > _STACK:
            return False
        for i in range(2):
            stack[count] = p, p_half, n, n_half
            column = 0 if p_half >= n_half else 2
            stack[count, column + 1] *= 0.5
            stack[count, column] += (2 * i - 1) * stack[count, column + 1]
            count += 1
    return False


@njit(cache=True, nogil=True)
def _either_way(table: FloatArray, cell: Cell, other: Cell) -> float:
    return min(round_bound(table, 0, cell, other), round_bound(table, 1, cell, other))


@njit(cache=True, nogil=True)
def _may_pass(
    table: FloatArray, begin: Cell, end: Cell, way: int, past: float, beat: float
) -> bool:
    """Whether a bearing may lie between contacts of both, on the way round, of no whole round."""
    sense = 1.0 - 2.0 * way
    over, ahead = wrap(sense * (end.bearing - begin.bearing)), wrap(sense * (past - begin.bearing))
    reach = begin.half + end.half
    if over + reach >= TWO_PI:
        # a little way, or nearly a whole round
        edge = begin.bearing + sense * begin.half
        if over > reach and round_over(table, way, wrap_signed(edge), over - reach) >= beat:
            over -= TWO_PI
    furthest = over + end.half
    return ahead <= furthest or -begin.half <= ahead - TWO_PI <= furthest
