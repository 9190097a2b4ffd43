"""A flight in short: its events and its figures."""

from collections import Counter
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from math import degrees
from typing import Any, assert_never

from relguide.contract.wire import to_wire
from relguide.flying.aircraft_documents import ClosestOther, LinkResult
from relguide.flying.documents import (
    Alert,
    AssignmentChanged,
    ClearanceNews,
    CommandGiven,
    ControlChanged,
    Document,
    EngagementChanged,
    FanChanged,
    FlightEnded,
    FlightStarted,
    ForecastChanged,
    LeaderChanged,
    LeaderRoute,
    ModeChanged,
    PlanChanged,
    PlanProposed,
    PlanRefused,
    PlanUnavailable,
    PromiseChanged,
    Sample,
    SeparationLost,
    Unable,
)
from relguide.planning.phrases import distance, too_close
from relguide.units import NM, Metre, Second

SummaryEvent = (
    LeaderChanged
    | PlanChanged
    | EngagementChanged
    | ControlChanged
    | AssignmentChanged
    | ClearanceNews
    | PlanUnavailable
    | PlanRefused
    | ModeChanged
    | PromiseChanged
    | Alert
    | Unable
    | SeparationLost
)


@dataclass(frozen=True, slots=True, kw_only=True)
class FlightSummary:
    """A flight without its samples and routes."""

    started: tuple[FlightStarted, ...] = ()
    """One, or empty if the documents began later."""
    events: tuple[SummaryEvent, ...] = ()
    ended: tuple[FlightEnded, ...] = ()
    """One, or empty if the documents broke off."""
    plans_by: Mapping[str, int] = field(default_factory=dict)
    """How many plans of the first link, announced or not, each planner made, by its name."""
    documents: int = 0
    """How many there were."""
    last_time: float = 0.0
    """Flight time of the last document [s]."""
    broken: str = ""
    """Why the documents broke off, if that is known."""


def summarize(documents: Iterable[Document]) -> FlightSummary:
    """The summary of a flight's documents, up to the `ValueError` if one ends them."""
    started: list[FlightStarted] = []
    events: list[SummaryEvent] = []
    planners: Counter[str] = Counter()
    ended: list[FlightEnded] = []
    count, last_time, broken = 0, 0.0, ""
    try:
        for document in documents:
            count, last_time = count + 1, document.t
            if isinstance(document, PlanChanged) and _is_of_first(document, started):
                planners[document.plan.planner] += 1
            match document:
                case FlightStarted():
                    started.append(document)
                case (
                    PlanChanged(announced=False)
                    | PlanProposed()
                    | LeaderRoute()
                    | ForecastChanged()
                    | FanChanged()
                    | CommandGiven()
                    | Sample()
                ):
                    pass  # nothing that is said to anybody
                case (
                    LeaderChanged()
                    | PlanChanged()
                    | EngagementChanged()
                    | ControlChanged()
                    | AssignmentChanged()
                    | ClearanceNews()
                    | PlanUnavailable()
                    | PlanRefused()
                    | ModeChanged()
                    | PromiseChanged()
                    | Alert()
                    | Unable()
                    | SeparationLost()
                ):
                    events.append(document)
                case FlightEnded():
                    ended.append(document)
                case _:
                    assert_never(document)
    except ValueError as error:
        if not count:
            raise
        broken = str(error)
    return FlightSummary(
        started=tuple(started[:1]),
        events=tuple(events),
        ended=tuple(ended[:1]),
        plans_by=dict(planners.most_common()),
        documents=count,
        last_time=last_time,
        broken=broken,
    )


def _is_of_first(document: PlanChanged, started: list[FlightStarted]) -> bool:
    """Whether a plan is for the pursuer of the first link; of any, where no link is known."""
    if not started:
        return True
    return any(document.ident == link.pursuer for link in started[0].links[:1])


def figures(flight: FlightSummary) -> dict[str, Any]:
    """How the flight of the first link went, under the names of the contract; it has ended.

    Where there are several links, the same of each is in `links`, with its pursuer and leader.
    """
    (ended,) = flight.ended
    first = _figures_of(ended.results[0], flight, ended)
    if len(ended.results) == 1:
        return first
    links = [
        {"pursuer": result.ident, "leader": result.leader} | _figures_of(result, flight, ended)
        for result in ended.results
    ]
    return first | {"links": links}


def _figures_of(result: LinkResult, flight: FlightSummary, ended: FlightEnded) -> dict[str, Any]:
    said = [event for event in flight.events if event.ident == result.ident]
    return {
        "joined": result.joined,
        "join_time_s": result.join_time if result.joined else None,
        "planned_time_s": result.planned_time,
        "promised_s": result.promised,
        "least_separation_m": result.least_separation,
        "heading_swing_deg": degrees(result.heading_swing),
        "bank_reversals": result.bank_reversals,
        "replans": result.replans,
        "replans_announced": result.replans_announced,
        "fallbacks": result.fallbacks,
        "track_nm": result.track / NM,
        "simulated_s": ended.t,
        "over_optimum_s": _over_optimum(result),
        "along_error_m": result.along_error,
        "across_error_m": result.across_error,
        "losses": [
            {
                "t_s": loss.t,
                "separation_m": loss.separation,
                "cause": loss.cause,
                "announced_s": loss.announced[0] if loss.announced else None,
                **({"other": loss.other} if loss.other else {}),
            }
            for loss in result.losses
        ],
        "alerts": [
            {
                "t_s": alert.t,
                "level": alert.level,
                "reason": alert.subject,
                "message": alert.message,
                "cleared": alert.cleared,
            }
            for alert in said
            if isinstance(alert, Alert)
        ],
        "unables": [
            {"t_s": unable.t, "reason": unable.reason, "message": unable.message}
            for unable in said
            if isinstance(unable, Unable)
        ],
        **({"least_other": to_wire(result.least_other[0])} if result.least_other else {}),
        **({"by_hand": to_wire(result.by_hand[0])} if result.by_hand else {}),
    }


def _over_optimum(result: LinkResult) -> Second | None:
    return result.join_time - result.optimum if result.joined and result.optimum else None


def failures(flight: FlightSummary) -> tuple[str, ...]:
    """What went wrong in a flight that ended, a sentence each."""
    sentences = []
    for ended in flight.ended:
        for result in ended.results:
            who = result.ident if len(ended.results) > 1 else "It"
            if not result.joined:
                sentences.append(f"{who} did not join. {ended.message}")
            for limit in _limits(flight, result):
                if result.least_separation < limit:
                    sentences.append(
                        f"The separation fell below {distance(limit)}: they came "
                        f"{too_close(result.least_separation, limit)}."
                    )
            sentences += [
                f"{who} {_came_too_close(other)}"
                for other in result.least_other
                if other.separation < other.min_separation
            ]
    return tuple(sentences)


def _came_too_close(other: ClosestOther) -> str:
    """What a pursuer did to another, behind its name; a cell has no minimum."""
    if other.min_separation == 0.0:
        return f"flew into the weather {other.ident} at {other.t:.0f} s."
    limit = distance(other.min_separation)
    return f"came within {distance(other.separation)} of {other.ident}, closer than {limit}."


def _limits(flight: FlightSummary, result: LinkResult) -> tuple[Metre, ...]:
    """d_min of a link; empty if its beginning is not known."""
    links = (link for started in flight.started for link in started.links)
    return tuple(
        link.min_separation
        for link in links
        if (link.pursuer, link.leader) == (result.ident, result.leader)
    )
