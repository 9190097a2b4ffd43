"""cut(trajectory, situation): the legs on which Pontryagin's conditions are checked.

A leg ends where the control changes or where d = d_min is touched, or the minimum of other traffic.
Touching is a contact at one instant, or a boundary arc: arcs of partial bank, one after another,
that keep to d = d_min. A contact with other traffic is like one with the leader, with the velocity
of the one that is touched in place of the leader's.
Everything here is in R and R/V_P; places are relative to where the trajectory ends.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from itertools import accumulate, pairwise
from math import cos, hypot, sin
from typing import NamedTuple

import numpy as np

from relguide.kernels.base.costate import contacts
from relguide.kernels.base.motion import advance
from relguide.planning.aircraft import Leader, Traffic
from relguide.planning.heights import counted, heights_of
from relguide.planning.situation import Situation
from relguide.planning.tables import motion_of
from relguide.planning.trajectory import Trajectory

TOUCHES = 1e-5
"""Separations this close to d_min touch it [R]: 12 cm for an airliner; plans stay 3e-7 outside."""
STRIDE = 0.01
"""Contacts closer together than this may count as one: half a second for an airliner."""
EDGE = 1e-4
"""A contact this close to a boundary arc belongs to it: the arc's beginning is found twice."""
MAX_CONTACTS = 4096
"""Room for contacts, including those between the many arcs of a boundary arc."""
ROUNDING = 1e-9
"""Pieces shorter than this are rounding; turn rates closer than this are equal."""

Vector = tuple[float, float]
"""East, north."""


@dataclass(frozen=True, slots=True, kw_only=True)
class CostateLeg:
    """A piece of the trajectory between two changes."""

    start: float
    """When."""
    duration: float
    x: float
    """Where it starts, east."""
    y: float
    """And north."""
    heading: float
    """Heading there, clockwise from north [rad]."""
    rate: float
    """Turn rate, positive to the right: ±1 at nominal bank."""
    part: int
    """How many contacts and boundary arcs come before it."""
    sliding: bool
    """Whether it is a piece of a boundary arc: that of touch number `part`."""

    def at(self, t: float) -> tuple[float, float, float]:
        """Place and heading after flying it for t."""
        return advance(self.x, self.y, self.heading, 1.0, self.rate, t)


