"""Situations amid others, drawn at random, and how near a path comes to each: sampled, over ground.

What is sampled shares nothing with the planner but `Trajectory.sample`.
"""

from dataclasses import replace
from math import cos, hypot, inf, pi, sin
from typing import TypeVar

import numpy as np

from relguide import (
    LEFT,
    RIGHT,
    Cell,
    Disc,
    FlyStraight,
    Leader,
    Polygon,
    Pursuer,
    Situation,
    Traffic,
    Trajectory,
    TurnTo,
    Wind,
)
from relguide.planning.certificate import FOLLOWED
from relguide.planning.intent import IntentPiece
from relguide.planning.slot import slot_offset
from relguide.units import DEG, NM

Rng = np.random.Generator
Aircraft = TypeVar("Aircraft", Pursuer, Leader, Traffic)
LIMIT = 5.0 * NM
"""To be kept from all aircraft [m]."""


def crossing(ident: str = "CROSSING", **changes: float) -> Traffic:
    """Traffic of which `blocked` comes too close to one."""
    given = {"x": -20e3, "y": -26e3, "heading": 0.5 * pi, "tas": 200.0, "min_separation": LIMIT}
    return Traffic(ident=ident, **(given | changes))


def blocked(*others: Traffic | Cell) -> Situation:
    """A pursuer 60 km behind its leader, on its route: straight is the fastest."""
    return Situation(
        pursuer=Pursuer(x=0.0, y=-60e3, heading=0.0, tas=240.0, max_bank=25.0 * DEG),
        leader=Leader(x=0.0, y=0.0, heading=0.0, tas=200.0),
        slot_distance=12e3,
        min_separation=LIMIT,
        others=others,
    )


def any_sky(rng: Rng, count: int, *, cells: bool = True, turns: bool = True) -> Situation:
    """Straight and turning traffic, discs and polygons that move and grow, wind."""
    wind = Wind(east=float(rng.uniform(-20.0, 20.0)), north=float(rng.uniform(-20.0, 20.0)))
    x, y = rng.uniform(-50e3, 50e3, 2).tolist()
    while hypot(x, y) < LIMIT:
        x, y = rng.uniform(-50e3, 50e3, 2).tolist()
    pursuer = Pursuer(
        x=x, y=y, heading=rng.uniform(0.0, 2.0 * pi), tas=rng.uniform(200.0, 250.0),
        max_bank=25.0 * DEG,
    )  # fmt: skip
    others: list[Traffic | Cell] = []
    while len(others) < count:
        other = _any_other(rng, f"T{len(others)}", cells, turns)
        if nearest(other, np.array([0.0]), np.array([x]), np.array([y]), wind) > 100.0:
            others.append(other)
    return Situation(
        pursuer=pursuer,
        leader=Leader(
            x=0.0, y=0.0, heading=0.3, tas=pursuer.tas * rng.uniform(0.6, 0.95),
            intent=_intent(rng) if turns and rng.random() < 0.5 else (),
        ),
        slot_distance=rng.uniform(10e3, 20e3),
        min_separation=LIMIT,
        wind=wind,
        others=tuple(others),
    )  # fmt: skip


def _any_other(rng: Rng, ident: str, cells: bool, turns: bool) -> Traffic | Cell:
    x, y = rng.uniform(-60e3, 60e3, 2).tolist()
    kind = rng.integers(4) if cells else 3
    if kind >= 2:
        return Traffic(
            ident=ident, x=x, y=y, heading=rng.uniform(0.0, 2.0 * pi),
            tas=rng.uniform(150.0, 260.0), min_separation=LIMIT,
            intent=_intent(rng) if turns and rng.random() < 0.5 else (),
        )  # fmt: skip
    size = rng.uniform(3e3, 12e3)
    around = np.sort(rng.uniform(0.0, 0.7, 6) + np.arange(6)) * 2.0 * pi / 6.0
    corners = tuple((x + size * cos(a), y + 0.6 * size * sin(a)) for a in around.tolist())
    return Cell(
        ident=ident,
        shape=Disc(x=x, y=y, radius=size) if kind == 0 else Polygon(corners=corners),
        east=rng.uniform(-20.0, 20.0), north=rng.uniform(-20.0, 20.0),
        growth=float(rng.choice([0.0, 3.0])),
    )  # fmt: skip


