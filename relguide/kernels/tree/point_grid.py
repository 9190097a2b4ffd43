"""Which of many points is nearest: a grid over their first two coordinates, searched outward.

Cells are scanned in square rings round the one that the question falls into, until no cell farther
out can hold a nearer point. So the answer is exact, and costs about as much as the points of nine
cells.
"""

from math import ceil, inf, sqrt
from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from relguide.kernels.base.roots import FloatArray

IntArray = NDArray[np.int64]
POINTS = 24
"""Points a cell on average: with fewer, more empty cells are looked at than points saved."""


class PointGrid(NamedTuple):
    """Points in order of their cells."""

    points: FloatArray
    """shape (n, dimensions)"""
    numbers: IntArray
    """Of each point in the order they were given. shape (n,)"""
    starts: IntArray
    """Where the points of each cell begin, row by row of cells. shape (rows · columns + 1,)"""
    columns: int
    """Cells along the first coordinate."""
    corner: tuple[float, float]
    """Least of the first two coordinates."""
    size: float
    """Edge of a cell."""


def point_grid(points: FloatArray) -> PointGrid:
    """Sort points into cells.

    Args:
        points: at least one; cells are as long in the first coordinate as in the second. shape
            (n, dimensions ≥ 2)
    """
    low, high = points[:, :2].min(axis=0), points[:, :2].max(axis=0)
    width, height = (float(extent) for extent in high - low)
    cells = max(1.0, len(points) / POINTS)
    # as many cells of a line, where the points lie on one
    size = max(sqrt(width * height / cells), max(width, height) / cells) or 1.0
    columns, rows = (max(1, ceil(extent / size)) for extent in (width, height))
    column, row = (
        np.minimum((points[:, k] - low[k]) / size, count - 1).astype(np.int64)
        for k, count in enumerate((columns, rows))
    )
    cell = row * columns + column
    numbers = np.argsort(cell, kind="stable")
    return PointGrid(
        points=np.ascontiguousarray(points[numbers]),
        numbers=numbers,
        starts=np.searchsorted(cell[numbers], np.arange(rows * columns + 1)),
        columns=columns,
        corner=(float(low[0]), float(low[1])),
        size=size,
    )


@njit(cache=True, nogil=True)
def nearest_points(
    grid: PointGrid, asked: FloatArray, distances: FloatArray, numbers: IntArray
) -> None:
    """The nearest point of each question.

    Args:
        grid: the points.
        asked: the questions. shape (m, dimensions)
        distances: takes how far each is. shape (m,)
        numbers: takes which it is, in the order the points were given. shape (m,)
    """
    for n in range(len(asked)):
        squared, numbers[n] = _nearest(grid, asked[n])
        distances[n] = sqrt(squared)


@njit(cache=True, nogil=True)
def _nearest(grid: PointGrid, asked: FloatArray) -> tuple[float, int]:
    """Squared distance and number of the nearest point."""
    columns = grid.columns
    rows = (len(grid.starts) - 1) // columns
    across, up = (asked[0] - grid.corner[0]) / grid.size, (asked[1] - grid.corner[1]) / grid.size
    column = int(min(max(across, 0.0), columns - 1.0))
    row = int(min(max(up, 0.0), rows - 1.0))
    # from outside, a cell is at least as far as its ring from where the grid is entered
    outside_x = max(-across, across - columns, 0.0)
    outside_y = max(-up, up - rows, 0.0)
    outside = outside_x * outside_x + outside_y * outside_y
    least, number = inf, -1
    for ring in range(max(columns, rows)):
        beyond = max(ring - 1.0, 0.0)
        if least <= (beyond * beyond + outside) * grid.size * grid.size:
            break
        for j in range(max(row - ring, 0), min(row + ring, rows - 1) + 1):
            whole = abs(j - row) == ring
            for i in range(column - ring, column + ring + 1, 1 if whole else max(2 * ring, 1)):
                if 0 <= i < columns:
                    cell = j * columns + i
                    for k in range(grid.starts[cell], grid.starts[cell + 1]):
                        squared = 0.0
                        for axis in range(len(asked)):
                            off = grid.points[k, axis] - asked[axis]
                            squared += off * off
                        if squared < least:
                            least, number = squared, grid.numbers[k]
    return least, number
