"""Frames: the slot frame by its definition, and latitude/longitude against the geodesic."""

from math import cos, hypot, pi, sin

import numpy as np
import pytest
from hypothesis import given
from pyproj import Geod

from relguide import Situation
from relguide.planning.frames import LocalPlane, middle_of
from relguide.planning.slot import slot_frame, slot_offset
from relguide.units import DEG
from tests.situations import numbers, situations


@given(situation=situations())
def test_the_slot_frame_gives_back_the_pursuer(situation: Situation) -> None:
    frame = slot_frame(situation, situation.leader.trajectory)
    along, left = frame.x * frame.radius, frame.y * frame.radius
    x = frame.origin_x + along * sin(frame.heading) - left * cos(frame.heading)
    y = frame.origin_y + along * cos(frame.heading) + left * sin(frame.heading)
    assert (x, y) == pytest.approx((situation.pursuer.x, situation.pursuer.y), abs=1e-6)
    back = (frame.heading - frame.h - situation.pursuer.heading) % (2.0 * pi)
    assert min(back, 2.0 * pi - back) == pytest.approx(0.0, abs=1e-9)


@given(situation=situations())
def test_once_open_the_slot_is_d_behind_the_leader_over_the_ground(situation: Situation) -> None:
    leader = situation.leader.trajectory
    frame = slot_frame(situation, leader)
    t = leader.duration + 400.0
    there = leader.pose_at(t)
    x = frame.origin_x + leader.tas * t * sin(frame.heading)
    y = frame.origin_y + leader.tas * t * cos(frame.heading)
    assert hypot(x - there.x, y - there.y) == pytest.approx(situation.slot_distance, abs=1e-5)
    east, north, ground_speed = slot_offset(there.heading, leader.tas, situation)
    later, wind = leader.pose_at(t + 1.0), situation.wind
    flown = (later.x - there.x + wind.east, later.y - there.y + wind.north)
    assert hypot(*flown) == pytest.approx(ground_speed, abs=1e-6)
    # behind: against the ground track
    assert east * flown[0] + north * flown[1] == pytest.approx(
        -situation.slot_distance * ground_speed, rel=1e-6
    )


@given(
    lat=numbers(-80.0, 80.0),
    lon=numbers(-179.0, 179.0),
    x=numbers(-3e5, 3e5),
    y=numbers(-3e5, 3e5),
)
def test_the_local_plane_is_true_from_its_centre(
    lat: float, lon: float, x: float, y: float
) -> None:
    plane = LocalPlane(lat, lon)
    there_lat, there_lon = plane.to_geodetic(x, y)
    azimuth, _, distance = Geod(ellps="WGS84").inv(lon, lat, there_lon, there_lat)
    assert distance == pytest.approx(hypot(x, y), abs=1e-3)
    if distance > 1.0:
        assert distance * sin(azimuth * pi / 180.0) == pytest.approx(x, abs=1e-2)
    assert plane.to_local(there_lat, there_lon) == pytest.approx((x, y), abs=1e-3)


@given(
    lat=numbers(-80.0, 80.0),
    lon=numbers(-179.0, 179.0),
    x=numbers(-3e5, 3e5),
    y=numbers(-3e5, 3e5),
)
def test_a_direction_of_the_earth_is_turned_to_the_planes(
    lat: float, lon: float, x: float, y: float
) -> None:
    """A step on a true course is a step of the plane on the course and the meridian's turn."""
    plane, course = LocalPlane(lat, lon), 1.0
    there = plane.to_geodetic(x, y)
    beyond_lon, beyond_lat, _ = Geod(ellps="WGS84").fwd(there[1], there[0], course / DEG, 10.0)
    step_x, step_y = plane.to_local(beyond_lat, beyond_lon)
    x, y = plane.to_local(*there)
    turned = course + plane.meridian(*there)
    along = (step_x - x) * sin(turned) + (step_y - y) * cos(turned)
    across = (step_x - x) * cos(turned) - (step_y - y) * sin(turned)
    assert along == pytest.approx(10.0, rel=2e-3)
    assert across == pytest.approx(0.0, abs=0.02)


def test_arrays_are_as_numbers_are() -> None:
    plane = LocalPlane(51.0, -179.0)
    lat, lon = np.array([50.0, 51.0, 52.0]), np.array([179.5, -179.0, -178.0])
    x, y = plane.to_local_each(lat, lon)
    assert list(zip(x, y, strict=True)) == [
        plane.to_local(*place) for place in zip(lat, lon, strict=True)
    ]
    assert np.column_stack(plane.to_geodetic_each(x, y)) == pytest.approx(
        np.column_stack((lat, lon)), abs=1e-6
    )
    assert plane.meridian_each(lat, lon) == pytest.approx(
        [plane.meridian(*place) for place in zip(lat, lon, strict=True)]
    )


@pytest.mark.parametrize(
    ("lats", "lons", "lat", "lon"),
    [
        ((48.0, 48.0, 48.0), (2.0, 2.1, 2.2), 48.0, 2.1),
        ((48.0, 48.0, 48.0), (179.9, 180.0, -179.9), 48.0, 180.0),
        ((48.0, 48.0, 48.0, -33.0, 48.0), (2.0, 2.0, 2.0, 151.0, 2.0), 48.0, 2.0),
        ((89.9, 90.0, 89.9), (20.0, 20.0, -160.0), 90.0, None),
    ],
)
def test_the_middle_knows_no_seam_and_no_pole(
    lats: tuple[float, ...], lons: tuple[float, ...], lat: float, lon: float | None
) -> None:
    plane = middle_of(np.array(lats), np.array(lons))
    assert plane.lat_deg == pytest.approx(lat, abs=1e-3)
    if lon is not None:
        assert (plane.lon_deg - lon + 180.0) % 360.0 == pytest.approx(180.0, abs=1e-3)
