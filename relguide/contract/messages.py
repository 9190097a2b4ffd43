"""The ticks of the stream, and the requests and answers of flights."""

from collections.abc import Mapping
from typing import (
    Annotated,
    Any,
    Literal,
)

from pydantic import (
    Discriminator,
    Field,
    Tag,
    field_validator,
    model_validator,
)

from relguide.contract.commands import Rate
from relguide.contract.crew_lines import CrewOrderLine, StickOrder
from relguide.contract.document_models import DocumentModel, model_of, no_default
from relguide.contract.flown_bodies import FlownSituationBody
from relguide.contract.intent_bodies import Intent
from relguide.contract.order_lines import OrderLine
from relguide.contract.other_bodies import Ident
from relguide.contract.pilot_bodies import ByHand
from relguide.contract.refusal import Strict
from relguide.flying.documents import EndReason, Engagement, Mode
from relguide.flying.verdicts import PlannerVerdict
from relguide.planning.limits import SPACING

_OF_SNAPSHOTS = Field(default="", json_schema_extra=no_default)
MAX_ORDERS = 1000
"""Most orders that a request for a flight has beside sticks, and most lines of a crew's script."""
MAX_STICKS = 36_000
"""Most sticks that it has: ten a second for an hour."""
Seed = Annotated[int, Field(ge=0, le=2**32 - 1)]
"""Accepted seeds of a flight's random numbers."""
SpacingTime = Annotated[float, Field(gt=0.0, le=SPACING.high)]
"""Accepted times behind the leader [s]."""


class Tick(Strict):
    """A frame of the stream: what happened in a flight since the last one."""

    kind: Literal["tick"]
    flight_id: str
    t_s: float
    """Flight time now."""
    rate: float
    """Simulated seconds per second."""
    paused: bool
    ended: bool
    documents: list[DocumentModel]
    """Since the last tick, in order; of several samples only the newest."""
    started_at: str = _OF_SNAPSHOTS
    """When the flight began by the wall clock, RFC 3339, UTC; of a recording, when it was flown.
    In a snapshot, as is `version`."""
    version: str = _OF_SNAPSHOTS
    """Of the software that flies it."""


class PlannerComparison(Strict):
    """What planners would fly in one situation."""

    planners: list[model_of(PlannerVerdict)]  # type: ignore[valid-type]
    """`exact`, `network`, `regular_dp` and `printed_network`, in this order."""


class ScenarioInfo(Strict):
    """A scenario that can be flown."""

    name: str
    """To start it by."""
    title: str
    """For people."""
    description: str
    """What it shows."""
    available: bool
    """Whether what it needs is installed."""
    message: str
    """If it is not available, what to install."""


class ScenarioList(Strict):
    """All scenarios."""

    scenarios: list[ScenarioInfo]
    """The paper's, and ours."""


class _HowToFly(Strict):
    """What may be asked of any flight."""

    rate: Rate = 1.0
    """Simulated seconds per second."""
    paused: bool = False
    """Whether it waits for the command `play`."""
    intent_known: bool | None = None
    """Whether the pursuer knows the leader's intent; if left out, as the scenario says. Of a
    situation of your own it does."""
    engagement: Engagement = "engaged"
    """How far guidance is engaged at the start."""
    seed: Seed = 0
    """0 flies the type as its data say; any other draws its constants, unknown to its guidance, and
    those of a pilot model that is asked for without any."""
    spacing_time_s: SpacingTime | None = None
    """Time behind the leader to keep once joined; if left out, D is kept."""
    by_hand: ByHand = False
    """Whether a pilot model flies the pursuer by hand, along the flight director's bars; its
    constants, if they are not those that pilots were found to have."""
    orders: list[OrderLine] = Field(default_factory=list, max_length=MAX_ORDERS + MAX_STICKS)
    """What aircraft are ordered at flight times, in order of time: at most 36,000 sticks, an hour
    of flying by hand, and at most 1,000 others."""
    crew: Annotated[list[CrewOrderLine] | None, Field(max_length=MAX_ORDERS)] = None
    """The script of a crew that reacts; its lines with `t_s` are in order of time. Guidance is off
    at the start, unless `engagement` or the first line, an engagement at 0 s, says otherwise."""

    @field_validator("crew")
    @classmethod
    def _expect_an_order(cls, lines: list[Any] | None) -> list[Any] | None:
        if lines == []:
            raise ValueError(
                "must have an order or more, not none: leave it out, and give engagement."
            )
        return lines

    @field_validator("orders", mode="before")
    @classmethod
    def _expect_readable(cls, lines: Any) -> Any:
        most = MAX_ORDERS + MAX_STICKS
        if isinstance(lines, list) and len(lines) > most:  # before each of them is read
            raise ValueError(f"must have at most {most:,} entries, not {len(lines):,}.")
        return lines

    @field_validator("orders")
    @classmethod
    def _expect_not_too_many(cls, lines: list[Any]) -> list[Any]:
        sticks = sum(isinstance(line, StickOrder) for line in lines)
        if sticks > MAX_STICKS:
            raise ValueError(f"must have at most {MAX_STICKS:,} sticks, not {sticks:,}.")
        if len(lines) - sticks > MAX_ORDERS:
            others = len(lines) - sticks
            raise ValueError(f"must have at most {MAX_ORDERS:,} beside sticks, not {others:,}.")
        return lines


