"""The bounds of `contact_bound` as a proof asks for them, ten thousand times a second.

Calls from Python pay for every record: numba knows a plain array or tuple four times as fast.
"""

from math import inf

import numpy as np
from numba import njit

from relguide.kernels.base.records import Pose, Scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.bounds.contact_bound import (
    Cell,
    Goal,
    between_bound,
    cell_bound,
    leaving_bound,
)

PlainCell = tuple[int, float, float, float, float, float]
"""A `Cell` as a plain tuple: `cell[:]`."""


def question_row(start: Pose, scene: Scene, goal: Goal) -> FloatArray:
    """What is the same for all cells, but for the leader, as an array of shape (8,)."""
    return np.array([*start, scene.alpha, scene.d_min, scene.t_release, *goal])


@njit(cache=True, nogil=True)
def _scene_of(question: FloatArray, leader: FloatArray) -> Scene:
    return Scene(leader, question[3], question[4], question[5], inf)


@njit(cache=True, nogil=True)
def _cell_of(cell: PlainCell) -> Cell:
    piece, side, bearing, half, start, end = cell
    return Cell(piece, side, bearing, half, start, end)


@njit(cache=True, nogil=True)
def reach_cell(
    question: FloatArray, leader: FloatArray, cell: PlainCell, beat: float
) -> tuple[float, float]:
    """`cell_bound` of a cell."""
    start, goal = Pose(question[0], question[1], question[2]), Goal(question[6], question[7])
    return cell_bound(start, _scene_of(question, leader), goal, _cell_of(cell), beat)


@njit(cache=True, nogil=True)
def leave_cell(question: FloatArray, leader: FloatArray, cell: PlainCell, beat: float) -> float:
    """`leaving_bound` of a cell."""
    return leaving_bound(_scene_of(question, leader), _cell_of(cell), beat)


@njit(cache=True, nogil=True)
def join_cells(
    question: FloatArray, leader: FloatArray, table: FloatArray, cell: PlainCell, other: PlainCell,
    beat: float,
) -> float:  # fmt: skip
    """`between_bound` of two cells."""
    scene = _scene_of(question, leader)
    return between_bound(scene, table, _cell_of(cell), _cell_of(other), beat)
