"""Aircraft, pictures and manoeuvres for tests, drawn by a seed."""

from math import cos, pi, sin

import numpy as np

from relguide.atc.picture import Picture, Seen
from relguide.atc.request import Manoeuvre
from relguide.atc.tracks import intent_track, path_track
from relguide.planning.aircraft import Traffic
from relguide.planning.intent import FlyStraight, TurnTo
from relguide.planning.trajectory import LEFT, RIGHT, Arc, Straight, Trajectory
from relguide.planning.wind import CALM, Wind
from relguide.units import DEG, FT, NM

NOW = 1.7e9
LEVEL = 33_000.0 * FT


def drawn_traffic(
    rng: np.random.Generator, ident: str, *, span: float = 60_000.0, altitude: float | None = None
) -> Traffic:
    """One with three turns to come."""
    intent = []
    for _ in range(3):
        turn = LEFT if rng.random() < 0.5 else RIGHT
        intent.append(FlyStraight(duration=rng.uniform(5.0, 150.0)))
        heading = rng.uniform(0.0, 2.0 * pi)
        intent.append(TurnTo(heading=heading, turn=turn, bank=rng.uniform(8.0, 30.0) * DEG))
    x, y = rng.uniform(-span, span, 2)
    return Traffic(
        ident=ident,
        x=x,
        y=y,
        heading=rng.uniform(0.0, 2.0 * pi),
        tas=rng.uniform(100.0, 240.0),
        min_separation=5.0 * NM,
        intent=tuple(intent),
        altitude=altitude,
    )


def seen_of(traffic: Traffic, until: float, wind: Wind = CALM, *, now: float = NOW) -> Seen:
    """What is seen of it now, with its intent."""
    east = traffic.tas * sin(traffic.heading) + wind.east
    north = traffic.tas * cos(traffic.heading) + wind.north
    return Seen(
        ident=traffic.ident,
        t=now,
        x=traffic.x,
        y=traffic.y,
        track=float(np.arctan2(east, north)),
        ground_speed=float(np.hypot(east, north)),
        altitude=traffic.altitude,
        path=intent_track(traffic, start=now, until=until, wind=wind),
    )


def drawn_path(rng: np.random.Generator, *, joins_after: float = 400.0) -> Trajectory:
    """Turns and straights of some length, through the middle of where the others are."""
    tas = rng.uniform(120.0, 230.0)
    segments = []
    left = tas * joins_after
    while left > 0.0:
        turn = Arc(
            turn=LEFT if rng.random() < 0.5 else RIGHT,
            turn_angle=rng.uniform(0.1, 3.0),
            radius=rng.uniform(4_000.0, 15_000.0),
        )
        straight = Straight(length=rng.uniform(1_000.0, 30_000.0))
        segments += [turn, straight]
        left -= turn.length + straight.length
    x, y = rng.uniform(-15_000.0, 15_000.0, 2)
    return Trajectory(
        x=x, y=y, heading=rng.uniform(0.0, 2.0 * pi), tas=tas, segments=tuple(segments)
    )


def manoeuvre_on(
    path: Trajectory, wind: Wind = CALM, *, now: float = NOW, d_min: float = 3.0 * NM
) -> tuple[Manoeuvre, Seen]:
    """A manoeuvre that ends 5 NM behind a leader that flies straight, and that leader as seen."""
    duration = path.duration
    end = path.pose_at(duration)
    east, north = path.tas * sin(end.heading), path.tas * cos(end.heading)
    over_ground = np.hypot(east + wind.east, north + wind.north)
    ahead = 5.0 * NM / over_ground
    leader = Traffic(
        ident="LEAD",
        x=end.x + (east + wind.east) * ahead - east * duration,
        y=end.y + (north + wind.north) * ahead - north * duration,
        heading=end.heading,
        tas=path.tas,
        min_separation=d_min,
    )
    until = now + duration + 120.0
    seen = seen_of(leader, until, wind, now=now)
    assert seen.path is not None
    manoeuvre = Manoeuvre(
        ident="OWN",
        leader="LEAD",
        spacing_type="distance",
        spacing=5.0 * NM,
        min_separation=d_min,
        path=path_track(path, start=now, until=until, wind=wind),
        joins=now + duration,
        leader_path=seen.path,
    )
    return manoeuvre, seen


def picture_of(*aircraft: Seen, now: float = NOW) -> Picture:
    """All of them, seen now."""
    return Picture(as_of=now, aircraft=aircraft)
