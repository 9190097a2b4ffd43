"""Where the cameras of a scene are: all that matters is in the picture, until a viewer moves one.

The origin of the scene is the middle between the two aircraft. Each viewer has a view of its own
and a window of its own shape; the camera stands as near as both fields of view allow.
`web/src/scene/camera.ts` does the same for the picture that the page draws itself.
"""

from math import cos, hypot, sin, tan
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from viser import CameraHandle, ClientHandle, GuiEvent, ViserServer

from relguide.units import DEG

Vector = tuple[float, float, float]
Array = NDArray[np.float64]

FOV = 45.0 * DEG
"""Vertical field of view [rad]."""
ROOM = 0.76
"""What must be seen lies within this part of half the picture: texts have room beside it."""
CHASE = "Chase"
TOP = "Top"
SIDE = "Side"
FREE = "Free"
VIEWS = (CHASE, TOP, SIDE, FREE)
"""Behind own ship towards the leader; north up; from the right, down to the ground; where it is."""
STANDS = {CHASE: (0.0, 21.0 * DEG), SIDE: (65.0 * DEG, 9.0 * DEG)}
"""How far round from behind own ship to its right a camera stands, and how high [rad]."""
NEAREST = 10.0
"""No camera is nearer to anything than this [scene units] …"""
CLEAR = 8.0
"""… and to an aircraft so many halves of its length: it would fill the picture."""
MOVED = 0.004
"""A camera is moved when it would go this far, relative to its distance."""
SWING = 0.15
"""Share of a change of the line of sight that a camera follows at once: it does not jerk."""
SEEN_FROM = 0.5
SEEN_TO = 12_000.0
"""Nothing nearer or farther than these is drawn: the sky is at half the second."""
FARTHEST = 1400.0
"""Further out than this no hand moves the camera."""
HALVINGS = 10
"""The middle of the picture is found to a part in a thousand of its field."""
SHAPE = 1.6
"""Width of a window by its height, before its viewer has said so."""


class Standpoint(NamedTuple):
    """Where a camera is, and the point round which a hand turns it [scene units]."""

    eye: Vector
    target: Vector


class Sights(NamedTuple):
    """What belongs in the picture, from the middle of the two aircraft [scene units]."""

    places: Array
    """Own ship first, then the leader, then the path ahead; (n, 3)."""
    radii: Array
    """Of what lies flat round each, (n,)."""


