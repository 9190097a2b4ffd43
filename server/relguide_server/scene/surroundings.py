"""What is about the two in the 3D scene: other aircraft, and weather cells as columns.

A cell reaches from the ground to above all that flies: a plan keeps out of it at any level.
"""

from collections.abc import Sequence
from math import atan2, ceil, cos, pi, sin, tau

import numpy as np
from viser import FrameHandle, SceneApi

from relguide.flying.aircraft_documents import AircraftSample, AlertLevel, CellCard, LinkCard
from relguide.flying.documents import Alert
from relguide.units import DEG, Metre, Second
from relguide_server.scene import paint as paint
from relguide_server.scene import shapes as shapes
from relguide_server.scene.aircraft import AircraftFigure
from relguide_server.scene.extrapolation import carry
from relguide_server.scene.paint import Colour, lines
from relguide_server.scene.shapes import ALTITUDE_SCALE, KM, Points

TOP: Metre = 13_000.0
"""Height of a column: above the levels of airliners [m]."""
ROUND = 12.0 * DEG
"""Chords of a round edge [rad]."""
GROWN: Metre = 100.0
"""A column that has grown by so much is drawn anew [m]."""
URGENT: dict[AlertLevel, Colour] = {"caution": paint.CAUTION, "warning": paint.ALERT}


class Surroundings:
    """All aircraft but the two, and all cells, under `/world`."""

    def __init__(self, scene: SceneApi, link: LinkCard, cells: Sequence[CellCard]) -> None:
        self._scene = scene
        self._two = (link.pursuer, link.leader)
        self._figures: dict[str, AircraftFigure] = {}
        self._columns = [_Column(scene, number, cell) for number, cell in enumerate(cells)]
        self._colours: dict[tuple[str, str], Colour] = {}
        self._others: list[AircraftSample] = []

    def warn(self, alert: Alert) -> None:
        """Colour what an alert is about, or give it its own colour again."""
        key = (alert.other, alert.subject)
        if alert.cleared or alert.level not in URGENT:
            self._colours.pop(key, None)
        else:
            self._colours[key] = URGENT[alert.level]

    @property
    def are_all_alerts(self) -> bool:
        """Whether alerts stand, and none of them is about the leader."""
        return bool(self._colours) and all(other not in self._two for other, _ in self._colours)

    def draw(self, t: Second, aircraft: Sequence[AircraftSample], enlarged: float) -> None:
        """Show all as they are at flight time t [s], aircraft so many times as large."""
        self._others = [each for each in aircraft if each.ident not in self._two]
        for each in self._others:
            if each.ident not in self._figures:
                name = f"others/{len(self._figures)}"
                self._figures[each.ident] = AircraftFigure(self._scene, name, paint.TRAFFIC, each)
            colour = self._colour(each.ident, paint.TRAFFIC)
            self._figures[each.ident].show(colour, enlarged)
        for column in self._columns:
            column.draw(t, self._colour(column.ident, paint.CELL))
        self.move(0.0)

    def move(self, ahead: Second) -> None:
        """Carry the other aircraft on from where they were drawn."""
        for each in self._others:
            self._figures[each.ident].move(carry(each, ahead))

    def _colour(self, ident: str, plain: Colour) -> Colour:
        found = [colour for (other, _), colour in self._colours.items() if other == ident]
        return paint.ALERT if paint.ALERT in found else next(iter(found), plain)


class _Column:
    """One cell, from the ground to the top."""

    def __init__(self, scene: SceneApi, number: int, cell: CellCard) -> None:
        self._scene = scene
        self._cell = cell
        self._root = f"/world/cells/{number}"
        self._place: FrameHandle = scene.add_frame(self._root, show_axes=False)
        self._drawn: tuple[Metre, Colour] | None = None

    @property
    def ident(self) -> str:
        return self._cell.ident

    def draw(self, t: Second, colour: Colour) -> None:
        cell = self._cell
        self._place.position = (cell.east * t / KM, cell.north * t / KM, 0.0)
        radius = cell.radius + cell.growth * max(0.0, t)
        if self._drawn and self._drawn[1] == colour and radius - self._drawn[0] < GROWN:
            return
        self._drawn = (radius, colour)
        edge = edge_of(cell, radius) / KM
        high = TOP / KM * ALTITUDE_SCALE
        n = len(edge)
        below = np.column_stack((edge, np.zeros(n)))
        above = np.column_stack((edge, np.full(n, high)))
        k = np.arange(n)
        after = (k + 1) % n
        walls = np.concatenate(
            (np.column_stack((k, after, n + after)), np.column_stack((k, n + after, n + k)))
        )
        self._scene.add_mesh_simple(
            f"{self._root}/walls",
            np.concatenate((below, above)).astype(np.float32),
            walls.astype(np.uint32),
            color=colour,
            opacity=0.16,
            side="double",
            cast_shadow=False,
            receive_shadow=False,
        )
        rims = [shapes.polyline(np.concatenate((rim, rim[:1]))) for rim in (below, above)]
        lines(self._scene, f"{self._root}/rims", np.concatenate(rims), colour, 1.5)


def edge_of(cell: CellCard, radius: Metre) -> Points:
    """The places at a distance of the hull of its corners, counter-clockwise [m], (n, 2)."""
    corners = list(zip(cell.x, cell.y, strict=True))
    if len(corners) == 1:
        angles = np.arange(0.0, tau, ROUND)
        return np.add(corners[0], radius * np.column_stack((np.cos(angles), np.sin(angles))))
    points = []
    for k, (x, y) in enumerate(corners):
        (x1, y1), (x2, y2) = corners[k - 1], corners[(k + 1) % len(corners)]
        begin = atan2(y - y1, x - x1) - pi / 2.0
        whole = (atan2(y2 - y, x2 - x) - pi / 2.0 - begin) % tau
        count = max(1, ceil(whole / ROUND)) if radius > 0.0 else 0
        for i in range(count + 1):
            angle = begin + whole * i / max(1, count)
            points.append((x + radius * cos(angle), y + radius * sin(angle)))
    return np.array(points)
