"""What a pursuer's crew orders, as outsiders write it: an object for each order.

It has its flight time, `t_s`, or waits for a cue: `on`, and how long `after_s`. One more field says
what is ordered.
"""

from abc import abstractmethod
from collections.abc import Mapping
from math import radians
from typing import Annotated, Any

from pydantic import BeforeValidator, Discriminator, Field, Tag, model_validator

from relguide.contract.accepted import Accepted
from relguide.contract.compass import heading_of
from relguide.contract.intent_bodies import Bank
from relguide.contract.other_bodies import Distance, Tas
from relguide.contract.places import Altitude, Heading, Position
from relguide.contract.refusal import TAG, Strict
from relguide.flying.engagement import Engagement
from relguide.flying.orders import (
    DEFLECTION,
    GROUND_SPEED,
    CrewCommand,
    LeaderData,
    LeaderReport,
    PursuerBank,
    PursuerHeading,
    PursuerSpeed,
    SetAutopilot,
    SetDirector,
    SetEngagement,
    SetSpacing,
    Stick,
)
from relguide.flying.scripted_crew import Cue

Ident = Annotated[str, Field(max_length=100)]
OrderTime = Annotated[float, Field(ge=0.0)]
Deflection = Annotated[float, Accepted(DEFLECTION)]
GroundSpeed = Annotated[float, Accepted(GROUND_SPEED)]


class Reported(Strict):
    """Where an aircraft is reported to be, over the ground."""

    x_m: Position
    """East, in the plane of the flight."""
    y_m: Position
    """North."""
    track_deg: Heading
    """Direction of its ground velocity, clockwise from the plane's north."""
    ground_speed_mps: GroundSpeed
    """Over the ground."""
    altitude_m: Altitude
    """Pressure altitude."""

    def order(self, ident: str) -> LeaderReport:
        """What a flight is given, for the aircraft of that ident."""
        return LeaderReport(
            x=self.x_m,
            y=self.y_m,
            track=heading_of(self.track_deg),
            ground_speed=self.ground_speed_mps,
            altitude=self.altitude_m,
            ident=ident,
        )


def _is_left_out(schema: dict[str, Any]) -> None:
    del schema["default"]  # the field is left out, never null


_LEFT_OUT: Any = Field(default=None, json_schema_extra=_is_left_out)


class CrewLine(Strict):
    """An order by a pursuer's crew, and when it gives it."""

    t_s: OrderTime = _LEFT_OUT
    """Flight time at which it is given; left out where it waits for a cue."""
    on: Cue = _LEFT_OUT
    """In place of `t_s`: what it waits for, each time that happens to its pursuer."""
    after_s: OrderTime = 0.0
    """How long after that."""
    ident: Ident = ""
    """The pursuer; empty for the first link's."""

    @model_validator(mode="after")
    def _expect_one_time(self) -> "CrewLine":
        if (self.t_s is None) == (self.on is None):
            raise ValueError("must have t_s or on, and not both.")
        if self.on is None and self.after_s != 0.0:
            raise ValueError("has after_s, which counts from what it waits for: give on, too.")
        return self

    @abstractmethod
    def command(self) -> CrewCommand:
        """What the flight is given."""


class EngagementOrder(CrewLine):
    """The crew designates the leader, accepts what is proposed, engages it, or disconnects."""

    engagement: Engagement
    """How far guidance is engaged from then on."""

    def command(self) -> CrewCommand:
        """What the flight is given."""
        return SetEngagement(engagement=self.engagement, ident=self.ident)


class PursuerHeadingOrder(CrewLine):
    """The crew selects a heading, while guidance is not engaged."""

    pursuer_heading_deg: Heading
    """Clockwise from true north."""

    def command(self) -> CrewCommand:
        """What the flight is given."""
        return PursuerHeading(heading=heading_of(self.pursuer_heading_deg), ident=self.ident)


class PursuerBankOrder(CrewLine):
    """The crew selects the bank that plans turn with."""

    pursuer_max_bank_deg: Bank
    """No more than the autopilot banks."""

    def command(self) -> CrewCommand:
        """What the flight is given."""
        return PursuerBank(bank=radians(self.pursuer_max_bank_deg), ident=self.ident)


class PursuerSpeedOrder(CrewLine):
    """The crew selects a speed in place of the one that guidance asks for."""

    pursuer_tas_mps: Tas | None
    """True airspeed; null leaves the speed to guidance again."""

    def command(self) -> CrewCommand:
        """What the flight is given."""
        return PursuerSpeed(tas=self.pursuer_tas_mps or 0.0, ident=self.ident)


