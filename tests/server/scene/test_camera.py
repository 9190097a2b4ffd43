"""Cameras of the scene: what must be seen is in the picture, whatever the shape of the window."""

from collections.abc import Iterator
from math import tan

import numpy as np
import pytest
from relguide_server.scene.camera import FOV, FREE, ROOM, VIEWS, Cameras
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


@pytest.mark.parametrize("aspect", [0.6, 1.6, 3.0])
@pytest.mark.parametrize("view", [view for view in VIEWS if view != FREE])
def test_both_aircraft_and_the_minimum_are_in_the_picture(
    viser_server: ViserServer, view: str, aspect: float
) -> None:
    rng = np.random.default_rng(7)
    for _ in range(20):
        cameras = Cameras(viser_server)
        x, y = rng.uniform(-60.0, 60.0, 2)
        own, leader = np.array((-x, -y, 19.0)), np.array((x, y, rng.uniform(10.0, 25.0)))
        cameras.frame(tuple(own), tuple(leader), 9.26)
        around = [leader + 9.26 * np.array((dx, dy, 0.0)) for dx, dy in ((1, 0), (0, -1))]
        eye, middle = (
            np.array(cameras.eye(view, aspect)),
            np.array((0.0, 0.0, (own + leader)[2] / 2)),
        )
        seen = pictured(eye, middle, np.array([own, leader, *around]), aspect)
        assert np.abs(seen).max() <= ROOM + 1e-9
        if np.hypot(x, y) > 30.0:  # no farther away than it must be
            assert np.abs(seen).max() > 0.5 * ROOM


def test_the_chase_looks_over_own_ship_to_the_leader(viser_server: ViserServer) -> None:
    cameras = Cameras(viser_server)
    own, leader = np.array((-20.0, 10.0, 19.0)), np.array((20.0, -10.0, 19.0))
    cameras.frame(tuple(own), tuple(leader), 9.0)
    eye, middle = np.array(cameras.eye("Chase", 1.6)), np.array((0.0, 0.0, 19.0))
    (own_x, own_y), (leader_x, leader_y) = pictured(eye, middle, np.array([own, leader]), 1.6)
    assert own_x == pytest.approx(0.0, abs=1e-9)
    assert leader_x == pytest.approx(0.0, abs=1e-9)
    assert own_y < 0.0 < leader_y


def test_aircraft_over_each_other_leave_the_camera_where_it_looked(
    viser_server: ViserServer,
) -> None:
    cameras = Cameras(viser_server)
    cameras.frame((0.0, 0.0, 19.0), (0.0, 0.0, 10.0), 0.0)
    assert np.isfinite(cameras.eye("Chase", 1.6)).all()
