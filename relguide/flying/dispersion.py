"""Dispersion: an aircraft that is not quite its type, and flights at random."""

from dataclasses import replace
from math import hypot, pi
from random import Random

from relguide.flying.airframe import Airframe
from relguide.flying.pilot_model import PilotModel
from relguide.planning.aircraft import Leader, Pursuer
from relguide.planning.intent import FlyStraight, IntentPiece, TurnTo
from relguide.planning.situation import Situation
from relguide.planning.trajectory import LEFT, RIGHT
from relguide.planning.wind import CALM, wind_from
from relguide.units import DEG, NM

DISPERSED = {
    "max_roll_rate": 1.0,
    "roll_time_constant": 1.0,
    "speed_time_constant": 1.0,
    "thrust_share": 0.3,
    "zero_lift_drag": 0.3,
    "induced_drag": 0.3,
    "speed_brake_drag": 1.0,
}
"""Constants of an airframe that differ from one aircraft of its type to the next, each with how
much, beside the others: engines and wings age little, and speed is the difference of the two."""
SHARE = 0.1
"""By how much of themselves they do at most; thrust and drag by 3 %."""

PILOTS_SHARE = 0.5
"""The same of a pilot's: as little is known of them."""


def disperse(airframe: Airframe, seed: int, share: float = SHARE) -> Airframe:
    """An aircraft whose constants differ from its type's by chance.

    Args:
        airframe: the type.
        seed: of the random numbers; 0 gives the type itself.
        share: each constant is drawn evenly within ± this share of itself, as `DISPERSED` says.
    """
    if seed == 0:
        return airframe
    rng = Random(seed)
    drawn = {
        name: getattr(airframe, name) * (1.0 + part * rng.uniform(-share, share))
        for name, part in DISPERSED.items()
    }
    return replace(airframe, **drawn)


def disperse_pilot(pilot: PilotModel, seed: int, share: float = PILOTS_SHARE) -> PilotModel:
    """A pilot whose constants differ from a model's by chance; its lead stays.

    Args:
        pilot: the model.
        seed: of the random numbers; 0 gives the model itself.
        share: each constant is drawn evenly within ± this share of itself.
    """
    if seed == 0:
        return pilot
    rng = Random(f"pilot {seed}")  # other numbers than its aircraft's
    names = ("bandwidth", "delay", "remnant", "threshold", "reaction")
    drawn = {name: getattr(pilot, name) * (1.0 + rng.uniform(-share, share)) for name in names}
    return replace(pilot, **drawn)


def random_situation(seed: int) -> Situation:
    """A start within 60 km, the leader turning once or not at all, in wind or in calm air.

    Args:
        seed: of the random numbers; the same gives the same situation.
    """
    rng = Random(seed)
    pursuer_tas = rng.uniform(200.0, 240.0)
    leader_tas = max(rng.uniform(0.65, 0.95) * pursuer_tas, 145.0)
    min_separation = rng.uniform(3.0, 5.0) * NM
    intent: tuple[IntentPiece, ...] = ()
    if rng.random() < 0.6:
        intent = (
            FlyStraight(duration=rng.uniform(60.0, 600.0)),
            TurnTo(
                heading=rng.uniform(0.0, 2.0 * pi),
                turn=rng.choice((LEFT, RIGHT)),
                bank=rng.uniform(15.0, 25.0) * DEG,
            ),
        )
    while True:
        x, y = rng.uniform(-60e3, 60e3), rng.uniform(-60e3, 60e3)
        if hypot(x, y) > min_separation + 10e3:
            break
    return Situation(
        pursuer=Pursuer(
            x=x,
            y=y,
            heading=rng.uniform(0.0, 2.0 * pi),
            tas=pursuer_tas,
            max_bank=25.0 * DEG,
        ),
        leader=Leader(
            x=0.0, y=0.0, heading=rng.uniform(0.0, 2.0 * pi), tas=leader_tas, intent=intent
        ),
        slot_distance=min_separation + rng.uniform(0.2, 2.0) * NM,
        min_separation=min_separation,
        wind=wind_from(rng.uniform(0.0, 2.0 * pi), rng.uniform(5.0, 30.0))
        if rng.random() < 0.5
        else CALM,
    )
