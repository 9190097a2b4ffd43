"""One aircraft of the 3D scene: its shape, its tag, the line down to the ground, and its trail."""

import numpy as np
from viser import SceneApi

from relguide.flying.aircraft_documents import AircraftCard, AircraftSample
from relguide.units import FT, KT
from relguide_server import scene_shapes as shapes
from relguide_server.scene_paint import Colour, dim, label, lines
from relguide_server.scene_shapes import ALTITUDE_SCALE, KM

LENGTH = 54.0
"""Length of an A300 [m]."""
ENLARGED = 80.0
"""How much aircraft are drawn larger than they are: 54 m would be less than a pixel here."""
TRAIL_PERIOD = 4.0
"""Flight time between two points of a trail [s]."""
TRAIL_POINTS = 1200
"""Most points of a trail: 80 minutes."""
FOOT = 0.9
"""Half the cross where the line meets the ground [scene units]."""


class AircraftFigure:
    """What is drawn for one aircraft, under `/world/{name}`."""

    def __init__(
        self, scene: SceneApi, name: str, colour: Colour, card: AircraftCard, first: AircraftSample
    ) -> None:
        self._ident = card.ident
        self._height = height_of(first)
        self._trail = [place_of(first)]
        self._trail_t = -TRAIL_PERIOD
        root = f"/world/{name}"
        self._place = scene.add_frame(root, show_axes=False)
        self._body = scene.add_frame(f"{root}/body", show_axes=False)
        vertices, faces = shapes.airliner()
        scene.add_mesh_simple(
            f"{root}/body/mesh",
            vertices,
            faces,
            color=colour,
            flat_shading=True,
            side="double",
            scale=LENGTH / KM * ENLARGED,
            cast_shadow=False,
        )
        self._drop = lines(scene, f"{root}/drop", shapes.drop(self._height, FOOT), colour, 1.2)
        self._tag = label(scene, f"{root}/tag", card.ident, (0, 0, 2.0), "bottom-center", size=1.2)
        self._level = label(
            scene, f"{root}/level", "", (0.3, 0, -0.5 * self._height), "center-left"
        )
        nothing, faint = np.zeros((1, 2, 3)), dim(colour, 0.6)
        self._past = lines(scene, f"/world/{name}_trail", nothing, faint, 2.2)
        self._recent = lines(scene, f"/world/{name}_recent", nothing, faint, 2.2)

    def move(self, now: AircraftSample, t: float) -> None:
        """Show the aircraft as it is at flight time t [s]."""
        here, height = place_of(now), height_of(now)
        self._place.position = here
        self._body.wxyz = shapes.attitude(now.heading, now.bank)
        self._tag.text = f"{self._ident} · {now.ground_speed / KT:.0f} kt"
        self._level.text = f"FL{now.altitude / FT / 100.0:03.0f}"
        if abs(height - self._height) > 0.02:  # 10 m of altitude: a new line is one small message
            self._height = height
            self._drop.points = shapes.drop(height, FOOT).astype(np.float32)
            self._level.position = (0.3, 0.0, -0.5 * height)
        # The long part of the trail is sent only when it grows; what moves is one segment.
        if t - self._trail_t >= TRAIL_PERIOD:
            self._trail_t = t
            self._trail = [*self._trail[1 - TRAIL_POINTS :], here]
            self._past.points = shapes.polyline(np.array(self._trail)).astype(np.float32)
        self._recent.points = np.array([[self._trail[-1], here]], dtype=np.float32)


def height_of(now: AircraftSample) -> float:
    """Height in the scene [scene units]."""
    return now.altitude / KM * ALTITUDE_SCALE


def place_of(now: AircraftSample) -> tuple[float, float, float]:
    """Position in the scene [scene units]."""
    return now.x / KM, now.y / KM, height_of(now)
