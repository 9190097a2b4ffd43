"""Whole flights amid others: `python -m benchmarks.flown_amid --flights 200 --broken 0.2`.

Each flight has others that come near the way that the pursuer would fly alone. With `--broken` a
share of them declares one thing and flies another. What counts: that no minimum is lost, to the
leader or to any of the others, and if one is, that the crew had been told before.
"""

import argparse
import sys
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import islice
from math import hypot, pi
from time import thread_time

import numpy as np
from rich.console import Console

from benchmarks.options import positive
from relguide.flying.aircraft_documents import LinkResult, Loss
from relguide.flying.dispersion import random_situation
from relguide.flying.documents import Alert, FlightEnded, PlanChanged, Unable
from relguide.flying.flight import Scenario, world_of
from relguide.flying.scenarios import own_scenario
from relguide.flying.simulation import simulate
from relguide.flying.surveillance import Surveillance
from relguide.flying.world import Declared, World
from relguide.planning.aircraft import Traffic
from relguide.planning.intent import FlyStraight, IntentPiece, TurnTo
from relguide.planning.outcome import Plan
from relguide.planning.plan import plan
from relguide.planning.trajectory import LEFT, RIGHT
from relguide.units import DEG, Metre, Second

LONGEST: Second = 3600.0
"""A flight that has not joined by then has not joined [s]."""
BEGINS: Metre = 20_000.0
"""Others begin at least so far outside of their minimum [m]: nearer ones that come head-on leave no
way out to an aircraft that has to turn first."""
PASSES: Metre = 6_000.0
"""σ of how near they pass where the pursuer would be if it were alone [m]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Flown:
    """A flight, and what came of it."""

    number: int
    result: LinkResult
    replans: int
    """Plans because others came in the way."""
    alerts: int
    """Alerts on others that were given."""
    unables: int
    cpu: float
    """Of this thread [s]."""


def draw_scenarios(seed: int, others: int, surveillance: str) -> Iterator[tuple[int, Scenario]]:
    """Flights that could be flown alone, with others in the way, by number."""
    number = seed
    while True:
        number += 1
        situation = random_situation(number)
        alone = plan(situation)
        if not isinstance(alone, Plan) or not 120.0 < alone.time_to_converge < 1800.0:
            continue
        rng = np.random.default_rng([seed, number])
        traffic = tuple(_draw_other(rng, f"T{k + 1}", alone) for k in range(others))
        try:
            scenario = own_scenario(replace(situation, others=traffic))
        except ValueError:  # no level at which it can fly its speed
            continue
        seen = Surveillance(kind="adsb") if surveillance == "adsb" else Surveillance()
        yield number, replace(scenario, duration_limit=LONGEST, surveillance=seen)


def _draw_other(rng: np.random.Generator, ident: str, alone: Plan) -> Traffic:
    """An aircraft that passes near where the pursuer would be at some time."""
    own, limit = alone.situation.pursuer, alone.situation.min_separation
    while True:
        at = rng.uniform(60.0, alone.time_to_converge + 60.0)
        there = alone.trajectory.pose_at(at)
        tas, heading = rng.uniform(170.0, 250.0), rng.uniform(0.0, 2.0 * pi)
        other = Traffic(
            ident=ident,
            x=0.0,
            y=0.0,
            heading=heading,
            tas=tas,
            min_separation=limit,
            intent=_draw_intent(rng, heading),
        )
        flown = other.trajectory.pose_at(at)
        x = there.x + rng.normal(0.0, PASSES) - flown.x
        y = there.y + rng.normal(0.0, PASSES) - flown.y
        if hypot(x - own.x, y - own.y) > limit + BEGINS:
            return replace(other, x=x, y=y)


def _draw_intent(rng: np.random.Generator, heading: float) -> tuple[IntentPiece, ...]:
    """Straight on, or one turn to come."""
    if rng.random() < 0.5:
        return ()
    turn = LEFT if rng.random() < 0.5 else RIGHT
    turned = rng.uniform(20.0, 120.0) * DEG
    return (
        FlyStraight(duration=rng.uniform(30.0, 600.0)),
        TurnTo(heading=(heading - turn * turned) % (2.0 * pi), turn=turn, bank=20.0 * DEG),
    )


def break_words(world: World, share: float, rng: np.random.Generator) -> World:
    """The same world, where a share of the others flies something that it has not declared."""
    aircraft = list(world.aircraft)
    for k in range(2, len(aircraft)):
        one = aircraft[k]
        if rng.random() < share and isinstance(one.pilot, Declared):
            flown = _draw_intent(rng, one.heading) or (
                FlyStraight(duration=rng.uniform(30.0, 300.0)),
                TurnTo(heading=(one.heading + 1.0) % (2.0 * pi), turn=RIGHT, bank=25.0 * DEG),
            )
            declares = one.pilot.intent
            aircraft[k] = replace(one, pilot=Declared(intent=flown, declares=declares))
    return replace(world, aircraft=tuple(aircraft))


def fly_one(number: int, scenario: Scenario, broken: float) -> Flown:
    """Fly it to its end."""
    started = thread_time()
    world = break_words(world_of(scenario), broken, np.random.default_rng([number, 1]))
    replans = alerts = unables = 0
    for document in simulate(
        world, plan, until=scenario.duration_limit, sample_period=1.0, seed=number
    ):
        match document:
            case PlanChanged(reason="traffic"):
                replans += 1
            case Alert(cleared=False, subject="separation"):
                alerts += 1
            case Unable():
                unables += 1
            case FlightEnded(results=(result,)):
                return Flown(
                    number=number,
                    result=result,
                    replans=replans,
                    alerts=alerts,
                    unables=unables,
                    cpu=thread_time() - started,
                )
            case _:
                pass
    raise AssertionError("A flight ends with its end.")


def main(arguments: Sequence[str] | None = None) -> int:
    """Fly, and print what came of it."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.flown_amid", description=__doc__)
    parser.add_argument("--flights", type=positive, default=100)
    parser.add_argument("--others", type=positive, default=5, help="other aircraft in each")
    parser.add_argument("--broken", type=float, default=0.0, help="share of others who break it")
    parser.add_argument("--surveillance", choices=("exact", "adsb"), default="exact")
    parser.add_argument("--seed", type=int, default=0)
    asked = parser.parse_args(arguments)
    flown: list[Flown] = []
    drawn = draw_scenarios(asked.seed, asked.others, asked.surveillance)
    aside, out = Console(stderr=True, soft_wrap=True), Console(soft_wrap=True)
    for number, scenario in islice(drawn, asked.flights):
        one = fly_one(number, scenario, asked.broken)
        flown.append(one)
        if one.result.losses or not one.result.joined:
            aside.print(_line(one), highlight=False)
    out.print(_report(flown, asked.broken), highlight=False, markup=False)
    return 0


