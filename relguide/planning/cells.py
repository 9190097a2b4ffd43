"""Weather cells: discs and convex polygons to be kept out of, which move and grow."""

from dataclasses import dataclass, replace
from itertools import pairwise
from math import atan2, hypot, tau
from typing import Literal, assert_never

import numpy as np

from relguide.kernels.base.roots import FloatArray
from relguide.planning.aircraft import expect_ident
from relguide.planning.inputs import expect, expect_within
from relguide.planning.intent import settle
from relguide.planning.limits import CELL_RADIUS, CELL_SPEED, GROWTH, MAX_CORNERS, POSITION
from relguide.planning.reprs import as_code
from relguide.units import Metre, MetrePerSecond, Second

LEAST_AREA = 1.0
"""A polygon with less area than this is a line [m²]."""


@dataclass(frozen=True, slots=True, kw_only=True, repr=False)
class Disc:
    """A round cell, at t = 0.

    Examples:
        >>> rg.Disc(x=60e3, y=20e3, radius=15e3)
        Disc(x=60000.0, y=20000.0, radius=15000.0)
    """

    x: Metre
    """Its middle, east [m]."""
    y: Metre
    """Its middle, north [m]."""
    radius: Metre
    """[m], > 0."""
    kind: Literal["disc"] = "disc"

    __repr__ = as_code

    def __post_init__(self) -> None:
        """Refuse what is no disc."""
        for name, accepted in (("x", POSITION), ("y", POSITION), ("radius", CELL_RADIUS)):
            settle(self, name, expect_within(f"disc.{name}", getattr(self, name), *accepted))


@dataclass(frozen=True, slots=True, kw_only=True, repr=False)
class Polygon:
    """A convex cell, at t = 0.

    Examples:
        >>> front = rg.Polygon(corners=((0.0, 0.0), (60e3, 10e3), (50e3, 25e3)))
        >>> rg.Cell(ident="FRONT", shape=front, east=8.0).after(600.0).shape.corners[0]  # [m]
        (4800.0, 0.0)
    """

    corners: tuple[tuple[Metre, Metre], ...]
    """East and north of each corner, either way round [m]. Kept counter-clockwise."""
    radius: Metre = 0.0
    """How far its edge lies outside the corners [m]: what it has grown by."""
    kind: Literal["polygon"] = "polygon"

    __repr__ = as_code

    def __post_init__(self) -> None:
        """Refuse what is no convex polygon."""
        settle(self, "corners", _convex(self.corners))
        grown = expect_within("polygon.radius", self.radius, 0.0, CELL_RADIUS.high, "m")
        settle(self, "radius", grown)


@dataclass(frozen=True, slots=True, kw_only=True, repr=False)
class Cell:
    """A weather cell at all levels, to be kept out of.

    Examples:
        >>> storm = rg.Cell(ident="CB1", shape=rg.Disc(x=60e3, y=20e3, radius=15e3), growth=1.0)
    """

    ident: str
    """Its name in answers: 1 to 24 characters."""
    shape: Disc | Polygon
    """Where it is at t = 0."""
    east: MetrePerSecond = 0.0
    """How fast it moves over the ground, toward the east [m/s]."""
    north: MetrePerSecond = 0.0
    """The same toward the north [m/s]."""
    growth: MetrePerSecond = 0.0
    """How fast its edge moves outward [m/s], ≥ 0."""

    __repr__ = as_code

    def __post_init__(self) -> None:
        """Refuse what no weather does."""
        expect_ident("cell.ident", self.ident)
        expect("cell.shape", self.shape, Disc, Polygon)
        for name, accepted in (("east", CELL_SPEED), ("north", CELL_SPEED), ("growth", GROWTH)):
            settle(self, name, expect_within(f"cell.{name}", getattr(self, name), *accepted))

    def after(self, seconds: Second, *, wider: Metre = 0.0) -> "Cell":
        """The same cell some time later: moved, and grown.

        Args:
            seconds: how much later [s], ≥ 0.
            wider: a berth that it is given besides [m].

        Raises:
            ValueError: if it has left the plane by then.
        """
        east, north = self.east * seconds, self.north * seconds
        grown = self.growth * seconds + wider
        match self.shape:
            case Disc(x=x, y=y, radius=radius):
                shape: Disc | Polygon = Disc(x=x + east, y=y + north, radius=radius + grown)
            case Polygon(corners=corners, radius=radius):
                moved = tuple((x + east, y + north) for x, y in corners)
                shape = Polygon(corners=moved, radius=radius + grown)
            case _:
                assert_never(self.shape)
        return replace(self, shape=shape)