class Cameras:
    """The cameras of one scene."""

    def __init__(self, server: ViserServer) -> None:
        self._server = server
        self._sight = (1.0, 0.0)
        self._sights = Sights(np.zeros((2, 3)), np.zeros(2))
        self._views: dict[int, str] = {}
        self._standpoints: dict[int, Standpoint] = {}
        self._initial: Standpoint | None = None
        server.initial_camera.fov = FOV
        server.initial_camera.near = SEEN_FROM
        server.initial_camera.far = SEEN_TO
        server.gui.set_panel_label("VIEW")
        for name in VIEWS:
            self._offer(name)

    def frame(self, sights: Sights) -> None:
        """Get both aircraft into the picture, the minimum round the leader and the path ahead."""
        self._sights = sights
        own, leader = sights.places[:2]
        self._look_along(float(leader[0] - own[0]), float(leader[1] - own[1]))
        clients = self._server.get_clients()
        self._standpoints = {k: was for k, was in self._standpoints.items() if k in clients}
        for client in clients.values():
            client.camera.max_orbit_distance = FARTHEST
            view = self._views.get(client.client_id, CHASE)
            if view == FREE:
                continue
            standpoint = self.standpoint(view, client.camera.aspect)
            if _is_far(standpoint, self._standpoints.get(client.client_id)):
                self._point(client, standpoint)
        standpoint = self.standpoint(CHASE, SHAPE)
        if _is_far(standpoint, self._initial):
            self._initial = standpoint
            self._server.initial_camera.position = standpoint.eye
            self._server.initial_camera.look_at = standpoint.target

    def standpoint(self, view: str, aspect: float) -> Standpoint:
        """Where the camera of a view stands, in a window so wide by its height."""
        if view == SIDE:  # down to the ground: heights are what this view is for
            feet = self._sights.places[:2] * (1.0, 1.0, 0.0)
            places, radii = self._sights
            sights = Sights(np.vstack((places, feet)), np.append(radii, (0.0, 0.0)))
        else:
            sights = self._sights
        return fit(np.array(self._direction(view)), sights, aspect)

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
        """From what is looked at to the camera, as a unit vector."""
        if view == TOP:
            return 0.0, -0.02, 0.9998
        x, y = self._sight
        round_, up = STANDS[view]
        behind, beside = cos(up) * cos(round_), cos(up) * sin(round_)
        return -x * behind + y * beside, -y * behind - x * beside, sin(up)

    def _offer(self, name: str) -> None:
        """A button in viser's panel, which the cockpit hides and presses from its own."""

        def show(event: GuiEvent[Any]) -> None:
            if event.client is not None:
                self._choose(event.client, name)

        self._server.gui.add_button(name).on_click(show)

    def _choose(self, client: ClientHandle, view: str) -> None:
        self._views[client.client_id] = view
        if view != FREE:
            self._point(client, self.standpoint(view, client.camera.aspect))

    def _point(self, client: ClientHandle, standpoint: Standpoint) -> None:
        self._standpoints[client.client_id] = standpoint
        camera: CameraHandle = client.camera
        with client.atomic():
            # In this order: a new position carries along what the camera looks at.
            camera.position = standpoint.eye
            camera.look_at = standpoint.target


def fit(away: Array, sights: Sights, aspect: float) -> Standpoint:
    """The nearest standpoint in a direction from which all sights are in the picture.

        |r·(P − E)| ≤ a f·(P − E)   ⇔   E·(±r − a f) ≥ P·(±r − a f),   a = tan of half the field

    for each place P, the eye E and the axes r (right) and f (forward), and so for up. A disc of
    radius ρ round P adds ρ times the level part of ±r − a f.

    Args:
        away: from what is looked at to the eye, a unit vector.
        sights: what must be seen.
        aspect: width of the window by its height.
    """
    forward = -away
    right = np.cross(forward, (0.0, 0.0, 1.0))
    right /= np.linalg.norm(right)
    up = np.cross(right, forward)
    high = ROOM * tan(FOV / 2.0)
    places, radii = sights
    middle = (places[0] + places[1]) / 2.0

    def reach(side: Array) -> float:
        return float(np.max((places - middle) @ side + radii * hypot(side[0], side[1])))

    def needed(axis: Array, field: float) -> float:
        return -(reach(axis - field * forward) + reach(-axis - field * forward)) / (2.0 * field)

    fields = ((right, high * aspect), (up, high))
    nearest = -reach(-forward) - max(NEAREST, CLEAR * radii[0])
    depth = min(nearest, *(needed(axis, field) for axis, field in fields))
    target = middle.copy()
    for axis, whole in fields:
        # The field that is just filled from there: its middle is the picture's.
        least, most = 0.0, whole
        for _ in range(HALVINGS):
            field = (least + most) / 2.0
            least, most = (least, field) if needed(axis, field) >= depth else (field, most)
        target += axis * (reach(axis - most * forward) - reach(-axis - most * forward)) / 2.0
    return Standpoint(_vector(target + depth * forward), _vector(target))


def _vector(place: Array) -> Vector:
    x, y, z = place.tolist()
    return x, y, z


def _is_far(standpoint: Standpoint, before: Standpoint | None) -> bool:
    if before is None:
        return True
    moved = [np.linalg.norm(np.subtract(*both)) for both in zip(standpoint, before, strict=True)]
    distance = np.linalg.norm(np.subtract(*before))
    return float(max(moved)) > MOVED * float(distance)
