"""Where things are as outsiders say it: x, y of the world frame, or latitude and longitude."""

from collections.abc import Mapping
from dataclasses import dataclass
from math import degrees, hypot, isfinite
from typing import Annotated, Any, NamedTuple

from pydantic import Field

from relguide.contract.accepted import Accepted
from relguide.contract.refusal import ContractError
from relguide.planning import limits
from relguide.planning.frames import LocalPlane
from relguide.units import Metre

Position = Annotated[float, Accepted(limits.POSITION)]
Heading = Annotated[float, Accepted(limits.COMPASS)]
Altitude = Annotated[float, Accepted(limits.ALTITUDE)]
Latitude = Annotated[float, Field(ge=-90.0, le=90.0)]
Longitude = Annotated[float, Field(ge=-180.0, le=180.0)]


@dataclass(frozen=True, slots=True, kw_only=True)
class Unanchored:
    """Positions came as x, y: there are no latitudes to give back."""


Anchor = LocalPlane | Unanchored
UNANCHORED = Unanchored()
"""How the world frame lies on the earth."""


class PlaceOnPlane(NamedTuple):
    """A place on the earth, in the world frame."""

    x: Metre
    y: Metre
    turned_deg: float
    """What makes a direction from true north there one of the world frame [°]."""


def which_position(value: Any) -> str:
    """The tag of a body by how it says where it is."""
    if isinstance(value, Mapping):
        geodetic = "lat_deg" in value or "lon_deg" in value
    else:
        geodetic = hasattr(value, "lat_deg")
    return "#geodetic" if geodetic else "#local"


def place_near(plane: LocalPlane, lat_deg: float, lon_deg: float, path: str) -> PlaceOnPlane:
    """A latitude and a longitude in the world frame of a leader.

    Args:
        plane: touches the earth at the leader.
        lat_deg: WGS84 [°].
        lon_deg: WGS84 [°].
        path: of what is there, for a refusal.

    Raises:
        ContractError: if it is farther away than a situation reaches.
    """
    x, y = plane.to_local(lat_deg, lon_deg)
    # at the antipode the projection gives infinity
    if not (isfinite(x) and isfinite(y)) or hypot(x, y) > limits.POSITION.high:
        message = f"must lie within {limits.POSITION.high / 1000.0:g} km of the leader."
        raise ContractError([(f"{path}.lat_deg, {path}.lon_deg", message)])
    return PlaceOnPlane(x, y, degrees(plane.meridian(lat_deg, lon_deg)))
