"""Shapes of the 3D scene as arrays: an airliner, paths over the ground, dashes, rings, quaternions.

Scene frame: x east, y north, z up, 1 unit = 1 km. Body frame: x forward, y left, z up.
"""

from collections.abc import Sequence
from math import cos, hypot, inf, pi, sin
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from relguide.flying.plan_documents import (
    BoundarySegment,
    PathSegment,
    StraightSegment,
    TurnSegment,
)

Points = NDArray[np.float64]
"""(n, 3) or, as line segments, (n, 2, 3)."""

KM = 1000.0
"""Metres in a scene unit."""
ALTITUDE_SCALE = 2.0
"""How much heights are drawn larger than they are: at true scale all would lie on the ground."""

LONGEST = 4000.0
"""Longest piece a straight is drawn in [m]."""

HELD = 0.22
"""The part of an edge that is left at each of its corners, of a gate that holds its aircraft."""

_FUSELAGE = (  # station along the fuselage and radius there, of an aircraft 1 long
    (0.500, 0.004),
    (0.480, 0.026),
    (0.430, 0.046),
    (0.360, 0.053),
    (-0.220, 0.053),
    (-0.380, 0.034),
    (-0.500, 0.008),
)
_ROUND = 14
"""Sides of the fuselage."""


def airliner() -> tuple[NDArray[np.float32], NDArray[np.uint32]]:
    """Vertices and faces of a swept-wing twin, 1 long, nose along +x, its middle at the origin."""
    vertices: list[tuple[float, float, float]] = []
    faces: list[tuple[int, int, int]] = []

    def tube(stations: Sequence[tuple[float, float]], y: float, z: float) -> None:
        first = len(vertices)
        for x, radius in stations:
            for k in range(_ROUND):
                angle = 2.0 * pi * k / _ROUND
                vertices.append((x, y + radius * cos(angle), z + radius * sin(angle)))
        for ring in range(len(stations) - 1):
            for k in range(_ROUND):
                a, b = first + ring * _ROUND + k, first + ring * _ROUND + (k + 1) % _ROUND
                c, d = a + _ROUND, b + _ROUND
                faces.extend([(a, c, b), (b, c, d)])
        for ring in (0, len(stations) - 1):
            start = first + ring * _ROUND
            faces.extend((start, start + k, start + k + 1) for k in range(1, _ROUND - 1))

    def plate(outline: Sequence[tuple[float, float, float]], thickness: Sequence[float]) -> None:
        """A thin solid: the outline moved half the thickness to either side."""
        first, n = len(vertices), len(outline)
        shift = np.asarray(thickness) / 2.0
        vertices.extend(tuple(np.asarray(p) + shift) for p in outline)
        vertices.extend(tuple(np.asarray(p) - shift) for p in outline)
        for k in range(1, n - 1):
            faces.append((first, first + k, first + k + 1))
            faces.append((first + n, first + n + k + 1, first + n + k))
        for k in range(n):
            a, b = first + k, first + (k + 1) % n
            faces.extend([(a, a + n, b), (b, a + n, b + n)])

    tube(_FUSELAGE, 0.0, 0.0)
    for side in (1.0, -1.0):
        plate(
            [
                (0.130, side * 0.03, -0.025),
                (-0.115, side * 0.47, 0.012),
                (-0.160, side * 0.47, 0.012),
                (-0.070, side * 0.17, -0.015),
                (-0.085, side * 0.03, -0.025),
            ],
            (0.0, 0.0, 0.016),
        )
        plate(
            [
                (-0.385, side * 0.01, 0.020),
                (-0.480, side * 0.175, 0.035),
                (-0.515, side * 0.175, 0.035),
                (-0.475, side * 0.01, 0.020),
            ],
            (0.0, 0.0, 0.012),
        )
        tube(((0.110, 0.020), (0.095, 0.031), (0.020, 0.029), (-0.015, 0.017)), side * 0.16, -0.062)
    plate(
        [(-0.350, 0.0, 0.03), (-0.470, 0.0, 0.205), (-0.520, 0.0, 0.205), (-0.475, 0.0, 0.02)],
        (0.0, 0.014, 0.0),
    )
    return np.asarray(vertices, dtype=np.float32), np.asarray(faces, dtype=np.uint32)


def attitude(heading: float, bank: float) -> tuple[float, float, float, float]:
    """Quaternion (w, x, y, z) from the body frame to the scene frame, level flight.

    Args:
        heading: clockwise from north [rad].
        bank: positive right wing down [rad].
    """
    half_yaw, half_roll = (pi / 2.0 - heading) / 2.0, bank / 2.0
    cy, sy, cr, sr = cos(half_yaw), sin(half_yaw), cos(half_roll), sin(half_roll)
    # q_z(yaw) · q_x(roll); y is the LEFT wing, so turning y toward z lowers the right one
    return (cy * cr, cy * sr, sy * sr, sy * cr)


def path_points(
    segments: Sequence[PathSegment],
    wind: tuple[float, float],
    height: float,
    *,
    since: float = 0.0,
) -> Points:
    """Points along a path over the ground [scene units].

    A turn at constant bank is an arc in the air mass; over the ground it is displaced by wind × t.

    Args:
        segments: in the order they are flown.
        wind: velocity of the air mass, east and north [m/s].
        height: z of all points [scene units].
        since: what is flown before is left out [s, from the beginning of the path].
    """
    coming = [segment for segment in segments if segment.end.t > since]
    pieces = [_piece_points(segment, wind, since) for segment in coming]
    if not pieces:
        return np.empty((0, 3))
    plane = np.concatenate(pieces) / KM  # (n, 2)
    return np.column_stack((plane, np.full(len(plane), height)))