class SpacingOrder(CrewLine):
    """The crew changes D, d_min or both."""

    slot_distance_m: Distance = 0.0
    """D; 0, or left out, leaves it as it is."""
    min_separation_m: Distance = 0.0
    """d_min; 0, or left out, leaves it as it is."""

    @model_validator(mode="after")
    def _expect_a_change(self) -> "SpacingOrder":
        if self.slot_distance_m == self.min_separation_m == 0.0:
            raise ValueError("must have slot_distance_m or min_separation_m above 0, or both.")
        return self

    def command(self) -> CrewCommand:
        """What the flight is given."""
        return SetSpacing(
            slot_distance=self.slot_distance_m,
            min_separation=self.min_separation_m,
            ident=self.ident,
        )


class AutopilotOrder(CrewLine):
    """The crew takes control from the autopilot, or gives it back."""

    autopilot: bool
    """Whether the autopilot flies from then on."""

    def command(self) -> CrewCommand:
        """What the flight is given."""
        return SetAutopilot(on=self.autopilot, ident=self.ident)


class DirectorOrder(CrewLine):
    """The crew switches the flight director."""

    director: bool
    """Whether its bars are on from then on."""

    def command(self) -> CrewCommand:
        """What the flight is given."""
        return SetDirector(on=self.director, ident=self.ident)


class StickOrder(CrewLine):
    """The crew moves the stick, which stays there until the next such order."""

    stick_roll: Deflection = 0.0
    """1 asks for the type's full rate of roll to the right, −1 to the left."""
    stick_pitch: Deflection = 0.0
    """1 pulls up with 0.1 g, −1 pushes down with as much."""

    def command(self) -> CrewCommand:
        """What the flight is given."""
        return Stick(roll=self.stick_roll, pitch=self.stick_pitch, ident=self.ident)


class LeaderDataOrder(CrewLine):
    """The leader's reports are received, or not."""

    leader_data_received: bool
    """Whether they are received from then on."""

    def command(self) -> CrewCommand:
        """What the flight is given."""
        return LeaderData(received=self.leader_data_received, ident=self.ident)


CREW_LINES: Mapping[str, type[CrewLine]] = {
    "engagement": EngagementOrder,
    "pursuer_heading_deg": PursuerHeadingOrder,
    "pursuer_max_bank_deg": PursuerBankOrder,
    "pursuer_tas_mps": PursuerSpeedOrder,
    "slot_distance_m": SpacingOrder,
    "min_separation_m": SpacingOrder,
    "autopilot": AutopilotOrder,
    "director": DirectorOrder,
    "stick_roll": StickOrder,
    "stick_pitch": StickOrder,
    "leader_data_received": LeaderDataOrder,
}
"""The field that only one kind of order has."""


def expect_one(line: Any, known: Mapping[str, Any]) -> Any:
    """Refuse what is no order, or is several.

    Args:
        line: what was sent.
        known: the field that only one kind of order has → that kind.

    Raises:
        ValueError: saying what would be right.
    """
    if not isinstance(line, Mapping):
        raise ValueError("must be an object with fields: an order.")
    given = {known[name] for name in line if name in known}
    if len(given) != 1:
        raise ValueError(f"must have one of {', '.join(known)}, not {len(given)} of them.")
    return line


def kind_in(line: Any, known: Mapping[str, Any]) -> str:
    """The tag of the kind of order that a line is, read or not; `TAG` alone if of none of these."""
    if isinstance(line, Strict):
        kinds = [type(line)] if type(line) in known.values() else []
    else:
        kinds = [known[name] for name in line if name in known]
    return TAG + "".join(kind.__name__ for kind in kinds[:1])


CrewOrderLine = Annotated[
    Annotated[EngagementOrder, Tag("#EngagementOrder")]
    | Annotated[PursuerHeadingOrder, Tag("#PursuerHeadingOrder")]
    | Annotated[PursuerBankOrder, Tag("#PursuerBankOrder")]
    | Annotated[PursuerSpeedOrder, Tag("#PursuerSpeedOrder")]
    | Annotated[SpacingOrder, Tag("#SpacingOrder")]
    | Annotated[AutopilotOrder, Tag("#AutopilotOrder")]
    | Annotated[DirectorOrder, Tag("#DirectorOrder")]
    | Annotated[StickOrder, Tag("#StickOrder")]
    | Annotated[LeaderDataOrder, Tag("#LeaderDataOrder")],
    Discriminator(lambda line: kind_in(line, CREW_LINES)),
    BeforeValidator(lambda line: expect_one(line, CREW_LINES)),
]
"""What a crew orders, and when."""
