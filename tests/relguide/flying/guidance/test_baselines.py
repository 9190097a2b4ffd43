"""Guidance without a plan: it joins where that is easy, banks as it may, and asks no planner."""

from dataclasses import replace
from math import cos, sin

import pytest

from relguide.flying.documents import (
    FlightStarted,
    ForecastChanged,
    ModeChanged,
    PlanChanged,
    PlanUnavailable,
    SeparationLost,
)
from relguide.flying.flight import Command, LeaderData, LeaderHeading, Scenario, fly, world_of
from relguide.flying.guidances import GUIDANCES, Guidance
from relguide.flying.scenarios import fig_6, own_scenario
from relguide.planning.aircraft import Leader, Pursuer
from relguide.planning.outcome import NoPlan, Plan
from relguide.planning.situation import Situation
from relguide.planning.wind import wind_from
from relguide.units import DEG, NM
from tests.flights import Flown, saying

BASELINES = [name for name in GUIDANCES if name != "relguide"]
HALF_A_DEGREE = 0.5 * DEG
"""By so much the roll loop overshoots."""


def never(situation: Situation) -> Plan | NoPlan:
    raise AssertionError(f"no baseline plans {situation}")


def behind(*, back: float, left: float, heading: float = 0.0, wind: float = 0.0) -> Scenario:
    """Behind a leader that flies straight on to the north-east."""
    course = 45.0 * DEG
    situation = Situation(
        pursuer=Pursuer(
            x=-back * sin(course) - left * cos(course),
            y=-back * cos(course) + left * sin(course),
            heading=course + heading,
            tas=235.0,
            max_bank=25.0 * DEG,
        ),
        leader=Leader(x=0.0, y=0.0, heading=course, tas=200.0),
        slot_distance=10_000.0,
        min_separation=5.0 * NM,
        wind=wind_from(300.0 * DEG, wind),
    )
    return own_scenario(situation, intent_known=False)


def flown(scenario: Scenario, guidance: Guidance, *said: tuple[float, Command]) -> Flown:
    documents = fly(scenario, never, sample_period=1.0, guidance=guidance, commands=saying(*said))
    return Flown(tuple(documents))


@pytest.mark.parametrize("guidance", BASELINES)
@pytest.mark.parametrize("wind", [0.0, 40.0])
def test_it_joins_a_leader_that_flies_straight(guidance: Guidance, wind: float) -> None:
    flight = flown(behind(back=20_000.0, left=4_000.0, wind=wind), guidance)
    assert flight.result.joined
    # 10 km at 35 m/s, some of it lost in the first turn and in braking
    assert 250.0 < flight.result.join_time < 500.0
    assert flight.result.along_error < 0.2 * NM
    assert flight.result.across_error < 0.1 * NM
    assert not flight.of(SeparationLost)


@pytest.mark.parametrize("guidance", BASELINES)
def test_it_banks_no_more_than_it_may(guidance: Guidance) -> None:
    scenario = behind(back=25_000.0, left=15_000.0, heading=150.0 * DEG)
    flight = flown(scenario, guidance)
    assert flight.result.joined
    most = max(abs(sample.pursuer.bank) for sample in flight.samples)
    limit = world_of(scenario).aircraft[0].autopilot_bank
    assert 10.0 * DEG < most <= limit + HALF_A_DEGREE


@pytest.mark.parametrize("guidance", BASELINES)
def test_it_follows_a_leader_that_turns(guidance: Guidance) -> None:
    scenario = replace(behind(back=14_000.0, left=1_000.0), after_joining=900.0)
    turn = LeaderHeading(heading=135.0 * DEG, direction="right")
    flight = flown(scenario, guidance, (600.0, turn))
    assert flight.result.joined
    assert flight.samples[-1].guidance.joined


@pytest.mark.parametrize("guidance", BASELINES)
def test_it_neither_plans_nor_looks_ahead(guidance: Guidance) -> None:
    flight = flown(fig_6(intent_known=False), guidance)
    (started,) = flight.of(FlightStarted)
    assert started.planner == guidance
    assert not flight.of(PlanChanged)
    assert not flight.of(PlanUnavailable)
    assert not flight.of(ForecastChanged)
    modes = [change.mode for change in flight.of(ModeChanged)]
    assert modes == ["converge", "follow"]


def test_a_loss_is_counted_as_in_any_flight() -> None:
    scenario = replace(behind(back=-5_000.0, left=9_400.0), duration_limit=600.0)
    flight = flown(scenario, "slot_pursuit")
    losses = flight.of(SeparationLost)
    assert losses
    assert len(losses) == len(flight.result.losses)
    assert not losses[0].announced
    assert flight.result.least_separation < 5.0 * NM


@pytest.mark.parametrize("guidance", BASELINES)
def test_it_flies_on_once_the_leader_is_no_longer_heard_of(guidance: Guidance) -> None:
    scenario = replace(behind(back=20_000.0, left=4_000.0), duration_limit=120.0)
    flight = flown(scenario, guidance, (60.0, LeaderData(received=False)))
    assert flight.samples[-1].guidance.engagement == "designated"
    assert flight.samples[-1].pursuer.bank == pytest.approx(0.0, abs=HALF_A_DEGREE)


def test_a_name_that_no_guidance_has_is_refused() -> None:
    with pytest.raises(ValueError, match="guidance must be one of relguide, slot_pursuit"):
        list(fly(fig_6(intent_known=False), never, guidance="carrot"))  # type: ignore[arg-type]
