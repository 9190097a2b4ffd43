"""The picture of the sky as outsiders send it: traffic with its intents, and closed airspaces.

An intent is given as where the aircraft will be, and when: that is what a ground system knows, and
it needs no wind to be understood. Airspaces are GeoJSON (RFC 7946), with edges along geodesics.
"""

from collections.abc import Sequence
from datetime import UTC, datetime
from itertools import pairwise
from math import asin, cos, degrees, inf, isfinite, radians, sin, sqrt
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import AfterValidator, Field, WithJsonSchema

from relguide.atc.reported import Reported, ReportedAirspace, Waypoint, perimeter
from relguide.contract.accepted import Accepted
from relguide.contract.compass import compass, heading_of
from relguide.contract.other_bodies import Ident
from relguide.contract.places import Altitude, Latitude, Longitude
from relguide.contract.refusal import ContractError, Strict
from relguide.planning.inputs import Range
from relguide.units import Metre, Second

MAX_AIRCRAFT = 5_000
"""Most aircraft that one source may report …"""
MAX_POINTS = 20_000
"""… and most points of all their intents."""
MAX_INTENT = 100
"""Most points of one intent."""
MAX_AIRSPACES = 500
"""Most airspaces that one source may report …"""
MAX_CORNERS = 1_000
"""… most corners of one …"""
MAX_ALL_CORNERS = 20_000
"""… and of all of them."""
LONGEST_EDGE: Metre = 4_000_000.0
"""Round an airspace."""
OLDEST: Second = 60.0
"""A picture that is older is not taken: what is older is forgotten anyway."""
AHEAD: Second = 5.0
"""How far clocks may differ."""
FASTEST = Range(0.0, 600.0, "m/s")
"""Ground speeds."""
CLIMB = Range(-150.0, 150.0, "m/s")
"""Vertical speeds."""
AFTER = Range(0.0, 14_400.0, "s")
"""How far ahead an intent may reach."""
STRAYS = Range(0.0, 20_000.0, "m")
"""How far an aircraft may be from the lines of its intent."""
EARTH: Metre = 6_371_000.0


def _expect_time(text: str) -> str:
    try:
        moment = datetime.fromisoformat(text)
    except ValueError:
        moment = None
    if moment is None or moment.tzinfo is None or not 1970 < moment.year < 2200:
        raise ValueError(f"must be a time with its zone, as {_EXAMPLE}, not {text[:40]!r}.")
    return text


_EXAMPLE = "2026-11-23T06:30:00Z"
Moment = Annotated[
    str,
    Field(max_length=40),
    AfterValidator(_expect_time),
    WithJsonSchema({"type": "string", "format": "date-time", "maxLength": 40}),
]
"""A time with its zone, ISO 8601."""


class IntentPoint(Strict):
    """Where an aircraft intends to be, and when."""

    t_s: Annotated[float, Accepted(AFTER)]
    """How long after the report of the aircraft; each point is later than the one before."""
    lat_deg: Latitude
    """WGS84."""
    lon_deg: Longitude
    """WGS84."""
    altitude_m: Altitude | None = None
    """Pressure altitude there; if left out, as at the point before."""


class ReportedAircraft(Strict):
    """An aircraft as it is reported."""

    ident: Ident
    """Its name in the picture: callsign, or address."""
    lat_deg: Latitude
    """WGS84."""
    lon_deg: Longitude
    """WGS84."""
    track_deg: float
    """Direction in which it moves over the ground, clockwise from true north."""
    ground_speed_mps: Annotated[float, Accepted(FASTEST)]
    """How fast it moves over the ground."""
    altitude_m: Altitude | None = None
    """Pressure altitude; if left out it is not known, and height keeps nothing apart."""
    climb_mps: Annotated[float, Accepted(CLIMB)] = 0.0
    """Vertical speed, positive up."""
    intent: Annotated[list[IntentPoint], Field(max_length=MAX_INTENT, default_factory=list)]
    """Where it intends to be, from here on: straight from point to point at constant speed, and
    past the last one straight on. Turns are given by points along them. Left out: not known."""
    strays_m: Annotated[float, Accepted(STRAYS)] = 0.0
    """How far it may be from these lines at their time, beyond what is always allowed for."""
    as_of: Moment | None = None
    """When it was there; if left out, at the time of the whole picture."""


class TrafficReport(Strict):
    """All aircraft that a source sees: they take the place of those that it reported before."""

    as_of: Moment
    """When they were there."""
    aircraft: Annotated[list[ReportedAircraft], Field(max_length=MAX_AIRCRAFT)]
    """None: it sees no aircraft any more."""