class ScenarioFlightRequest(_HowToFly):
    """Start a flight of a scenario."""

    scenario: Annotated[str, Field(max_length=100)]
    """Its name."""

    @model_validator(mode="before")
    @classmethod
    def _expect_a_flight(cls, value: Any) -> Any:
        if isinstance(value, Mapping) and "scenario" not in value:
            raise ValueError("must have a scenario, by its name, or a situation of your own.")
        return value


class SituationFlightRequest(_HowToFly):
    """Start a flight from a situation of your own."""

    situation: FlownSituationBody
    """As `POST /plans` takes it, and what only a flight depends on."""
    flown_intent: Intent | None = None
    """What the leader flies if that is not what it declares in `situation`: it breaks its word."""
    reported_leader: Ident | None = None
    """The aircraft of the picture of air traffic that is the leader: it begins, and flies, as that
    one is reported, whatever place `situation` gives. The situation is on the earth, and the flight
    is flown at rate 1."""


def _which_request(value: Any) -> str:
    own = isinstance(value, SituationFlightRequest) or (
        isinstance(value, Mapping) and "situation" in value
    )
    return "#situation" if own else "#scenario"


FlightRequest = Annotated[
    Annotated[ScenarioFlightRequest, Tag("#scenario")]
    | Annotated[SituationFlightRequest, Tag("#situation")],
    Discriminator(_which_request),
]
"""A request for a new flight."""
FlightOutcome = Literal["", "broken", "stopped", EndReason]
"""Why a flight is over; empty while it flies."""


class FlightStatus(Strict):
    """Where a flight stands."""

    id: str
    """To ask for it by."""
    scenario: str
    """Its name; empty for a situation of your own."""
    title: str
    """For people."""
    t_s: float
    """Flight time."""
    rate: float
    """Simulated seconds per second."""
    paused: bool
    """Whether it waits for `play`."""
    ended: bool
    """Whether it is over."""
    outcome: FlightOutcome
    """Why: broken: by a mistake of the server; stopped: nothing follows, as at the end of a
    recording that was cut short; the others as in `flight_ended`. Empty while it flies."""
    started_at: str
    """When it began by the wall clock, RFC 3339, UTC; of a recording, when it was flown."""
    mode: Mode
    """What guidance does now."""
    engagement: Engagement
    """How far the crew has engaged guidance."""
    joined: bool
    """Whether the pursuer has joined."""
    separation_m: float
    """Between pursuer and leader now."""
    stream_url: str
    """Path of its WebSocket."""
    scene_url: str
    """Path of its 3D scene."""
    seed: int
    """Of its random numbers, as asked for: with the same version it gives the same flight."""
    version: str
    """Of the software that flies it."""
    recorded: bool
    """Whether it is on record: `GET /records/flights/{id}` knows it."""


class FlightList(Strict):
    """All flights."""

    flights: list[FlightStatus]
    """In the order they were started; of several processes, one after the other."""
    missing: list[str] = Field(default_factory=list)
    """Letters of the processes that did not answer; left out if all did."""
