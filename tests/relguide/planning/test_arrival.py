"""Where and when a trajectory ends, seen from the slot: eq. (7)."""

from dataclasses import replace

import pytest
from hypothesis import assume, given

from relguide import RIGHT, FlyStraight, Plan, Situation, Straight, TurnTo, plan
from relguide.planning.arrival import MAX_SLOT_ERROR, arrival
from relguide.units import DEG
from tests.plans import find_plan, fly_planned, straight_behind
from tests.situations import situations

BEHIND = straight_behind()


@given(situation=situations())
def test_exact_plans_arrive_to_the_last_digit(situation: Situation) -> None:
    answer = plan(situation)
    assume(isinstance(answer, Plan))
    assert isinstance(answer, Plan)
    assert answer.arrival.holds
    assert answer.arrival.slot_error < 1e-3
    assert answer.arrival.heading_error < 1e-6
    assert answer.arrival.early < 1e-6


@pytest.mark.parametrize("extra", [-99.0, 99.0, -101.0, 101.0])
def test_the_end_may_be_a_hundred_metres_off(extra: float) -> None:
    """Behind a leader on the same heading a longer path ends as much nearer as both then differ."""
    length = find_plan(BEHIND).trajectory.length + extra / (1.0 - 180.0 / 220.0)
    found = arrival(fly_planned(BEHIND, Straight(length=length)), BEHIND)
    assert found.slot_error == pytest.approx(abs(extra))
    assert found.holds == (abs(extra) < MAX_SLOT_ERROR)
    assert (found.heading_error, found.early) == (0.0, 0.0)


@pytest.mark.parametrize("off", [-0.6, -0.4, 0.4, 0.6])
def test_the_heading_may_be_half_a_degree_off(off: float) -> None:
    askew = replace(BEHIND, pursuer=replace(BEHIND.pursuer, heading=off * DEG))
    found = arrival(fly_planned(askew, Straight(length=1_000.0)), askew)
    assert found.heading_error == pytest.approx(abs(off) * DEG)
    assert replace(found, slot_error=0.0).holds == (abs(off) < 0.5)


@pytest.mark.parametrize(("waits", "holds"), [(0.0, True), (0.4, True), (0.6, False)])
def test_the_slot_must_be_open(waits: float, holds: bool) -> None:
    """The leader's turn, of a degree, ends later and later: the slot opens D behind it then."""
    slow = find_plan(BEHIND).time_to_converge
    release = BEHIND.slot_distance / BEHIND.leader.tas
    turn = TurnTo(heading=1e-4, turn=RIGHT, bank=20.0 * DEG)
    until = slow - release - replace(BEHIND.leader, intent=(turn,)).trajectory.duration + waits
    turning = replace(
        BEHIND,
        leader=replace(BEHIND.leader, intent=(FlyStraight(duration=until), turn)),
    )
    found = arrival(find_plan(BEHIND).trajectory, turning)
    assert found.slot_error < MAX_SLOT_ERROR
    assert found.early == pytest.approx(waits, abs=1e-6)
    assert found.holds == holds
