"""The short way to the fastest extremal finds what the long one does."""

from math import pi

import pytest
from hypothesis import given

from relguide import FlyStraight, Leader, Plan, Pursuer, Situation, candidates, certify, plan
from relguide.planning.outcome import AS_FAST
from relguide.planning.straight_ahead import first_candidate
from relguide.planning.words import HORIZON
from relguide.units import DEG
from tests.situations import situations

ROUNDING = 1e-9
"""Of a time, as part of it: the two ways add up in another order."""


@given(situations(with_intent=False, speed_ratio=(0.5, 1.1)))
def test_it_is_the_first_of_all_candidates(situation: Situation) -> None:
    found = candidates(situation)
    first = first_candidate(situation, situation.pursuer.turn_radius)
    assert (first is None) == (len(found) == 0 or found.bound > HORIZON)
    if first is not None:
        fastest, time = next(iter(found)), first[1]
        assert first[0].time_to_converge == pytest.approx(fastest.time_to_converge, rel=ROUNDING)
        assert time == pytest.approx(found.bound, rel=ROUNDING)


@given(situations(with_intent=False))
def test_it_is_the_plan_where_it_keeps_the_limit(situation: Situation) -> None:
    first = first_candidate(situation, situation.pursuer.turn_radius)
    assert first is not None
    planned = plan(situation)
    if certify(first[0].trajectory, situation).holds:
        assert isinstance(planned, Plan)
        assert planned.trajectory == first[0].trajectory
        assert planned.optimality.proof == "relaxation"
        assert planned.optimality.lower_bound == first[1]
    elif isinstance(planned, Plan):
        assert planned.time_to_converge >= first[1] - AS_FAST


def behind(*, leader_tas: float, heading: float = 0.0, straight: bool = False) -> Situation:
    return Situation(
        pursuer=Pursuer(x=0.0, y=-60e3, heading=heading, tas=200.0, max_bank=25 * DEG),
        leader=Leader(
            x=0.0,
            y=0.0,
            heading=heading,
            tas=leader_tas,
            intent=(FlyStraight(duration=60.0),) if straight else (),
        ),
        slot_distance=12e3,
        min_separation=9e3,
    )


def test_an_intent_is_for_others() -> None:
    situation = behind(leader_tas=180.0, straight=True)
    assert first_candidate(situation, situation.pursuer.turn_radius) is None


@pytest.mark.parametrize("leader_tas", [200.0, 210.0, 199.5])
def test_what_is_never_reached_or_too_late_is_for_others(leader_tas: float) -> None:
    situation = behind(leader_tas=leader_tas)
    assert first_candidate(situation, situation.pursuer.turn_radius) is None


@pytest.mark.parametrize("turns", [-2, -1, 1, 2])
def test_headings_past_a_whole_turn_are_the_same(turns: int) -> None:
    usual, wound = behind(leader_tas=180.0), behind(leader_tas=180.0, heading=turns * 2.0 * pi)
    radius = usual.pursuer.turn_radius
    first, second = first_candidate(usual, radius), first_candidate(wound, radius)
    assert first is not None
    assert second is not None
    assert second[1] == pytest.approx(first[1], rel=ROUNDING)
