"""The figures of a flight, counted as it is flown."""

from dataclasses import replace
from typing import NamedTuple

from relguide.flying.aircraft_documents import LinkResult, Loss
from relguide.flying.documents import (
    Alert,
    Document,
    ModeChanged,
    PlanChanged,
    SeparationLost,
    Unable,
)
from relguide.flying.logbook import Names
from relguide.units import Metre, Radian, Second


class Tally(NamedTuple):
    """Figures of a flight so far; all but the first until joined."""

    least_separation: Metre
    heading_swing: Radian = 0.0
    """Total variation of the pursuer's heading."""
    track: Metre = 0.0
    """Flown over the ground."""
    bank_reversals: int = 0
    """From one side to the other."""


class Milestones(NamedTuple):
    """What guidance has reached so far."""

    planned_time: Second = 0.0
    """Time to converge of the plan at engagement; 0 if there was none [s]."""
    promised: Second = 0.0
    """Time until joined that it promised; 0 if there was none [s]."""
    replans: int = 0
    replans_announced: int = 0
    joined: bool = False
    join_time: Second = 0.0
    """When it first joined, if it has [s]."""
    following_since: Second = 0.0
    """When it last began to follow, if it has [s]."""
    alerted: tuple[Second, ...] = ()
    """When the alert that stands was given first; empty if none stands."""
    unable: tuple[Second, ...] = ()
    """When `Unable` was said first since the last plan; empty if it was not."""
    losses: tuple[Loss, ...] = ()


def count_event(milestones: Milestones, document: Document) -> Milestones:
    """The milestones after what guidance announced."""
    match document:
        case PlanChanged(t=0.0, reason="engaged", plan=card, promised=promised):
            return milestones._replace(planned_time=card.time_to_converge, promised=promised)
        case PlanChanged(reason="engaged"):
            return milestones._replace(unable=())
        case PlanChanged(announced=announced):
            return milestones._replace(
                unable=(),
                replans=milestones.replans + 1,
                replans_announced=milestones.replans_announced + announced,
            )
        case ModeChanged(t=t, mode="follow"):
            return milestones._replace(following_since=t)
        case Alert(cleared=True):
            return milestones._replace(alerted=())
        case Alert(t=t, level="caution" | "warning"):
            return milestones._replace(alerted=milestones.alerted or (t,))
        case Unable(t=t):
            return milestones._replace(unable=milestones.unable or (t,))
        case SeparationLost():
            loss = Loss(
                t=document.t,
                separation=document.separation,
                cause=document.cause,
                announced=document.announced,
            )
            return milestones._replace(losses=(*milestones.losses, loss))
        case _:
            return milestones


def count_loss(milestones: Milestones, least: Metre) -> Milestones:
    """The last loss went on, and came to this [m]."""
    *before, last = milestones.losses
    last = replace(last, separation=min(last.separation, least))
    return milestones._replace(losses=(*before, last))


def link_result(
    t: Second, names: Names, milestones: Milestones, tally: Tally, fallbacks: int
) -> LinkResult:
    """How the flight of one pursuer went.

    Args:
        t: flight time at its end [s].
        names: of both.
        milestones: what it reached.
        tally: its figures.
        fallbacks: how often an exact plan took the place of the planner's.
    """
    return LinkResult(
        ident=names.pursuer,
        leader=names.leader,
        joined=milestones.joined,
        join_time=milestones.join_time if milestones.joined else t,
        planned_time=milestones.planned_time,
        promised=milestones.promised,
        least_separation=tally.least_separation,
        heading_swing=tally.heading_swing,
        bank_reversals=tally.bank_reversals,
        replans=milestones.replans,
        replans_announced=milestones.replans_announced,
        fallbacks=fallbacks,
        track=tally.track,
        losses=milestones.losses,
    )
