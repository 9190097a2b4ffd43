"""Where the cameras of a scene are: both aircraft are in the picture, until a viewer moves one.

The origin of the scene is the middle between the two aircraft, so a camera that stands still
follows them. As they close in, each camera that is still where we put it comes nearer; one that was
moved by hand stays until a view is chosen again.
"""

from math import tan
from typing import Any

import numpy as np
from viser import CameraHandle, ClientHandle, GuiEvent, ViserServer

from relguide.units import DEG

Vector = tuple[float, float, float]

FOV = 45.0 * DEG
"""Vertical field of view [rad]."""
VIEWS: dict[str, Vector] = {
    "Overview": (0.0, -0.85, 0.53),
    "From above": (0.0, -0.02, 1.0),
    "From the side": (0.0, -1.0, 0.02),
}
"""Directions from the middle of the two aircraft to the camera; north is up or ahead in all."""
LEAST_REACH = 12.0
"""Nearer than this [scene units] the picture would show the aircraft and nothing else."""
REFIT = 0.02
"""A change of the reach by this share is worth moving the cameras."""
STILL = 0.01
"""A camera this near to where we put it, relative to its distance, has not been moved by hand."""


class Cameras:
    """The cameras of one scene."""

    def __init__(self, server: ViserServer) -> None:
        self._server = server
        self._reach = 0.0
        self._height = 0.0
        self._views: dict[int, Vector] = {}
        server.initial_camera.fov = FOV
        server.initial_camera.far = 2000.0
        server.gui.set_panel_label("VIEW")
        for name, direction in VIEWS.items():
            self._offer(name, direction)

    def frame(self, separation: float, height: float) -> None:
        """Get both aircraft into the picture.

        Args:
            separation: between them [scene units].
            height: of the leader [scene units].
        """
        reach = max(0.7 * separation, LEAST_REACH)
        if abs(reach - self._reach) < REFIT * reach:
            return
        still = [client for client in self._server.get_clients().values() if self._is_still(client)]
        self._reach, self._height = reach, height
        for client in still:
            self._point(client.camera, self._view_of(client))
        initial = self._server.initial_camera
        initial.position = self._eye(VIEWS["Overview"])
        initial.look_at = self._middle()

    def _offer(self, name: str, direction: Vector) -> None:
        """A button in viser's panel, which the cockpit hides and presses from its own."""

        def show(event: GuiEvent[Any]) -> None:
            if event.client is not None:
                self._views[event.client.client_id] = direction
                self._point(event.client.camera, direction)

        self._server.gui.add_button(name).on_click(show)

    def _view_of(self, client: ClientHandle) -> Vector:
        return self._views.get(client.client_id, VIEWS["Overview"])

    def _is_still(self, client: ClientHandle) -> bool:
        eye = np.array(self._eye(self._view_of(client)))
        away = float(np.linalg.norm(client.camera.position - eye))
        return away < STILL * float(np.linalg.norm(eye))

    def _point(self, camera: CameraHandle, direction: Vector) -> None:
        with camera.client.atomic():
            # In this order: a new position carries along what the camera looks at.
            camera.position = self._eye(direction)
            camera.look_at = self._middle()

    def _middle(self) -> Vector:
        return 0.0, 0.0, 0.6 * self._height

    def _eye(self, direction: Vector) -> Vector:
        distance = self._reach / tan(FOV / 2.0)
        x, y, z = (part * distance for part in direction)
        return x, y, z + self._middle()[2]
