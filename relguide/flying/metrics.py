"""The figures of a flight, counted as it is flown, and losses of separation as they begin."""

from collections.abc import Iterator
from dataclasses import replace
from math import inf

import numpy as np

from relguide.flying.aircraft_documents import ClosestOther, FlownByHand, LinkResult, Loss
from relguide.flying.by_hand import bars_in_view
from relguide.flying.documents import (
    Alert,
    Document,
    EngagementChanged,
    ModeChanged,
    PlanChanged,
    SeparationLost,
    Unable,
)
from relguide.flying.fleet import Fleet
from relguide.flying.logbook import PairNames
from relguide.flying.pursuit import FlightMetrics, Pursuit
from relguide.flying.world import kept_from
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.flight.second import REVERSALS, SWING, TRACK
from relguide.planning.cells import outside
from relguide.units import DEG, Metre, Radian, Second

RECENT: Second = 120.0
"""A loss so soon after something new of the leader is put down to it [s]."""


def count_event(metrics: FlightMetrics, document: Document, leader: str) -> FlightMetrics:
    """The figures after what guidance announced.

    Args:
        metrics: before.
        document: what was said.
        leader: ident of the leader: what is said of others counts for itself.
    """
    match document:
        case Alert(subject="separation", other=other) if other != leader:
            return _count_alert(metrics, document)
        case EngagementChanged(t=t, engagement="engaged"):
            return metrics._replace(engaged_at=t)
        case PlanChanged(t=t, reason="engaged", plan=card, promised=promised):
            metrics = metrics._replace(unable=())
            if t == metrics.engaged_at and metrics.planned_time == 0.0:
                return metrics._replace(planned_time=card.time_to_converge, promised=promised)
            return metrics
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
        case Alert(subject="data", cleared=True):
            return metrics._replace(unheard=())
        case Alert(t=t, subject="data"):
            return metrics._replace(unheard=metrics.unheard or (t,))
        case Unable(t=t):
            return metrics._replace(unable=metrics.unable or (t,))
        case SeparationLost():
            loss = Loss(
                t=document.t,
                separation=document.separation,
                cause=document.cause,
                announced=document.announced,
                other="" if document.other == leader else document.other,
            )
            return metrics._replace(losses=(*metrics.losses, loss))
        case _:
            return metrics


def _count_alert(metrics: FlightMetrics, alert: Alert) -> FlightMetrics:
    """The figures after an alert on another aircraft or a cell."""
    stand = dict(metrics.others_alerted)
    if alert.cleared:
        stand.pop(alert.other, None)
    elif alert.level in ("caution", "warning"):
        stand.setdefault(alert.other, alert.t)
    return metrics._replace(others_alerted=tuple(stand.items()))


def count_loss(metrics: FlightMetrics, least: Metre, other: str = "") -> FlightMetrics:
    """The last loss went on, and came to this.

    Args:
        metrics: before.
        least: the separation that it came to [m].
        other: ident of the other; empty for the leader.
    """
    losses = list(metrics.losses)
    k = max(k for k, loss in enumerate(losses) if loss.other == other)
    losses[k] = replace(losses[k], separation=min(losses[k].separation, least))
    return metrics._replace(losses=tuple(losses))


def count_steps(one: Pursuit, fleet: Fleet, t: Second) -> list[SeparationLost]:
    """Count the steps last flown, from t on; whether separation was lost in them."""
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
    if not one.autopilot:
        metrics = metrics._replace(by_hand=_count_by_hand(one, fleet))
    one.metrics = metrics
    said = list[SeparationLost]()
    limit = one.link.min_separation
    if least >= limit:
        one.lost = one.lost and fleet.counted_apart(one.pursuer, one.ahead) < limit
    else:
        if not one.lost:
            apart = _apart(fleet, one.pursuer, one.ahead)
            said.append(_loss(one, fleet, t, one.names.leader, apart, limit, _cause(one, t)))
            one.metrics = count_event(one.metrics, said[0], one.names.leader)
        one.metrics = count_loss(one.metrics, least)
        one.lost = True
    return [*said, *_count_others(one, fleet, t)]


WITHIN_BAR: Radian = 2.0 * DEG
"""So near the commanded bank, a crew follows the bar [rad]."""


def _count_by_hand(one: Pursuit, fleet: Fleet) -> FlownByHand:
    """How it was flown by hand so far, with the steps last flown."""
    before = one.metrics.by_hand or FlownByHand(time=0.0, with_bars=0.0, within_bar=0.0, tube=0.0)
    i, across = one.pursuer, 0.0
    begin, end = fleet.rows.start, fleet.rows.stop - 1
    error = fleet.bars[i, begin + 1 : end + 1, 0] - fleet.trace[i, begin:end, 3]
    flown = fleet.step * len(error)
    in_view = flown if bars_in_view(one) else 0.0
    if one.advice is not None and one.advice.mode == "converge":
        across = abs(one.advice.across)
    return FlownByHand(
        time=before.time + flown,
        with_bars=before.with_bars + in_view,
        within_bar=before.within_bar + in_view * float(np.mean(np.abs(error) <= WITHIN_BAR)),
        tube=max(before.tube, across),
    )


