"""Heights that are certain: when 1,000 ft keep two aircraft apart, known before either has flown.

A declared change of level does not depend on the path: it begins when the pieces before it are
flown. So bounds on the altitude over time follow from the intent alone,

    low(t) ≤ h(t) ≤ high(t),        ḣ within ±20 % of the declared rate, begun ±5 s,

with 200 ft of altimetry at both edges while the level changes. An aircraft that may fly by either
of two changes is bounded by the higher rate of the two above, and by the lower below. The bounds
are linear between knots, and so are the times in which 1,000 ft are certain intervals. In all other
times the horizontal minimum counts.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from math import copysign, inf
from typing import NamedTuple

from relguide.planning.aircraft import Leader, Pursuer, Traffic
from relguide.planning.intent import ChangeLevel, LevelChange
from relguide.units import FT, Metre, MetrePerSecond, Second

VERTICAL_MINIMUM: Metre = 1_000.0 * FT
"""Height that keeps two aircraft apart whatever their distance [m]."""
WHOLE_METRE: Metre = 1.0
"""So much less is enough: two levels in whole metres may be this much nearer than they are [m]."""
RATE_TOLERANCE = 0.2
"""How far a rate of climb or descent may be off the declared one, as a share of it."""
START_TOLERANCE: Second = 5.0
"""How far the start of a change may be off the declared one [s]."""
ALTIMETRY: Metre = 200.0 * FT
"""How far off an aircraft may be while its level changes, beside that [m]."""

JOINED_HEIGHT: Metre = 300.0 * FT
"""A pursuer so near the level of its leader has joined it [m]."""
FASTEST: MetrePerSecond = 6_000.0 * FT / 60.0
"""No two aircraft come nearer in height than this [m/s]."""

Interval = tuple[Second, Second]
"""From when until when [s]; the end may be infinite."""
ALWAYS: tuple[Interval, ...] = ((0.0, inf),)
"""All time."""


class _Knot(NamedTuple):
    """A bound on the altitude from one time on; linear until the next knot."""

    at: Second
    low: Metre
    high: Metre
    low_rate: MetrePerSecond
    high_rate: MetrePerSecond
    changing: bool
    """Whether the level may change now."""

    def until(self, t: Second) -> tuple[Metre, Metre]:
        """Both bounds at a time before the next knot, altimetry included [m]."""
        since = t - self.at if t > self.at else 0.0
        spare = ALTIMETRY if self.changing else 0.0
        return self.low + self.low_rate * since - spare, self.high + self.high_rate * since + spare


@dataclass(frozen=True, slots=True, kw_only=True)
class Heights:
    """The altitude of an aircraft now, and the changes of level that it has declared or planned."""

    altitude: Metre | None
    """At t = 0 [m]; `None` where it is not known."""
    changes: tuple[LevelChange, ...] = ()
    """In order of time; a later one takes the place of one that is not over."""

    @property
    def final_altitude(self) -> Metre | None:
        """Where all changes lead [m]; `None` where it is not known."""
        if self.altitude is None:
            return None
        return self.changes[-1].to_altitude if self.changes else self.altitude

    def at(self, t: Second) -> Metre | None:
        """Where the aircraft is at a time if it keeps to what it declared [m]."""
        altitude = self.altitude
        if altitude is None:
            return None
        ends = [change.at for change in self.changes[1:]] + [inf]
        for change, end in zip(self.changes, ends, strict=False):
            way = change.to_altitude - altitude
            step = change.rate * max(min(t, end) - change.at, 0.0)
            altitude += copysign(min(abs(way), step), way)
        return altitude

    def bends(self) -> tuple[Second, ...]:
        """When its rate of climb changes, in order of time [s]."""
        found: list[Second] = []
        ends = [change.at for change in self.changes[1:]] + [inf]
        for change, end in zip(self.changes, ends, strict=False):
            here = self.at(change.at)
            assert here is not None
            reached = change.at + abs(change.to_altitude - here) / change.rate
            found += [change.at, min(reached, end)]
        return tuple(found)

    def bounds(self, t: Second) -> tuple[Metre, Metre]:
        """Between which altitudes the aircraft is at a time, altimetry included [m]."""
        if self.altitude is None:
            return -inf, inf
        knots = _knots(self)
        return next(knot for knot in reversed(knots) if knot.at <= max(t, 0.0)).until(t)

    def bound_knots(self) -> tuple[Second, ...]:
        """Between these times `bounds` are linear; at them they may jump [s]."""
        return () if self.altitude is None else tuple(knot.at for knot in _knots(self))


UNKNOWN = Heights(altitude=None)
"""Of an aircraft whose level is not known."""


class KeptByHeight(NamedTuple):
    """An interval of time in which height keeps two aircraft apart."""

    from_time: Second
    """Since when [s]."""
    to_time: Second
    """Until when [s]."""
    least_height: Metre
    """No height between the two is below this in between, within all tolerances [m]."""


def heights_of(aircraft: Pursuer | Leader | Traffic) -> Heights:
    """What an aircraft declares, or plans, of its altitude."""
    if isinstance(aircraft, Pursuer):
        return Heights(altitude=aircraft.altitude, changes=aircraft.levels)
    changes, t = [], 0.0
    durations = iter(aircraft.trajectory.durations()) if aircraft.intent else iter(())
    for piece in aircraft.intent:
        if isinstance(piece, ChangeLevel):
            changes.append(LevelChange(at=t, to_altitude=piece.to_altitude, rate=piece.rate))
        else:
            t += float(next(durations))
    return Heights(altitude=aircraft.altitude, changes=tuple(changes))


def counted(own: Heights, other: Heights) -> tuple[Interval, ...]:
    """When the horizontal minimum counts between two aircraft, since 1,000 ft are not certain.

    Args:
        own: of one of them.
        other: of the other.

    Returns:
        Intervals in order of time; all time where a level is not known, none where both are always
        1,000 ft apart.
    """
    if own.altitude is None or other.altitude is None:
        return ALWAYS
    return tuple((since, until) for since, until, certain, _ in _spans(own, other) if not certain)


def off_level(own: Heights, leader: Heights) -> tuple[Interval, ...]:
    """When a pursuer is not at its leader's level, by what both are to do.

    Args:
        own: of the pursuer.
        leader: of its leader.

    Returns:
        Intervals in order of time; none where a level is not known.
    """
    if own.altitude is None or leader.altitude is None:
        return ()
    times = sorted({0.0, *own.bends(), *leader.bends()})
    gaps = [_between(own, leader, t) for t in times]
    found: list[Interval] = []
    for (t, gap), (end, then) in pairwise(zip([*times, inf], [*gaps, gaps[-1]], strict=True)):
        cuts = [t]
        for side in (-JOINED_HEIGHT, JOINED_HEIGHT):
            if (gap - side) * (then - side) < 0.0:
                cuts.append(t + (gap - side) / (gap - then) * (end - t))
        for low, high in pairwise([*sorted(cuts), end]):
            if abs(_between(own, leader, min(0.5 * (low + high), low + 1.0))) <= JOINED_HEIGHT:
                continue
            begun = found.pop()[0] if found and found[-1][1] == low else low
            found.append((begun, high))
    return tuple(found)


def time_to_level(own: Heights, leader: Heights, since: Second = 0.0) -> Second:
    """When a pursuer is first at its leader's level from `since` [s] on; infinite if never [s]."""
    for begin, end in off_level(own, leader):
        if begin <= since < end:
            return end
    return since


