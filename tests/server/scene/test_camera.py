"""Cameras of the scene: what must be seen is in the picture, whatever the shape of the window."""

from collections.abc import Iterator
from math import tan

import numpy as np
import pytest
from relguide_server.scene import shapes as shapes
from relguide_server.scene.camera import (
    CHASE,
    FOV,
    FREE,
    NEAREST,
    ROOM,
    SIDE,
    VIEWS,
    Cameras,
    Sights,
    Standpoint,
)
from viser import ViserServer


@pytest.fixture(scope="module")
def viser_server() -> Iterator[ViserServer]:
    server = ViserServer(host="127.0.0.1", port=0, verbose=False)
    yield server
    server.stop()


def pictured(eye: np.ndarray, middle: np.ndarray, places: np.ndarray, aspect: float) -> np.ndarray:
    """Where places are seen: −1 to 1 across and up, a camera with z up looking at the middle."""
    forward = (middle - eye) / np.linalg.norm(middle - eye)
    right = np.cross(forward, (0.0, 0.0, 1.0))
    right /= np.linalg.norm(right)
    away = places - eye
    depth = away @ forward
    assert (depth > 0.0).all()
    across = (away @ right) / (depth * aspect * tan(FOV / 2.0))
    return np.column_stack((across, (away @ np.cross(right, forward)) / (depth * tan(FOV / 2.0))))


def sights_of(own: np.ndarray, leader: np.ndarray, ahead: np.ndarray | None = None) -> Sights:
    """Both aircraft and a path, from the middle of the two; 5 NM round the leader."""
    places = np.vstack((own, leader, np.empty((0, 3)) if ahead is None else ahead))
    radii = np.zeros(len(places))
    radii[1] = 9.26
    return Sights(places, radii)


def seen_of(standpoint: Standpoint, places: np.ndarray, aspect: float) -> np.ndarray:
    return pictured(np.array(standpoint.eye), np.array(standpoint.target), places, aspect)


@pytest.mark.parametrize("aspect", [0.6, 1.6, 3.0])
@pytest.mark.parametrize("view", [view for view in VIEWS if view != FREE])
def test_both_aircraft_the_minimum_and_the_join_are_in_the_picture(
    viser_server: ViserServer, view: str, aspect: float
) -> None:
    rng = np.random.default_rng(7)
    for _ in range(20):
        cameras = Cameras(viser_server)
        x, y = rng.uniform(-60.0, 60.0, 2)
        own, leader = np.array((-x, -y, 19.0)), np.array((x, y, rng.uniform(10.0, 25.0)))
        ahead = np.column_stack((rng.uniform(-200.0, 200.0, (5, 2)), np.full(5, 19.0)))
        cameras.frame(sights_of(own, leader, ahead))
        around = leader + shapes.circle(9.26)
        feet = [own * (1, 1, 0), leader * (1, 1, 0)] if view == SIDE else []
        places = np.array([own, leader, *around, *ahead, *feet])
        standpoint = cameras.standpoint(view, aspect)
        seen = seen_of(standpoint, places, aspect)
        assert np.abs(seen).max() <= ROOM + 1e-9
        assert (np.abs(seen.max(axis=0) + seen.min(axis=0)) < 0.02).all()
        # no farther away than it must be: full from side to side, or up and down, or one is close
        forward = np.subtract(standpoint.target, standpoint.eye)
        depth = (places - standpoint.eye) @ forward / np.linalg.norm(forward)
        close = depth.min() < 1.001 * NEAREST
        assert close or np.ptp(seen, axis=0).max() > 1.9 * ROOM


def test_the_side_has_both_down_to_the_ground_and_the_heights_fill_it(
    viser_server: ViserServer,
) -> None:
    cameras = Cameras(viser_server)
    own, leader = np.array((-6.0, 0.0, 19.0)), np.array((6.0, 0.0, 19.0))
    cameras.frame(sights_of(own, leader))
    places = np.array([own, leader, own * (1, 1, 0), leader * (1, 1, 0)])
    seen = seen_of(cameras.standpoint(SIDE, 1.6), places, 1.6)
    assert np.abs(seen).max() <= ROOM + 1e-9
    assert np.ptp(seen[:, 1]) > ROOM


def test_the_chase_looks_over_own_ship_to_the_leader(viser_server: ViserServer) -> None:
    cameras = Cameras(viser_server)
    own, leader = np.array((-20.0, 10.0, 19.0)), np.array((20.0, -10.0, 19.0))
    cameras.frame(sights_of(own, leader))
    standpoint = cameras.standpoint(CHASE, 1.6)
    (own_x, own_y), (leader_x, leader_y) = seen_of(standpoint, np.array([own, leader]), 1.6)
    assert own_x == pytest.approx(0.0, abs=1e-9)
    assert leader_x == pytest.approx(0.0, abs=1e-9)
    assert own_y < 0.0 < leader_y


def test_aircraft_over_each_other_leave_the_camera_where_it_looked(
    viser_server: ViserServer,
) -> None:
    cameras = Cameras(viser_server)
    cameras.frame(sights_of(np.array((0.0, 0.0, 19.0)), np.array((0.0, 0.0, 10.0))))
    assert np.isfinite(cameras.standpoint(CHASE, 1.6).eye).all()
