"""What a flight in the air can be told: its pace, what others do, and what a crew does."""

from typing import Annotated, Literal

from pydantic import Field, model_validator

from relguide.contract.crew_lines import Deflection, Ident, Reported
from relguide.contract.intent_bodies import Bank, ClimbRate
from relguide.contract.other_bodies import Distance, Tas
from relguide.contract.places import Altitude, Heading
from relguide.contract.refusal import Strict
from relguide.flying.engagement import Engagement
from relguide.flying.plan_documents import Direction

Rate = Annotated[float, Field(ge=1.0, le=60.0)]
"""Accepted simulated seconds per second."""


class PlayCommand(Strict):
    """Continue the flight."""

    command: Literal["play"]
    """Which command it is."""


class PauseCommand(Strict):
    """Pause the flight."""

    command: Literal["pause"]
    """Which command it is."""


class SetRateCommand(Strict):
    """Change how fast simulated time runs."""

    command: Literal["set_rate"]
    """Which command it is."""
    rate: Rate
    """Simulated seconds per second."""


class LeaderHeadingCommand(Strict):
    """Instruct the leader to turn to a heading."""

    command: Literal["leader_heading"]
    """Which command it is."""
    heading_deg: Heading
    """Clockwise from true north."""
    direction: Direction | None = None
    """Which way round; if left out, the shorter."""
    ident: Ident = ""
    """Of the aircraft; if left out, the first link's leader."""


class LeaderSpeedCommand(Strict):
    """Instruct the leader to fly at a speed."""

    command: Literal["leader_speed"]
    """Which command it is."""
    tas_mps: Tas
    """True airspeed."""
    ident: Ident = ""
    """Of the aircraft; if left out, the first link's leader."""


class LeaderLevelCommand(Strict):
    """Instruct the leader to climb or descend to a level."""

    command: Literal["leader_level"]
    """Which command it is."""
    altitude_m: Altitude
    """Pressure altitude."""
    rate_mps: ClimbRate = 7.62
    """How fast; if left out, 1,500 ft/min."""
    ident: Ident = ""
    """Of the aircraft; if left out, the first link's leader."""


class LeaderReportCommand(Reported):
    """Say where the leader will be a second from now, as it is reported: it flies there.

    Sent each second, it flies as another aircraft does; without the next one it flies straight on.
    """

    command: Literal["leader_report"]
    """Which command it is."""
    ident: Ident = ""
    """Of the aircraft; if left out, the first link's leader."""


class IntentKnownCommand(Strict):
    """Give the leader's intent to the pursuer, or withdraw it."""

    command: Literal["intent_known"]
    """Which command it is."""
    known: bool
    """Whether the pursuer knows it from now on."""
    ident: Ident = ""
    """Of the leader; if left out, the first link's."""


class LeaderDataCommand(Strict):
    """Let the leader's reports be received, or not."""

    command: Literal["leader_data"]
    """Which command it is."""
    received: bool
    """Whether they are received from now on."""
    ident: Ident = ""
    """Of the pursuer; if left out, the first link's."""


class PursuerHeadingCommand(Strict):
    """Select a heading for the pursuer, while guidance is not engaged."""

    command: Literal["pursuer_heading"]
    """Which command it is."""
    heading_deg: Heading
    """Clockwise from true north."""
    ident: Ident = ""
    """Of the pursuer; if left out, the first link's."""


class SetEngagementCommand(Strict):
    """Designate the leader, accept what is proposed, engage it, or disconnect."""

    command: Literal["set_engagement"]
    """Which command it is."""
    engagement: Engagement
    """How far guidance is engaged from now on."""
    ident: Ident = ""
    """Of the pursuer; if left out, the first link's."""


class PursuerBankCommand(Strict):
    """Select the bank that plans turn with."""

    command: Literal["pursuer_bank"]
    """Which command it is."""
    bank_deg: Bank
    """No more than the autopilot banks."""
    ident: Ident = ""
    """Of the pursuer; if left out, the first link's."""


class PursuerSpeedCommand(Strict):
    """Select a speed in place of the one that guidance asks for, or leave it to guidance again."""

    command: Literal["pursuer_speed"]
    """Which command it is."""
    tas_mps: Tas | None
    """True airspeed; null for guidance's."""
    ident: Ident = ""
    """Of the pursuer; if left out, the first link's."""


class SetSpacingCommand(Strict):
    """Change D, d_min or both in flight."""

    command: Literal["set_spacing"]
    """Which command it is."""
    slot_distance_m: Distance | None = None
    """D; if left out, as it is."""
    min_separation_m: Distance | None = None
    """d_min; if left out, as it is."""
    ident: Ident = ""
    """Of the pursuer; if left out, the first link's."""

    @model_validator(mode="after")
    def _expect_a_change(self) -> "SetSpacingCommand":
        if not self.slot_distance_m and not self.min_separation_m:
            raise ValueError("must have slot_distance_m or min_separation_m above 0, or both.")
        return self


class SetAutopilotCommand(Strict):
    """Take control from the autopilot, to fly by hand, or give it back."""

    command: Literal["set_autopilot"]
    """Which command it is."""
    on: bool
    """Whether the autopilot flies from now on."""
    ident: Ident = ""
    """Of the pursuer; if left out, the first link's."""


class SetDirectorCommand(Strict):
    """Switch the flight director."""

    command: Literal["set_director"]
    """Which command it is."""
    on: bool
    """Whether its bars are on from now on."""
    ident: Ident = ""
    """Of the pursuer; if left out, the first link's."""


class StickCommand(Strict):
    """Move the stick, while the crew has control; it stays there until the next such command."""

    command: Literal["stick"]
    """Which command it is."""
    roll: Deflection
    """1 asks for the type's full rate of roll to the right, −1 to the left."""
    pitch: Deflection = 0.0
    """1 pulls up with 0.1 g, −1 pushes down with as much."""
    ident: Ident = ""
    """Of the pursuer; if left out, the first link's."""


Command = Annotated[
    PlayCommand
    | PauseCommand
    | SetRateCommand
    | LeaderHeadingCommand
    | LeaderSpeedCommand
    | LeaderLevelCommand
    | LeaderReportCommand
    | IntentKnownCommand
    | LeaderDataCommand
    | PursuerHeadingCommand
    | PursuerBankCommand
    | PursuerSpeedCommand
    | SetSpacingCommand
    | SetEngagementCommand
    | SetAutopilotCommand
    | SetDirectorCommand
    | StickCommand,
    Field(discriminator="command"),
]
"""A command to a flight."""