class TrafficTaken(Strict):
    """What became of a report."""

    source: str
    """Who reported."""
    aircraft: int
    """How many are taken from it."""
    too_old: list[str]
    """Idents of those whose own time is so long ago that they are forgotten already."""
    known_later: list[str]
    """Idents of those that another source reported at a later time: that report counts."""


class SeenAircraft(ReportedAircraft):
    """An aircraft of the picture: the newest report of it."""

    age_s: float
    """How long ago it was there."""
    source: str
    """Who reported it."""
    also_from: list[str]
    """Who reported it as well, but not as lately."""


class TrafficPicture(Strict):
    """All reported aircraft."""

    as_of: str
    """When this was put together, UTC."""
    aircraft: list[SeenAircraft]
    """By ident; flights of this service are not among them."""


Coordinates = Annotated[list[float], Field(min_length=2, max_length=3)]


class AirspaceGeometry(Strict):
    """The outline of an airspace."""

    type: Literal["Polygon"]
    """Of several parts each is an airspace of its own."""
    coordinates: Annotated[
        list[Annotated[list[Coordinates], Field(min_length=4, max_length=MAX_CORNERS + 1)]],
        Field(min_length=1, max_length=1),
    ]
    """One ring of [longitude, latitude], closed: the first is given again as the last."""


class AirspaceProperties(Strict):
    """When and between which heights an airspace is closed."""

    ident: Ident
    """Its name in answers."""
    from_altitude_m: Altitude | None = None
    """Pressure altitude of its floor; if left out or null, from the ground."""
    to_altitude_m: Altitude | None = None
    """… and of its ceiling; if left out or null, without one."""
    since: Moment | None = None
    """From when it is closed; if left out or null, always."""
    until: Moment | None = None
    """Until when; if left out or null, always."""
    source: str | None = None
    """Who reports it: in answers, and ignored in a report."""


class AirspaceFeature(Strict):
    """A closed airspace as GeoJSON."""

    type: Literal["Feature"]
    """Which object of GeoJSON it is."""
    properties: AirspaceProperties
    """When and between which heights it is closed."""
    geometry: AirspaceGeometry
    """Where it is."""
    id: str | int | None = None
    """Not looked at."""
    bbox: list[float] | None = None
    """Not looked at."""


class AirspaceReport(Strict):
    """All closed airspaces of a source: they take the place of those that it reported before."""

    type: Literal["FeatureCollection"]
    """Which object of GeoJSON it is."""
    features: Annotated[list[AirspaceFeature], Field(max_length=MAX_AIRSPACES)]
    """The airspaces."""
    name: str | None = None
    """Not looked at."""
    bbox: list[float] | None = None
    """Not looked at."""


def utc(text: str) -> Second:
    """A `Moment` as UTC [s]."""
    return datetime.fromisoformat(text).timestamp()


def moment(t: Second) -> str:
    """UTC [s] as a `Moment`, to the millisecond."""
    said = datetime.fromtimestamp(round(t, 3), UTC).isoformat(timespec="milliseconds")
    return said.replace("+00:00", "Z")


def reported_from_body(body: TrafficReport, now: Second) -> list[Reported]:
    """The aircraft of a report whose shape is right.

    Args:
        body: a report.
        now: UTC [s].

    Raises:
        ContractError: for what a shape cannot rule out.
    """
    as_of = _expect_near("as_of", body.as_of, now)
    if as_of < now - OLDEST:
        late = f"is {now - as_of:.0f} s ago, and what is older than {OLDEST:.0f} s is forgotten: "
        raise ContractError([("as_of", f"{late}send it while it is new.")])
    points = sum(len(one.intent) for one in body.aircraft)
    if points > MAX_POINTS:
        many = f"must have at most {MAX_POINTS:,} points of intent in all, not {points:,}."
        raise ContractError([("aircraft", many)])
    first: dict[str, int] = {}
    for index, one in enumerate(body.aircraft):
        if one.ident in first:
            said = f"is that of aircraft[{first[one.ident]}] already: report each once."
            raise ContractError([(f"aircraft[{index}].ident", said)])
        first[one.ident] = index
    return [
        _reported(one, as_of, now, f"aircraft[{index}]") for index, one in enumerate(body.aircraft)
    ]


def _expect_near(path: str, text: str, now: Second) -> Second:
    t = utc(text)
    if t > now + AHEAD:
        ahead = f"is {t - now:.0f} s from now: clocks may differ by {AHEAD:.0f} s."
        raise ContractError([(path, ahead)])
    return t


