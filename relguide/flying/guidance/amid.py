"""Amid others: how near a flight ahead comes to other aircraft and to cells, and what plans take.

A flight ahead has the pursuer's place each second. So has what each other is expected to fly; in
between both are taken to fly straight, which is within 2 m. A cell moves straight, and grows.
"""

from math import hypot, inf
from typing import NamedTuple

import numpy as np

from relguide.flying.belief import Belief
from relguide.flying.guidance.assignment import Assignment
from relguide.flying.guidance.forecast import Forecast
from relguide.flying.seen_others import SeenOther, prolonged
from relguide.kernels.base.roots import FloatArray
from relguide.planning.aircraft import Pursuer
from relguide.planning.cells import Cell, outside
from relguide.planning.limits import MAX_OTHERS
from relguide.planning.phrases import distance
from relguide.planning.situation import Other
from relguide.units import Metre, Second

BEGUN_INSIDE: Metre = 1.0
"""A plan begins so far outside the berth that it gives another [m]."""


class Nearing(NamedTuple):
    """How near a flight ahead comes to one other aircraft, or to the edge of a cell."""

    ident: str
    limit: Metre
    """What is to be kept [m]; 0 for a cell."""
    margin: Metre
    """What is kept beside it for what is not certain [m]."""
    apart: Metre
    """How far apart they are now [m]; negative inside a cell."""
    now: Metre
    """The same; infinite where 1,000 ft keep them apart [m]."""
    least: Metre
    """The least ahead [m]; infinite as above."""
    at: Second
    """When, flight time [s]."""
    breaks: Second
    """When it first is below the limit, flight time [s]; infinite if it is not."""
    is_cell: bool = False

    @property
    def spare(self) -> Metre:
        """What is left of the least beside the limit [m]; negative if it is broken."""
        return self.least - self.limit

    @property
    def name(self) -> str:
        """As it is called in a sentence."""
        return f"Weather {self.ident}" if self.is_cell else self.ident

    @property
    def sentence(self) -> str:
        """What would come of it, without a full stop."""
        if self.is_cell:
            return f"{self.name} is in the way"
        return (
            f"{self.name} would come within {distance(self.least)}, closer than "
            f"{distance(self.limit)}"
        )


def nearings(
    ahead: Forecast, belief: Belief, assignment: Assignment, *, turning_on: bool = False
) -> tuple[Nearing, ...]:
    """How near a flight ahead comes to each of the others from now on, the least spare first.

    Args:
        ahead: the flight; past its end the pursuer is taken to fly straight on for a while.
        belief: gives the others as they are now.
        assignment: how far to look.
        turning_on: whether those that turn unannounced may also turn on, for `caution` seconds.
    """
    if not belief.others and not belief.cells:
        return ()
    t, settings = belief.t, assignment.settings
    rows = ahead.own[max(ahead.row(t), 0) :, :2]
    own = prolonged(rows, max(len(rows) - 1, int(settings.watch))) if len(rows) > 1 else rows
    found = [_nearing(own, other, t, settings.caution, turning_on) for other in belief.others]
    found += [_nearing_cell(own, cell, t) for cell in belief.cells]
    return tuple(sorted(found, key=lambda nearing: nearing.spare))


def keeps_clear(ahead: Forecast, belief: Belief, assignment: Assignment) -> Nearing | None:
    """What a flight ahead comes too close to, with what is not certain of it; `None` if nothing."""
    for nearing in nearings(ahead, belief, assignment):
        # what is nearer now than the margin asks may come half as near again, but not too near
        has = max(nearing.now - nearing.limit, 0.0)
        if nearing.spare < min(nearing.margin, 0.5 * has):
            return nearing
    return None


def others_after(
    belief: Belief, pursuer: Pursuer, seconds: Second, wider: Metre
) -> tuple[Other, ...]:
    """All others as plans take them, some time from now.

    Each is given a wider berth than its minimum, as far as the pursuer is outside of it then.

    Args:
        belief: gives the others now.
        pursuer: as it is then.
        seconds: from now [s].
        wider: what is to be kept beside each minimum [m].
    """
    found: list[Other] = []
    for other in _nearest(belief):
        if not other.may_count():  # at another level
            continue
        there = other.after(seconds)
        apart = hypot(there.x - pursuer.x, there.y - pursuer.y)
        spare = apart - other.min_separation - BEGUN_INSIDE
        berth = min(max(wider, other.margin), spare)
        found.append(other.after(seconds, wider=max(berth, 0.0)))
    for cell in belief.cells:
        then = cell.after(seconds)
        place = np.array([[pursuer.x, pursuer.y]])
        spare = float(outside(then, place, np.zeros(1))[0]) - BEGUN_INSIDE
        found.append(then.after(0.0, wider=max(min(wider, spare), 0.0)))
    return tuple(found)


def _nearest(belief: Belief) -> list[SeenOther]:
    """As many as a plan takes, the nearest first where there are more."""
    room = MAX_OTHERS - len(belief.cells)
    if len(belief.others) <= room:
        return list(belief.others)
    own = belief.own
    near = sorted(belief.others, key=lambda o: hypot(o.body.x - own.x, o.body.y - own.y))
    return near[:room]


def _nearing(
    own: FloatArray, other: SeenOther, t: Second, caution: Second, turning_on: bool
) -> Nearing:
    expected = [other.places(len(own) - 1)]
    if turning_on and other.turns_unannounced:
        seconds = min(int(caution), len(own) - 1)
        expected.append(other.places_turning_on(seconds))
    limit, least, at, breaks = other.min_separation, inf, t, inf
    counts = other.counts_at(len(own) - 1)
    for theirs in expected:
        apart, when = _closest(own[: len(theirs)] - theirs)
        apart = np.where(counts[: len(apart)], apart, inf)
        k = int(np.argmin(apart))
        if apart[k] < least:
            least, at = float(apart[k]), t + float(when[k])
        below = np.flatnonzero(apart < limit)
        if len(below):
            breaks = min(breaks, t + float(below[0]))
    distance_now = hypot(*(own[0] - expected[0][0]).tolist())
    now = distance_now if counts[0] else inf
    return Nearing(other.ident, limit, other.margin, distance_now, now, least, at, breaks)


def _closest(apart: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Least distance in each second, and when, of two that fly straight in it.

    Args:
        apart: from the one to the other at each second [m]. shape (n + 1, 2)
    """
    if len(apart) < 2:
        return np.hypot(*apart.T), np.zeros(len(apart))
    begin, move = apart[:-1], np.diff(apart, axis=0)
    square = np.maximum(np.einsum("ij,ij->i", move, move), 1e-9)
    share = np.clip(-np.einsum("ij,ij->i", begin, move) / square, 0.0, 1.0)
    nearest = begin + share[:, None] * move
    return np.hypot(nearest[:, 0], nearest[:, 1]), np.arange(len(share)) + share


def _nearing_cell(own: FloatArray, cell: Cell, t: Second) -> Nearing:
    beyond = outside(cell, own, np.arange(float(len(own))))
    k = int(np.argmin(beyond))
    inside = np.flatnonzero(beyond < 0.0)
    breaks = t + float(inside[0]) if len(inside) else inf
    now, least = float(beyond[0]), float(beyond[k])
    return Nearing(cell.ident, 0.0, 0.0, now, now, least, t + float(k), breaks, is_cell=True)
