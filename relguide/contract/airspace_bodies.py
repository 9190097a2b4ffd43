"""Closed airspaces as outsiders send them: GeoJSON (RFC 7946), with edges along geodesics."""

from collections.abc import Sequence
from itertools import pairwise
from math import inf, isfinite
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import Field

from relguide.atc.reported import ReportedAirspace, perimeter
from relguide.contract.moments import Moment, moment, utc
from relguide.contract.other_bodies import Ident
from relguide.contract.places import Altitude
from relguide.contract.refusal import ContractError, Strict
from relguide.units import Metre

MAX_AIRSPACES = 500
"""Most airspaces that one source may report …"""
MAX_CORNERS = 1_000
"""… most corners of one …"""
MAX_ALL_CORNERS = 20_000
"""… and of all of them."""
LONGEST_EDGE: Metre = 4_000_000.0
"""Round an airspace."""
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
