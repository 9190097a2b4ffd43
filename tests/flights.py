"""Short ways to fly in tests, and random starts."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from math import hypot, pi
from random import Random
from typing import TypeVar

from relguide.campaign.instant import Instant as Instant
from relguide.campaign.instant import instant as instant
from relguide.flying.aircraft_documents import LinkResult
from relguide.flying.documents import Document, FlightEnded, Sample
from relguide.flying.flight import Command, Scenario, fly
from relguide.planning.aircraft import Leader, Pursuer
from relguide.planning.intent import FlyStraight, TurnTo
from relguide.planning.outcome import Planner
from relguide.planning.plan import plan
from relguide.planning.situation import Situation
from relguide.planning.trajectory import LEFT, RIGHT
from relguide.planning.wind import wind_from
from relguide.units import DEG, NM

T = TypeVar("T")


@dataclass(frozen=True)
class Flown:
    """All that a flight said."""

    documents: tuple[Document, ...]

    @property
    def end(self) -> FlightEnded:
        last = self.documents[-1]
        assert isinstance(last, FlightEnded)
        return last

    @property
    def result(self) -> LinkResult:
        (result,) = self.end.results
        return result

    @property
    def samples(self) -> list[Instant]:
        return [instant(sample) for sample in self.of(Sample)]

    def of(self, kind: type[T]) -> list[T]:
        return [document for document in self.documents if isinstance(document, kind)]


def fly_whole(scenario: Scenario, *said: tuple[float, Command], planner: Planner = plan) -> Flown:
    """A whole flight, a sample a second, with commands at their times."""
    return Flown(tuple(fly(scenario, planner, commands=saying(*said), sample_period=1.0)))


def saying(*said: tuple[float, Command]) -> Callable[[float], Iterable[Command]]:
    """Commands, each at its time."""
    left = list(said)

    def commands(t: float) -> Iterable[Command]:
        now = [command for when, command in left if when <= t + 1e-9]
        del left[: len(now)]
        return now

    return commands


def random_start(seed: int, *, wind: float = 0.0) -> Situation:
    """A start within 60 km that keeps d_min with a mile to spare, the leader turning or not."""
    rng = Random(seed)
    while True:
        x, y = rng.uniform(-60e3, 60e3), rng.uniform(-60e3, 60e3)
        tas = rng.uniform(200.0, 245.0)
        turn = (
            FlyStraight(duration=rng.uniform(0.0, 300.0)),
            TurnTo(
                heading=rng.uniform(0.0, 2.0 * pi),
                turn=rng.choice((LEFT, RIGHT)),
                bank=rng.uniform(15.0, 25.0) * DEG,
            ),
        )
        situation = Situation(
            pursuer=Pursuer(
                x=x, y=y, heading=rng.uniform(0.0, 2.0 * pi), tas=tas, max_bank=25.0 * DEG
            ),
            leader=Leader(
                x=0.0,
                y=0.0,
                heading=rng.uniform(0.0, 2.0 * pi),
                tas=tas * rng.uniform(0.6, 0.95),
                intent=turn if rng.random() < 0.5 else (),
            ),
            slot_distance=rng.uniform(10e3, 14e3),
            min_separation=5.0 * NM,
            wind=wind_from(rng.uniform(0.0, 2.0 * pi), wind),
        )
        if 6.0 * NM < hypot(x, y) < 60e3:
            return situation