def _intent(rng: Rng) -> tuple[IntentPiece, ...]:
    return (
        FlyStraight(duration=rng.uniform(10.0, 200.0)),
        TurnTo(
            heading=rng.uniform(0.0, 2.0 * pi), turn=LEFT if rng.random() < 0.5 else RIGHT,
            bank=rng.uniform(10.0, 25.0) * DEG,
        ),
    )  # fmt: skip


def margins(path: Trajectory, situation: Situation, step: float = 0.1) -> dict[str, float]:
    """How much farther than its minimum a path keeps from each, at least; the leader is "" [m].

    From the others also in the slot, for as long as the certificate says.
    """
    end = path.duration
    t = np.append(np.arange(0.0, end, step), end)
    way = path.over_ground(situation.wind, t)
    leader = Traffic(
        ident="LEADER", x=situation.leader.x, y=situation.leader.y,
        heading=situation.leader.heading, tas=situation.leader.tas,
        min_separation=situation.min_separation, intent=situation.leader.intent,
    )  # fmt: skip
    found = {"": nearest(leader, t, way.x, way.y, situation.wind)}
    after = end + np.arange(0.0, FOLLOWED, step)
    led = situation.leader.trajectory.over_ground(situation.wind, after)
    east, north, _ = slot_offset(situation.leader.final_heading, situation.leader.tas, situation)
    for other in situation.others:
        found[other.ident] = min(
            nearest(other, t, way.x, way.y, situation.wind),
            nearest(other, after, led.x + east, led.y + north, situation.wind),
        )
    return found


def nearest(
    other: Traffic | Cell, t: np.ndarray, x: np.ndarray, y: np.ndarray, wind: Wind
) -> float:
    """Least distance of places at times beyond what is to be kept [m]."""
    if isinstance(other, Traffic):
        theirs = other.trajectory.over_ground(wind, t)
        return float(np.hypot(x - theirs.x, y - theirs.y).min()) - other.min_separation
    x, y = x - other.east * t, y - other.north * t
    if isinstance(other.shape, Disc):
        far = np.hypot(x - other.shape.x, y - other.shape.y) - other.shape.radius
    else:
        far = _from_polygon(x, y, np.array(other.shape.corners))
    return float((far - other.growth * t).min())


def _from_polygon(x: np.ndarray, y: np.ndarray, corners: np.ndarray) -> np.ndarray:
    """Distance of places from a polygon; negative inside. By complex numbers."""
    place = x + 1j * y
    a = corners[:, 0] + 1j * corners[:, 1]
    outside, inside = np.full(len(x), inf), np.full(len(x), True)
    for begin, end in zip(a, np.roll(a, -1), strict=True):
        along = (place - begin) / (end - begin)
        foot = begin + np.clip(along.real, 0.0, 1.0) * (end - begin)
        outside = np.minimum(outside, np.abs(place - foot))
        inside &= along.imag > 0.0
    return np.where(inside, -outside, outside)


def mirrored(situation: Situation) -> Situation:
    """East and west exchanged."""

    def mirror(one: Aircraft) -> Aircraft:
        return replace(one, x=-one.x, heading=-one.heading)

    return replace(
        situation,
        pursuer=mirror(situation.pursuer),
        leader=mirror(situation.leader),
        others=tuple(mirror(one) for one in situation.others if isinstance(one, Traffic)),
        wind=Wind(east=-situation.wind.east, north=situation.wind.north),
    )


def moved(situation: Situation, east: float, north: float, turned: float) -> Situation:
    """Turned clockwise about the origin [rad], then moved [m]."""
    s, c = sin(turned), cos(turned)

    def move(one: Aircraft) -> Aircraft:
        x, y = one.x * c + one.y * s + east, one.y * c - one.x * s + north
        return replace(one, x=x, y=y, heading=one.heading + turned)

    return replace(
        situation,
        pursuer=move(situation.pursuer),
        leader=move(situation.leader),
        others=tuple(move(one) for one in situation.others if isinstance(one, Traffic)),
    )
