"""Air traffic as outsiders send it, with its intents.

An intent is given as where the aircraft will be, and when: that is what a ground system knows, and
it needs no wind to be understood.
"""

from collections.abc import Sequence
from math import asin, cos, degrees, radians, sin, sqrt
from typing import Annotated, Any

from pydantic import Field

from relguide.atc.reported import Reported, Waypoint
from relguide.contract.accepted import Accepted
from relguide.contract.compass import compass, heading_of
from relguide.contract.moments import Moment, moment, utc
from relguide.contract.other_bodies import Ident
from relguide.contract.places import Altitude, Heading, Latitude, Longitude
from relguide.contract.refusal import ContractError, Strict
from relguide.planning.inputs import Range
from relguide.units import Metre, Second

MAX_AIRCRAFT = 5_000
"""Most aircraft that one source may report …"""
MAX_POINTS = 20_000
"""… and most points of all their intents."""
MAX_INTENT = 100
"""Most points of one intent."""
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
    track_deg: Heading
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
