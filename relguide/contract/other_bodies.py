"""Other traffic and weather cells as outsiders send them, placed as both aircraft are.

On the earth, directions are from true north where the aircraft or the cell is: at the middle of a
disc, at the first corner of a polygon.
"""

from collections.abc import Mapping, Sequence
from itertools import chain
from math import cos, radians, sin
from typing import Annotated, Any, assert_never

from pydantic import AfterValidator, Discriminator, Field, Tag

from relguide.contract.accepted import Accepted
from relguide.contract.compass import heading_of
from relguide.contract.intent_bodies import Intent, intent_from_body
from relguide.contract.places import (
    Altitude,
    Anchor,
    Heading,
    Latitude,
    Longitude,
    PlaceOnPlane,
    Position,
    Unanchored,
    place_near,
    which_position,
)
from relguide.contract.refusal import ContractError, Strict
from relguide.planning import limits
from relguide.planning.aircraft import LONGEST_IDENT, Traffic, expect_ident
from relguide.planning.cells import Cell, Disc, Polygon
from relguide.planning.frames import LocalPlane
from relguide.planning.situation import Other
from relguide.units import Metre

Tas = Annotated[float, Accepted(limits.TAS)]
Distance = Annotated[float, Accepted(limits.DISTANCE)]
Radius = Annotated[float, Accepted(limits.CELL_RADIUS)]
CellSpeed = Annotated[float, Accepted(limits.CELL_SPEED)]
Velocity = Annotated[
    list[CellSpeed], Field(min_length=2, max_length=2, default_factory=lambda: [0.0, 0.0])
]
Growth = Annotated[float, Accepted(limits.GROWTH)]


def _expect_printable(ident: str) -> str:
    try:
        return expect_ident("", ident)
    except ValueError as error:
        raise ValueError(str(error).strip()) from None


Ident = Annotated[str, Field(max_length=LONGEST_IDENT), AfterValidator(_expect_printable)]


class LocalTraffic(Strict):
    """Another aircraft, at t = 0, with what it has declared it will do: to be kept clear of."""

    ident: Ident
    """Its name in answers: no other aircraft and no cell has it."""
    x_m: Position
    """East."""
    y_m: Position
    """North."""
    heading_deg: Heading
    """Clockwise from true north."""
    tas_mps: Tas
    """True airspeed, kept constant."""
    altitude_m: Altitude | None = None
    """Pressure altitude; if left out it is not known, and height keeps nothing apart."""
    intent: Annotated[Intent, Field(default_factory=list)]
    """Pieces to come; what follows the last is flown for ever."""
    min_separation_m: Distance | None = None
    """How near the pursuer may come to it; if left out, as near as to the leader."""


class GeodeticTraffic(Strict):
    """Another aircraft, at t = 0, placed on the earth (WGS84): to be kept clear of."""

    ident: Ident
    """Its name in answers: no other aircraft and no cell has it."""
    lat_deg: Latitude
    """WGS84."""
    lon_deg: Longitude
    """WGS84."""
    heading_deg: Heading
    """Clockwise from true north."""
    tas_mps: Tas
    """True airspeed, kept constant."""
    altitude_m: Altitude | None = None
    """Pressure altitude; if left out it is not known, and height keeps nothing apart."""
    intent: Annotated[Intent, Field(default_factory=list)]
    """Pieces to come; what follows the last is flown for ever."""
    min_separation_m: Distance | None = None
    """How near the pursuer may come to it; if left out, as near as to the leader."""


TrafficBody = LocalTraffic | GeodeticTraffic


class LocalDisc(Strict):
    """A round cell, at t = 0."""

    x_m: Position
    """Its middle, east."""
    y_m: Position
    """Its middle, north."""
    radius_m: Radius
    """From its middle to its edge."""


class GeodeticDisc(Strict):
    """A round cell, at t = 0, placed on the earth (WGS84)."""

    lat_deg: Latitude
    """Its middle, WGS84."""
    lon_deg: Longitude
    """Its middle, WGS84."""
    radius_m: Radius
    """From its middle to its edge."""


class GeodeticCorner(Strict):
    """A corner of a cell, placed on the earth (WGS84)."""

    lat_deg: Latitude
    """WGS84."""
    lon_deg: Longitude
    """WGS84."""


LocalCorner = Annotated[list[Position], Field(min_length=2, max_length=2)]


class DiscCell(Strict):
    """A round weather cell at all levels, to be kept out of."""

    ident: Ident
    """Its name in answers: no other cell and no aircraft has it."""
    disc: Annotated[
        Annotated[LocalDisc, Tag("#local")] | Annotated[GeodeticDisc, Tag("#geodetic")],
        Discriminator(which_position),
    ]
    """Where it is."""
    velocity_mps: Velocity
    """How it moves over the ground: east, north."""
    growth_mps: Growth = 0.0
    """How fast its edge moves outward."""


