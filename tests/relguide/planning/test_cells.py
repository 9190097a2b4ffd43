"""Weather cells: where they are later, and how far outside of them a place is."""

from dataclasses import replace
from math import hypot

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from relguide.kernels.separation.cell import signed_distance
from relguide.planning.cells import Cell, Disc, Polygon, outside
from relguide.planning.certificate import cell_shape
from relguide.planning.wind import CALM

SQUARE = Cell(
    ident="CB1",
    shape=Polygon(corners=((0.0, 0.0), (10_000.0, 0.0), (10_000.0, 8_000.0), (0.0, 8_000.0))),
    east=12.0,
    north=-5.0,
    growth=2.0,
)
ROUND = replace(SQUARE, shape=Disc(x=1_000.0, y=2_000.0, radius=6_000.0))
PLACES = st.tuples(st.floats(-40_000.0, 40_000.0), st.floats(-40_000.0, 40_000.0))


@pytest.mark.parametrize("cell", [SQUARE, ROUND], ids=["polygon", "disc"])
@given(place=PLACES, t=st.floats(0.0, 1_000.0))
def test_outside_is_what_the_kernels_say_of_the_place_seen_from_the_cell(
    cell: Cell, place: tuple[float, float], t: float
) -> None:
    corners, (radius, growth, east, north) = cell_shape(cell, CALM)
    x, y = place[0] - east * t, place[1] - north * t
    expected = signed_distance(x, y, corners, radius + growth * t)[0]
    (found,) = outside(cell, np.array([place]), np.array([t]))
    assert found == pytest.approx(expected, abs=1e-6)


@pytest.mark.parametrize("cell", [SQUARE, ROUND], ids=["polygon", "disc"])
@given(place=PLACES, t=st.floats(0.0, 500.0), later=st.floats(0.0, 500.0))
def test_a_cell_some_time_later_is_the_same_cell(
    cell: Cell, place: tuple[float, float], t: float, later: float
) -> None:
    there = np.array([place])
    (now,) = outside(cell, there, np.array([t + later]))
    (then,) = outside(cell.after(later), there, np.array([t]))
    assert then == pytest.approx(now, abs=1e-6)
    (wider,) = outside(cell.after(later, wider=300.0), there, np.array([t]))
    assert wider == pytest.approx(now - 300.0, abs=1e-6)


def test_a_grown_polygon_has_round_corners() -> None:
    grown = SQUARE.after(0.0, wider=1_000.0)
    beside = np.array([[-600.0, -800.0], [5_000.0, -1_000.0]])  # 1,000 m from a corner, from a side
    assert outside(grown, beside, np.zeros(2)) == pytest.approx(np.zeros(2), abs=1e-9)
    assert hypot(600.0, 800.0) == 1_000.0