def _reported(body: ReportedAircraft, as_of: Second, now: Second, path: str) -> Reported:
    t = as_of if body.as_of is None else _expect_near(f"{path}.as_of", body.as_of, now)
    here: ReportedAircraft | IntentPoint = body
    since = 0.0
    for index, point in enumerate(body.intent):
        where = f"{path}.intent[{index}]"
        if point.t_s <= since:
            found = f"must be later than {since:g} s, not {point.t_s:g} s: points are in order."
            raise ContractError([(f"{where}.t_s", found)])
        if point.altitude_m is not None and body.altitude_m is None:
            need = "needs the altitude_m of the aircraft itself as well."
            raise ContractError([(f"{where}.altitude_m", need)])
        speed = _apart(here, point) / (point.t_s - since)
        if speed > FASTEST.high:
            found = f"is reached at {speed:,.0f} m/s: aircraft fly at most {FASTEST.high:g} m/s."
            raise ContractError([(where, found)])
        here, since = point, point.t_s
    return Reported(
        ident=body.ident,
        t=t,
        lat_deg=body.lat_deg,
        lon_deg=body.lon_deg,
        track=heading_of(body.track_deg),
        ground_speed=body.ground_speed_mps,
        altitude=body.altitude_m,
        climb=body.climb_mps,
        waypoints=tuple(
            Waypoint(
                t=t + point.t_s,
                lat_deg=point.lat_deg,
                lon_deg=point.lon_deg,
                altitude=point.altitude_m,
            )
            for point in body.intent
        ),
        strays=body.strays_m,
    )


def _apart(a: ReportedAircraft | IntentPoint, b: IntentPoint) -> Metre:
    """How far it is along a great circle of a sphere: right within 0.5 %."""
    lat, next_lat = radians(a.lat_deg), radians(b.lat_deg)
    half_lat, half_lon = 0.5 * (next_lat - lat), 0.5 * radians(b.lon_deg - a.lon_deg)
    share = sin(half_lat) ** 2 + cos(lat) * cos(next_lat) * sin(half_lon) ** 2
    return 2.0 * EARTH * asin(min(sqrt(share), 1.0))


def aircraft_card(one: Reported, now: Second, source: str, also: Sequence[str]) -> dict[str, Any]:
    """A `SeenAircraft` in JSON: what is not known is left out.

    Args:
        one: the newest report.
        now: UTC [s].
        source: who reported it.
        also: who reported it as well.
    """
    intent = []
    for point in one.waypoints:
        height = {} if point.altitude is None else {"altitude_m": point.altitude}
        place = {"lat_deg": point.lat_deg, "lon_deg": point.lon_deg}
        intent.append({"t_s": round(point.t - one.t, 3), **place, **height})
    return {
        "ident": one.ident,
        "lat_deg": one.lat_deg,
        "lon_deg": one.lon_deg,
        "track_deg": round(compass(degrees(one.track)), 9),
        "ground_speed_mps": one.ground_speed,
        **({} if one.altitude is None else {"altitude_m": one.altitude}),
        "climb_mps": one.climb,
        "intent": intent,
        "strays_m": one.strays,
        "as_of": moment(one.t),
        "age_s": round(max(now - one.t, 0.0), 3),
        "source": source,
        "also_from": list(also),
    }


def airspaces_from_body(body: AirspaceReport) -> list[ReportedAirspace]:
    """The airspaces of a report whose shape is right.

    Raises:
        ContractError: for what a shape cannot rule out.
    """
    corners = sum(len(one.geometry.coordinates[0]) - 1 for one in body.features)
    if corners > MAX_ALL_CORNERS:
        many = f"must have at most {MAX_ALL_CORNERS:,} corners in all, not {corners:,}."
        raise ContractError([("features", many)])
    first: dict[str, int] = {}
    for index, feature in enumerate(body.features):
        ident = feature.properties.ident
        if ident in first:
            said = f"is that of features[{first[ident]}] already: give each its own."
            raise ContractError([(f"features[{index}].properties.ident", said)])
        first[ident] = index
    return [_airspace(feature, f"features[{index}]") for index, feature in enumerate(body.features)]


