"""Further pursuers of a flight as outsiders send them: a queue before its pursuer, or behind it."""

from math import radians
from typing import TYPE_CHECKING, Annotated

from pydantic import Discriminator, Field, Tag

from relguide.contract.compass import heading_of
from relguide.contract.intent_bodies import Bank
from relguide.contract.other_bodies import Ident, Tas
from relguide.contract.places import (
    Anchor,
    Heading,
    Latitude,
    Longitude,
    Position,
    Unanchored,
    place_near,
    which_position,
)
from relguide.contract.refusal import ContractError, Strict
from relguide.planning.aircraft import Pursuer

if TYPE_CHECKING:
    from relguide.flying.followers import Follower

MAX_FOLLOWERS = 9
"""Most in a queue before a pursuer, or behind it."""


class LocalFollower(Strict):
    """A guided aircraft of a queue, at t = 0."""

    ident: Ident
    """Its own."""
    x_m: Position
    """East."""
    y_m: Position
    """North."""
    heading_deg: Heading
    """Clockwise from true north."""
    tas_mps: Tas
    """True airspeed V_P, kept until its spacing closes."""
    max_bank_deg: Bank
    """Bank of its turns."""


class GeodeticFollower(Strict):
    """A guided aircraft of a queue, at t = 0, placed on the earth (WGS84)."""

    ident: Ident
    """Its own."""
    lat_deg: Latitude
    """WGS84."""
    lon_deg: Longitude
    """WGS84."""
    heading_deg: Heading
    """Clockwise from true north."""
    tas_mps: Tas
    """True airspeed V_P, kept until its spacing closes."""
    max_bank_deg: Bank
    """Bank of its turns."""


FollowerBody = Annotated[
    Annotated[LocalFollower, Tag("#local")] | Annotated[GeodeticFollower, Tag("#geodetic")],
    Discriminator(which_position),
]
"""Placed as the pursuer of the flight is."""
Queue = Annotated[list[FollowerBody], Field(default_factory=list, max_length=MAX_FOLLOWERS)]


def followers_from_body(
    name: str, bodies: list[LocalFollower | GeodeticFollower], anchor: Anchor
) -> "tuple[Follower, ...]":
    """Followers in library units.

    Args:
        name: of the field that they came in.
        bodies: as they came.
        anchor: how the world of the flight lies on the earth.

    Raises:
        ContractError: for one that is placed otherwise than the flight's pursuer.
    """
    from relguide.flying.followers import Follower  # which a client need not load

    found: list[Follower] = []
    for index, body in enumerate(bodies):
        x, y, turned = _place(body, anchor, f"{name}[{index}]")
        pursuer = Pursuer(
            x=x,
            y=y,
            heading=heading_of(body.heading_deg + turned),
            tas=body.tas_mps,
            max_bank=radians(body.max_bank_deg),
        )
        found.append(Follower(ident=body.ident, pursuer=pursuer))
    return tuple(found)


def _place(
    body: LocalFollower | GeodeticFollower, anchor: Anchor, path: str
) -> tuple[float, float, float]:
    match body:
        case LocalFollower(x_m=x, y_m=y) if isinstance(anchor, Unanchored):
            return x, y, 0.0
        case GeodeticFollower(lat_deg=lat, lon_deg=lon) if not isinstance(anchor, Unanchored):
            return place_near(anchor, lat, lon, path)
        case _:
            wrong = "must have x_m, y_m or lat_deg, lon_deg as the pursuer and the leader have."
            raise ContractError([(path, wrong)])
