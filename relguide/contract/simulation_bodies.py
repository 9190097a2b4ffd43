"""Flights flown without anybody watching, as outsiders ask for them and get their figures."""

from typing import Annotated, Literal

from pydantic import Field, RootModel

from relguide.contract.messages import FlightRequest
from relguide.contract.refusal import ContractError, Strict
from relguide.flying.aircraft_documents import AlertLevel
from relguide.flying.documents import AlertSubject, UnableReason

MAX_SIMULATIONS = 32
"""Most flights in one request."""
WATCHED = ("rate", "paused", "engagement")
"""What only a flight has that somebody watches."""


Flights = Annotated[list[FlightRequest], Field(min_length=1, max_length=MAX_SIMULATIONS)]


class SimulationRequest(RootModel[Flights]):
    """Flights, each as `POST /flights` takes it, without `rate`, `paused` and `engagement`."""


class SimulationLoss(Strict):
    """One time at which the minimum separation was lost."""

    t_s: float
    """When it was lost."""
    separation_m: float
    """The least."""
    cause: str
    """Whose doing it was."""
    announced_s: float | None
    """When it was announced; null if it was not."""
    other: str = ""
    """Whom it came too close to; left out for the leader."""


class SimulationNearest(Strict):
    """How near the pursuer came to one other aircraft, or to the edge of a cell."""

    ident: str
    """Its name."""
    separation_m: float
    """The least; negative inside a cell."""
    t_s: float
    """When."""
    min_separation_m: float
    """What was to be kept; 0 for a cell."""


class SimulationByHand(Strict):
    """How well the crew, or its model, flew by hand along the flight director's bars."""

    time_s: float
    """How long it flew by hand."""
    with_bars_s: float
    """… of that with the bars in view."""
    within_bar_s: float
    """… of that with the roll bar within 2° of the middle."""
    tube_m: float
    """Largest distance from the path that it was to fly."""


class SimulationAlert(Strict):
    """An alert that was given to the pursuer's crew, or its end."""

    t_s: float
    """When."""
    level: AlertLevel
    """How grave it is, or was."""
    reason: AlertSubject
    """What it is about."""
    message: str
    """The same in a sentence."""
    cleared: bool
    """Whether the alert ends."""


class SimulationUnable(Strict):
    """One thing that guidance could not do."""

    t_s: float
    """When the crew was told."""
    reason: UnableReason
    """Why."""
    message: str
    """The same in a sentence."""


class SimulationFigures(Strict):
    """How the flight of one pursuer went."""

    joined: bool
    """Whether the pursuer joined."""
    join_time_s: float | None
    """When it joined; null if it did not."""
    planned_time_s: float
    """Time to converge of the plan at engagement."""
    promised_s: float
    """The same, braking included."""
    least_separation_m: float
    """Between the two aircraft."""
    heading_swing_deg: float
    """Total variation of heading until joined."""
    bank_reversals: int
    """Rolls from one side to the other."""
    replans: int
    """Plans that took another's place."""
    replans_announced: int
    """Those that the crew was told of."""
    fallbacks: int
    """Plans by the exact planner in place of another's."""
    track_nm: float
    """Flown until joined."""
    simulated_s: float
    """Time flown."""
    over_optimum_s: float | None
    """By how much it joined later than the fastest plan from its start would; null where it did not
    join, there is no such plan, or the leader is recorded."""
    along_error_m: float
    """Largest error of the spacing along the route while it followed."""
    across_error_m: float
    """Largest distance beside the route while it followed."""
    losses: list[SimulationLoss]
    """Times at which the minimum separation was lost."""
    alerts: list[SimulationAlert]
    """Given to the pursuer's crew, and their ends."""
    unables: list[SimulationUnable]
    """What guidance could not do."""
    least_other: SimulationNearest | None = None
    """Of all others, the one with the least to spare; left out where there are none."""
    by_hand: SimulationByHand | None = None
    """Left out where the autopilot flew all the way."""


class SimulationLink(SimulationFigures):
    """How the flight of one pursuer of several went."""

    pursuer: str
    """Its ident."""
    leader: str
    """Ident of the aircraft that it was to join."""


class SimulationAnswer(SimulationFigures):
    """The figures of a flight, as `relguide fly --json` gives them: of its first pursuer."""

    scenario: str
    """Its name; empty for a situation of your own."""
    seed: int
    """As asked for: with the same version it gives the same flight."""
    version: str
    """Of the software that flew it."""
    reason: Literal["joined", "time_over", "recording_over", "plane_left"]
    """Why it ended."""
    message: str
    """The same as a sentence."""
    wall_s: float
    """Time it took."""
    links: list[SimulationLink] = Field(default_factory=list)
    """The same of every pursuer, where there are several; else left out."""


def expect_unwatched(flights: SimulationRequest) -> None:
    """Refuse what has no meaning where nobody watches.

    Raises:
        ContractError: for the first such field.
    """
    for index, wanted in enumerate(flights.root):
        for name in WATCHED:
            if name in wanted.model_fields_set:
                said = "has no meaning in a simulation, which nobody watches: leave it out."
                raise ContractError([(f"[{index}].{name}", said)])
