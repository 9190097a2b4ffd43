"""Deviations put into flights that were flown, and when each leaves its threshold.

What is true of a deviation is found by sampling the path and the leader's trail densely; it shares
no code with the monitor.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from math import cos, hypot, pi, sin

import numpy as np

from relguide.atc.documents import DeviationKind
from relguide.atc.picture import Seen
from relguide.atc.request import Manoeuvre
from relguide.atc.settings import AtcSettings
from relguide.kernels.base.angles import wrap, wrap_signed
from relguide.kernels.base.roots import FloatArray
from relguide.units import DEG, Second

SETTINGS = AtcSettings()
DENSE: Second = 0.1
"""Paths are sampled so densely."""
TURNED = 5.0 * DEG
"""A turn can be seen once an aircraft has turned by this."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Watched:
    """A flight as it was seen, once a second, while it flew what it was cleared to fly."""

    number: int
    manoeuvre: Manoeuvre
    own: tuple[Seen, ...]
    leader: tuple[Seen, ...]

    @property
    def joined(self) -> int:
        """The first second in which it has joined; past the last one if it never does."""
        later = (k for k, seen in enumerate(self.own) if seen.t >= self.manoeuvre.joins)
        return next(later, len(self.own))


@dataclass(frozen=True, slots=True, kw_only=True)
class Deviating:
    """A flight that deviates."""

    kind: str
    subject: DeviationKind
    """What the monitor is to say."""
    own: tuple[Seen, ...]
    begins: int
    """The second in which it begins to deviate."""
    leaves: int
    """The first second in which it has left the threshold of a caution."""


Injection = Callable[[Watched, np.random.Generator], Deviating | None]


def drifts(flight: Watched, rng: np.random.Generator) -> Deviating | None:
    """It flies some degrees off, to one side."""
    if (begins := _begin(flight, rng)) is None:
        return None
    angle = float(rng.uniform(3.0, 20.0)) * DEG * float(rng.choice((-1.0, 1.0)))
    own, aside = list(flight.own[:begins]), 0.0
    for seen in flight.own[begins:]:
        aside += seen.ground_speed * sin(angle)
        own.append(_moved(seen, aside * cos(seen.track), -aside * sin(seen.track), angle))
    off = np.abs(_off(flight.manoeuvre, own)[0])
    return _left("drifts aside", "across", own, begins, off > SETTINGS.across.caution)


def at_another_speed(flight: Watched, rng: np.random.Generator) -> Deviating | None:
    """It flies where it is to fly, some percent too fast or too slow."""
    if (begins := _begin(flight, rng)) is None:
        return None
    share = float(rng.uniform(0.02, 0.08)) * float(rng.choice((-1.0, 1.0)))
    t = np.array([seen.t for seen in flight.own])
    x, y = np.array([(seen.x, seen.y) for seen in flight.own]).T
    tracks = np.unwrap([seen.track for seen in flight.own])
    flown = t + share * np.maximum(t - t[begins], 0.0)
    count = int(np.sum(flown <= t[-1]))
    own = [
        replace(
            seen,
            x=float(np.interp(flown[k], t, x)),
            y=float(np.interp(flown[k], t, y)),
            track=wrap(float(np.interp(flown[k], t, tracks))),
            ground_speed=seen.ground_speed * (1.0 + share if k >= begins else 1.0),
        )
        for k, seen in enumerate(flight.own[:count])
    ]
    early = np.abs(_off(flight.manoeuvre, own)[1])
    return _left("another speed", "along", own, begins, early > SETTINGS.along.caution)


def turns_late(flight: Watched, rng: np.random.Generator) -> Deviating | None:
    """It flies straight on where a turn is to begin."""
    if (turn := _turn(flight, rng)) is None:
        return None
    begins, seen_at = turn
    own = list(flight.own[: begins + 1])
    for seen in flight.own[begins + 1 :]:
        own.append(_ahead(own[-1], own[-1].track, seen))
    late = np.arange(len(own)) > seen_at + SETTINGS.turn.caution
    return _left("turns late", "turn", own, begins, late)


def turns_away(flight: Watched, rng: np.random.Generator) -> Deviating | None:
    """It turns to the other side."""
    if (turn := _turn(flight, rng)) is None:
        return None
    begins, seen_at = turn
    own, before = list(flight.own[: begins + 1]), flight.own[begins].track
    for seen in flight.own[begins + 1 :]:
        own.append(_ahead(own[-1], wrap(2.0 * before - seen.track), seen))
    return _left("turns to the other side", "turn", own, begins, np.arange(len(own)) >= seen_at)


def leaves_level(flight: Watched, rng: np.random.Generator) -> Deviating | None:
    """It climbs or descends."""
    if (begins := _begin(flight, rng)) is None:
        return None
    rate = float(rng.uniform(1.0, 10.0)) * float(rng.choice((-1.0, 1.0)))
    own = list(flight.own[:begins])
    for k, seen in enumerate(flight.own[begins:]):
        assert seen.altitude is not None
        own.append(replace(seen, altitude=seen.altitude + rate * k, climb=rate))
    off = np.abs([_altitude(seen) - _altitude(flight.own[0]) for seen in own])
    return _left("leaves its level", "level", own, begins, off > SETTINGS.level.caution)


