"""A situation that is flown: what a plan depends on, in what air, and how well the leader is seen.

Where `air` gives no wind, the situation's blows; what `believed_air` leaves out is believed as it
is.
"""

from dataclasses import replace
from typing import TYPE_CHECKING, Annotated, Literal

from pydantic import Field

from relguide.contract.accepted import Accepted
from relguide.contract.bodies import NamedSituationBody, WindBody, situation_from_body, wind_of
from relguide.contract.follower_bodies import Queue, followers_from_body
from relguide.contract.other_bodies import Ident
from relguide.contract.places import Anchor, Heading
from relguide.contract.refusal import ContractError, Strict
from relguide.flying.air import GUSTS, ISA_DEVIATION, Air
from relguide.flying.surveillance import (
    BURST,
    EXACT,
    INTERVAL,
    LATENCY,
    LOSS_SHARE,
    POSITION_BOUNDS,
    VELOCITY_BOUNDS,
    Surveillance,
)
from relguide.flying.wind_profile import LEVELS, WindLevel, WindProfile
from relguide.planning.limits import WIND
from relguide.planning.wind import CALM, Wind

if TYPE_CHECKING:
    from relguide.flying.flight import Scenario

MAX_LEVELS = 100
"""Most levels of a profile."""


class WindLevelBody(Strict):
    """The wind at one altitude."""

    altitude_m: Annotated[float, Accepted(LEVELS)]
    """Pressure altitude."""
    from_deg: Heading
    """Where it comes from, clockwise from true north."""
    speed_mps: Annotated[float, Accepted(WIND)]
    """How strong it is."""


Profile = Annotated[list[WindLevelBody], Field(min_length=1, max_length=MAX_LEVELS)]


class AirBody(Strict):
    """The air as it is, or as it is believed to be."""

    wind: WindBody | None = None
    """The same everywhere; if left out, that of the situation."""
    profile: Profile | None = None
    """The wind by altitude, in place of any other: linear in between, constant beyond the ends."""
    gusts_mps: Annotated[float, Accepted(GUSTS)] = 0.0
    """σ of gusts along and across an aircraft's heading (Dryden). Guidance expects none: in
    `believed_air` it changes nothing."""
    isa_deviation_k: Annotated[float, Accepted(ISA_DEVIATION)] = 0.0
    """How much warmer than the standard atmosphere."""


class SurveillanceBody(Strict):
    """How well the pursuer sees its leader."""

    kind: Literal["exact", "adsb"]
    """`exact`: as it is, and the rest has no meaning. `adsb`: by reports that are noisy, late and
    sometimes lost."""
    nacp: Annotated[int, Field(ge=1, le=max(POSITION_BOUNDS))] = EXACT.nacp
    """Category of positions, NACp."""
    nacv: Annotated[int, Field(ge=1, le=max(VELOCITY_BOUNDS))] = EXACT.nacv
    """Category of velocities, NACv."""
    latency_s: Annotated[float, Accepted(LATENCY)] = EXACT.latency
    """Between a measurement and its report's arrival."""
    interval_s: Annotated[float, Accepted(INTERVAL)] = EXACT.interval
    """Between reports."""
    loss_share: Annotated[float, Accepted(LOSS_SHARE)] = EXACT.loss_share
    """Share of reports that never arrive."""
    burst_s: Annotated[float, Accepted(BURST)] = EXACT.burst
    """Longest time without a report."""


class FlownSituationBody(NamedSituationBody):
    """A situation to be flown."""

    pursuer_ident: Ident = "PURSUER"
    """What the pursuer is called in the flight, e.g. by its callsign."""
    leader_ident: Ident = "LEADER"
    """What the leader is called."""
    air: AirBody | None = None
    """What it is flown in; if left out, the standard atmosphere and `wind`."""
    believed_air: AirBody | None = None
    """What guidance believes of the air at the start; if left out, what the aircraft measures."""
    surveillance: SurveillanceBody | None = None
    """If left out, the leader is seen as it is."""
    ahead: Queue
    """A queue behind the leader, whose last aircraft the pursuer joins; the first one first."""
    followers: Queue
    """A queue behind the pursuer, each behind the one before."""


