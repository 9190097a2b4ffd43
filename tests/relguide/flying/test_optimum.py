"""No flight is faster than the fastest plan from its start, where one is to be known."""

from dataclasses import replace
from math import pi

import pytest

from relguide.flying.flight import Scenario, world_of
from relguide.flying.optimum import optimum
from relguide.flying.scenarios import fig_6, own_scenario
from relguide.flying.world import Recorded, World
from relguide.planning.outcome import Plan
from relguide.planning.plan import plan
from relguide.planning.wind import wind_from
from relguide.units import DEG
from tests.flights import fly_whole, random_start
from tests.recording import recording
from tests.relguide.flying.guidance.beliefs import behind

KNOWN, UNKNOWN = fig_6(intent_known=True), fig_6(intent_known=False)


def of(world: World) -> float:
    (link,) = world.links
    return optimum(world, link)


@pytest.mark.parametrize("scenario", [KNOWN, UNKNOWN], ids=["intent known", "unknown"])
def test_it_knows_all_that_the_leader_is_to_fly(scenario: Scenario) -> None:
    fastest = plan(KNOWN.situation)
    assert isinstance(fastest, Plan)
    assert of(world_of(scenario)) == pytest.approx(fastest.time_to_converge, abs=1e-6)


def test_it_turns_with_the_bank_that_is_asked_for_in_the_wind_that_blows() -> None:
    situation = replace(random_start(3), wind=wind_from(0.7 * pi, 20.0))
    gentle = replace(situation, pursuer=replace(situation.pursuer, max_bank=15.0 * DEG))
    for one in (situation, gentle):
        fastest = plan(one)
        assert isinstance(fastest, Plan)
        assert of(world_of(own_scenario(one))) == pytest.approx(fastest.time_to_converge, abs=1e-6)
    assert of(world_of(own_scenario(gentle))) > of(world_of(own_scenario(situation)))


def test_of_a_recorded_leader_it_is_not_to_be_known() -> None:
    world = world_of(behind(along=40_000.0))
    own, leader = world.aircraft
    recorded = replace(leader, pilot=Recorded(track=recording(200, turns_at=50.0)))
    assert of(replace(world, aircraft=(own, recorded))) == 0.0


def test_there_is_none_where_no_path_leads_to_the_slot() -> None:
    assert of(world_of(behind(along=5_000.0, tas=200.0, leader_tas=195.0))) == 0.0


@pytest.mark.slow
@pytest.mark.parametrize("seed", [1, 4, 5])
def test_a_flight_joins_no_sooner(seed: int) -> None:
    """What it takes to roll and to brake comes on top."""
    flight = fly_whole(own_scenario(random_start(seed)))
    assert flight.result.joined
    assert flight.result.optimum > 0.0
    assert flight.result.join_time > flight.result.optimum