@dataclass(frozen=True, slots=True, kw_only=True)
class Instant:
    """The pursuer and the leader, or other traffic that it touches, at an instant."""

    time: float
    course: Vector
    """The pursuer's velocity: a unit vector."""
    leader_velocity: Vector
    toward: Vector
    """Unit vector from the pursuer to the leader."""
    separation: float
    ident: str = ""
    """Of other traffic that takes the leader's place."""

    @property
    def passing(self) -> Vector:
        """The pursuer's velocity relative to the leader."""
        return (
            self.course[0] - self.leader_velocity[0],
            self.course[1] - self.leader_velocity[1],
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class Touch:
    """Where d = d_min: a contact or a boundary arc."""

    nodes: tuple[Instant, ...]
    """The contact; or the ends of a boundary arc's arcs, in the order flown."""

    @property
    def entry(self) -> Instant:
        """Where it begins."""
        return self.nodes[0]

    @property
    def exit(self) -> Instant:
        """Where it ends."""
        return self.nodes[-1]

    @property
    def slides(self) -> bool:
        """Whether it lasts."""
        return len(self.nodes) > 1

    @property
    def ends(self) -> tuple[Instant, ...]:
        """Entry and exit of a boundary arc; a contact itself."""
        return (self.entry, self.exit) if self.slides else self.nodes


@dataclass(frozen=True, slots=True, kw_only=True)
class Cut:
    """A trajectory in legs."""

    legs: tuple[CostateLeg, ...]
    """In the order flown, each longer than `ROUNDING`; empty if the trajectory has no length."""
    touches: tuple[Touch, ...]
    """In the order flown, without contacts at the trajectory's two ends: they add no condition."""
    end: Instant
    """At t_f."""


def cut(trajectory: Trajectory, situation: Situation) -> Cut:
    """Cut a trajectory where the conditions change."""
    leader, radius = situation.leader, situation.pursuer.turn_radius
    scale = radius / trajectory.tas
    pieces = list(_pieces(trajectory, scale))

    def encounter(t: float, other: Leader | Traffic = leader) -> Instant:
        ours, theirs = trajectory.pose_at(t * scale), other.trajectory.pose_at(t * scale)
        dx, dy = theirs.x - ours.x, theirs.y - ours.y
        d = max(hypot(dx, dy), 1e-9)  # where they meet there is no direction, and no limit
        alpha = other.tas / trajectory.tas
        return Instant(
            time=t,
            course=(sin(ours.heading), cos(ours.heading)),
            leader_velocity=(alpha * sin(theirs.heading), alpha * cos(theirs.heading)),
            toward=(dx / d, dy / d),
            separation=d / radius,
            ident=other.ident if isinstance(other, Traffic) else "",
        )

    times = [0.0, *accumulate(duration for duration, _ in pieces)]
    limit = situation.min_separation / radius
    boundary_arcs = _boundary_arcs(pieces, [abs(encounter(t).separation - limit) for t in times])
    touched: list[Leader | Traffic] = [leader]
    touched += [one for one in situation.others if isinstance(one, Traffic)]
    spans = [_Span(times[i], times[j], leader) for i, j in boundary_arcs]
    spans += [
        _Span(t, t, other)
        for other in touched
        for t in _contacts(trajectory, situation, other)
        # at its two ends a trajectory's λ is free
        if ROUNDING < t < times[-1] - ROUNDING
        and not any(low - EDGE < t < high + EDGE for low, high, _ in spans)
    ]
    spans.sort(key=lambda span: (span.low, span.high))
    return Cut(
        legs=join_legs(_legs(pieces, trajectory.heading, spans)),
        touches=tuple(
            Touch(
                nodes=tuple(encounter(t, other) for t in (times if a < b else (a,)) if a <= t <= b)
            )
            for a, b, other in spans
        ),
        end=encounter(times[-1]),
    )


class _Span(NamedTuple):
    """When one of the others, or the leader, is touched: from when until when."""

    low: float
    high: float
    other: Leader | Traffic


def _pieces(trajectory: Trajectory, scale: float) -> Iterator[tuple[float, float]]:
    """Duration and turn rate of each piece; neighbours of equal rate are joined."""
    duration, last = 0.0, 0.0
    for seconds, rate in trajectory.bends():
        if seconds <= ROUNDING * scale:
            continue
        if duration > 0.0 and abs(rate * scale - last) > ROUNDING:
            yield duration, last
            duration = 0.0
        duration, last = duration + seconds / scale, rate * scale
    if duration > 0.0:
        yield duration, last


def is_partial(rate: float) -> bool:
    """Whether a turn is flown at a bank other than nominal."""
    return rate != 0.0 and abs(abs(rate) - 1.0) > ROUNDING


def _boundary_arcs(
    pieces: list[tuple[float, float]], off_limit: list[float]
) -> list[tuple[int, int]]:
    """Runs of pieces that slide: number of the first, and of the first after."""
    sliding = [
        is_partial(rate) and max(off_limit[i : i + 2]) < TOUCHES
        for i, (_, rate) in enumerate(pieces)
    ]
    edges = [i for i, (a, b) in enumerate(pairwise([False, *sliding, False])) if a != b]
    return list(zip(edges[::2], edges[1::2], strict=True))


def _contacts(trajectory: Trajectory, situation: Situation, other: Leader | Traffic) -> list[float]:
    """When the leader, or other traffic, is touched, in the times in which its minimum counts."""
    radius = situation.pursuer.turn_radius
    limit = (other if isinstance(other, Traffic) else situation).min_separation
    found = np.empty(MAX_CONTACTS)
    n = contacts(
        motion_of(trajectory),
        motion_of(other.trajectory),
        trajectory.duration,
        limit - TOUCHES * radius,
        limit + TOUCHES * radius,
        STRIDE * radius / trajectory.tas,
        found,
    )
    when = counted(heights_of(situation.pursuer), heights_of(other))
    return [
        t * trajectory.tas / radius
        for t in found[:n].tolist()
        if any(since <= t <= until for since, until in when)
    ]


def _legs(
    pieces: list[tuple[float, float]], heading: float, spans: list[_Span]
) -> Iterator[CostateLeg]:
    """The pieces, cut at contacts; `join_legs` gives them their places."""
    t, end, part = 0.0, 0.0, 0
    for duration, rate in pieces:
        end += duration
        while end - t > ROUNDING:
            while part < len(spans) and spans[part].high <= t + ROUNDING:
                part += 1
            low, high = spans[part][:2] if part < len(spans) else (end, end)
            sliding = low - ROUNDING <= t
            stop = min(end, high if sliding else low)
            yield CostateLeg(
                start=t, duration=stop - t, x=0.0, y=0.0, heading=heading, rate=rate, part=part,
                sliding=sliding,
            )  # fmt: skip
            heading += rate * (stop - t)
            t = stop


def join_legs(legs: Iterable[CostateLeg]) -> tuple[CostateLeg, ...]:
    """The legs, moved so that each begins where the one before ends, and the last at the origin."""
    chain: list[CostateLeg] = []
    x, y = 0.0, 0.0
    for leg in reversed(tuple(legs)):
        dx, dy, _ = advance(0.0, 0.0, leg.heading, 1.0, leg.rate, leg.duration)
        x, y = x - dx, y - dy
        chain.insert(0, replace(leg, x=x, y=y))
    return tuple(chain)
