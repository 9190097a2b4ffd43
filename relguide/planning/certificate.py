"""certify(trajectory, situation): a proved lower bound on the separation, all turns included.

It does not depend on where the trajectory comes from: it reads the segments alone. Each other
aircraft and each cell has a bound of its own, until `FOLLOWED` seconds after the pursuer joins:
from then on it flies in the slot.

Where both levels are known, a separation counts only in the times in which 1,000 ft are not certain
(`heights`). Where it never counts, the certificate has the least separation of all time, and holds.
"""

from dataclasses import dataclass
from math import inf
from typing import NamedTuple, assert_never

import numpy as np

from relguide.kernels.base.roots import FloatArray
from relguide.kernels.separation.approach import least_on_paths, least_on_paths_within
from relguide.kernels.separation.cell import least_from_cell
from relguide.kernels.separation.clearance import SLACK
from relguide.planning.aircraft import Traffic
from relguide.planning.cells import Cell, Disc, Polygon
from relguide.planning.heights import (
    ALWAYS,
    Heights,
    Interval,
    KeptByHeight,
    counted,
    heights_of,
    kept_by_height,
)
from relguide.planning.inputs import expect
from relguide.planning.situation import Other, Situation
from relguide.planning.slot import slot_frame
from relguide.planning.tables import leader_path, path_of
from relguide.planning.trajectory import Trajectory
from relguide.planning.wind import Wind
from relguide.units import Metre, Second

TOLERANCE = 1e-7
"""How far below the least separation found the proof may stop [R]: 1 mm for an airliner."""
AROUND_CELLS: Metre = 0.1
"""The same of cells, whose edges are not known to a metre [m]."""
FOLLOWED: Second = 120.0
"""So long after joining the pursuer must keep clear of others, in the slot [s]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class OtherSeparation:
    """Least separation from one other aircraft, or from the edge of a cell, with its proof."""

    ident: str
    """Of the aircraft or the cell."""
    least_separation: Metre
    """The least found, reached at `at_time`; negative inside a cell [m]."""
    at_time: Second
    """When it is reached [s]."""
    lower_bound: Metre
    """No separation until `FOLLOWED` seconds after joining is below this [m]: proved."""
    min_separation: Metre
    """What is to be kept [m]; 0 for a cell."""
    holds: bool
    """Whether `lower_bound` keeps it, to 1e-6 R, or height does."""
    vertical: tuple[KeptByHeight, ...] = ()
    """When height keeps it: separations then do not count."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Certificate:
    """Least separation of a trajectory from the leader over [0, T], with its proof."""

    least_separation: Metre
    """The least separation found where it counts, reached at `at_time` [m]."""
    at_time: Second
    """When it is reached [s]."""
    lower_bound: Metre
    """No separation that counts in [0, T] is below this [m]: proved, not sampled."""
    holds: bool
    """Whether `lower_bound` keeps d_min, to 1e-6 R, or height does, and each of the others is kept
    clear of."""
    others: tuple[OtherSeparation, ...] = ()
    """The same of other traffic and cells, least margin first."""
    vertical: tuple[KeptByHeight, ...] = ()
    """When height keeps the leader apart: separations then do not count."""


def certify(trajectory: Trajectory, situation: Situation) -> Certificate:
    """Judge a trajectory of the air mass against the situation's real leader, its turns included.

    It holds where d ≥ d_min is proved all along, eq. (5).

    Examples:
        >>> best = rg.plan(rg.scenario("fig_6b").situation)
        >>> rg.certify(best.trajectory, best.situation).holds
        True

    Args:
        trajectory: the pursuer's, from t = 0 to its end.
        situation: gives the leader with its intent, and d_min. Uniform wind moves both alike.
    """
    expect("trajectory", trajectory, Trajectory)
    expect("situation", situation, Situation)
    return judge(trajectory, situation, situation.pursuer.turn_radius, leader_path(situation))


def judge(
    trajectory: Trajectory, situation: Situation, radius: Metre, leading: FloatArray
) -> Certificate:
    """As `certify`, for many trajectories of one situation.

    Args:
        trajectory: the pursuer's.
        situation: gives the leader and d_min.
        radius: R, which callers have at hand [m].
        leading: the situation's `leader_path`, or `path_of` what its leader flies.
    """
    path, end = path_of(trajectory), trajectory.duration
    own, theirs = heights_of(situation.pursuer), heights_of(situation.leader)
    when, limit = counted(own, theirs), situation.min_separation
    if when == ALWAYS:
        found = _Least(*least_on_paths(path, leading, TOLERANCE * radius))
    else:
        found = _least_where(path, leading, 0.0, end, when, TOLERANCE * radius)
    others = _others(path, end, situation, radius) if situation.others else ()
    return Certificate(
        least_separation=found.separation,
        at_time=found.at,
        lower_bound=found.bound,
        holds=(found.bound >= limit - SLACK * radius or not found.counts)
        and all(other.holds for other in others),
        others=others,
        vertical=() if when == ALWAYS else kept_by_height(own, theirs, end),
    )


