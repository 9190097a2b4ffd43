"""What each second adds to the figures of a flight, and losses of separation as they begin."""

import numpy as np

from relguide.flying.documents import SeparationLost
from relguide.flying.fleet import Fleet
from relguide.flying.pursuit import Pursuit
from relguide.flying.tally import Milestones, count_event, count_loss
from relguide.kernels.flight.second import REVERSALS, SWING, TRACK
from relguide.units import Metre, Second

RECENT: Second = 120.0
"""A loss so soon after something new of the leader is put down to it [s]."""


def count_second(one: Pursuit, fleet: Fleet, t: Second) -> list[SeparationLost]:
    """Count the second flown from t on; whether separation was lost in it."""
    least = fleet.least_apart(one.pursuer, one.leader)
    row = fleet.tallies[one.pursuer]
    tally = one.tally._replace(least_separation=min(least, one.tally.least_separation))
    if not one.milestones.joined:
        tally = tally._replace(
            heading_swing=float(row[SWING]),
            track=float(row[TRACK]),
            bank_reversals=int(row[REVERSALS]),
        )
    one.tally = tally
    limit = one.link.min_separation
    if least >= limit:
        one.lost = one.lost and fleet.apart(one.pursuer, one.leader) < limit
        return []
    said = [] if one.lost else [_loss(one, fleet, t)]
    for loss in said:
        one.milestones = count_event(one.milestones, loss)
    one.milestones = count_loss(one.milestones, least)
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
        announced=_announced(one.milestones),
    )


def _announced(milestones: Milestones) -> tuple[Second, ...]:
    """When what stands was said first, alert or `Unable`; empty if nothing stands."""
    said = (*milestones.alerted, *milestones.unable)
    return (min(said),) if said else ()


def _first_below(fleet: Fleet, one: Pursuit, limit: Metre) -> tuple[int, Metre]:
    """At which step of the last second the separation is below d_min, and what it is."""
    apart = np.hypot(*(fleet.trace[one.pursuer, :, :2] - fleet.trace[one.leader, :, :2]).T)
    below = np.flatnonzero(apart < limit)
    k = int(below[0]) if len(below) else int(np.argmin(apart))
    return min(k, fleet.steps - 1), float(apart[k])


def _cause(one: Pursuit, t: Second) -> str:
    """Why separation was lost, in a sentence."""
    if t - one.view.changed_at < RECENT and one.view.changed:
        return one.view.changed
    if one.memory.mode in ("heading", "escape"):
        return "There was no path that kept it."
    return "What was flown is not what was forecast."
