"""A leader that is reported and not simulated: where a flight behind it begins, and by what clock.

What it flies from second to second is the business of `atc`, which has the reports.
"""

from collections.abc import Callable
from math import atan2, cos, degrees, hypot, sin
from typing import NamedTuple

from relguide.contract.bodies import GeodeticLeader, GeodeticPursuer, wind_of
from relguide.contract.compass import compass
from relguide.contract.messages import FlightRequest, SituationFlightRequest
from relguide.contract.refusal import ContractError
from relguide.units import Metre, MetrePerSecond, Radian

BY_ITS_CLOCK = (
    "The leader of this flight flies as it is reported, so the flight goes by the clock on the "
    "wall: at rate 1, and never paused."
)


class ReportedPlace(NamedTuple):
    """Where an aircraft is now, as it is reported."""

    lat_deg: float
    """WGS84 [°]."""
    lon_deg: float
    """WGS84 [°]."""
    track: Radian
    """Direction of its ground velocity, clockwise from true north there [rad]."""
    ground_speed: MetrePerSecond
    altitude: Metre | None
    """Pressure altitude; `None` where it is not known."""


Lookup = Callable[[str], ReportedPlace | None]
"""Where an aircraft of that ident is now; `None` if nothing is heard of it."""


def begun_at_report(wanted: FlightRequest, lookup: Lookup) -> FlightRequest:
    """A request whose leader, if it is a reported one, begins where it is reported.

    Args:
        wanted: what is asked for.
        lookup: knows the picture.

    Raises:
        ContractError: if it is not reported, or the flight is not on the earth or at rate 1.
    """
    if not isinstance(wanted, SituationFlightRequest) or wanted.reported_leader is None:
        return wanted
    ident, situation = wanted.reported_leader, wanted.situation
    if wanted.rate != 1.0 or wanted.paused:
        raise ContractError([("reported_leader", BY_ITS_CLOCK)])
    if not isinstance(situation.pursuer, GeodeticPursuer):
        said = "needs a situation on the earth: place both by lat_deg, lon_deg."
        raise ContractError([("reported_leader", said)])
    place = lookup(ident)
    if place is None:
        said = f"{ident} is not in the picture of air traffic: PUT /traffic, or a feed, reports it."
        raise ContractError([("reported_leader", said)])
    wind = wind_of(situation.wind.from_deg, situation.wind.speed_mps)
    east = place.ground_speed * sin(place.track) - wind.east
    north = place.ground_speed * cos(place.track) - wind.north
    leader = GeodeticLeader(
        lat_deg=place.lat_deg,
        lon_deg=place.lon_deg,
        heading_deg=compass(degrees(atan2(east, north))),
        tas_mps=hypot(east, north),
        intent=[],
        altitude_m=place.altitude,
    )
    flown = situation.model_copy(update={"leader": leader, "leader_ident": ident})
    return wanted.model_copy(update={"situation": flown, "intent_known": False})
