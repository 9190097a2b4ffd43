"""One aircraft of the 3D scene: its shape, the line down to the ground, and where it has been."""

from math import cos, sin

import numpy as np
from viser import LineSegmentsHandle, SceneApi

from relguide.flying.aircraft_documents import AircraftSample
from relguide.units import FT, Metre, Second
from relguide_server.scene import shapes as shapes
from relguide_server.scene.paint import Colour, dim, lines
from relguide_server.scene.shapes import ALTITUDE_SCALE, KM, Points

LENGTH = 54.0
"""Length of an A300 [m]."""
ENLARGED = 100.0
"""How much aircraft are drawn larger than they are at most: 54 m would be less than a pixel …"""
SHARE = 0.3
"""… and never longer than this share of their separation: what does not touch is not drawn so."""
ENLARGED_STEP = 5.0
"""The page writes how much it is: in whole steps."""
LEVELS = 10_000.0 * FT
"""From one mark of the altitude scale to the next, on the lines down to the ground [m] …"""
HIDDEN = 0.3
"""… and none so near below the aircraft [levels]."""
TRAIL_PERIOD = 10.0
"""Flight time between two marks of where an aircraft has been [s], as on the navigation display."""
TRAIL_MARKS = 480
"""Most of them: 80 minutes."""
MARK = 0.25
"""Length of a mark [scene units]: the past is marks apart from each other, never a line."""
FOOT = 0.9
"""Half the cross where the line meets the ground [scene units]."""


class AircraftFigure:
    """What is drawn for one aircraft, under `/world/{name}`."""

    def __init__(self, scene: SceneApi, name: str, colour: Colour, first: AircraftSample) -> None:
        self._scene = scene
        self._root = f"/world/{name}"
        self._height = height_of(first)
        self._colour = colour
        self._marks: list[Points] = []
        self._marked_t = -TRAIL_PERIOD
        root = self._root
        self._place = scene.add_frame(root, show_axes=False)
        self._body = scene.add_frame(f"{root}/body", show_axes=False)
        vertices, faces = shapes.airliner()
        self._mesh = scene.add_mesh_simple(
            f"{root}/body/mesh",
            vertices,
            faces,
            color=colour,
            flat_shading=True,
            side="double",
            scale=LENGTH / KM * ENLARGED,
            cast_shadow=False,
        )
        self._drop = self._draw_drop()
        self._past = lines(scene, f"/world/{name}_past", np.zeros((1, 2, 3)), dim(colour, 0.7), 2.5)

    def show(self, colour: Colour, enlarged: float) -> None:
        """Give it a colour, and its size in the picture."""
        if colour != self._colour:
            self._colour = self._mesh.color = colour
            self._drop = self._draw_drop()
        scale = LENGTH / KM * enlarged
        if self._mesh.scale != scale:
            self._mesh.scale = scale

    def _draw_drop(self) -> LineSegmentsHandle:
        return lines(self._scene, f"{self._root}/drop", _drop(self._height), self._colour, 1.2)

    def hide(self, hidden: bool) -> None:
        """Take it out of the picture with all that hangs on it, or put it back."""
        self._place.visible = not hidden

    def move(self, now: AircraftSample) -> None:
        """Show the aircraft as it is."""
        here, height = place_of(now), height_of(now)
        self._place.position = here
        self._body.wxyz = shapes.attitude(now.heading, now.bank)
        if abs(height - self._height) > 0.02:  # 10 m of altitude: a new line is one small message
            self._height = height
            self._drop.points = _drop(height).astype(np.float32)

    def mark(self, now: AircraftSample, t: Second) -> None:
        """Leave a mark where it is at flight time t, if it is time for one."""
        if t - self._marked_t < TRAIL_PERIOD:
            return
        self._marked_t = t
        here, back = place_of(now), (-MARK * sin(now.track), -MARK * cos(now.track), 0.0)
        self._marks = [*self._marks[1 - TRAIL_MARKS :], np.array([here, np.add(here, back)])]
        self._past.points = np.array(self._marks, dtype=np.float32)


def enlargement(separation: Metre) -> float:
    """How much both aircraft are drawn larger than they are."""
    steps = SHARE * separation / LENGTH // ENLARGED_STEP
    return max(ENLARGED_STEP, min(ENLARGED, ENLARGED_STEP * steps))


def _drop(height: float) -> Points:
    """The line down to the ground, with a cross at each level that the aircraft does not hide."""
    step = LEVELS / KM * ALTITUDE_SCALE
    return shapes.drop(height, FOOT, np.arange(step, height - HIDDEN * step, step).tolist())


def height_of(now: AircraftSample) -> float:
    """Height in the scene [scene units]."""
    return now.altitude / KM * ALTITUDE_SCALE


def place_of(now: AircraftSample) -> tuple[float, float, float]:
    """Position in the scene [scene units]."""
    return now.x / KM, now.y / KM, height_of(now)
