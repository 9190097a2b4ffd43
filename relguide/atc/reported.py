"""Aircraft and airspaces as others report them: on the earth, and placed on the plane of a sky."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import ceil, nan

import numpy as np
from numpy.typing import NDArray

from relguide.atc.picture import Airspace, Seen
from relguide.atc.settings import AtcSettings
from relguide.atc.track import Track
from relguide.kernels.base.roots import FloatArray
from relguide.planning.extras import need
from relguide.planning.frames import LocalPlane
from relguide.units import DEG, Metre, MetrePerSecond, Radian, Second

REACH: Metre = 2_000_000.0
"""What is farther from the middle of a sky is not seen in it: a plane bends no farther."""
CHORD: Metre = 1_000.0
"""Edges of airspaces are geodesics, drawn by chords of at most this: they stray by centimetres."""

USUAL = AtcSettings()


@dataclass(frozen=True, slots=True, kw_only=True)
class Waypoint:
    """Where an aircraft intends to be at a time."""

    t: Second
    """UTC [s]."""
    lat_deg: float
    """WGS84 [°]."""
    lon_deg: float
    """WGS84 [°]."""
    altitude: Metre | None = None
    """Pressure altitude [m]; `None`: as at the point before."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Reported:
    """An aircraft as it is reported."""

    ident: str
    t: Second
    """When it was there, UTC [s]."""
    lat_deg: float
    """WGS84 [°]."""
    lon_deg: float
    """WGS84 [°]."""
    track: Radian
    """Direction of its ground velocity, clockwise from true north there [rad]."""
    ground_speed: MetrePerSecond
    """[m/s]"""
    altitude: Metre | None = None
    """Pressure altitude [m]; `None` where it is not known."""
    climb: MetrePerSecond = 0.0
    """Vertical speed, positive up [m/s]."""
    waypoints: tuple[Waypoint, ...] = ()
    """What it intends to fly from here: straight from each to the next, and past the last one
    straight on. Later than `t`, ascending. None where it has not said so."""
    strays: Metre = 0.0
    """How far it may be from those straight lines at their time: in turns, for one [m]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ReportedAirspace:
    """A closed part of the sky as it is reported; its edges are geodesics."""

    ident: str
    lat_deg: tuple[float, ...]
    """Of its corners in turn, WGS84 [°]; the first is not given again."""
    lon_deg: tuple[float, ...]
    low: Metre
    """Pressure altitude of its floor [m]; -inf: from the ground."""
    high: Metre
    """… and of its ceiling [m]; inf: without one."""
    since: Second
    """From when it is closed, UTC [s]; -inf: always."""
    until: Second
    """Until when, UTC [s]; inf: always."""


def seen_on(
    plane: LocalPlane, reports: Sequence[Reported], settings: AtcSettings = USUAL
) -> list[Seen | None]:
    """Reported aircraft on the plane of a sky, each where it was when it was seen.

    Args:
        plane: of the sky.
        reports: aircraft.
        settings: how far from its level an aircraft may be that says at which it will fly.

    Returns:
        In the order of `reports`; `None` for what is farther away than `REACH`.
    """
    if not reports:
        return []
    points: list[Reported | Waypoint] = []
    for one in reports:
        points += (one, *one.waypoints)
    lat = np.array([point.lat_deg for point in points])
    lon = np.array([point.lon_deg for point in points])
    x, y = plane.to_local_each(lat, lon)
    # at the antipode the projection gives infinity
    near = (np.hypot(x, y) <= REACH).tolist()
    t = np.array([point.t for point in points])
    edges = np.cumsum([0, *(1 + len(one.waypoints) for one in reports)])
    low, high = _levels(reports, edges, settings)
    begins = edges[:-1]
    track = np.array([one.track for one in reports])
    with np.errstate(invalid="ignore"):  # there, as well
        track = (track + plane.meridian_each(lat[begins], lon[begins])) % (360.0 * DEG)
    seen: list[Seen | None] = []
    for one, chi, (begin, end) in zip(
        reports, track.tolist(), pairwise(edges.tolist()), strict=True
    ):
        if not all(near[begin:end]):
            seen.append(None)
            continue
        its = slice(begin, end)
        path = Track(t=t[its], x=x[its], y=y[its], low=low[its], high=high[its], error=one.strays)
        seen.append(
            Seen(
                ident=one.ident,
                t=one.t,
                x=float(x[begin]),
                y=float(y[begin]),
                track=chi,
                ground_speed=one.ground_speed,
                altitude=one.altitude,
                climb=one.climb,
                path=path if one.waypoints else None,
            )
        )
    return seen


def _levels(
    reports: Sequence[Reported], edges: NDArray[np.int64], settings: AtcSettings
) -> tuple[FloatArray, FloatArray]:
    """Between which heights the points of all aircraft are, in their order [m]."""
    levels = list[float]()
    for one in reports:
        level = nan if one.altitude is None else one.altitude
        levels.append(level)
        for point in one.waypoints:
            level = level if point.altitude is None else point.altitude
            levels.append(level)
    altitude = np.array(levels)
    changes = np.diff(altitude, prepend=altitude[0]) != 0.0
    changes[edges[:-1]] = False
    # what a climb may differ by holds at both of its ends
    climbs = changes | np.append(changes[1:], False)
    buffer = np.where(climbs, settings.climb_buffer, settings.level_buffer)
    known = np.isfinite(altitude)
    low = np.where(known, altitude - buffer, -np.inf)
    return low, np.where(known, altitude + buffer, np.inf)


def airspace_on(plane: LocalPlane, airspace: ReportedAirspace) -> Airspace | None:
    """A reported airspace on the plane of a sky; `None` if it is farther away than `REACH`."""
    lat, lon = _edge(airspace)
    x, y = plane.to_local_each(lat, lon)
    if not (np.isfinite(x).all() and np.isfinite(y).all() and np.hypot(x, y).max() <= REACH):
        return None
    return Airspace(
        ident=airspace.ident,
        x=tuple(x.tolist()),
        y=tuple(y.tolist()),
        low=airspace.low,
        high=airspace.high,
        since=airspace.since,
        until=airspace.until,
    )


def perimeter(lat_deg: Sequence[float], lon_deg: Sequence[float]) -> Metre:
    """How long the edges of a polygon on the earth are together [m]."""
    need("pyproj")
    from pyproj import Geod

    ring = [*lon_deg, lon_deg[0]], [*lat_deg, lat_deg[0]]
    return float(Geod(ellps="WGS84").line_length(*ring))


def _edge(airspace: ReportedAirspace) -> tuple[FloatArray, FloatArray]:
    """Latitudes and longitudes of points along its edges, `CHORD` apart at most [°]."""
    need("pyproj")
    from pyproj import Geod

    earth = Geod(ellps="WGS84")
    corners = list(zip(airspace.lat_deg, airspace.lon_deg, strict=True))
    lats, lons = list[float](), list[float]()
    for (lat, lon), (next_lat, next_lon) in pairwise([*corners, corners[0]]):
        lats.append(lat)
        lons.append(lon)
        _, _, length = earth.inv(lon, lat, next_lon, next_lat)
        between = ceil(length / CHORD) - 1
        if between > 0:
            for far_lon, far_lat in earth.npts(lon, lat, next_lon, next_lat, between):
                lats.append(far_lat)
                lons.append(far_lon)
    return np.array(lats), np.array(lons)