def _between(own: Heights, leader: Heights, t: Second) -> Metre:
    """How far a pursuer is above its leader at a time, where both levels are known [m]."""
    here, there = own.at(t), leader.at(t)
    assert here is not None
    assert there is not None
    return here - there


def kept_by_height(own: Heights, other: Heights, until: Second) -> tuple[KeptByHeight, ...]:
    """The other times until `until` [s], each with the least height between the two."""
    if own.altitude is None or other.altitude is None:
        return ()
    return tuple(
        KeptByHeight(since, min(to, until), least)
        for since, to, certain, least in _spans(own, other, until)
        if certain
    )


def _spans(
    own: Heights, other: Heights, until: Second = inf
) -> Iterator[tuple[Second, Second, bool, Metre]]:
    """Time cut where 1,000 ft become certain or cease to be: from, to, certain, least height."""
    enough = VERTICAL_MINIMUM - WHOLE_METRE
    since, certain, least = 0.0, False, inf
    for start, _, at_start, at_end in _gaps(own, other, until):
        here = at_start >= enough and at_end >= enough
        if start > 0.0 and here != certain:
            yield since, start, certain, least
            since, least = start, inf
        certain, least = here, min(least, at_start, at_end)
    yield since, until, certain, least


def _gaps(
    own: Heights, other: Heights, until: Second
) -> Iterator[tuple[Second, Second, Metre, Metre]]:
    """Pieces of time in which the certain height is linear, on one side of the minimum each.

    Yields:
        from, to, the height that is certain at the start and at the end [m], negative without any.
    """
    if until <= 0.0:
        return
    enough = VERTICAL_MINIMUM - WHOLE_METRE
    ours, theirs = _knots(own), _knots(other)
    times = sorted({knot.at for knot in (*ours, *theirs) if knot.at < until})
    for start, end in zip(times, [*times[1:], until], strict=True):
        mine = next(knot for knot in reversed(ours) if knot.at <= start)
        yours = next(knot for knot in reversed(theirs) if knot.at <= start)
        last = start + 1.0 if end == inf else end  # from the last knot on all is level

        def above(t: Second, mine: _Knot = mine, yours: _Knot = yours) -> tuple[Metre, Metre]:
            (low, high), (other_low, other_high) = mine.until(t), yours.until(t)
            return low - other_high, other_low - high

        cuts = {start, end}
        for a, b in zip(above(start), above(last), strict=True):
            if (a < enough) != (b < enough):
                cuts.add(start + (enough - a) / (b - a) * (last - start))
        inner = sorted(cut for cut in cuts if start <= cut <= end)
        for low, high in pairwise(inner):
            side = above(0.5 * (low + min(high, last)))
            k = 0 if side[0] >= side[1] else 1
            ends = above(low)[k], above(min(high, last))[k]
            if side[k] >= enough:  # its edges are so but for rounding
                ends = max(ends[0], enough), max(ends[1], enough)
            yield low, high, *ends


