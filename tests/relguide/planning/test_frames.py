"""Frames: the slot frame by its definition, and latitude/longitude against the geodesic."""

from math import cos, hypot, pi, sin

import pytest
from hypothesis import given
from pyproj import Geod

from relguide import Situation
from relguide.planning.frames import LocalPlane
from relguide.planning.slot import slot_frame, slot_offset
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
