"""The ground of the 3D scene where a flight has a place on the earth: coast lines and airports.

Both come from `earth.npz`, which `tools/earth.py` makes: coast lines of Natural Earth, airports of
airportsdata, longitudes and latitudes in steps of `STEP`, the lines as differences.
"""

from functools import cache
from math import cos
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from viser import SceneApi

from relguide.planning.frames import LocalPlane
from relguide.units import DEG
from relguide_server.scene import paint as paint
from relguide_server.scene.lettering import written
from relguide_server.scene.paint import lines
from relguide_server.scene.shapes import KM, Points

EARTH = Path(__file__).with_name("earth.npz")
STEP = 0.002
"""Longitudes and latitudes are whole numbers of these [°]: 220 m."""
DEGREE = 111.2
"""A degree of latitude [km]."""
COASTS_TO = 600.0
AIRPORTS_TO = 250.0
"""How far from the middle of the flight's plane each is drawn [km]."""
RUNWAY = 1.6
"""Half the size of an airport's mark [scene units]."""
LETTER = 2.4
"""Height of the letters beside it [scene units]."""
BESIDE = 1.6 * RUNWAY
"""How far from its mark a name begins [scene units]."""
GROUND = 0.02
"""A little above the grid [scene units]."""


class Earth(NamedTuple):
    """What is known of the ground: longitudes and latitudes [°], (n, 2) each."""

    coast: NDArray[np.float64]
    """Both ends of each piece of coast, (n, 2, 2)."""
    codes: list[str]
    """Airports, by ICAO's code …"""
    sites: NDArray[np.float64]
    """… and where they are."""


@cache
def earth() -> Earth:
    """All of it, read once."""
    with np.load(EARTH) as found:
        steps, lengths = found["steps"].astype(np.int32), found["lengths"]
        ends = np.cumsum(steps, axis=0)
        before = np.concatenate((np.zeros((1, 2), dtype=np.int32), ends))
        begins = before[np.cumsum(lengths) - lengths]
        ends += np.repeat(found["starts"] - begins, lengths, axis=0)
        coast = np.stack((ends - steps, ends), axis=1) * STEP
        codes = [code.decode() for code in found["codes"].tolist()]
        return Earth(coast, codes, found["sites"] * STEP)


def draw_ground(scene: SceneApi, plane: LocalPlane) -> None:
    """Draw coast lines and airports round the point where a flight's plane touches the earth."""
    known = earth()
    near = known.coast[_is_near(known.coast[:, 0], plane, COASTS_TO)]
    if len(near) > 0:
        coast = np.stack((_on(plane, near[:, 0]), _on(plane, near[:, 1])), axis=1)
        lines(scene, "/world/coast", coast, paint.COAST, 1.4)
    chosen = np.flatnonzero(_is_near(known.sites, plane, AIRPORTS_TO))
    if len(chosen) > 0:
        sites = _on(plane, known.sites[chosen])
        marks = [_AIRPORT + site for site in sites]
        marks += _names([known.codes[number] for number in chosen], sites)
        lines(scene, "/world/airports", np.concatenate(marks), paint.AIRPORT, 1.4)


def _is_near(places: NDArray[np.float64], plane: LocalPlane, within: float) -> NDArray[np.bool_]:
    """Which of some longitudes and latitudes [°] are within a box round the plane's point [km]."""
    east = (places[:, 0] - plane.lon_deg + 180.0) % 360.0 - 180.0
    north = places[:, 1] - plane.lat_deg
    shrink = max(0.05, cos(plane.lat_deg * DEG))
    near: NDArray[np.bool_] = (np.abs(east) * shrink < within / DEGREE) & (
        np.abs(north) < within / DEGREE
    )
    return near


def _on(plane: LocalPlane, places: NDArray[np.float64]) -> Points:
    """Longitudes and latitudes [°], (n, 2), as points on the ground [scene units], (n, 3)."""
    flat = [plane.to_local(lat, lon) for lon, lat in places.tolist()]
    return np.column_stack((np.array(flat) / KM, np.full(len(flat), GROUND)))


def _names(codes: list[str], sites: Points) -> list[Points]:
    """Names to the right or to the left of their marks; where neither has room, none."""
    taken = [_box(_AIRPORT + site) for site in sites]
    names = []
    for code, site in zip(codes, sites, strict=True):
        word = written(code, LETTER) - np.array([0.0, 0.5 * LETTER, 0.0])
        width = float(np.ptp(word[:, :, 0]))
        for shift in (BESIDE, -BESIDE - width):
            name = word + site + np.array([shift, 0.0, 0.0])
            box = _box(name)
            if not any(_overlap(box, other) for other in taken):
                taken.append(box)
                names.append(name)
                break
    return names


def _box(drawn: Points) -> NDArray[np.float64]:
    """What something drawn on the ground covers, its corners in the south-west and north-east."""
    flat = drawn.reshape(-1, 3)[:, :2]
    return np.array([flat.min(axis=0), flat.max(axis=0)])


def _overlap(one: NDArray[np.float64], other: NDArray[np.float64]) -> bool:
    return bool(np.all(one[0] < other[1]) and np.all(other[0] < one[1]))


_AIRPORT: Points = RUNWAY * np.array(
    [
        [(-0.7, -0.7, 0.0), (0.7, 0.7, 0.0)],
        [(-0.35, 0.7, 0.0), (0.35, -0.7, 0.0)],
    ]
)
"""Two runways that cross."""