class _Least(NamedTuple):
    """What a kernel finds of one path, and of one of the others."""

    separation: Metre
    at: Second
    bound: Metre
    counts: bool = True
    """Whether there is a time in which it counts."""


def _least_where(
    path: FloatArray,
    theirs: FloatArray,
    begin: Second,
    end: Second,
    when: tuple[Interval, ...],
    tolerance: Metre,
) -> _Least:
    """The least separation of two aircraft from `begin` to `end`, in the times that count.

    Args:
        path: the pursuer's.
        theirs: the other aircraft's.
        begin: from when on [s].
        end: until when [s].
        when: times in which the horizontal minimum counts.
        tolerance: how closely the least is proved [m].
    """
    spans = [(max(begin, since), min(end, until)) for since, until in when]
    spans = [(since, until) for since, until in spans if since <= until]
    found = [
        _Least(*least_on_paths_within(path, theirs, since, until, tolerance))
        for since, until in spans or [(begin, end)]
    ]
    nearest = min(found)
    bound = min(one.bound for one in found)
    return _Least(nearest.separation, nearest.at, bound, bool(spans))


def _others(
    path: FloatArray, joined: Second, situation: Situation, radius: Metre
) -> tuple[OtherSeparation, ...]:
    """All others in turn, least margin first."""
    found = [
        _other(path, _following(situation), joined, other, situation, radius)
        for other in situation.others
    ]
    return tuple(sorted(found, key=_margin))


def _margin(other: OtherSeparation) -> Metre:
    """What is left of the minimum; all there is where height keeps both apart [m]."""
    margin = other.lower_bound - other.min_separation
    return inf if other.holds and other.vertical and margin < 0.0 else margin


def _following(situation: Situation) -> FloatArray:
    """How a pursuer that has joined flies: as the slot, from where that would be at t = 0."""
    leader = situation.leader.trajectory
    frame = slot_frame(situation, leader)
    return np.array((frame.origin_x, frame.origin_y, frame.heading, leader.tas))


def _other(
    path: FloatArray,
    following: FloatArray,
    joined: Second,
    other: Other,
    situation: Situation,
    radius: Metre,
) -> OtherSeparation:
    """One of the others, on the way to the slot and in it."""
    limit = other.min_separation if isinstance(other, Traffic) else 0.0
    legs = (path, 0.0, joined), (following, joined, joined + FOLLOWED)
    own = heights_of(situation.pursuer)
    theirs = heights_of(other) if isinstance(other, Traffic) else Heights(altitude=None)
    when = counted(own, theirs)
    every = [_least(*leg, other, situation.wind, radius, when) for leg in legs]
    least = [found for found in every if found.counts] or every
    nearest = min(least)
    bound = min(found.bound for found in least)
    return OtherSeparation(
        ident=other.ident,
        least_separation=nearest.separation,
        at_time=nearest.at,
        lower_bound=bound,
        min_separation=limit,
        holds=bound >= limit - SLACK * radius or not nearest.counts,
        vertical=kept_by_height(own, theirs, joined + FOLLOWED),
    )


def _least(
    path: FloatArray,
    begin: Second,
    end: Second,
    other: Other,
    wind: Wind,
    radius: Metre,
    when: tuple[Interval, ...],
) -> _Least:
    match other:
        case Traffic():
            theirs = path_of(other.trajectory)
            return _least_where(path, theirs, begin, end, when, TOLERANCE * radius)
        case Cell():
            corners, cell = cell_shape(other, wind)
            return _Least(*least_from_cell(path, corners, cell, begin, end, AROUND_CELLS))
        case _:
            assert_never(other)


def cell_shape(cell: Cell, wind: Wind) -> tuple[FloatArray, FloatArray]:
    """A cell as kernels take it.

    Returns:
        its corners at t = 0, shape (n, 2) [m]; and its radius [m], growth [m/s], and velocity east
        and north in the air mass [m/s].
    """
    match cell.shape:
        case Disc(x=x, y=y, radius=radius):
            corners = [(x, y)]
        case Polygon(corners=points, radius=radius):
            corners = list(points)
        case _:
            assert_never(cell.shape)
    velocity = cell.east - wind.east, cell.north - wind.north
    return np.array(corners), np.array((radius, cell.growth, *velocity))


def lost_to(certificate: Certificate) -> OtherSeparation | None:
    """The other that a path comes too close to, by the most; `None` if it keeps clear of all."""
    return next((other for other in certificate.others if not other.holds), None)
