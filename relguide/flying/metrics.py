"""The figures of a flight, counted as it is flown, and losses of separation as they begin."""

from dataclasses import replace

import numpy as np

from relguide.flying.aircraft_documents import LinkResult, Loss
from relguide.flying.documents import (
    Alert,
    Document,
    ModeChanged,
    PlanChanged,
    SeparationLost,
    Unable,
)
from relguide.flying.fleet import Fleet
from relguide.flying.logbook import PairNames
from relguide.flying.pursuit import FlightMetrics, Pursuit
from relguide.kernels.flight.second import REVERSALS, SWING, TRACK
from relguide.units import Metre, Second

RECENT: Second = 120.0
"""A loss so soon after something new of the leader is put down to it [s]."""


def count_event(metrics: FlightMetrics, document: Document) -> FlightMetrics:
    """The figures after what guidance announced."""
    match document:
        case PlanChanged(t=0.0, reason="engaged", plan=card, promised=promised):
            return metrics._replace(planned_time=card.time_to_converge, promised=promised)
        case PlanChanged(reason="engaged"):
            return metrics._replace(unable=())
        case PlanChanged(announced=announced):
            return metrics._replace(
                unable=(),
                replans=metrics.replans + 1,
                replans_announced=metrics.replans_announced + announced,
            )
        case ModeChanged(t=t, mode="follow"):
            return metrics._replace(following_since=t)
        case Alert(subject="separation", cleared=True):
            return metrics._replace(alerted=())
        case Alert(t=t, subject="separation", level="caution" | "warning"):
            return metrics._replace(alerted=metrics.alerted or (t,))
        case Unable(t=t):
            return metrics._replace(unable=metrics.unable or (t,))
        case SeparationLost():
            loss = Loss(
                t=document.t,
                separation=document.separation,
                cause=document.cause,
                announced=document.announced,
            )
            return metrics._replace(losses=(*metrics.losses, loss))
        case _:
            return metrics


def count_loss(metrics: FlightMetrics, least: Metre) -> FlightMetrics:
    """The last loss went on, and came to this [m]."""
    *before, last = metrics.losses
    last = replace(last, separation=min(last.separation, least))
    return metrics._replace(losses=(*before, last))


def count_second(one: Pursuit, fleet: Fleet, t: Second) -> list[SeparationLost]:
    """Count the second flown from t on; whether separation was lost in it."""
    least = fleet.least_apart(one.pursuer, one.ahead)
    row = fleet.tallies[one.pursuer]
    metrics = one.metrics._replace(least_separation=min(least, one.metrics.least_separation))
    if not metrics.joined:
        metrics = metrics._replace(
            heading_swing=float(row[SWING]),
            track=float(row[TRACK]),
            bank_reversals=int(row[REVERSALS]),
        )
    if one.memory.mode == "follow" and one.advice is not None:
        metrics = metrics._replace(
            along_error=max(metrics.along_error, abs(one.advice.along)),
            across_error=max(metrics.across_error, abs(one.advice.across)),
        )
    one.metrics = metrics
    limit = one.link.min_separation
    if least >= limit:
        one.lost = one.lost and fleet.apart(one.pursuer, one.ahead) < limit
        return []
    said = [] if one.lost else [_loss(one, fleet, t)]
    for loss in said:
        one.metrics = count_event(one.metrics, loss)
    one.metrics = count_loss(one.metrics, least)
    one.lost = True
    return said


def _loss(one: Pursuit, fleet: Fleet, t: Second) -> SeparationLost:
    """The loss that began in the second from t on."""
    k, apart = _first_below(fleet, one, one.link.min_separation)
    own = fleet.state(one.pursuer, k)
    return SeparationLost(
        t=t + k * fleet.step,
        ident=one.names.pursuer,
        other=one.names.leader,
        separation=apart,
        x=own.x,
        y=own.y,
        cause=_cause(one, t),
        announced=_announced(one.metrics),
    )


def _announced(metrics: FlightMetrics) -> tuple[Second, ...]:
    """When what stands was said first, alert or `Unable`; empty if nothing stands."""
    said = (*metrics.alerted, *metrics.unable)
    return (min(said),) if said else ()


def _first_below(fleet: Fleet, one: Pursuit, limit: Metre) -> tuple[int, Metre]:
    """At which step of the last second the separation is below d_min, and what it is."""
    apart = np.hypot(*(fleet.trace[one.pursuer, :, :2] - fleet.trace[one.ahead, :, :2]).T)
    below = np.flatnonzero(apart < limit)
    k = int(below[0]) if len(below) else int(np.argmin(apart))
    return min(k, fleet.steps - 1), float(apart[k])


def _cause(one: Pursuit, t: Second) -> str:
    """Why separation was lost, in a sentence."""
    if t - one.view.changed_at < RECENT and one.view.changed:
        return one.view.changed
    if one.memory.forecast is None:
        return "Nothing looked ahead."
    if one.memory.mode in ("heading", "escape"):
        return "There was no path that kept it."
    return "What was flown is not what was forecast."


def link_result(
    t: Second, names: PairNames, metrics: FlightMetrics, fallbacks: int, optimum: Second
) -> LinkResult:
    """How the flight of one pursuer went.

    Args:
        t: flight time at its end [s].
        names: of both.
        metrics: its figures.
        fallbacks: how often an exact plan took the place of the planner's.
        optimum: time to converge of the fastest plan from the start; 0 if there is none [s].
    """
    return LinkResult(
        ident=names.pursuer,
        leader=names.leader,
        joined=metrics.joined,
        join_time=metrics.join_time if metrics.joined else t,
        planned_time=metrics.planned_time,
        promised=metrics.promised,
        least_separation=metrics.least_separation,
        heading_swing=metrics.heading_swing,
        bank_reversals=metrics.bank_reversals,
        replans=metrics.replans,
        replans_announced=metrics.replans_announced,
        fallbacks=fallbacks,
        track=metrics.track,
        losses=metrics.losses,
        optimum=optimum,
        along_error=metrics.along_error,
        across_error=metrics.across_error,
    )
