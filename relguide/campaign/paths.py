"""Paths of announced plans in the air mass, how far off one flies, and full circles."""

from collections.abc import Iterable, Iterator, Sequence
from itertools import pairwise
from math import cos, pi, sin
from typing import assert_never

import numpy as np
from numpy.typing import NDArray

from relguide.flying.plan_documents import (
    BoundarySegment,
    PathPoint,
    PathSegment,
    StraightSegment,
    TurnSegment,
)
from relguide.planning.wind import Wind
from relguide.units import DEG, Metre, Radian, Second

Floats = NDArray[np.float64]
CIRCLE: Radian = 345.0 * DEG
"""So much in one direction is a full circle: a roll-out before the last degrees makes it none."""
PAUSE: Second = 30.0
"""A turn that goes on after so long a straight is the same circle: a racetrack."""
TURNING = 0.2 * DEG
"""Less is a correction, not a turn [rad/s]."""
CORRECTION: Radian = 1.0 * DEG
"""Less to a side is none of a plan's turns."""
EVERY: Second = 1.0
"""Between two points of a path: at 240 m/s the chord of a turn is 0.6 m inside."""


def path_in_air(segments: Sequence[PathSegment], wind: Wind) -> Floats:
    """Points of a plan's path in the air mass of its start: x, y. shape (n, 2)."""
    end = segments[-1].end
    return np.vstack([*(_points(segment, wind) for segment in segments), _in_air(end, wind)])


def _points(segment: PathSegment, wind: Wind) -> Floats:
    """From the start of a segment on; its end is the start of the next. shape (n, 2)."""
    start = segment.start
    match segment:
        case StraightSegment():
            return _in_air(start, wind)
        case TurnSegment():
            side = 1.0 if segment.direction == "right" else -1.0
            count = int(segment.duration / EVERY) + 1
            headings = start.heading + side * np.linspace(0.0, segment.angle, count, endpoint=False)
            radius = side * segment.radius
            east = radius * (cos(start.heading) - np.cos(headings))
            north = radius * (np.sin(headings) - sin(start.heading))
            return _in_air(start, wind) + np.column_stack([east, north])
        case BoundarySegment():
            return np.vstack([_in_air(point, wind) for point in (start, *segment.via)])
        case _:
            assert_never(segment)


def _in_air(point: PathPoint, wind: Wind) -> Floats:
    """Where a place of a path is in the air mass. shape (1, 2)."""
    return np.array([[point.x - wind.east * point.t, point.y - wind.north * point.t]])


def distance_from(path: Floats, x: Metre, y: Metre) -> Metre:
    """Of a place from a path."""
    begin, step = path[:-1], np.diff(path, axis=0)
    lengths = np.maximum(np.einsum("ij,ij->i", step, step), 1e-9)
    away = np.array([x, y]) - begin
    share = np.clip(np.einsum("ij,ij->i", away, step) / lengths, 0.0, 1.0)
    return float(np.min(np.hypot(*(away - share[:, None] * step).T)))


def turns_flown(
    plans: Sequence[tuple[Second, Sequence[PathSegment]]], until: Second
) -> Iterator[tuple[Radian, Second]]:
    """What plans turn, each as far as it was flown before the next took its place.

    Args:
        plans: when each began to be flown [s], and its path; in order of time. None, if none was.
        until: when the last was left [s].

    Yields:
        the heading change of each piece, positive to the right, and how long it took.
    """
    ends = [*(begun for begun, _ in plans[1:]), until][: len(plans)]
    for (begun, segments), end in zip(plans, ends, strict=True):
        left = end - begun
        for segment in segments:
            if left <= 0.0:
                break
            flown = min(segment.duration, left)
            share = flown / segment.duration if segment.duration > 0.0 else 0.0
            yield _turn_angle(segment) * share, flown
            left -= flown


def count_circles(rates: Iterable[float], every: Second) -> int:
    """Full circles in a series of turn rates [rad/s]."""
    return circles((rate * every if abs(rate) > TURNING else 0.0, every) for rate in rates)


def circles(turns: Iterable[tuple[Radian, Second]]) -> int:
    """Full circles in successive heading changes, each with the time it took."""
    return sum(_whole(run) for run, _, _ in _runs(turns))


def lone_circles(rates: Sequence[float], leader_rates: Sequence[float], every: Second) -> int:
    """Full circles in a series of turn rates during which the leader turned less than half of one.

    Args:
        rates: the pursuer's [rad/s].
        leader_rates: the leader's, at the same times [rad/s].
        every: between them [s].
    """
    turns = [(rate * every if abs(rate) > TURNING else 0.0, every) for rate in rates]
    return sum(
        _whole(run)
        for run, first, last in _runs(turns)
        if abs(sum(leader_rates[first:last])) * every < pi
    )


def _runs(turns: Iterable[tuple[Radian, Second]]) -> Iterator[tuple[Radian, int, int]]:
    """Turns to one side with no long pause: how far [rad], the first change and past the last."""
    run, idle, first, last = 0.0, 0.0, 0, 0
    for i, (angle, duration) in enumerate(turns):
        if angle == 0.0:
            idle += duration
            continue
        if idle > PAUSE or angle * run < 0.0:
            yield run, first, last
            run, first = 0.0, i
        run, idle, last = run + angle, 0.0, i + 1
    yield run, first, last


def reversals_of(segments: Sequence[PathSegment]) -> int:
    """How often a plan changes from one side to the other."""
    return reversals(map(_turn_angle, segments))


def reversals(turns: Iterable[Radian]) -> int:
    """How often successive heading changes go from one side to the other, corrections apart."""
    sides = [angle > 0.0 for angle in without_corrections(turns) if angle != 0.0]
    return sum(a != b for a, b in pairwise(sides))


def without_corrections(turns: Iterable[Radian]) -> list[Radian]:
    """Successive heading changes, with 0 for what turns less than 1° to a side and then back."""
    runs: list[list[Radian]] = [[]]
    for angle in turns:
        if angle * sum(runs[-1]) < 0.0:
            runs.append([])
        runs[-1].append(angle)
    return [angle if abs(sum(run)) > CORRECTION else 0.0 for run in runs for angle in run]


def _whole(run: Radian) -> int:
    return int((abs(run) + 2.0 * pi - CIRCLE) / (2.0 * pi))


def _turn_angle(segment: PathSegment) -> Radian:
    """Heading change, positive to the right [rad]."""
    match segment:
        case StraightSegment():
            return 0.0
        case TurnSegment():
            return segment.angle if segment.direction == "right" else -segment.angle
        case BoundarySegment():
            headings = [segment.start.heading, *(p.heading for p in segment.via)]
            turned = np.unwrap([*headings, segment.end.heading])
            return float(turned[-1] - turned[0])
        case _:
            assert_never(segment)
