"""The same flight of the campaign, flown by our own aircraft or by JSBSim's A320."""

from dataclasses import dataclass, replace

import pytest

from relguide.campaign.families import draw
from relguide.flying import simulation
from relguide.flying.documents import FlightEnded
from relguide.flying.fleet import Fleet
from relguide.units import MetrePerSecond, Second
from tests.independent.a320 import A320Fleet

FAMILIES = ("declared", "near_limit", "undeclared")
NUMBERS = range(8)
TOO_LATE, TOO_NEAR = 0.02, 0.015
"""So much later or sooner, and so much less of d_min, is another flight."""
LONGEST: Second = 5_000.0
SPARE: Second = 60.0
"""A flight goes on so long after it should have joined, or after it has."""


@dataclass(frozen=True, slots=True)
class Outcome:
    """What became of a flight."""

    joined: bool
    join_time: Second
    least: float
    """Least separation, in d_min."""
    silent: int
    """Losses of d_min that were not announced."""
    lost: int
    """All of them."""


def outcome(
    family: str,
    number: int,
    fleet: type[Fleet] = Fleet,
    *,
    gusts: MetrePerSecond = 0.0,
    seed: int = 0,
    until: Second = LONGEST,
) -> Outcome:
    """Fly a flight of the campaign; σ of the gusts in m/s."""
    world = draw(family, number).world()
    world = replace(world, air=replace(world.air, gusts=gusts))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(simulation, "Fleet", fleet)
        *_, end = simulation.simulate(
            world, sample_period=1.0, seed=seed, until=until, after_joining=SPARE
        )
    assert isinstance(end, FlightEnded)
    (result,) = end.results
    return Outcome(
        joined=result.joined,
        join_time=result.join_time,
        least=result.least_separation / world.links[0].min_separation,
        silent=sum(not loss.announced for loss in result.losses),
        lost=len(result.losses),
    )


@dataclass(frozen=True, slots=True)
class Pair:
    """One flight by both."""

    own: Outcome
    a320: Outcome

    @property
    def later(self) -> float:
        """By what share of our own time the A320 joins later."""
        return self.a320.join_time / self.own.join_time - 1.0

    @property
    def nearer(self) -> float:
        """By what share of d_min it comes nearer."""
        return self.own.least - self.a320.least

    @property
    def same(self) -> bool:
        """Whether that is the same flight, and nothing was lost in silence."""
        told = self.a320.joined and self.own.joined and self.a320.silent == 0
        return told and abs(self.later) <= TOO_LATE and self.nearer <= TOO_NEAR


def both(family: str, number: int, fleet: type[Fleet] = A320Fleet) -> Pair:
    """Fly it in still or moving air without gusts; the A320 no longer than would still do."""
    own = outcome(family, number)
    until = (1.0 + TOO_LATE) * own.join_time + SPARE
    return Pair(own, outcome(family, number, fleet, until=float(int(until))))