def outside(cell: Cell, places: FloatArray, times: FloatArray) -> FloatArray:
    """How far outside a cell places are; negative inside [m].

    As `signed_distance` of the kernels has it, for many places over the ground.

    Args:
        cell: it moves and grows.
        places: east and north [m]. shape (n, 2)
        times: when [s]. shape (n,)
    """
    match cell.shape:
        case Disc(x=x, y=y, radius=radius):
            corners = np.array([(x, y)])
        case Polygon(corners=points, radius=radius):
            corners = np.array(points)
        case _:
            assert_never(cell.shape)
    edge = radius + cell.growth * times
    moved = times[:, None] * np.array((cell.east, cell.north))
    from_corners = (places - moved)[:, None] - corners  # (n, corners, 2)
    dx, dy = from_corners[..., 0], from_corners[..., 1]
    if len(corners) == 1:
        far: FloatArray = np.hypot(dx[:, 0], dy[:, 0]) - edge
        return far
    sides = np.roll(corners, -1, axis=0) - corners
    lengths = np.hypot(sides[:, 0], sides[:, 1])
    east, north = sides[:, 0] / lengths, sides[:, 1] / lengths
    beyond = np.max(dx * north - dy * east, axis=1)
    along = np.clip(dx * east + dy * north, 0.0, lengths)
    near = np.min(np.hypot(dx - along * east, dy - along * north), axis=1)
    signed: FloatArray = np.where(beyond <= 0.0, beyond, near) - edge
    return signed


def _convex(corners: object) -> tuple[tuple[float, float], ...]:
    """The corners of a convex polygon, counter-clockwise; the first may be given again as the last.

    Raises:
        ValueError: for what is no convex polygon.
    """
    if not isinstance(corners, tuple | list):
        raise ValueError("polygon.corners must be a tuple of (east, north).")
    points: list[tuple[float, float]] = []
    for i, corner in enumerate(corners):
        if not isinstance(corner, tuple | list) or len(corner) != 2:
            raise ValueError(f"polygon.corners[{i}] must be (east, north).")
        name = f"polygon.corners[{i}]"
        point = expect_within(name, corner[0], *POSITION), expect_within(name, corner[1], *POSITION)
        if not points or point != points[-1]:
            points.append(point)
    if len(points) > 1 and points[0] == points[-1]:
        points.pop()
    if not 3 <= len(points) <= MAX_CORNERS:
        raise ValueError(
            f"polygon.corners must have 3 to {MAX_CORNERS} different corners, not {len(points)}."
        )
    x0, y0 = points[0]
    area = sum(
        (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0) for (x1, y1), (x2, y2) in pairwise(points)
    )
    if abs(area) < 2.0 * LEAST_AREA:
        raise ValueError(
            "polygon.corners must go round an area: these lie on one line, or cross themselves."
        )
    if area < 0.0:
        points.reverse()
    turned = 0.0
    for i, (x, y) in enumerate(points):
        (x1, y1), (x2, y2) = points[i - 1], points[(i + 1) % len(points)]
        ahead, then = (x - x1, y - y1), (x2 - x, y2 - y)
        cross = ahead[0] * then[1] - ahead[1] * then[0]
        if cross < -1e-9 * hypot(*ahead) * hypot(*then):
            raise ValueError(
                f"polygon.corners must go round one way, and at ({x:g}, {y:g}) m they turn back: "
                "a cell must be convex. Give it as several convex cells."
            )
        turned += atan2(cross, ahead[0] * then[0] + ahead[1] * then[1])
    if turned > 1.5 * tau:
        raise ValueError("polygon.corners must go round once: a cell must be convex.")
    return tuple(points)