class _Active(NamedTuple):
    """A change while it may be flown."""

    begin: Second
    end: Second
    change: LevelChange


def _knots(heights: Heights) -> list[_Knot]:
    """Bounds on a known altitude, from t = 0 on; level behind the last knot."""
    assert heights.altitude is not None
    changes = heights.changes
    begins = [max(change.at - START_TOLERANCE, 0.0) for change in changes]
    ends = [change.at + START_TOLERANCE for change in changes[1:]] + [inf] * bool(changes)
    active = [_Active(*one) for one in zip(begins, ends, changes, strict=True)]
    holds_until = changes[0].at + START_TOLERANCE if changes else inf
    events = sorted({0.0, *begins, *ends, holds_until} - {inf})
    t, low, high = 0.0, heights.altitude, heights.altitude
    knots: list[_Knot] = []
    while True:
        flown = [one.change for one in active if one.begin <= t < one.end]
        low_rates = [_rate(low, change, -1.0) for change in flown]
        high_rates = [_rate(high, change, 1.0) for change in flown]
        if t < holds_until:
            low_rates.append(0.0)
            high_rates.append(0.0)
        down, up = min(low_rates), max(high_rates)
        changing = bool(flown) and (
            len(flown) > 1 or t < holds_until or low != high or low != flown[0].to_altitude
        )
        knots.append(_Knot(t, low, high, down, up, changing))
        following = [event for event in events if event > t]
        for bound, rate in ((low, down), (high, up)):
            following += [
                t + (change.to_altitude - bound) / rate
                for change in flown
                if rate != 0.0 and (change.to_altitude - bound) * rate > 0.0
            ]
        later = [event for event in following if event > t]
        if not later:
            return knots
        then = min(later)
        low, high = (_reached(bound, rate, then - t, flown) for bound, rate in
                     ((low, down), (high, up)))  # fmt: skip
        t = then


def _rate(altitude: Metre, change: LevelChange, side: float) -> MetrePerSecond:
    """The largest vertical speed by a change; with `side` −1 the least [m/s]."""
    if altitude == change.to_altitude:
        return 0.0
    way = 1.0 if altitude < change.to_altitude else -1.0
    return way * change.rate * (1.0 + way * side * RATE_TOLERANCE)


def _reached(bound: Metre, rate: MetrePerSecond, time: Second, flown: list[LevelChange]) -> Metre:
    """A bound some time on; exactly the level where it is reached [m]."""
    then = bound + rate * time
    for change in flown:
        if abs(then - change.to_altitude) < 1e-6:
            return change.to_altitude
    return then
