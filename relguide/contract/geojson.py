"""A plan as GeoJSON (RFC 7946): paths as lines on the earth, weather cells as polygons.

They are drawn in longitude and latitude (WGS84, seven decimals: a centimetre), cut where they pass
180° of longitude, and so close that their chords stray from the path by some metres at most.
"""

from collections.abc import Sequence
from itertools import pairwise
from math import ceil, cos, hypot, sin, tau
from typing import Any, assert_never

import numpy as np

from relguide.planning.aircraft import Traffic
from relguide.planning.cells import Cell, Disc, Polygon
from relguide.planning.frames import LocalPlane
from relguide.planning.sampling import Samples
from relguide.planning.situation import Situation
from relguide.planning.trajectory import Trajectory
from relguide.units import DEG, Metre, Radian, Second

TURN: Radian = 2.0 * DEG
"""Most turn between two points of a line: the chord strays by 1.5e-4 of the radius."""
STRIDE: Metre = 5_000.0
"""Most distance between them: at 60° of latitude a chord strays by a metre from a straight path."""
DECIMALS = 7
CORNERS = 64
"""Corners of a disc as a polygon: its edge strays by 1.2e-3 of the radius."""


def plan_features(
    situation: Situation,
    path: Trajectory,
    others: Sequence[tuple[Trajectory, str]],
    plane: LocalPlane,
) -> list[dict[str, Any]]:
    """The features of a plan: `path`, `leader` until it is joined, `slot`, and what else there is.

    That are other traffic until then (`traffic-0` …), cells at t = 0 (`cell-0` …), and other paths
    (`other-0` …).

    Args:
        situation: what was planned.
        path: of the pursuer, in the air mass.
        others: other paths to the slot, and why each is not flown.
        plane: how the situation lies on the earth.
    """
    flown, joined = situation.leader.trajectory, path.duration
    own = path.over_ground(situation.wind, _times(path, joined))
    leading = flown.over_ground(situation.wind, _times(flown, joined))
    features = [
        _line("path", own, plane, {}),
        _line("leader", leading, plane, {}),
        {
            "type": "Feature",
            "id": "slot",
            "properties": {"t_s": joined},
            "geometry": {"type": "Point", "coordinates": _places(own, plane)[-1]},
        },
    ]
    amid = situation.others
    for number, traffic in enumerate(other for other in amid if isinstance(other, Traffic)):
        path_flown = traffic.trajectory
        along = path_flown.over_ground(situation.wind, _times(path_flown, joined))
        features.append(_line(f"traffic-{number}", along, plane, _about(traffic)))
    cells = (other for other in amid if isinstance(other, Cell))
    features += [_cell(f"cell-{number}", cell, plane) for number, cell in enumerate(cells)]
    for number, (other, why) in enumerate(others):
        drawn = other.over_ground(situation.wind, _times(other, other.duration))
        features.append(_line(f"other-{number}", drawn, plane, {"why": why}))
    return features


def _about(traffic: Traffic) -> dict[str, Any]:
    known = {} if traffic.altitude is None else {"altitude_m": traffic.altitude}
    return {"ident": traffic.ident, "min_separation_m": traffic.min_separation, **known}


def _cell(name: str, cell: Cell, plane: LocalPlane) -> dict[str, Any]:
    """A cell at t = 0; how it moves and grows are among its properties."""
    radius: dict[str, Metre] = {}
    match cell.shape:
        case Disc(x=x, y=y, radius=r):
            radius = {"radius_m": r}
            angles = [tau * k / CORNERS for k in range(CORNERS)]
            corners = [(x + r * cos(angle), y + r * sin(angle)) for angle in angles]
            first = x, y
        case Polygon(corners=given):
            corners, first = list(given), given[0]
        case _:
            assert_never(cell.shape)
    edge = [point for a, b in pairwise([*corners, corners[0]]) for point in _along(a, b)]
    turned = plane.meridian(*plane.to_geodetic(*first))
    velocity = (
        cell.east * cos(turned) - cell.north * sin(turned),
        cell.north * cos(turned) + cell.east * sin(turned),
    )
    return {
        "type": "Feature",
        "id": name,
        "properties": {
            "ident": cell.ident,
            "t_s": 0.0,
            **radius,
            "velocity_mps": [round(part, 6) for part in velocity],
            "growth_mps": cell.growth,
        },
        "geometry": area_geometry([_place(x, y, plane) for x, y in edge]),
    }


