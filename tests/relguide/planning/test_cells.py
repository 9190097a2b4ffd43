"""Cells: which are refused, where they are later, and how far outside of them a place is."""

from dataclasses import replace
from math import hypot, pi

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from relguide import Cell, Disc, FlyStraight, Polygon
from relguide.kernels.separation.cell import signed_distance
from relguide.planning.cells import LEAST_AREA, outside
from relguide.planning.certificate import cell_shape
from relguide.planning.wind import CALM
from tests.skies import blocked, crossing

SQUARE = ((0.0, 0.0), (4e3, 0.0), (4e3, 4e3), (0.0, 4e3))


def test_a_polygon_is_kept_counter_clockwise_and_open() -> None:
    assert Polygon(corners=SQUARE).corners == SQUARE
    assert Polygon(corners=(*SQUARE, SQUARE[0])).corners == SQUARE
    assert Polygon(corners=SQUARE[::-1]).corners == SQUARE


@pytest.mark.parametrize(
    ("corners", "why"),
    [
        (SQUARE[:2], "must have 3 to 64 different corners, not 2"),
        (((0.0, 0.0), (1e3, 0.0), (2e3, 0.0)), "must go round an area: these lie on one line"),
        (((0.0, 0.0), (1e3, 1e3), (1e3, 0.0), (0.0, 1e3)), "or cross themselves"),
        (((0.0, 0.0), (4e3, 0.0), (1e3, 1e3), (0.0, 4e3)), "at \\(1000, 1000\\) m they turn back"),
        (
            ((0.0, 3.0), (-1.8, -2.4), (2.9, 0.9), (-2.9, 0.9), (1.8, -2.4)),
            "must go round once",
        ),
        ((*SQUARE[:3], (0.0,)), r"polygon.corners\[3\] must be \(east, north\)"),
        ((*SQUARE[:3], (0.0, 2e6)), r"polygon.corners\[3\] must lie in"),
        ("abc", "must be a tuple of"),
    ],
)
def test_what_is_no_convex_polygon_is_refused(
    corners: tuple[tuple[float, ...], ...], why: str
) -> None:
    if "once" in why:
        corners = tuple((1e3 * x, 1e3 * y) for x, y in corners)
    with pytest.raises(ValueError, match=why):
        Polygon(corners=corners)  # type: ignore[arg-type]


def test_the_least_area_is_a_square_metre() -> None:
    side = 1.01 * LEAST_AREA
    Polygon(corners=((0.0, 0.0), (side, 0.0), (side, side), (0.0, side)))
    with pytest.raises(ValueError, match="area"):
        Polygon(corners=((0.0, 0.0), (0.9, 0.0), (0.9, 0.9), (0.0, 0.9)))


@pytest.mark.parametrize(
    ("changes", "why"),
    [
        ({"ident": ""}, "cell.ident must have 1 to 24 printable characters"),
        ({"ident": "x" * 25}, "cell.ident must have 1 to 24 printable characters"),
        ({"shape": SQUARE}, "cell.shape must be"),
        ({"east": 151.0}, "cell.east must lie in -150 … 150 m/s"),
        ({"growth": -1.0}, "cell.growth must lie in 0 … 50 m/s"),
    ],
)
def test_cells_that_no_weather_is_are_refused(changes: dict[str, object], why: str) -> None:
    storm = Cell(ident="STORM", shape=Disc(x=0.0, y=0.0, radius=1e3))
    with pytest.raises(ValueError, match=why):
        replace(storm, **changes)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match=r"disc\.radius must lie in"):
        Disc(x=0.0, y=0.0, radius=0.0)


@pytest.mark.parametrize(
    ("changes", "why"),
    [
        ({"ident": " "}, "traffic.ident must have 1 to 24 printable characters"),
        ({"tas": 20.0}, "traffic.tas must lie in 30 … 400 m/s"),
        ({"heading": 90.0}, "Did you mean degrees"),
        ({"min_separation": 5}, "Did you mean 5 NM"),
        ({"intent": (1.0,)}, r"traffic.intent\[0\] must be"),
        ({"altitude": 30e3}, "traffic.altitude must lie in"),
    ],
)
def test_traffic_that_cannot_be_flown_is_refused(changes: dict[str, object], why: str) -> None:
    with pytest.raises(ValueError, match=why):
        replace(crossing(), **changes)  # type: ignore[arg-type]


def test_traffic_flies_what_it_declared() -> None:
    flown = replace(crossing(), intent=(FlyStraight(duration=10.0),)).trajectory
    assert flown.duration == pytest.approx(10.0)
    assert flown.pose_at(20.0).x == pytest.approx(-20e3 + 20.0 * 200.0)
    assert crossing().trajectory.pose_at(10.0).heading == pytest.approx(0.5 * pi)


def test_others_have_idents_of_their_own_and_are_not_too_many() -> None:
    with pytest.raises(ValueError, match="'CROSSING' is twice"):
        blocked(crossing(), crossing())
    with pytest.raises(ValueError, match="at most 100 members, not 101"):
        blocked(*(crossing(str(k)) for k in range(101)))
    with pytest.raises(ValueError, match=r"others\[1\]"):
        blocked(crossing(), "BAW12")  # type: ignore[arg-type]
    assert replace(blocked(), others=[crossing()]).others == (crossing(),)  # type: ignore[arg-type]


MOVING = Cell(
    ident="CB1",
    shape=Polygon(corners=((0.0, 0.0), (10_000.0, 0.0), (10_000.0, 8_000.0), (0.0, 8_000.0))),
    east=12.0,
    north=-5.0,
    growth=2.0,
)
ROUND = replace(MOVING, shape=Disc(x=1_000.0, y=2_000.0, radius=6_000.0))
PLACES = st.tuples(st.floats(-40_000.0, 40_000.0), st.floats(-40_000.0, 40_000.0))


@pytest.mark.parametrize("cell", [MOVING, ROUND], ids=["polygon", "disc"])
@given(place=PLACES, t=st.floats(0.0, 1_000.0))
def test_outside_is_what_the_kernels_say_of_the_place_seen_from_the_cell(
    cell: Cell, place: tuple[float, float], t: float
) -> None:
    corners, (radius, growth, east, north) = cell_shape(cell, CALM)
    x, y = place[0] - east * t, place[1] - north * t
    expected = signed_distance(x, y, corners, radius + growth * t)[0]
    (found,) = outside(cell, np.array([place]), np.array([t]))
    assert found == pytest.approx(expected, abs=1e-6)


@pytest.mark.parametrize("cell", [MOVING, ROUND], ids=["polygon", "disc"])
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
    grown = MOVING.after(0.0, wider=1_000.0)
    beside = np.array([[-600.0, -800.0], [5_000.0, -1_000.0]])  # 1,000 m from a corner, from a side
    assert outside(grown, beside, np.zeros(2)) == pytest.approx(np.zeros(2), abs=1e-9)
    assert hypot(600.0, 800.0) == 1_000.0