def _airspace(feature: AirspaceFeature, path: str) -> ReportedAirspace:
    ring, where = feature.geometry.coordinates[0], f"{path}.geometry.coordinates[0]"
    if ring[0][:2] != ring[-1][:2]:
        raise ContractError(
            [(where, "must be closed: the first corner is given again as the last.")]
        )
    for index, (lon, lat, *_) in enumerate(ring):
        if not (-180.0 <= lon <= 180.0 and -90.0 <= lat <= 90.0):
            wrong = f"must be [longitude, latitude] within ±180° and ±90°, not [{lon:g}, {lat:g}]."
            raise ContractError([(f"{where}[{index}]", wrong)])
    corners = [(lon, lat) for lon, lat, *_ in ring]
    edges = [(here, there) for here, there in pairwise(corners) if here != there]
    crossing = _crossing(edges)
    if crossing:
        raise ContractError([(where, f"must not cross itself, as it does {crossing}.")])
    lat_deg, lon_deg = (tuple(here[k] for here, _ in edges) for k in (1, 0))
    if len(edges) < 3:
        raise ContractError([(where, "must have three corners at least that differ.")])
    length = perimeter(lat_deg, lon_deg)
    if not isfinite(length) or length > LONGEST_EDGE:
        long = (
            f"must be at most {LONGEST_EDGE / 1000.0:,.0f} km round, not {length / 1000.0:,.0f} km."
        )
        raise ContractError([(where, long)])
    about = feature.properties
    low = -inf if about.from_altitude_m is None else about.from_altitude_m
    high = inf if about.to_altitude_m is None else about.to_altitude_m
    if low >= high:
        found = f"must be above from_altitude_m ({low:g} m), not {high:g} m."
        raise ContractError([(f"{path}.properties.to_altitude_m", found)])
    since = -inf if about.since is None else utc(about.since)
    until = inf if about.until is None else utc(about.until)
    if since >= until:
        found = f"must be later than since ({about.since}), not {about.until}."
        raise ContractError([(f"{path}.properties.until", found)])
    return ReportedAirspace(
        ident=about.ident, lat_deg=lat_deg, lon_deg=lon_deg,
        low=low, high=high, since=since, until=until,
    )  # fmt: skip


Corner = tuple[float, float]


def _crossing(edges: Sequence[tuple[Corner, Corner]]) -> str:
    """Where two edges of a ring cross, for people; empty if none do.

    They are looked at as straight in longitude and latitude, which changes nothing but for edges
    that nearly touch.
    """
    a, b = (np.array([edge[k] for edge in edges], dtype=np.float64) for k in (0, 1))
    if len(edges) < 4:
        return ""
    # longitudes beyond 180° count on, so that none jumps
    turn = np.round((b[:, 0] - a[:, 0]) / 360.0)
    a[:, 0] -= 360.0 * np.concatenate([[0.0], np.cumsum(turn)[:-1]])
    b[:, 0] -= 360.0 * np.cumsum(turn)
    for k in range(len(edges) - 2):
        # neighbours share a corner; the last is the first one's neighbour
        others = slice(k + 2, len(edges) - (k == 0))
        one = _side(a[k], b[k], a[others]) * _side(a[k], b[k], b[others]) < 0.0
        two = _side(a[others], b[others], a[k]) * _side(a[others], b[others], b[k]) < 0.0
        found = np.flatnonzero(one & two)
        if found.size:
            other = edges[k + 2 + int(found[0])]
            return f"between {_named(edges[k])} and {_named(other)}"
    return ""


def _side(a: Any, b: Any, place: Any) -> Any:
    """On which side of the line from a to b a place is: positive on the left."""
    return (b[..., 0] - a[..., 0]) * (place[..., 1] - a[..., 1]) - (b[..., 1] - a[..., 1]) * (
        place[..., 0] - a[..., 0]
    )


def _named(edge: tuple[Corner, Corner]) -> str:
    (lon, lat), (next_lon, next_lat) = edge
    return f"[{lon:g}, {lat:g}]–[{next_lon:g}, {next_lat:g}]"


def airspace_feature(one: ReportedAirspace, source: str) -> dict[str, Any]:
    """An `AirspaceFeature` in JSON: what has no end is left out.

    Args:
        one: an airspace.
        source: who reports it.
    """
    ring = [[lon, lat] for lon, lat in zip(one.lon_deg, one.lat_deg, strict=True)]
    heights = {"from_altitude_m": one.low, "to_altitude_m": one.high}
    times = {"since": one.since, "until": one.until}
    return {
        "type": "Feature",
        "properties": {
            "ident": one.ident,
            **{name: value for name, value in heights.items() if isfinite(value)},
            **{name: moment(value) for name, value in times.items() if isfinite(value)},
            "source": source,
        },
        "geometry": {"type": "Polygon", "coordinates": [[*ring, ring[0]]]},
    }
