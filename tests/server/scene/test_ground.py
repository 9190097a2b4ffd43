"""The ground under a flight that has a place on the earth: where the coast and the airports are."""

import numpy as np
import pytest
from relguide_server.scene.flight_scene import FlightScene
from relguide_server.scene.ground import _AIRPORT, _box, _names, _overlap, earth
from relguide_server.scene.lettering import written
from viser import ViserServer

from relguide.planning.frames import LocalPlane
from tests.server.flown import ideal_flight
from tests.server.scene.test_flight_scene import nodes, viser_server

__all__ = ["viser_server"]

NEAR_NICE = LocalPlane(43.5, 7.0)
MID_ATLANTIC = LocalPlane(30.0, -45.0)


@pytest.mark.parametrize(
    ("name", "lon", "lat"),
    [("Cap Gris-Nez", 1.583, 50.869), ("Cape Agulhas", 20.0, -34.833), ("Dezhnev", -169.65, 66.08)],
)
def test_the_coast_is_where_the_world_has_it(name: str, lon: float, lat: float) -> None:
    ends = earth().coast.reshape(-1, 2)
    apart = np.hypot((ends[:, 0] - lon) * np.cos(np.radians(lat)), ends[:, 1] - lat)
    assert apart.min() * 111.2 < 3.0, name  # km


def test_airports_are_where_the_world_has_them() -> None:
    known = earth()
    lon, lat = known.sites[known.codes.index("LFPG")]
    assert (lon, lat) == pytest.approx((2.55, 49.01), abs=0.02)
    assert len(known.codes) > 7000


def test_no_line_is_drawn_where_the_map_is_cut() -> None:
    """Land is closed along the antimeridian and round the south pole; coasts are not there."""
    coast = earth().coast
    assert np.abs(coast[:, 0] - coast[:, 1]).max() < 10.0
    at_edge = np.abs(coast[:, :, 0]) > 179.98
    assert not np.any(at_edge.all(axis=1) & (np.abs(np.diff(coast[:, :, 1], axis=1)[:, 0]) > 0.5))


def test_coast_and_airports_lie_on_the_ground_near_the_flight(viser_server: ViserServer) -> None:
    FlightScene(viser_server, NEAR_NICE).draw(list(ideal_flight(duration=5.0, step=1.0)))
    for name, reach in (("coast", 900.0), ("airports", 400.0)):
        points = nodes(viser_server)[f"/world/{name}"].points
        assert len(points) > 100
        assert np.abs(points[:, :, 2]).max() < 0.1
        assert np.hypot(points[:, :, 0], points[:, :, 1]).max() < reach


@pytest.mark.parametrize("plane", [None, MID_ATLANTIC], ids=["nowhere", "at sea"])
def test_where_there_is_no_ground_none_is_drawn(
    viser_server: ViserServer, plane: LocalPlane | None
) -> None:
    FlightScene(viser_server, plane).draw(list(ideal_flight(duration=5.0, step=1.0)))
    assert "/world/coast" not in nodes(viser_server)
    assert "/world/airports" not in nodes(viser_server)


def test_letters_are_as_high_as_asked_and_stand_side_by_side() -> None:
    code = written("LFPG", 2.0)
    assert code[:, :, 1].min() == 0.0
    assert code[:, :, 1].max() == 2.0
    assert code[:, :, 0].max() < 4 * 2.0
    assert len(written("?", 2.0)) == 0
    for letter in "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789":
        assert len(written(letter, 1.0)) > 0


def test_no_name_of_an_airport_runs_over_another_or_over_a_mark() -> None:
    """Twenty airports within 120 km: each has a mark, those that have room have a name."""
    codes = [f"EG{a}{b}" for a in "ABCD" for b in "ABCDE"]
    rng = np.random.default_rng(7)
    sites = np.column_stack((rng.uniform(-60.0, 60.0, (len(codes), 2)), np.zeros(len(codes))))
    names = _names(codes, sites)
    marks = [_AIRPORT + site for site in sites]
    boxes = [_box(each) for each in names]
    assert 10 < len(names) <= len(codes)
    for k, box in enumerate(boxes):
        assert not any(_overlap(box, other) for other in boxes[k + 1 :])
        assert not any(_overlap(box, _box(mark)) for mark in marks)
