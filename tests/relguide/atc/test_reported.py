"""Reported aircraft and airspaces on a plane: the same geometry as pyproj's, found another way."""

from math import cos, hypot, inf, pi, sin

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pyproj import Geod

from relguide.atc.reported import (
    CHORD,
    Reported,
    ReportedAirspace,
    Waypoint,
    airspace_on,
    perimeter,
    seen_on,
)
from relguide.atc.settings import AtcSettings
from relguide.planning.frames import LocalPlane
from relguide.units import FT

EARTH = Geod(ellps="WGS84")
PLANE = LocalPlane(50.0, 8.0)


def reported(lat: float, lon: float, **more: object) -> Reported:
    said: dict[str, object] = {
        "ident": "BAW12", "t": 1_000.0, "lat_deg": lat, "lon_deg": lon, "track": 0.0,
        "ground_speed": 200.0,
    }  # fmt: skip
    return Reported(**(said | more))  # type: ignore[arg-type]


@given(
    bearing=st.floats(0.0, 360.0),
    distance=st.floats(1.0, 300_000.0),
    track=st.floats(0.0, 2.0 * pi),
)
def test_a_place_has_its_true_bearing_and_distance(
    bearing: float, distance: float, track: float
) -> None:
    lon, lat, _ = EARTH.fwd(8.0, 50.0, bearing, distance)
    (seen,) = seen_on(PLANE, [reported(lat, lon, track=track)])
    assert seen is not None
    assert hypot(seen.x, seen.y) == pytest.approx(distance, abs=0.01)
    along = seen.x * sin(bearing * pi / 180.0) + seen.y * cos(bearing * pi / 180.0)
    assert along == pytest.approx(distance, abs=0.01)
    # a little later on its track, it is where the plane's direction says
    lon_on, lat_on, _ = EARTH.fwd(lon, lat, track * 180.0 / pi, 100.0)
    x, y = PLANE.to_local(lat_on, lon_on)
    assert hypot(x - seen.x - 100.0 * sin(seen.track), y - seen.y - 100.0 * cos(seen.track)) < 0.1


def test_what_is_on_the_other_side_of_the_earth_is_not_seen() -> None:
    far = [reported(-50.0, -172.0), reported(-49.0, -170.0), reported(0.0, 60.0)]
    assert seen_on(PLANE, far) == [None, None, None]
    assert seen_on(PLANE, []) == []


def test_an_intent_is_a_track_through_its_points() -> None:
    points = (
        Waypoint(t=1_100.0, lat_deg=50.2, lon_deg=8.0),
        Waypoint(t=1_200.0, lat_deg=50.3, lon_deg=8.2, altitude=9_600.0),
        Waypoint(t=1_300.0, lat_deg=50.4, lon_deg=8.2),
        Waypoint(t=1_400.0, lat_deg=50.5, lon_deg=8.2),
    )
    own = reported(50.0, 8.0, altitude=9_000.0, waypoints=points, strays=120.0)
    # beside others, as arrays of all of them are cut
    _, seen, _ = seen_on(PLANE, [reported(51.0, 8.0), own, reported(51.0, 9.0, altitude=100.0)])
    assert seen is not None
    assert seen.path is not None
    assert seen.path.t.tolist() == [1_000.0, 1_100.0, 1_200.0, 1_300.0, 1_400.0]
    for point in points:
        assert seen.path.place(point.t) == pytest.approx(
            PLANE.to_local(point.lat_deg, point.lon_deg), abs=1e-6
        )
    settings = AtcSettings()
    level, climb = settings.level_buffer, settings.climb_buffer
    expected = [9_000.0 - level, 9_000.0 - climb, 9_600.0 - climb, 9_600.0 - level]
    assert seen.path.low.tolist() == pytest.approx([*expected, 9_600.0 - level])
    assert seen.path.high[1] == pytest.approx(9_000.0 + 1_500.0 * FT)
    assert seen.path.error == 120.0


def test_an_unknown_level_keeps_nothing_apart() -> None:
    ahead = (Waypoint(t=1_100.0, lat_deg=50.2, lon_deg=8.0),)
    (seen,) = seen_on(PLANE, [reported(50.0, 8.0, waypoints=ahead)])
    assert seen is not None
    assert seen.path is not None
    assert seen.altitude is None
    assert set(seen.path.low.tolist()) == {-inf}
    assert set(seen.path.high.tolist()) == {inf}


def test_edges_of_an_airspace_are_geodesics() -> None:
    corners = [(49.0, 7.0), (49.0, 9.0), (51.0, 9.0), (50.0, 8.0), (51.0, 7.0)]
    airspace = ReportedAirspace(
        ident="D12", lat_deg=tuple(lat for lat, _ in corners),
        lon_deg=tuple(lon for _, lon in corners), low=-inf, high=9_000.0, since=-inf, until=inf,
    )  # fmt: skip
    placed = airspace_on(PLANE, airspace)
    assert placed is not None
    x, y = np.array(placed.x), np.array(placed.y)
    steps = np.hypot(np.diff(x, append=x[0]), np.diff(y, append=y[0]))
    # a plane 300 km wide is true to 1e-4 or so
    assert steps.max() < CHORD * 1.001
    assert steps.sum() == pytest.approx(perimeter(airspace.lat_deg, airspace.lon_deg), rel=1e-3)
    # the shortest way along a parallel lies up to half a kilometre north of it
    north = EARTH.npts(7.0, 49.0, 9.0, 49.0, 1)[0][1]
    lat = [PLANE.to_geodetic(*place)[0] for place in zip(placed.x, placed.y, strict=True)]
    assert north > 49.004
    assert max(lat[:147]) == pytest.approx(north, abs=1e-6)
    assert (placed.low, placed.high, placed.since, placed.until) == (-inf, 9_000.0, -inf, inf)


def test_an_airspace_far_away_is_not_in_this_sky() -> None:
    away = ReportedAirspace(
        ident="D", lat_deg=(0.0, 0.0, 1.0), lon_deg=(60.0, 61.0, 60.0), low=0.0, high=1.0,
        since=-inf, until=inf,
    )  # fmt: skip
    assert airspace_on(PLANE, away) is None