class PolygonCell(Strict):
    """A convex weather cell at all levels, to be kept out of."""

    ident: Ident
    """Its name in answers: no other cell and no aircraft has it."""
    polygon: Annotated[
        list[
            Annotated[
                Annotated[LocalCorner, Tag("#local")] | Annotated[GeodeticCorner, Tag("#geodetic")],
                Discriminator(which_position),
            ]
        ],
        Field(min_length=3, max_length=limits.MAX_CORNERS + 1),
    ]
    """Its corners in turn, [east, north]; the first may be given again as the last."""
    velocity_mps: Velocity
    """How it moves over the ground: east, north."""
    growth_mps: Growth = 0.0
    """How fast its edge moves outward."""


CellBody = DiscCell | PolygonCell


def _which_shape(value: Any) -> str:
    if isinstance(value, Mapping):
        return "#polygon" if "polygon" in value else "#disc"
    return "#polygon" if isinstance(value, PolygonCell) else "#disc"


AnyTraffic = Annotated[
    Annotated[LocalTraffic, Tag("#local")] | Annotated[GeodeticTraffic, Tag("#geodetic")],
    Discriminator(which_position),
]
AnyCell = Annotated[
    Annotated[DiscCell, Tag("#disc")] | Annotated[PolygonCell, Tag("#polygon")],
    Discriminator(_which_shape),
]
TrafficList = Annotated[list[AnyTraffic], Field(max_length=limits.MAX_OTHERS)]
CellList = Annotated[list[AnyCell], Field(max_length=limits.MAX_OTHERS)]


def others_from_body(
    traffic: Sequence[TrafficBody],
    cells: Sequence[CellBody],
    anchor: Anchor,
    min_separation: Metre,
) -> tuple[Other, ...]:
    """Other traffic and cells whose shapes are right, in library units; traffic first.

    Args:
        traffic: other aircraft.
        cells: weather.
        anchor: how pursuer and leader are placed.
        min_separation: that of traffic which gives none [m].

    Raises:
        ContractError: for what a shape cannot rule out.
    """
    if len(traffic) + len(cells) > limits.MAX_OTHERS:
        found = f"must be at most {limits.MAX_OTHERS} together, not {len(traffic) + len(cells)}."
        raise ContractError([("traffic, cells", found)])
    first: dict[str, str] = {}
    for path, other in chain(_named("traffic", traffic), _named("cells", cells)):
        if other.ident in first:
            said = f"is that of {first[other.ident]} already: give each its own."
            raise ContractError([(f"{path}.ident", said)])
        first[other.ident] = path
    return (
        *(
            _traffic(body, anchor, path, min_separation)
            for path, body in _named("traffic", traffic)
        ),
        *(_cell(body, anchor, path) for path, body in _named("cells", cells)),
    )


def _named(name: str, bodies: Sequence[Any]) -> list[tuple[str, Any]]:
    return [(f"{name}[{index}]", body) for index, body in enumerate(bodies)]


def _traffic(body: TrafficBody, anchor: Anchor, path: str, min_separation: Metre) -> Traffic:
    place = _place(body, anchor, path)
    limit = body.min_separation_m
    return Traffic(
        ident=body.ident,
        x=place.x,
        y=place.y,
        heading=heading_of(body.heading_deg + place.turned_deg),
        tas=body.tas_mps,
        min_separation=min_separation if limit is None else limit,
        intent=intent_from_body(body.intent, turned_deg=place.turned_deg),
        altitude=body.altitude_m,
    )


def _cell(body: CellBody, anchor: Anchor, path: str) -> Cell:
    shape: Disc | Polygon
    match body:
        case DiscCell(disc=disc):
            first = _place(disc, anchor, f"{path}.disc")
            shape = Disc(x=first.x, y=first.y, radius=disc.radius_m)
        case PolygonCell(polygon=polygon):
            corners = [
                _place(corner, anchor, f"{path}.polygon[{index}]")
                for index, corner in enumerate(polygon)
            ]
            first = corners[0]
            try:
                shape = Polygon(corners=tuple((corner.x, corner.y) for corner in corners))
            except ValueError as error:
                wrong = str(error).removeprefix("polygon.corners ")
                raise ContractError([(f"{path}.polygon", wrong)]) from None
        case _:
            assert_never(body)
    east, north = body.velocity_mps
    turned = radians(first.turned_deg)
    return Cell(
        ident=body.ident,
        shape=shape,
        east=east * cos(turned) + north * sin(turned),
        north=north * cos(turned) - east * sin(turned),
        growth=body.growth_mps,
    )


def _place(
    body: TrafficBody | LocalDisc | GeodeticDisc | GeodeticCorner | list[float],
    anchor: Anchor,
    path: str,
) -> PlaceOnPlane:
    """Where something is, which must be said as it is said of pursuer and leader."""
    match body, anchor:
        case ((LocalTraffic() | LocalDisc()), Unanchored()):
            return PlaceOnPlane(body.x_m, body.y_m, 0.0)
        case [x, y], Unanchored():
            return PlaceOnPlane(x, y, 0.0)
        case ((GeodeticTraffic() | GeodeticDisc() | GeodeticCorner()), LocalPlane()):
            return place_near(anchor, body.lat_deg, body.lon_deg, path)
        case _, Unanchored():
            wanted = "[x, y]" if isinstance(body, GeodeticCorner) else "x_m, y_m"
        case _:
            wanted = "lat_deg, lon_deg"
    raise ContractError([(path, f"must be placed by {wanted}, as pursuer and leader are.")])
