"""A sky as controllers see it: a label for each aircraft, and what is closed."""

from collections.abc import Mapping, Sequence
from datetime import UTC, datetime
from math import inf, isfinite

import numpy as np

from relguide.atc.documents import AirspaceCard, SkyCard, TrafficCard, TrafficSeen
from relguide.atc.picture import Airspace, Picture, Seen
from relguide.contract.wire import Place
from relguide.planning.frames import LocalPlane
from relguide.units import FT, Metre, Second

HUNDRED: Metre = 100.0 * FT
"""A flight level."""


def traffic_seen(
    sky: str, title: str, picture: Picture, sources: Mapping[str, tuple[str, str]]
) -> TrafficSeen:
    """A sky now.

    Args:
        sky: its id.
        title: for people.
        picture: of it.
        sources: who reports an aircraft, and the flight that it is of, by ident.
    """
    now = picture.as_of
    return TrafficSeen(
        t=now,
        sky=SkyCard(
            id=sky,
            title=title,
            airspaces=tuple(_airspace(one, now, dated=sky == "") for one in picture.airspaces),
        ),
        aircraft=tuple(
            _aircraft(one, now, *sources.get(one.ident, ("clearance", "")))
            for one in picture.aircraft
        ),
    )


def places_of(seen: TrafficSeen, plane: LocalPlane) -> Place:
    """x, y → latitude, longitude on a plane: of all aircraft that are seen, made at once.

    One at a time takes twenty times as long.
    """
    x = np.array([one.x for one in seen.aircraft])
    y = np.array([one.y for one in seen.aircraft])
    lat, lon = plane.to_geodetic_each(x, y)
    places = zip(lat.tolist(), lon.tolist(), strict=True)
    known = dict(zip(zip(x.tolist(), y.tolist(), strict=True), places, strict=True))

    def place(east: Metre, north: Metre) -> tuple[float, float]:
        return known.get((east, north)) or plane.to_geodetic(east, north)

    return place


def _aircraft(one: Seen, now: Second, source: str, flight_id: str) -> TrafficCard:
    return TrafficCard(
        ident=one.ident,
        x=one.x,
        y=one.y,
        track=one.track,
        ground_speed=one.ground_speed,
        altitude=one.altitude or 0.0,
        climb=one.climb,
        age=max(now - one.t, 0.0),
        intends=one.path is not None,
        source=source,
        flight_id=flight_id,
    )


def _airspace(one: Airspace, now: Second, *, dated: bool) -> AirspaceCard:
    times = _times(one.since, one.until) if dated else ""
    return AirspaceCard(
        ident=one.ident,
        x=_column(one.x),
        y=_column(one.y),
        text=f"{_level(one.low)}–{_level(one.high)}{times}",
        closed=one.since <= now < one.until,
    )


def _column(values: Sequence[float]) -> tuple[float, ...]:
    return tuple(float(value) for value in values)


def _level(altitude: Metre) -> str:
    if altitude == -inf:
        return "GND"
    if altitude == inf:
        return "UNL"
    return f"FL{max(altitude, 0.0) / HUNDRED:03.0f}"


def _times(since: Second, until: Second) -> str:
    """From when until when, as far as there is an end."""
    begin = f" from {_time(since)}" if isfinite(since) else ""
    return f"{begin} until {_time(until)}" if isfinite(until) else begin


def _time(t: Second) -> str:
    return f"{datetime.fromtimestamp(t, UTC):%d %b %H:%MZ}"
