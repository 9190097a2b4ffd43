"""A plan as GeoJSON (RFC 7946): its path, the leader's and the other paths, as lines on the earth.

Lines are drawn in longitude and latitude (WGS84, seven decimals: a centimetre), cut where they pass
180° of longitude, and so close that their chords stray from the path by some metres at most.
"""

from collections.abc import Sequence
from itertools import pairwise
from math import ceil
from typing import Any

import numpy as np

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


def plan_features(
    situation: Situation,
    path: Trajectory,
    others: Sequence[tuple[Trajectory, str]],
    plane: LocalPlane,
) -> list[dict[str, Any]]:
    """The features of a plan: `path`, `leader` until it is joined, `slot`, and other paths.

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
    for number, (other, why) in enumerate(others):
        drawn = other.over_ground(situation.wind, _times(other, other.duration))
        features.append(_line(f"other-{number}", drawn, plane, {"why": why}))
    return features


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


def _line(name: str, drawn: Samples, plane: LocalPlane, more: dict[str, str]) -> dict[str, Any]:
    return {
        "type": "Feature",
        "id": name,
        "properties": {"t_s": [round(t, 3) for t in drawn.t.tolist()], **more},
        "geometry": line_geometry(_places(drawn, plane)),
    }


def _places(drawn: Samples, plane: LocalPlane) -> list[list[float]]:
    """Longitude and latitude of each point [°]."""
    along = (
        plane.to_geodetic(x, y) for x, y in zip(drawn.x.tolist(), drawn.y.tolist(), strict=True)
    )
    return np.round([[lon, lat] for lat, lon in along], DECIMALS).tolist()  # type: ignore[no-any-return]
