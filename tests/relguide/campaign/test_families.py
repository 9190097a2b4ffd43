"""Flights that can be drawn again, from their family, their number and the seed alone."""

from math import hypot

import pytest

import relguide
from relguide.campaign import recordings
from relguide.campaign.families import FAMILIES, draw
from relguide.campaign.starts import REACH

DRAWN = [family for family in FAMILIES if family != "recorded"]


@pytest.mark.parametrize("family", DRAWN)
@pytest.mark.parametrize("number", [0, 1, 2])
def test_a_flight_is_drawn_from_its_name_alone(family: str, number: int) -> None:
    case = draw(family, number)
    assert case == draw(family, number)
    assert case.scenario.situation != draw(family, number + 3).scenario.situation
    times = [t for t, _ in case.orders]
    assert times == sorted(times)
    situation = case.scenario.situation
    away = hypot(situation.pursuer.x, situation.pursuer.y)
    assert situation.min_separation <= away <= REACH
    words = {name: getattr(relguide, name) for name in relguide.__all__}
    # what is printed makes the same situation again
    (printed,) = (line for line in case.as_code().splitlines() if line.startswith("situation"))
    assert eval(printed.removeprefix("situation = "), words) == situation


@pytest.mark.slow
def test_all_recorded_flights_of_the_collection_lead() -> None:
    assert recordings.count() == 235
    assert draw("recorded", 1).scenario.leader_source is recordings.track(1)
    assert recordings.track(235) is recordings.track(0)
    assert all(draw("recorded", number).scenario.leader_source for number in range(235))


def test_a_seed_draws_other_flights_and_none_is_that_of_the_page() -> None:
    assert draw("declared", 3, seed=0) == draw("declared", 3)
    assert draw("declared", 3, seed=7) == draw("declared", 3, seed=7)
    assert draw("declared", 3, seed=7) != draw("declared", 3)
    # the flight that docs/flight.md counts as declared 3: a change of the draws is another campaign
    situation = draw("declared", 3).scenario.situation
    assert situation.pursuer.tas == pytest.approx(202.34320267057598, rel=1e-12)