def _count_others(one: Pursuit, fleet: Fleet, t: Second) -> Iterator[SeparationLost]:
    """How near all others came in the steps last flown, from t on; which are too near now."""
    lost = set(one.lost_others)
    for ident, limit, apart in _others_apart(one, fleet, t):
        k = int(np.argmin(apart))
        least, before = float(apart[k]), one.metrics.least_other
        spare = inf if before is None else before.separation - before.min_separation
        if least - limit < spare:
            nearest = ClosestOther(
                ident=ident, separation=least, t=t + k * fleet.step, min_separation=limit
            )
            one.metrics = one.metrics._replace(least_other=nearest)
        if least >= limit:
            if apart[-1] >= limit:
                lost.discard(ident)
            continue
        if ident not in lost:
            cause = _cause_of_other(one, ident)
            loss = _loss(one, fleet, t, ident, apart, limit, cause)
            one.metrics = count_event(one.metrics, loss, one.names.leader)
            lost.add(ident)
            yield loss
        one.metrics = count_loss(one.metrics, least, ident)
    one.lost_others = frozenset(lost)


def _others_apart(one: Pursuit, fleet: Fleet, t: Second) -> Iterator[tuple[str, Metre, FloatArray]]:
    """Of each other its ident, its minimum [m], and how far it was at each step [m].

    That is infinite where height kept both apart.
    """
    own = fleet.trace[one.pursuer, fleet.rows, :2]
    for j, aircraft in enumerate(fleet.world.aircraft):
        if j not in (one.pursuer, one.ahead):
            limit = kept_from(aircraft, one.link)
            apart = np.hypot(*(own - fleet.trace[j, fleet.rows, :2]).T)
            yield aircraft.ident, limit, np.where(fleet.by_height(one.pursuer, j), inf, apart)
    times = t + fleet.step * np.arange(float(len(own)))
    for cell in fleet.world.cells:
        yield cell.ident, 0.0, outside(cell, own, times)


def _loss(
    one: Pursuit,
    fleet: Fleet,
    t: Second,
    other: str,
    apart: FloatArray,
    limit: Metre,
    cause: str,
) -> SeparationLost:
    """The loss that began in the steps last flown, from t on.

    Args:
        one: whose.
        fleet: its aircraft.
        t: flight time at the first of them [s].
        other: whom it came too close to.
        apart: how far apart they were at each step [m].
        limit: what was to be kept [m].
        cause: why, in a sentence.
    """
    below = np.flatnonzero(apart < limit)
    k = int(below[0]) if len(below) else int(np.argmin(apart))
    own = fleet.state(one.pursuer, fleet.rows.start + k)
    return SeparationLost(
        t=t + k * fleet.step,
        ident=one.names.pursuer,
        other=other,
        separation=float(apart[k]),
        x=own.x,
        y=own.y,
        cause=cause,
        announced=_announced(one.metrics, other, one.names.leader),
    )


def _announced(metrics: FlightMetrics, other: str, leader: str) -> tuple[Second, ...]:
    """When what stands was said first, alert or `Unable`; empty if nothing stands."""
    alerted = (*metrics.alerted, *metrics.unheard)
    if other != leader:
        alerted = tuple(t for ident, t in metrics.others_alerted if ident == other)
    said = (*alerted, *metrics.unable)
    return (min(said),) if said else ()


def _apart(fleet: Fleet, i: int, j: int) -> FloatArray:
    """How far two aircraft were apart at each of the steps last flown [m].

    Infinite where 1,000 ft kept them apart.
    """
    apart = np.hypot(*(fleet.trace[i, fleet.rows, :2] - fleet.trace[j, fleet.rows, :2]).T)
    return np.where(fleet.by_height(i, j), inf, apart)


def _cause(one: Pursuit, t: Second) -> str:
    """Why separation was lost, in a sentence."""
    if t - one.view.changed_at < RECENT and one.view.changed:
        return one.view.changed
    return _own_cause(one)


def _cause_of_other(one: Pursuit, ident: str) -> str:
    """Why the minimum to another was lost, in a sentence."""
    for other in one.seen_others:
        if other.ident == ident and other.broke_its_word:
            return f"{ident} broke its word."
        if other.ident == ident and other.turns_unannounced:
            return f"{ident} turned unannounced."
    return _own_cause(one)


def _own_cause(one: Pursuit) -> str:
    """Why a minimum was lost that no other aircraft broke, in a sentence."""
    if one.memory.engagement != "engaged":
        return "Guidance was not engaged: the crew flew."
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
        least_other=() if metrics.least_other is None else (metrics.least_other,),
        by_hand=() if metrics.by_hand is None else (metrics.by_hand,),
    )