def scenario_from_body(body: FlownSituationBody) -> tuple["Scenario", Anchor]:
    """The flight of a situation whose shape is right, and how its world lies on the earth.

    Raises:
        ContractError: for what a shape cannot rule out, as two winds that differ.
        ValueError: if the aircraft cannot fly so at the level, or at any, in a sentence.
    """
    from relguide.flying.flight import world_of  # which a client need not load
    from relguide.flying.scenarios import own_scenario

    air = body.air or AirBody()
    situation, anchor = situation_from_body(body.model_copy(update={"wind": _wind(body, air)}))
    profile = _profile("air", air)
    own = own_scenario(situation, isa_deviation=air.isa_deviation_k)
    if profile is not None:
        own = replace(own, situation=replace(situation, wind=profile.at(own.altitude)))
    own = replace(own, profile=profile, gusts=air.gusts_mps, surveillance=_surveillance(body))
    own = replace(own, believed_air=_believed(body, own.air))
    if body.pursuer_ident == body.leader_ident:
        raise ContractError([("leader_ident", "is what the pursuer is called: choose another.")])
    own = replace(own, pursuer_ident=body.pursuer_ident, leader_ident=body.leader_ident)
    _expect_own_idents(body, own)
    own = replace(
        own,
        ahead=followers_from_body("ahead", body.ahead, anchor),
        followers=followers_from_body("followers", body.followers, anchor),
    )
    world_of(own)
    return own, anchor


def _expect_own_idents(body: FlownSituationBody, own: "Scenario") -> None:
    """Refuse others that are called like another aircraft of the flight."""
    taken = {own.pursuer_ident: "pursuer", own.leader_ident: "leader"}
    queue = (("ahead", body.ahead), ("followers", body.followers))
    for name, others in (*queue, ("traffic", body.traffic), ("cells", body.cells)):
        for index, other in enumerate(others):
            if other.ident in taken:
                said = f"is what the {taken[other.ident]} of a flight is called: choose another."
                raise ContractError([(f"{name}[{index}].ident", said)])
            if name in ("ahead", "followers"):
                taken[other.ident] = "follower"


def _wind(body: FlownSituationBody, air: AirBody) -> WindBody:
    """The wind of the situation, which it and its air may give."""
    is_given = "wind" in body.model_fields_set
    if air.profile is not None and is_given:
        said = "gives the wind by altitude: leave out the situation's wind."
        raise ContractError([("air.profile", said)])
    if air.wind is None:
        return body.wind
    if is_given and _as_wind(air.wind) != _as_wind(body.wind):
        said = (
            "is another than the situation's: leave out one of them; what guidance believes of "
            "the wind is given as believed_air."
        )
        raise ContractError([("air.wind", said)])
    return air.wind


def _as_wind(body: WindBody) -> Wind:
    return wind_of(body.from_deg, body.speed_mps)


def _profile(path: str, air: AirBody) -> WindProfile | None:
    if air.profile is None:
        return None
    if air.wind is not None:
        said = "must be left out where a profile gives it by altitude."
        raise ContractError([(f"{path}.wind", said)])
    levels = (
        WindLevel(level.altitude_m, wind_of(level.from_deg, level.speed_mps))
        for level in air.profile
    )
    try:
        return WindProfile(levels=tuple(levels))
    except ValueError as error:  # two winds at one altitude
        raise ContractError([(f"{path}.profile", str(error).removeprefix("levels "))]) from None


def _believed(body: FlownSituationBody, true: Air) -> Air | None:
    """What guidance believes, of what it is told; the rest is true."""
    told = body.believed_air
    if told is None:
        return None
    believed, profile = true, _profile("believed_air", told)
    if profile is not None:
        believed = replace(believed, wind=CALM, profile=profile)
    elif told.wind is not None:
        believed = replace(believed, wind=_as_wind(told.wind), profile=None)
    if "isa_deviation_k" in told.model_fields_set:
        believed = replace(believed, isa_deviation=told.isa_deviation_k)
    return believed


def _surveillance(body: FlownSituationBody) -> Surveillance:
    seen = body.surveillance
    if seen is None:
        return EXACT
    return Surveillance(
        kind=seen.kind,
        nacp=seen.nacp,
        nacv=seen.nacv,
        latency=seen.latency_s,
        interval=seen.interval_s,
        loss_share=seen.loss_share,
        burst=seen.burst_s,
    )
