"""Situations drawn at random, among them those in which the separation limit is active."""

from dataclasses import replace
from math import cos, hypot, pi, radians, sin

import numpy as np

from relguide import (
    CALM,
    LEFT,
    RIGHT,
    FlyStraight,
    Leader,
    Pursuer,
    Situation,
    Traffic,
    TurnTo,
    Wind,
    candidates,
    certify,
    wind_from,
)
from relguide.planning.intent import IntentPiece
from relguide.units import NM


def anywhere(rng: np.random.Generator) -> Situation:
    """An airliner within 40 km or within 150 km of a leader that flies straight, calm."""
    far = float(rng.uniform(15e3, rng.choice([40e3, 150e3])))
    bearing = radians(rng.uniform(0, 360))
    tas = float(rng.uniform(180, 250))
    return Situation(
        pursuer=Pursuer(
            x=far * sin(bearing),
            y=far * cos(bearing),
            heading=radians(rng.uniform(0, 360)),
            tas=tas,
            max_bank=radians(rng.uniform(15, 30)),
        ),
        leader=Leader(
            x=0.0,
            y=0.0,
            heading=radians(rng.uniform(0, 360)),
            tas=tas * float(rng.uniform(0.6, 0.98)),
        ),
        slot_distance=float(rng.uniform(10e3, 20e3)),
        min_separation=float(rng.uniform(5.5e3, 9.3e3)),
    )


def near(rng: np.random.Generator, *, tight: bool, intent: bool = False) -> Situation:
    """A situation near the leader, where the limit tends to be active.

    Args:
        rng: the source of chance.
        tight: whether R < d_min and the pursuer is close beside, ahead of or behind the leader.
        intent: whether the leader turns once or twice, in wind.
    """
    tas, bank = float(rng.uniform(90.0, 260.0)), radians(rng.uniform(15.0, 35.0))
    bearing, heading = rng.uniform(0.0, 2.0 * pi), float(rng.uniform(0.0, 2.0 * pi))
    pursuer = Pursuer(
        x=0.0, y=0.0, heading=float(rng.uniform(0.0, 2.0 * pi)), tas=tas, max_bank=bank
    )
    limit = pursuer.turn_radius * float(rng.uniform(1.0, 4.0) if tight else rng.uniform(0.3, 1.0))
    distance = limit * float(rng.uniform(1.0, 1.6) if tight else rng.uniform(1.0, 8.0))
    return Situation(
        pursuer=pursuer,
        leader=Leader(
            x=-distance * sin(bearing),
            y=-distance * cos(bearing),
            heading=heading,
            tas=tas * float(rng.uniform(0.6, 0.98)),
            intent=_turns(rng) if intent else (),
        ),
        slot_distance=limit * float(rng.uniform(1.0, 2.0)),
        min_separation=limit,
        wind=_wind(rng, tas) if intent else CALM,
    )


def active(
    rng: np.random.Generator, *, tight: bool, intent: bool = False, slot_at_limit: bool = False,
    calm: bool = False,
) -> Situation:  # fmt: skip
    """A situation near the leader whose fastest way without the limit breaks it.

    Args:
        rng: the source of chance.
        tight: as in `near`.
        intent: as in `near`.
        slot_at_limit: whether D = d_min.
        calm: whether there is no wind.
    """
    while True:
        situation = near(rng, tight=tight, intent=intent)
        if calm:
            situation = replace(situation, wind=CALM)
        if slot_at_limit:
            situation = replace(situation, slot_distance=situation.min_separation)
        if is_active(situation):
            return situation


def is_active(situation: Situation) -> bool:
    """Whether the slot can be reached, but by none of the fastest ways without coming too close.

    Ways that arrive as the slot opens are all equally fast; later there is one fastest.
    """
    found = candidates(situation)
    if found.reachable_at_release:
        fastest = tuple(found.at_release)
    elif len(found.rows) > 0:
        fastest = (next(found.later),)
    else:
        return False
    return not any(certify(way.trajectory, situation).holds for way in fastest)


def _turns(rng: np.random.Generator) -> tuple[IntentPiece, ...]:
    pieces: list[IntentPiece] = []
    for _ in range(rng.integers(1, 3)):
        pieces.append(FlyStraight(duration=float(rng.uniform(0.0, 120.0))))
        pieces.append(
            TurnTo(
                heading=float(rng.uniform(0.0, 2.0 * pi)),
                turn=LEFT if rng.random() < 0.5 else RIGHT,
                bank=radians(rng.uniform(15.0, 30.0)),
            )
        )
    return tuple(pieces)


def _wind(rng: np.random.Generator, tas: float) -> Wind:
    # a quarter of the pursuer's airspeed: the slowest leader still makes headway
    return wind_from(float(rng.uniform(0.0, 2.0 * pi)), tas * float(rng.uniform(0.0, 0.25)))


def amid_traffic(rng: np.random.Generator, count: int) -> Situation:
    """A straight leader in calm air, with other straight traffic anywhere within 140 km.

    The pursuer begins within 100 km of the leader; all are clear of it at first.

    Args:
        rng: the source of chance.
        count: how many others.
    """
    limit, tas = 5.0 * NM, float(rng.uniform(200.0, 250.0))
    while True:
        alone = Situation(
            pursuer=Pursuer(
                x=float(rng.uniform(-70e3, 70e3)),
                y=float(rng.uniform(-70e3, 70e3)),
                heading=float(rng.uniform(0.0, 2.0 * pi)),
                tas=tas,
                max_bank=radians(25.0),
            ),
            leader=Leader(x=0.0, y=0.0, heading=0.0, tas=tas * float(rng.uniform(0.7, 0.95))),
            slot_distance=12e3,
            min_separation=limit,
        )
        own = alone.pursuer
        others: list[Traffic] = []
        while len(others) < count:
            x, y = rng.uniform(-140e3, 140e3, 2)
            heading, speed = rng.uniform(0.0, 2.0 * pi), rng.uniform(180.0, 260.0)
            if hypot(x - own.x, y - own.y) > limit:
                others.append(
                    Traffic(
                        ident=f"T{len(others) + 1}",
                        x=float(x),
                        y=float(y),
                        heading=float(heading),
                        tas=float(speed),
                        min_separation=limit,
                    )
                )
        if hypot(own.x, own.y) > limit:
            return replace(alone, others=tuple(others))
