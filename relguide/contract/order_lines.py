"""Orders at their flight times as outsiders write them: what a leader does, and what crews do."""

from abc import abstractmethod
from collections.abc import Mapping
from typing import Annotated, Any

from pydantic import BeforeValidator, Discriminator, Tag

from relguide.contract.compass import heading_of
from relguide.contract.crew_lines import (
    CREW_LINES,
    CrewOrderLine,
    Ident,
    OrderTime,
    Reported,
    expect_one,
    kind_in,
)
from relguide.contract.intent_bodies import ClimbRate
from relguide.contract.other_bodies import Tas
from relguide.contract.places import Altitude, Heading
from relguide.contract.refusal import TAG, Strict
from relguide.flying.leaders.declared import TurnChoice
from relguide.flying.orders import (
    IntentKnown,
    LeaderCommand,
    LeaderHeading,
    LeaderLevel,
    LeaderSpeed,
)


class LeaderLine(Strict):
    """An order to a leader, or to any other aircraft that is not guided."""

    t_s: OrderTime
    """Flight time at which it is given."""
    ident: Ident = ""
    """Who is to do so; empty for the first link's leader."""

    @abstractmethod
    def command(self) -> LeaderCommand:
        """What the flight is given."""


class HeadingOrder(LeaderLine):
    """The leader is to turn to a heading."""

    leader_heading_deg: Heading
    """Clockwise from true north."""
    direction: TurnChoice = "shorter"
    """Which way round."""

    def command(self) -> LeaderCommand:
        """What the flight is given."""
        heading = heading_of(self.leader_heading_deg)
        return LeaderHeading(heading=heading, direction=self.direction, ident=self.ident)


class SpeedOrder(LeaderLine):
    """The leader is to fly at a speed."""

    leader_tas_mps: Tas
    """True airspeed."""

    def command(self) -> LeaderCommand:
        """What the flight is given."""
        return LeaderSpeed(tas=self.leader_tas_mps, ident=self.ident)


class LevelOrder(LeaderLine):
    """The leader is to climb or descend."""

    leader_level_m: Altitude
    """Pressure altitude to level off at."""
    rate_mps: ClimbRate = 7.62
    """How fast; 1,500 ft/min if left out."""

    def command(self) -> LeaderCommand:
        """What the flight is given."""
        return LeaderLevel(altitude=self.leader_level_m, rate=self.rate_mps, ident=self.ident)


class ReportOrder(LeaderLine):
    """The leader flies to where it is reported to be a second later."""

    leader_report: Reported
    """Where that is."""

    def command(self) -> LeaderCommand:
        """What the flight is given."""
        return self.leader_report.order(self.ident)


class IntentOrder(LeaderLine):
    """The leader's intent is given to the pursuer, or withdrawn."""

    intent_known: bool
    """Whether the pursuer knows it from then on."""

    def command(self) -> LeaderCommand:
        """What the flight is given."""
        return IntentKnown(known=self.intent_known, ident=self.ident)


_LEADER_LINES: Mapping[str, type[LeaderLine]] = {
    "leader_heading_deg": HeadingOrder,
    "leader_tas_mps": SpeedOrder,
    "leader_level_m": LevelOrder,
    "leader_report": ReportOrder,
    "intent_known": IntentOrder,
}
_LINES = {**_LEADER_LINES, **CREW_LINES}
"""The field that only one kind of order has."""


def _kind_of(line: Any) -> str:
    kind = kind_in(line, _LEADER_LINES)
    return kind if kind != TAG else "#crew"


OrderLine = Annotated[
    Annotated[HeadingOrder, Tag("#HeadingOrder")]
    | Annotated[SpeedOrder, Tag("#SpeedOrder")]
    | Annotated[LevelOrder, Tag("#LevelOrder")]
    | Annotated[ReportOrder, Tag("#ReportOrder")]
    | Annotated[IntentOrder, Tag("#IntentOrder")]
    | Annotated[CrewOrderLine, Tag("#crew")],
    Discriminator(_kind_of),
    BeforeValidator(lambda line: expect_one(line, _LINES)),
]
"""An order at a flight time."""