def _line(one: Flown) -> str:
    state = "joined" if one.result.joined else "not joined"
    losses = " ".join(map(_loss, one.result.losses))
    return f"{one.number}: {state} at {one.result.join_time:.0f} s, {one.alerts} alerts. {losses}"


def _loss(loss: Loss) -> str:
    known = "not announced"
    if loss.announced:
        known = f"announced {loss.t - loss.announced[0]:.0f} s before"
    whom = loss.other or "the leader"
    return f"{loss.separation:.0f} m from {whom} at {loss.t:.0f} s, {known}: {loss.cause}"


def _report(flown: Sequence[Flown], broken: float) -> str:
    losses = [loss for one in flown for loss in one.result.losses]
    unannounced = [loss for loss in losses if not loss.announced]
    margins = sorted(
        (round(least.separation - least.min_separation), one.number)
        for one in flown
        for least in one.result.least_other
    )
    later = [one.result.join_time - one.result.optimum for one in flown if one.result.joined]
    median, most = np.quantile(later, (0.5, 0.95))
    cpu = [one.cpu for one in flown]
    whom = Counter("others" if loss.other else "leader" for loss in losses)
    replans, alerts = sum(one.replans for one in flown), sum(one.alerts for one in flown)
    return "\n".join(
        (
            f"{len(flown)} flights, {broken:.0%} of the others break their word",
            f"joined: {sum(one.result.joined for one in flown)}",
            f"losses: {len(losses)} {dict(whom)}, not announced: {len(unannounced)}",
            f"least margins to others, by number of the flight [m]: {margins[:10]}",
            f"later than the optimum alone [s]: median {median:.0f}, 95 % {most:.0f}, "
            f"worst {max(later):.0f}",
            f"plans because of others: {replans}, alerts on others: {alerts}, "
            f"unable: {sum(one.unables for one in flown)}",
            f"CPU of a flight [s]: median {np.median(cpu):.2f}, worst {max(cpu):.1f}",
        )
    )


if __name__ == "__main__":
    sys.exit(main())