def _along(a: tuple[Metre, Metre], b: tuple[Metre, Metre]) -> list[tuple[Metre, Metre]]:
    """Points from one corner on, `STRIDE` apart at most, without the next corner."""
    steps = max(ceil(hypot(b[0] - a[0], b[1] - a[1]) / STRIDE), 1)
    shares = [k / steps for k in range(steps)]
    return [(a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])) for share in shares]


def _times(flown: Trajectory, end: Second) -> list[Second]:
    """When to look at a trajectory, from its start to some time [s]."""
    pieces = [*flown.bends(), (max(end - flown.duration, 0.0), 0.0)]
    times, begin = [0.0], 0.0
    for duration, rate in pieces:
        steps = ceil(max(duration * abs(rate) / TURN, duration * flown.tas / STRIDE, 1.0))
        times += [begin + duration * (step + 1) / steps for step in range(steps)]
        begin += duration
    return [*(t for t in times if t < end), end]


def line_geometry(places: Sequence[list[float]]) -> dict[str, Any]:
    """A line on the earth, cut where it passes 180° of longitude (RFC 7946, 3.1.9).

    Args:
        places: longitude, latitude [°] and what else each point has; one place is a point.
    """
    if len(places) == 1:
        return {"type": "Point", "coordinates": places[0]}
    lines: list[list[list[float]]] = [[]]
    for here, there in pairwise(places):
        lines[-1].append(here)
        if abs(there[0] - here[0]) > 180.0:
            edge = 180.0 if here[0] > 0.0 else -180.0
            share = (edge - here[0]) / (there[0] + 2.0 * edge - here[0] or 1.0)
            cut = [
                round(a + share * (b - a), DECIMALS)
                for a, b in zip(here[1:], there[1:], strict=True)
            ]
            lines[-1].append([edge, *cut])
            lines.append([[-edge, *cut]])
    lines[-1].append(places[-1])
    if len(lines) > 1:
        return {"type": "MultiLineString", "coordinates": lines}
    return {"type": "LineString", "coordinates": lines[0]}


def area_geometry(corners: Sequence[list[float]]) -> dict[str, Any]:
    """A convex area on the earth, cut where it passes 180° of longitude (RFC 7946, 3.1.9).

    Args:
        corners: longitude, latitude [°], counter-clockwise; the first is not given again.
    """
    first = corners[0][0]
    # longitudes beyond 180° count on, so that none jumps
    unrolled = [[lon + 360.0 * round((first - lon) / 360.0), lat] for lon, lat in corners]
    reach = [lon for lon, _ in unrolled]
    edge = 180.0 if max(reach) > 180.0 else -180.0
    if min(reach) >= edge or max(reach) <= edge:
        return {"type": "Polygon", "coordinates": [_ring(unrolled)]}
    parts = [_beyond(unrolled, edge, side) for side in (-1.0, 1.0)]
    shift = -360.0 if edge > 0.0 else 360.0
    inside = 0 if edge > 0.0 else 1
    parts[1 - inside] = [[lon + shift, lat] for lon, lat in parts[1 - inside]]
    return {"type": "MultiPolygon", "coordinates": [[_ring(part)] for part in parts]}


def _ring(corners: Sequence[list[float]]) -> list[list[float]]:
    return [[round(part, DECIMALS) for part in corner] for corner in (*corners, corners[0])]


def _beyond(corners: Sequence[list[float]], edge: float, side: float) -> list[list[float]]:
    """The part of a convex area west (−1) or east (+1) of a meridian."""
    kept = list[list[float]]()
    for here, there in zip(corners, (*corners[1:], corners[0]), strict=True):
        a, b = side * (here[0] - edge), side * (there[0] - edge)
        if a >= 0.0:
            kept.append(here)
        if a * b < 0.0:
            share = a / (a - b)
            kept.append([edge, here[1] + share * (there[1] - here[1])])
    return kept


def _place(x: Metre, y: Metre, plane: LocalPlane) -> list[float]:
    """Longitude and latitude [°]."""
    lat, lon = plane.to_geodetic(x, y)
    return [lon, lat]


def _line(name: str, drawn: Samples, plane: LocalPlane, more: dict[str, Any]) -> dict[str, Any]:
    return {
        "type": "Feature",
        "id": name,
        "properties": {"t_s": [round(t, 3) for t in drawn.t.tolist()], **more},
        "geometry": line_geometry(_places(drawn, plane)),
    }


def _places(drawn: Samples, plane: LocalPlane) -> list[list[float]]:
    """Longitude and latitude of each point [°]."""
    along = zip(drawn.x.tolist(), drawn.y.tolist(), strict=True)
    return np.round([_place(x, y, plane) for x, y in along], DECIMALS).tolist()  # type: ignore[no-any-return]
