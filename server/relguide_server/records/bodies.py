"""Records as JSON: the shapes of requests and answers."""

from typing import Any

from relguide.contract.commands import Rate
from relguide.contract.refusal import Strict
from relguide_server.records.entries import Outcome


class ReplayRequest(Strict):
    """Fly a recording again."""

    rate: Rate = 1.0
    """Simulated seconds per second."""
    paused: bool = False
    """Whether it waits for the command `play`."""


class FlightFigures(Strict):
    """How a flight went so far."""

    simulated_s: float
    """Time flown."""
    joined: bool
    """Whether it was joined at some time."""
    join_time_s: float | None
    """When it was joined first, to a second."""
    least_separation_m: float | None
    """Between the first pursuer and its leader, to a second."""
    plans: int
    """How many plans were flown."""
    alerts: int
    """How many alerts were given."""
    losses: int
    """How many times the separation fell below its minimum."""


class RecordedFlight(Strict):
    """A flight on record, in short."""

    id: str
    """To ask for it by."""
    scenario: str
    """Its name; empty for a situation of the client's own."""
    title: str
    """For people."""
    outcome: Outcome
    """What became of it. flying: it is in the air; removed: somebody ended it; unwatched: nobody
    looked at it any more; broken: by a mistake of the server; stopped: with the service;
    interrupted: the service was killed; the others are why it ended by itself."""
    started_at: str
    """RFC 3339, UTC."""
    ended_at: str | None
    """The same; null while it flies. Of an interrupted one, when it was seen last."""
    seed: int
    """Of its random numbers."""
    version: str
    """Of relguide."""
    requested_by: str
    """Address of the client."""
    documents: int
    """How many there are, lost ones included: the number of the next one."""
    lost: int
    """How many could not be kept."""
    bytes: int
    """What they take."""
    figures: FlightFigures
    """How it went."""


class RecordedFlightList(Strict):
    """Flights on record, the newest first."""

    flights: list[RecordedFlight]
    """At most as many as were asked for."""
    next: str | None
    """`cursor` of what follows; null at the end."""
    total: int
    """How many there are in all, with the same query but for `limit` and `cursor`."""


class RecordedCommand(Strict):
    """A command that a flight was given."""

    number: int
    """In the flight, from 0."""
    at: str
    """RFC 3339, UTC."""
    t_s: float
    """Flight time."""
    command: dict[str, Any]
    """As it was sent."""
    sent_by: str
    """Address of the client."""


class RecordedFlightDetails(RecordedFlight):
    """All about a flight on record but its documents."""

    request: dict[str, Any]
    """The body that asked for it."""
    settings: dict[str, Any]
    """Those of the service."""
    form: int
    """Version of the form of its documents."""
    commands: list[RecordedCommand]
    """In the order they were given."""


class NumberedDocument(Strict):
    """A document of a flight."""

    number: int
    """In the flight, from 0. One that is missing was lost."""
    document: dict[str, Any]
    """As the stream sends it."""


class RecordedDocuments(Strict):
    """Documents of a flight, in order."""

    documents: list[NumberedDocument]
    """At most as many as were asked for."""
    next: int
    """Ask for this number on for what follows."""


class RecordedPlan(Strict):
    """A plan that was asked for."""

    at: str
    """RFC 3339, UTC."""
    situation: dict[str, Any]
    """As it was sent."""
    planner: str
    """Who was asked; empty: the service's own."""
    status: str
    """Of the answer."""
    compute_ms: float
    """How long planning took."""
    asked_by: str
    """Address of the client."""


class RecordedPlanList(Strict):
    """Plans that were asked for, the newest first."""

    plans: list[RecordedPlan]
    """At most as many as were asked for."""
    next: str | None
    """`cursor` of what follows; null at the end."""
    total: int
    """How many there are in all, with the same query but for `limit` and `cursor`."""
