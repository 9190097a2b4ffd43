"""Whether a path can come in time from contacts on one side to contacts on the other: disproved.

Behind a leader that keeps straight. The time round the disc knows nothing of sides: but who passes
clockwise first, and counter-clockwise last, leaves some contact P on the way that passes clockwise,
and the next one, N, passes counter-clockwise. From the first contact to P, and from N to the last,
it takes no less than round the disc, the one way or the other; and from P to N as long as a word
that begins and ends as it must (see `hop`), and no less than round the disc.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import pi

import numpy as np
from numba import njit

from relguide.kernels.base.records import Scene, Window
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.bounds.cells import Cell
from relguide.kernels.bounds.hop import hops_within, standing
from relguide.kernels.bounds.round_time import round_bound

_CELLS = 8  # of each side, at first
_MOST = 3_000  # pairs of cells are looked at
_STACK = 256
_SMALLEST = 1e-3  # of a cell [rad]
_LARGEST = 0.2  # of one of which words are looked at [rad]
_ROUNDING = 1e-9  # of a time, as part of it


@njit(cache=True, nogil=True)
def cannot_change_sides(
    scene: Scene, table: FloatArray, cell: Cell, other: Cell, beat: float
) -> bool:
    """Whether certainly no path leads from any contact of a cell to one of another within a time.

    Args:
        scene: a leader that keeps straight, and d_min.
        table: of `times_round`.
        cell: of contacts.
        other: of contacts on the other side.
        beat: the time [R/V_P].
    """
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
        there = standing(cell.piece, other.side, n, n_half)
        elsewhere = _either_way(table, cell, here) + _either_way(table, there, other)
        between = _either_way(table, here, there)
        if elsewhere + between >= beat:
            continue
        size = max(p_half, n_half)
        window = Window(between * (1.0 - _ROUNDING), beat - elsewhere)
        if size < _LARGEST and not hops_within(scene, here, there, window):
            continue
        if size < _SMALLEST or count + 2 > _STACK:
            return False
        for k in range(2):
            stack[count] = p, p_half, n, n_half
            column = 0 if p_half >= n_half else 2
            stack[count, column + 1] *= 0.5
            stack[count, column] += (2 * k - 1) * stack[count, column + 1]
            count += 1
    return False


@njit(cache=True, nogil=True)
def _either_way(table: FloatArray, cell: Cell, other: Cell) -> float:
    return min(round_bound(table, 0, cell, other), round_bound(table, 1, cell, other))
