"""Whoever made a plan, what must not be flown is not: it is said, counted, and replaced."""

from dataclasses import replace

import pytest

from relguide.flying.documents import PlanChanged, PlanRefused
from relguide.flying.flight import Scenario
from relguide.flying.scenarios import own_scenario
from relguide.planning.acceptance import Fault
from relguide.planning.outcome import NoPlan, Optimality, Plan
from relguide.planning.plan import plan
from relguide.planning.situation import Situation
from tests.flights import Flown, fly_whole
from tests.liars import LIARS, LIED_ABOUT, Liar, comes_too_early, ends_beside

SHORT: Scenario = replace(own_scenario(LIED_ABOUT), duration_limit=20.0)


@pytest.fixture(scope="module")
def honest() -> Flown:
    return fly_whole(SHORT)


def faults_of(liar: Liar) -> list[Fault]:
    """What is said of it, once each: on the way a path that was early is no longer, but as near to
    the leader as before.
    """
    return [LIARS[liar], *(["separation"] if liar is comes_too_early else [])]  # type: ignore[list-item]


@pytest.mark.parametrize("liar", LIARS, ids=lambda liar: liar.__name__)
def test_a_lie_is_said_counted_and_not_flown(liar: Liar, honest: Flown) -> None:
    asked = list[Situation]()

    def planner(situation: Situation) -> Plan | NoPlan:
        asked.append(situation)
        return liar(situation)

    flight = fly_whole(SHORT, planner=planner)
    assert flight.samples == honest.samples
    # once before the flight, for its name; then at engagement, and every 10 s for a faster path
    assert flight.result.fallbacks == len(asked) - 1 == 3
    refused = flight.of(PlanRefused)
    assert refused[0].t == 0.0
    assert [document.fault for document in refused] == faults_of(liar)
    (first,) = flight.of(PlanChanged)
    (true,) = honest.of(PlanChanged)
    assert (first.plan.planner, first.plan.word) == ("exact", true.plan.word)


@pytest.mark.parametrize("liar", LIARS, ids=lambda liar: liar.__name__)
def test_a_lie_told_on_the_way_is_not_flown_either(liar: Liar) -> None:
    """While a faster path is not excluded it is asked each second, and lies from the sixth on."""
    asked = iter(range(1_000_000))

    def planner(situation: Situation) -> Plan | NoPlan:
        return liar(situation) if next(asked) > 6 else plan_unproved(situation)

    flight = fly_whole(SHORT, planner=planner)
    honest = fly_whole(SHORT, planner=plan_unproved)
    assert flight.samples == honest.samples
    assert [d.t for d in flight.of(PlanChanged)] == [0.0]
    refused = flight.of(PlanRefused)
    assert refused[0].t == 6.0
    assert [document.fault for document in refused] == faults_of(liar)
    assert flight.result.fallbacks == 15


def plan_unproved(situation: Situation) -> Plan | NoPlan:
    """The fastest path, of which its planner cannot say so."""
    answer = plan(situation)
    if isinstance(answer, NoPlan):
        return answer
    return replace(answer, planner="modest", optimality=Optimality(proof="none", lower_bound=0.0))


def test_a_lie_repeated_for_a_while_is_said_again() -> None:
    asked = iter(range(1_000_000))

    def sometimes(situation: Situation) -> Plan | NoPlan:
        return ends_beside(situation) if next(asked) // 5 % 2 else plan_unproved(situation)

    flight = fly_whole(SHORT, planner=sometimes)
    assert len(flight.of(PlanRefused)) == 2
    assert flight.result.fallbacks == 10
