"""Where the cameras of a scene are: both aircraft are in the picture, until a viewer moves one.

The origin of the scene is the middle between the two aircraft. Each viewer has a view of its own
and a window of its own shape; the camera stands as near as both fields of view allow.
"""

from math import cos, hypot, sin, tan
from typing import Any

import numpy as np
from numpy.typing import NDArray
from viser import CameraHandle, ClientHandle, GuiEvent, ViserServer

from relguide.units import DEG

Vector = tuple[float, float, float]
Array = NDArray[np.float64]

FOV = 45.0 * DEG
"""Vertical field of view [rad]."""
ROOM = 0.74
"""What must be seen lies within this part of half the picture: texts have room beside it."""
CHASE = "Chase"
FREE = "Free"
VIEWS = (CHASE, "Top", "Side", FREE)
"""Behind own ship towards the leader; north up; with both aircraft side by side; where it is."""
ELEVATION = {CHASE: 21.0 * DEG, "Side": 4.0 * DEG}
LEAST_REACH = 12.0
"""Nearer than this [scene units] the picture would show the aircraft and nothing else."""
MOVED = 0.004
"""A camera is moved when it would go this far, relative to its distance."""
SWING = 0.15
"""Share of a change of the line of sight that a camera follows at once: it does not jerk."""
ROUND = np.array(
    [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (-1.0, 0.0, 0.0), (0.0, -1.0, 0.0)]
)
"""The middle of a circle, and points on it."""
SEEN_TO = 2000.0
FARTHEST = 0.7 * SEEN_TO
"""Beyond the one nothing is drawn, and further out than the other no hand moves the camera."""
SHAPE = 1.6
"""Width of a window by its height, before its viewer has said so."""


class Cameras:
    """The cameras of one scene."""

    def __init__(self, server: ViserServer) -> None:
        self._server = server
        self._sight = (1.0, 0.0)
        self._middle: Vector = (0.0, 0.0, 0.0)
        self._places: Array = np.zeros((1, 3))
        self._views: dict[int, str] = {}
        self._eyes: dict[int, Vector] = {}
        self._initial: Vector | None = None
        server.initial_camera.fov = FOV
        server.initial_camera.far = SEEN_TO
        server.gui.set_panel_label("VIEW")
        for name in VIEWS:
            self._offer(name)

    def frame(self, own: Vector, leader: Vector, radius: float) -> None:
        """Get both aircraft into the picture, and the minimum round the leader [scene units]."""
        self._look_along(leader[0] - own[0], leader[1] - own[1])
        self._middle = (0.0, 0.0, (own[2] + leader[2]) / 2.0)
        self._places = np.array([own, *(leader + radius * ROUND)]) - self._middle
        clients = self._server.get_clients()
        self._eyes = {key: eye for key, eye in self._eyes.items() if key in clients}
        for client in clients.values():
            client.camera.max_orbit_distance = FARTHEST
            view = self._views.get(client.client_id, CHASE)
            if view == FREE:
                continue
            eye = self.eye(view, client.camera.aspect)
            if _is_far(eye, self._eyes.get(client.client_id)):
                self._eyes[client.client_id] = eye
                self._point(client.camera, eye)
        eye = self.eye(CHASE, SHAPE)
        if _is_far(eye, self._initial):
            self._initial = eye
            self._server.initial_camera.position = eye
            self._server.initial_camera.look_at = self._middle

    def eye(self, view: str, aspect: float) -> Vector:
        """Where the camera of a view stands, in a window so wide by its height [scene units].

        |r·P| ≤ tan(h) (d + f·P),  |u·P| ≤ tan(v) (d + f·P)   for every place P in the picture
        """
        away = np.array(self._direction(view))
        forward = -away
        right = np.cross(forward, (0.0, 0.0, 1.0))
        right /= np.linalg.norm(right)
        up = np.cross(right, forward)
        high = ROOM * tan(FOV / 2.0)
        depth = self._places @ forward
        needed = np.maximum(
            np.abs(self._places @ right) / (high * aspect), np.abs(self._places @ up) / high
        )
        distance = max(float(np.max(needed - depth)), LEAST_REACH / tan(FOV / 2.0))
        x, y, z = away * distance + self._middle
        return float(x), float(y), float(z)

    def _look_along(self, x: float, y: float) -> None:
        """Turn the line of sight from own ship to the leader towards where it is now."""
        length = hypot(x, y)
        if length < 1e-6:  # one over the other: as before
            return
        was_x, was_y = self._sight
        share = SWING if self._initial is not None else 1.0
        x, y = was_x + share * (x / length - was_x), was_y + share * (y / length - was_y)
        length = hypot(x, y)
        # opposite to what it was: no way round is the shorter one
        self._sight = (x / length, y / length) if length > 1e-3 else (-was_y, was_x)

    def _direction(self, view: str) -> Vector:
        """From the middle of the two aircraft to the camera, as a unit vector."""
        x, y = self._sight
        if view == "Top":
            return 0.0, -0.02, 0.9998
        across, level = cos(ELEVATION[view]), sin(ELEVATION[view])
        if view == CHASE:
            return -x * across, -y * across, level
        return y * across, -x * across, level

    def _offer(self, name: str) -> None:
        """A button in viser's panel, which the cockpit hides and presses from its own."""

        def show(event: GuiEvent[Any]) -> None:
            if event.client is not None:
                self._choose(event.client, name)

        self._server.gui.add_button(name).on_click(show)

    def _choose(self, client: ClientHandle, view: str) -> None:
        self._views[client.client_id] = view
        if view != FREE:
            eye = self.eye(view, client.camera.aspect)
            self._eyes[client.client_id] = eye
            self._point(client.camera, eye)

    def _point(self, camera: CameraHandle, eye: Vector) -> None:
        with camera.client.atomic():
            # In this order: a new position carries along what the camera looks at.
            camera.position = eye
            camera.look_at = self._middle


def _is_far(eye: Vector, before: Vector | None) -> bool:
    if before is None:
        return True
    away = np.subtract(eye, before)
    return float(np.linalg.norm(away)) > MOVED * float(np.linalg.norm(before))
