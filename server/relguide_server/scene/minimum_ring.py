"""The minimum separation round the leader in the 3D scene, and what is kept beside it."""

import numpy as np
from viser import SceneApi, SceneNodeHandle

from relguide.flying.aircraft_documents import GuidanceSample
from relguide.units import Metre, Second
from relguide_server.scene import paint as paint
from relguide_server.scene import shapes as shapes
from relguide_server.scene.paint import Colour, lines
from relguide_server.scene.shapes import KM

WALL = 0.8
"""Half the height of the cylinder of radius d_min [scene units]; separation is horizontal."""
THIN = (1.6, 1.0)
MARGIN = (0.5, 0.8)
"""Dashes and gaps of the minimum, and of what is kept beside it [scene units]."""
STEP = 50.0
"""Circles that differ by less look the same [m]."""
GRAZE = 20.0
"""Plans may graze d_min: this much below it is no loss yet [m]."""
STALE: Second = 5.0
"""Reports older than this no longer tell where the leader is …"""
GONE: Second = 24.0
"""… and older than this they tell nothing: as on the navigation display [s]."""
ASTRAY = 0.5 * 9.81 * 0.466
"""How far a leader may be from where it is drawn: as if it turned since, at 25° of bank [m/s²]."""


class MinimumRing:
    """What is drawn under `/world/leader` for the minimum."""

    def __init__(self, scene: SceneApi) -> None:
        self._scene = scene
        self._drawn: tuple[Colour, Metre, Metre] | None = None
        self._handles: list[SceneNodeHandle] = []
        self.reach = 0.0
        """Radius of the outermost circle that is drawn [scene units]."""

    def draw(self, guidance: GuidanceSample, min_separation: Metre) -> None:
        """Both circles, as they are now."""
        if min_separation <= 0.0:
            return
        colour = separation_colour(guidance, min_separation)
        is_shown = guidance.engagement != "off" or colour != paint.LEADER
        self._show(is_shown)
        astray = ASTRAY * guidance.leader_age**2 if guidance.leader_age > STALE else 0.0
        radius, margin = min_separation + _stepped(astray), _stepped(guidance.margin)
        if self._drawn == (colour, radius, margin):
            return
        self._drawn = (colour, radius, margin)
        self.reach = (radius + margin) / KM
        cylinder = self._scene.add_cylinder(
            "/world/leader/min_separation",
            radius / KM,
            2.0 * WALL,
            colour,
            opacity=0.18 if colour == paint.ALERT else 0.1,
            radial_segments=72,
            side="double",
            cast_shadow=False,
            receive_shadow=False,
        )
        edges = [_edge(radius, z, colour == paint.ALERT) for z in (WALL, -WALL)]
        wide = 3.0 if colour == paint.ALERT else 1.5
        edge = lines(self._scene, "/world/leader/edge", np.concatenate(edges), colour, wide)
        self._handles = [cylinder, edge]
        if margin > 0.0:
            beside = shapes.dashes(shapes.circle((radius + margin) / KM), MARGIN)
            circle = lines(self._scene, "/world/leader/margin", beside, paint.LEADER, 1.0)
            self._handles.append(circle)
        else:
            self._scene.remove_by_name("/world/leader/margin")
        self._show(is_shown)

    def _show(self, is_shown: bool) -> None:
        for handle in self._handles:
            if handle.visible != is_shown:
                handle.visible = is_shown


def separation_colour(guidance: GuidanceSample, min_separation: Metre) -> Colour:
    """Red where the minimum is lost, amber where it will be."""
    if guidance.separation < min_separation - GRAZE:
        return paint.ALERT
    return paint.CAUTION if guidance.alert in ("caution", "warning") else paint.LEADER


def leader_colour(guidance: GuidanceSample, min_separation: Metre) -> Colour:
    """Red where the minimum is lost, amber where the leader's reports are old."""
    if guidance.separation < min_separation - GRAZE:
        return paint.ALERT
    return paint.CAUTION if guidance.leader_age > STALE else paint.LEADER


def _edge(radius: Metre, z: float, lost: bool) -> shapes.Points:
    """A circle: dashed, and whole once the minimum is lost."""
    points = shapes.circle(radius / KM, z)
    return shapes.polyline(points) if lost else shapes.dashes(points, THIN)


def _stepped(radius: Metre) -> Metre:
    return STEP * round(radius / STEP)
