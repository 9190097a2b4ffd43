"""Cells and traffic that no situation may have are refused, in a sentence that says why."""

from dataclasses import replace
from math import pi

import pytest

from relguide import Cell, Disc, FlyStraight, Polygon
from relguide.planning.cells import LEAST_AREA
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
        (((0.0, 0.0), (1e3, 0.0), (2e3, 0.0)), "lie on one line: a cell must have an area"),
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