def timed_points(
    times: Sequence[float],
    x: Sequence[float],
    y: Sequence[float],
    *,
    height: float,
    since: float,
    until: float = inf,
) -> Points:
    """Points along a path that is known by places at times, from one time on [scene units].

    Args:
        times: ascending [s].
        x: east of each [m].
        y: north of each [m].
        height: z of all points [scene units].
        since: what was flown before is left out [s] …
        until: … and what will be flown after.
    """
    steps = np.diff(times)
    lengths = np.hypot(np.diff(x), np.diff(y))
    # Lines that reach far behind the camera are drawn broken, so none is long.
    counts = np.maximum(np.ceil(lengths / LONGEST).astype(int), 1)
    pieces = zip(times[:-1], steps, counts, strict=True)
    at = np.concatenate([t + dt * np.arange(n) / n for t, dt, n in pieces] + [times[-1:]])
    at = np.concatenate(([since], at[(at > since) & (at < until)], [min(until, times[-1])]))
    plane = np.column_stack((np.interp(at, times, x), np.interp(at, times, y))) / KM
    return np.column_stack((plane, np.full(len(plane), height)))


def _piece_points(segment: PathSegment, wind: tuple[float, float], since: float) -> Points:
    duration = segment.end.t - segment.start.t
    first = min(max(0.0, (since - segment.start.t) / duration), 1.0) if duration > 0.0 else 0.0
    match segment:
        case StraightSegment():
            a, b = segment.start, segment.end
            # Lines that reach far behind the camera are drawn broken, so none is long.
            count = max(2, int(hypot(b.x - a.x, b.y - a.y) / LONGEST) + 2)
            share = np.linspace(first, 1.0, count)
            return np.column_stack((a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)))
        case TurnSegment():
            count = max(2, int(segment.angle / 0.05) + 2)  # 0.05 rad: 4 m off the arc at R = 12 km
            share = np.linspace(first, 1.0, count)
            side = 1.0 if segment.direction == "right" else -1.0
            h0 = segment.start.heading
            h = h0 + side * segment.angle * share
            x = segment.start.x + side * segment.radius * (np.cos(h0) - np.cos(h))
            y = segment.start.y + side * segment.radius * (np.sin(h) - np.sin(h0))
            t = segment.duration * share
            return np.column_stack((x + wind[0] * t, y + wind[1] * t))
        case BoundarySegment():
            points = (segment.start, *segment.via, segment.end)
            return np.array([(point.x, point.y) for point in points if point.t >= since])


def polyline(points: Points) -> Points:
    """Line segments (n − 1, 2, 3) that join points (n, 3)."""
    return np.stack((points[:-1], points[1:]), axis=1) if len(points) > 1 else np.empty((0, 2, 3))


def dashes(points: Points, pattern: Sequence[float]) -> Points:
    """The dashes along a line, as line segments.

    Args:
        points: (n, 3) [scene units].
        pattern: lengths of a dash, of the gap after it, and so on, again and again [scene units].
    """
    if len(points) < 2:
        return np.empty((0, 2, 3))
    along = np.concatenate(([0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))))
    edges = np.concatenate(([0.0], np.cumsum(pattern)))
    rounds = np.arange(0.0, along[-1], edges[-1])
    starts = np.add.outer(rounds, edges[0:-1:2]).ravel()
    starts = starts[starts < along[-1]]
    ends = np.minimum(np.add.outer(rounds, edges[1::2]).ravel()[: len(starts)], along[-1])
    at = [np.column_stack([np.interp(s, along, points[:, k]) for k in range(3)])
          for s in (starts, ends)]  # fmt: skip
    return np.stack(at, axis=1)


def ring(radius: float, z: float = 0.0) -> Points:
    """A circle about the origin as line segments."""
    return polyline(circle(radius, z))


def circle(radius: float, z: float = 0.0, sides: int = 72) -> Points:
    """Points (n, 3) of a circle about the origin, the first one again at the end."""
    angle = np.linspace(0.0, 2.0 * pi, sides + 1)
    return np.column_stack((radius * np.cos(angle), radius * np.sin(angle), np.full(sides + 1, z)))


GateLook = Literal["open", "held", "crossed"]


def gate(length: float, width: float, height: float, look: GateLook = "open") -> Points:
    """A box of thin lines along the x axis (the way through it), as line segments.

    Held, it has its corners only, and what is in it is seen; crossed, its front has both diagonals.
    """
    half = np.array((length, width, height)) / 2.0
    corners = half * [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
    pairs = [(i, i | bit) for i in range(8) for bit in (1, 2, 4) if not i & bit]
    edges = np.array([(corners[i], corners[k]) for i, k in pairs])
    if look == "crossed":
        return np.concatenate((edges, [(corners[4], corners[7]), (corners[5], corners[6])]))
    if look == "held":
        begins, ends = edges[:, 0], edges[:, 1]
        part = HELD * (ends - begins)
        return np.concatenate(
            (np.stack((begins, begins + part), axis=1), np.stack((ends - part, ends), axis=1))
        )
    return edges


def drop(height: float, foot: float, levels: Sequence[float] = ()) -> Points:
    """A line down to the ground from the origin, a cross where it meets it, and at its levels.

    Args:
        height: of the origin over the ground.
        foot: half of the cross on the ground; those of the levels are half as large.
        levels: heights over the ground.
    """
    crosses = [(0.0, foot), *((level, foot / 2.0) for level in levels)]
    segments = [[(0.0, 0.0, 0.0), (0.0, 0.0, -height)]]
    for level, half in crosses:
        z = level - height
        segments += [[(-half, 0.0, z), (half, 0.0, z)], [(0.0, -half, z), (0.0, half, z)]]
    return np.array(segments)
