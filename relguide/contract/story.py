"""A flight in short: its events and its figures."""

from collections.abc import Iterable
from dataclasses import dataclass
from math import degrees
from typing import Any

from relguide.flying.documents import (
    Document,
    FlightEnded,
    FlightStarted,
    LeaderChanged,
    ModeChanged,
    PlanChanged,
    PlanRefused,
    PlanUnavailable,
)
from relguide.planning.phrases import distance, too_close
from relguide.units import NM

Event = LeaderChanged | PlanChanged | PlanUnavailable | PlanRefused | ModeChanged


@dataclass(frozen=True, slots=True, kw_only=True)
class Story:
    """A flight without its samples and routes."""

    started: tuple[FlightStarted, ...] = ()
    """One, or empty if the documents began later."""
    events: tuple[Event, ...] = ()
    ended: tuple[FlightEnded, ...] = ()
    """One, or empty if the documents broke off."""
    documents: int = 0
    """How many there were."""
    last_time: float = 0.0
    """Flight time of the last document [s]."""
    broken: str = ""
    """Why the documents broke off, if that is known."""


def story_of(documents: Iterable[Document]) -> Story:
    """The story of a flight's documents, up to the `ValueError` if one ends them."""
    started: list[FlightStarted] = []
    events: list[Event] = []
    ended: list[FlightEnded] = []
    count, last_time, broken = 0, 0.0, ""
    try:
        for document in documents:
            count, last_time = count + 1, document.t
            match document:
                case FlightStarted():
                    started.append(document)
                case (
                    LeaderChanged()
                    | PlanChanged()
                    | PlanUnavailable()
                    | PlanRefused()
                    | ModeChanged()
                ):
                    events.append(document)
                case FlightEnded():
                    ended.append(document)
    except ValueError as error:
        if not count:
            raise
        broken = str(error)
    return Story(
        started=tuple(started[:1]),
        events=tuple(events),
        ended=tuple(ended[:1]),
        documents=count,
        last_time=last_time,
        broken=broken,
    )


def figures(ended: FlightEnded) -> dict[str, Any]:
    """How a flight went, under the names of the contract."""
    return {
        "joined": ended.joined,
        "join_time_s": ended.join_time,
        "planned_time_s": ended.planned_time,
        "least_separation_m": ended.least_separation,
        "heading_swing_deg": degrees(ended.heading_swing),
        "bank_reversals": ended.bank_reversals,
        "replans": ended.replans,
        "fallbacks": ended.fallbacks,
        "track_nm": ended.track / NM,
        "simulated_s": ended.t,
    }


def failures(flight: Story) -> tuple[str, ...]:
    """What went wrong in a flight that ended, a sentence each."""
    sentences = []
    for ended in flight.ended:
        if not ended.joined:
            sentences.append(f"It did not join within {ended.t:.0f} s.")
        for started in flight.started:
            if ended.least_separation < started.min_separation:
                sentences.append(
                    f"The separation fell below {distance(started.min_separation)}: they came "
                    f"{too_close(ended.least_separation, started.min_separation)}."
                )
    return tuple(sentences)