def closes_up(flight: Watched, rng: np.random.Generator) -> Deviating | None:
    """It has joined, and then flies faster or slower than its leader."""
    joined = flight.joined
    if joined + 100 > len(flight.own):
        return None
    begins = joined + int(rng.integers(5, 40))
    faster = float(rng.uniform(8.0, 25.0)) * float(rng.choice((-1.0, 1.0)))
    own, ahead = list(flight.own[:begins]), 0.0
    for seen in flight.own[begins:]:
        ahead += faster
        moved = _moved(seen, ahead * sin(seen.track), ahead * cos(seen.track), 0.0)
        own.append(replace(moved, ground_speed=seen.ground_speed + faster))
    error = np.abs(_behind(flight, own) - flight.manoeuvre.spacing)
    apart = [hypot(a.x - b.x, a.y - b.y) for a, b in zip(own, flight.leader, strict=False)]
    after = np.arange(len(own)) >= joined
    left = (after & (error > SETTINGS.spacing.caution)) | (
        np.array(apart) < flight.manoeuvre.min_separation
    )
    return _left("leaves its place behind", "spacing", own, begins, left)


INJECTIONS: Mapping[str, Injection] = {
    "drifts aside": drifts,
    "another speed": at_another_speed,
    "turns late": turns_late,
    "turns to the other side": turns_away,
    "leaves its level": leaves_level,
    "leaves its place behind": closes_up,
}


def _begin(flight: Watched, rng: np.random.Generator) -> int | None:
    """A second on the way to the leader."""
    return int(rng.integers(20, flight.joined - 60)) if flight.joined > 100 else None


def _turn(flight: Watched, rng: np.random.Generator) -> tuple[int, int] | None:
    """The second before a turn of 30° or more by what was flown, and that in which it is seen."""
    tracks = np.unwrap([seen.track for seen in flight.own])
    found = []
    for k in range(12, flight.joined - 60):
        straight = np.ptp(tracks[k - 10 : k + 1]) < 0.2 * DEG
        changed = tracks[k : k + 61] - tracks[k]
        if straight and abs(changed[-1]) > 30.0 * DEG and abs(tracks[k + 1] - tracks[k]) > 1e-4:
            side = np.sign(changed[-1])
            seen = int(np.argmax(side * changed >= TURNED))
            if seen < 12 and np.min(side * changed[: seen + 1]) > -0.5 * DEG:
                found.append((k, k + seen))
    return found[int(rng.integers(len(found)))] if found else None


def _left(
    kind: str, subject: DeviationKind, own: Sequence[Seen], begins: int, left: FloatArray
) -> Deviating | None:
    """`None` if it does not leave its threshold for long enough to be found."""
    if not np.any(left):
        return None
    leaves = int(np.argmax(left))
    if leaves + 10 >= len(own):
        return None
    return Deviating(kind=kind, subject=subject, own=tuple(own), begins=begins, leaves=leaves)


def _off(manoeuvre: Manoeuvre, own: Sequence[Seen]) -> tuple[FloatArray, FloatArray]:
    """How far from the nearest place of the path [m], and how much too early there [s]."""
    path = manoeuvre.path
    t = np.arange(path.begin, path.end, DENSE)
    x, y = np.interp(t, path.t, path.x), np.interp(t, path.t, path.y)
    across, along = [], []
    for seen in own:
        about = slice(*np.searchsorted(t, (seen.t - 25.0, seen.t + 25.0)).tolist())
        apart = np.hypot(x[about] - seen.x, y[about] - seen.y)
        if not len(apart):
            across.append(0.0)
            along.append(0.0)
            continue
        nearest = int(np.argmin(apart))
        across.append(float(apart[nearest]))
        along.append(float(t[about][nearest]) - seen.t)
    return np.array(across), np.array(along)


def _behind(flight: Watched, own: Sequence[Seen]) -> FloatArray:
    """How far behind its leader, along the leader's trail and the line on which it began [m]."""
    first = flight.leader[0]
    back = np.arange(-400.0, 0.0, DENSE) * first.ground_speed
    t = np.array([seen.t for seen in flight.leader])
    dense = np.arange(t[0], t[-1], DENSE)
    places = np.array([(seen.x, seen.y) for seen in flight.leader])
    x = np.concatenate((first.x + back * sin(first.track), np.interp(dense, t, places[:, 0])))
    y = np.concatenate((first.y + back * cos(first.track), np.interp(dense, t, places[:, 1])))
    way = np.concatenate(([0.0], np.cumsum(np.hypot(np.diff(x), np.diff(y)))))
    behind = []
    for seen, leader in zip(own, flight.leader, strict=False):
        last = len(back) + int((leader.t - t[0]) / DENSE)
        first_place = max(last - int(250.0 / DENSE), 0)
        apart = np.hypot(x[first_place : last + 1] - seen.x, y[first_place : last + 1] - seen.y)
        end = way[min(last, len(way) - 1)]
        behind.append(end - way[min(first_place + int(np.argmin(apart)), len(way) - 1)])
    return np.array(behind)


def _moved(seen: Seen, east: float, north: float, turned: float) -> Seen:
    return replace(seen, x=seen.x + east, y=seen.y + north, track=wrap(seen.track + turned))


def _ahead(last: Seen, track: float, seen: Seen) -> Seen:
    """A second later, by way of the mean of two directions."""
    mean = last.track + 0.5 * wrap_signed(track - last.track)
    x, y = last.x + seen.ground_speed * sin(mean), last.y + seen.ground_speed * cos(mean)
    return replace(seen, x=x, y=y, track=track % (2.0 * pi))


def _altitude(seen: Seen) -> float:
    assert seen.altitude is not None
    return seen.altitude
