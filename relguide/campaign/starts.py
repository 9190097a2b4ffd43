"""Where the aircraft of a flight begin, and what the leader has declared."""

from math import cos, pi, sin, sqrt

import numpy as np

from relguide.planning.aircraft import Leader, Pursuer
from relguide.planning.intent import FlyStraight, IntentPiece, TurnTo
from relguide.planning.situation import Situation
from relguide.planning.trajectory import LEFT, RIGHT
from relguide.planning.wind import wind_from
from relguide.units import DEG, NM, Metre, MetrePerSecond

Draw = np.random.Generator
REACH: Metre = 60_000.0
"""The pursuer begins no farther away."""
FASTEST: MetrePerSecond = 244.0
LEAST_FOLLOWED: MetrePerSecond = 127.0
"""Leaders begin no slower; on command they do slow down below what a pursuer can fly [m/s]."""
STRONGEST_WIND = 50.0
"""[m/s]."""


def draw_situation(
    rng: Draw, intent: tuple[IntentPiece, ...], *, extra: tuple[float, float] = (0.0, 3.0)
) -> Situation:
    """A start; D exceeds d_min by so many nautical miles."""
    tas = min(float(rng.uniform(180.0, 250.0)), FASTEST)
    min_separation = float(rng.uniform(3.0, 5.5)) * NM
    bearing = float(rng.uniform(0.0, 2.0 * pi))
    # evenly over the ring between d_min and the farthest start
    away = sqrt(float(rng.uniform(min_separation**2, REACH**2)))
    return Situation(
        pursuer=Pursuer(
            x=away * sin(bearing),
            y=away * cos(bearing),
            heading=float(rng.uniform(0.0, 2.0 * pi)),
            tas=tas,
            max_bank=25.0 * DEG,
        ),
        leader=Leader(
            x=0.0,
            y=0.0,
            heading=float(rng.uniform(0.0, 2.0 * pi)),
            tas=max(tas * float(rng.uniform(0.6, 0.98)), LEAST_FOLLOWED),
            intent=intent,
        ),
        slot_distance=min_separation + float(rng.uniform(*extra)) * NM,
        min_separation=min_separation,
        wind=wind_from(float(rng.uniform(0.0, 2.0 * pi)), float(rng.uniform(0.0, STRONGEST_WIND))),
    )


def draw_turns(rng: Draw) -> tuple[IntentPiece, ...]:
    """One to three turns, each after a straight."""
    pieces: list[IntentPiece] = []
    for _ in range(rng.integers(1, 4)):
        pieces.append(FlyStraight(duration=float(rng.uniform(0.0, 600.0))))
        pieces.append(
            TurnTo(
                heading=float(rng.uniform(0.0, 2.0 * pi)),
                turn=LEFT if rng.random() < 0.5 else RIGHT,
                bank=float(rng.uniform(15.0, 25.0)) * DEG,
            )
        )
    return tuple(pieces)
