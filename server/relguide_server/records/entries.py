"""What flights, routes and the plan service tell the writer, as values."""

from dataclasses import dataclass
from typing import Literal

from relguide.flying.documents import Document
from relguide.units import Second

Outcome = Literal[
    "flying", "joined", "time_over", "recording_over", "plane_left", "removed", "unwatched",
    "broken", "stopped", "interrupted",
]  # fmt: skip
"""What became of a flight. removed: somebody ended it; unwatched: nobody looked at it any more;
broken: a mistake of the server; stopped: with the service; interrupted: the service was killed;
the others are the reasons of `FlightEnded`."""


class Unavailable(OSError):
    """The records cannot be read or written now; the sentence says why."""


@dataclass(frozen=True, slots=True, kw_only=True)
class FlightCard:
    """A flight as it was asked for."""

    id: str
    scenario: str
    """Its name; empty for a situation of the client's own."""
    title: str
    request: str
    """The body of the request, JSON."""
    settings: str
    """Those of the service that matter to it, JSON."""
    seed: int
    requested_by: str
    """Address of the client."""


@dataclass(frozen=True, slots=True)
class Began:
    """A flight begins."""

    card: FlightCard
    at: float
    """Unix time [s]."""


@dataclass(frozen=True, slots=True)
class FlownDocument:
    """A document of a flight."""

    flight_id: str
    number: int
    """Of the documents to be kept, from 0."""
    document: Document


@dataclass(frozen=True, slots=True, kw_only=True)
class Commanded:
    """A command was given to a flight."""

    flight_id: str
    at: float
    """Unix time [s]."""
    t: Second
    """Flight time."""
    body: str
    """As it was sent, JSON."""
    sent_by: str
    """Address of the client."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Ended:
    """A flight is over."""

    flight_id: str
    at: float
    """Unix time [s]."""
    outcome: Outcome
    lost: int
    """Documents of it that the writer was never given, as too much waited."""


@dataclass(frozen=True, slots=True, kw_only=True)
class PlanAsked:
    """A situation was planned."""

    at: float
    """Unix time [s]."""
    body: str
    """The situation, JSON."""
    planner: str
    """Who was asked; empty: the service's own."""
    status: str
    """Of the answer."""
    seconds: Second
    """How long planning took."""
    asked_by: str
    """Address of the client."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ClearanceNoted:
    """A clearance is new, or something of it is: this takes the place of what was known of it."""

    id: str
    at: float
    """When it was asked for, Unix time [s]."""
    changed_at: float
    """Unix time [s]."""
    flight_id: str
    """The flight that asked; empty if it is none of the service."""
    state: str
    over: bool
    """Whether nothing follows its state."""
    request: str
    """The body that asked for it, JSON."""
    card: str
    """All of it, JSON, as the API shows it."""
    owner: str
    """Who asked, as access knows it."""
    asked_by: str
    """Address of the client."""


Entry = Began | FlownDocument | Commanded | Ended | PlanAsked | ClearanceNoted


@dataclass(frozen=True, slots=True, kw_only=True)
class Place:
    """A place in a list of records, the newest first."""

    at: float
    """When the flight began or the plan was made [Unix time, s]."""
    name: str
    """Of the flight; of the run of the service that made the plan."""
    number: int = 0
    """Of the plan in its run."""


@dataclass(frozen=True, slots=True, kw_only=True)
class RecordSearch:
    """Which records are wanted, the newest first."""

    since: float | None = None
    """Begun at this time or later [Unix time, s]."""
    until: float | None = None
    """Begun before this time [Unix time, s]."""
    scenario: str | None = None
    outcome: str | None = None
    """Of a flight; the status of a plan."""
    limit: int = 100
    after: Place | None = None
    """Only those behind it."""
