"""draw_visited(rng, size, …): situations that closed loops meet, as rows in the slot frame.

What is drawn at random is not what is asked in flight. There the planner is asked where its plan
is to begin, a few seconds ahead; a leader that turns unannounced sweeps the slot round, and a plan
is asked for as it does; and while a faster path is not excluded, one is looked for again and again
along the one that is flown. So flights are flown, with everything a flight has (rolling,
commitment, capture), and what the planner was asked is kept.
"""

from collections.abc import Callable
from dataclasses import replace
from math import cos, pi, sin

import numpy as np
from numpy.typing import NDArray

from relguide.flying.flight import Scenario, fly
from relguide.flying.guidance.settings import Settings
from relguide.flying.scenarios import own_scenario
from relguide.kernels.base.angles import wrap
from relguide.planning.aircraft import Leader, Pursuer
from relguide.planning.intent import FlyStraight, IntentPiece, TurnTo
from relguide.planning.outcome import NoPlan, Plan, Planner
from relguide.planning.plan import plan
from relguide.planning.situation import Situation
from relguide.planning.slot import slot_frame
from relguide.planning.trajectory import LEFT, RIGHT
from relguide.units import DEG, Second

Floats = NDArray[np.float64]
STEP: Second = 0.25
"""Integration step: flights end within a second of those at 0.05 s, in half the time."""
LONGEST: Second = 900.0
"""A flight is left there: what follows is a long straight, or the leader's path."""
KEPT = 60
"""Situations kept of a flight at most; the others would be next to them."""
FLIGHTS = 50
"""So many flights in a row without a situation to keep are an error."""


def draw_visited(
    rng: np.random.Generator,
    size: int,
    *,
    max_range: float,
    min_ratio: float,
    max_ratio: float,
    planner: Planner = plan,
) -> Floats:
    """Fly until there are so many situations.

    Args:
        rng: the source of chance; nothing else is random.
        size: how many.
        max_range: farthest from the slot [R]; situations beyond are left out.
        min_ratio: least V_L/V_P.
        max_ratio: largest V_L/V_P.
        planner: flies, and decides by what it answers what it meets next.

    Returns:
        x, y [R], h in [0, 2π) [rad], α, D/R, d_min/R, on either side of the route. shape (size, 6)

    Raises:
        ValueError: if flights never come there.
    """
    kept: list[Floats] = []
    missing, in_vain = size, 0
    while missing > 0:
        if in_vain == FLIGHTS:
            raise ValueError(
                f"{FLIGHTS} flights met nothing within {max_range:g} R and speed ratios of "
                f"{min_ratio:g} … {max_ratio:g}."
            )
        flight = draw_flight(rng, ratios=(min_ratio, max_ratio))
        asked = collect_situations(flight, planner)
        rows = np.array([row_of(situation) for situation in asked])
        away, alpha = np.hypot(rows[:, 0], rows[:, 1]), rows[:, 3]
        rows = rows[(away <= max_range) & (alpha >= min_ratio) & (alpha <= max_ratio)]
        rows = rows[np.sort(rng.permutation(len(rows))[: min(KEPT, missing)])]
        in_vain = 0 if len(rows) else in_vain + 1
        missing -= len(rows)
        kept.append(rows)
    return np.concatenate(kept) if kept else np.empty((0, 6))


def draw_flight(rng: np.random.Generator, *, ratios: tuple[float, float] = (0.6, 0.97)) -> Scenario:
    """A flight of airliners in still air, whose leader changes course once or twice.

    At a level where the pursuer can fly its speed and, if there is one, its leader's.

    The pursuer begins within 40 km or within 150 km. In every other flight it knows the leader's
    course changes beforehand; else it sees them as they happen.

    Args:
        rng: the source of chance.
        ratios: least and largest V_L/V_P.
    """
    tas = float(rng.uniform(150.0, 250.0))
    slot_distance = float(rng.uniform(8e3, 20e3))
    min_separation = float(rng.uniform(5.5e3, min(9.3e3, slot_distance)))
    far = min_separation + float(rng.uniform(0.0, rng.choice([40e3, 150e3])))
    bearing = float(rng.uniform(0.0, 2.0 * pi))
    begun = heading = float(rng.uniform(0.0, 2.0 * pi))
    intent: list[IntentPiece] = []
    for _ in range(rng.integers(1, 3)):
        turn = LEFT if rng.random() < 0.5 else RIGHT
        heading -= turn * float(rng.uniform(10.0, 150.0)) * DEG
        intent.append(FlyStraight(duration=float(rng.uniform(0.0, 300.0))))
        bank = float(rng.uniform(15.0, 30.0)) * DEG
        intent.append(TurnTo(heading=wrap(heading), turn=turn, bank=bank))
    situation = Situation(
        pursuer=Pursuer(
            x=far * sin(bearing),
            y=far * cos(bearing),
            heading=float(rng.uniform(0.0, 2.0 * pi)),
            tas=tas,
            max_bank=float(rng.uniform(15.0, 30.0)) * DEG,
        ),
        leader=Leader(
            x=0.0,
            y=0.0,
            heading=begun,
            tas=tas * float(rng.uniform(*ratios)),
            intent=tuple(intent),
        ),
        slot_distance=slot_distance,
        min_separation=min_separation,
    )
    flight = own_scenario(situation, intent_known=bool(rng.random() < 0.5))
    return replace(
        flight,
        name="visited",
        title="Visited",
        description="A flight whose leader changes course.",
        duration_limit=LONGEST,
        after_joining=0.0,
    )


def collect_situations(scenario: Scenario, planner: Planner) -> list[Situation]:
    """Fly a scenario, and give what its planner was asked, in order."""
    asked: list[Situation] = []
    listening, each_second = listen_to(planner, asked.append), Settings(always_ask=True)
    for _ in fly(scenario, listening, step=STEP, sample_period=1.0, settings=each_second):
        pass
    return asked


def listen_to(planner: Planner, tell: Callable[[Situation], None]) -> Planner:
    """The same planner, which also notes what it is asked."""

    def asked(situation: Situation) -> Plan | NoPlan:
        tell(situation)
        return planner(situation)

    return asked


def row_of(situation: Situation) -> tuple[float, float, float, float, float, float]:
    """A situation as the networks take it: x, y [R], h [rad], α, D/R, d_min/R."""
    frame = slot_frame(situation, situation.leader.trajectory)
    radius = frame.radius
    slot, limit = situation.slot_distance / radius, situation.min_separation / radius
    return frame.x, frame.y, frame.h, frame.alpha, slot, limit
