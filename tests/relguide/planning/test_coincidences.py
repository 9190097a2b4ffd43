"""Numbers that are equal to the last digit: D = d_min above all. Laws that need no oracle."""

from dataclasses import replace
from math import hypot, inf

import numpy as np
import pytest
from hypothesis import given

from relguide import NoPlan, Plan, Situation, plan
from relguide.kernels.separation.clearance import SLACK
from relguide.planning.batch import Situations, plan_arrays
from tests.bench import draws
from tests.oracle import arrival_error
from tests.situations import coincidences

MILLIMETRE = 1e-3
ALIKE = 0.01
"""What a millimetre may cost, where it makes no other path best [s]."""


def arrival_time(situation: Situation) -> float:
    answer = plan(situation)
    return answer.time_to_converge if isinstance(answer, Plan) else inf


@pytest.mark.parametrize("tight", [True, False], ids=["R < d_min", "R > d_min"])
def test_a_slot_at_the_limit_is_reached_as_soon_as_one_a_millimetre_behind(tight: bool) -> None:
    rng = np.random.default_rng(12)
    for _ in range(20):
        situation = draws.active(rng, tight=tight, slot_at_limit=True)
        assert situation.slot_distance == situation.min_separation
        farther = replace(situation, slot_distance=situation.slot_distance + MILLIMETRE)
        assert arrival_time(situation) <= arrival_time(farther) + ALIKE


@given(coincidences(kinds=("slot at the limit",), with_wind=True))
def test_so_it_is_in_wind(situation: Situation) -> None:
    farther = replace(situation, slot_distance=situation.slot_distance + MILLIMETRE)
    assert arrival_time(situation) <= arrival_time(farther) + ALIKE


@given(coincidences(with_intent=True, with_wind=True))
def test_every_plan_arrives_and_keeps_its_distance(situation: Situation) -> None:
    answer = plan(situation)
    if isinstance(answer, NoPlan):
        return
    assert answer.certificate.holds
    assert answer.arrival.holds
    assert answer.optimality.lower_bound <= answer.time_to_converge + 1e-6
    if answer.time_to_converge > 0.0:
        distance, heading_error, least = arrival_error(situation, answer.trajectory)
        assert distance < 0.02
        assert heading_error < 1e-6
        assert least > situation.min_separation - 0.5  # interpolated between samples


@given(coincidences())
def test_a_row_of_a_batch_says_the_same(situation: Situation) -> None:
    pursuer, leader = situation.pursuer, situation.leader
    columns = Situations(
        pursuer_x=np.array([pursuer.x]),
        pursuer_y=pursuer.y,
        pursuer_heading=pursuer.heading,
        pursuer_tas=pursuer.tas,
        max_bank=pursuer.max_bank,
        leader_heading=leader.heading,
        leader_tas=leader.tas,
        slot_distance=situation.slot_distance,
        min_separation=situation.min_separation,
    )
    row = plan_arrays(columns)
    assert row.time_to_converge[0] == pytest.approx(arrival_time(situation), abs=1e-3)


def at_contact(plan: Plan) -> Situation:
    """The situation when the plan is nearest to the leader."""
    situation, t = plan.situation, plan.certificate.at_time
    ours, theirs = plan.trajectory.pose_at(t), situation.leader.trajectory.pose_at(t)
    return replace(
        situation,
        pursuer=replace(situation.pursuer, x=ours.x, y=ours.y, heading=ours.heading),
        leader=replace(situation.leader, x=theirs.x, y=theirs.y, heading=theirs.heading),
    )


def test_what_is_left_of_a_plan_is_found_again_from_its_contact() -> None:
    rng = np.random.default_rng(5)
    seen = 0
    while seen < 12:
        answer = plan(draws.active(rng, tight=seen % 2 == 0))
        if not isinstance(answer, Plan) or answer.optimality.proof != "bound":
            continue
        left = answer.time_to_converge - answer.certificate.at_time
        if left < 1.0:
            continue
        seen += 1
        met = at_contact(answer)
        away = hypot(met.pursuer.x - met.leader.x, met.pursuer.y - met.leader.y)
        # there the start lies on d_min to the last digit, or inside by what still counts as kept
        for inside in (0.0, 0.5 * SLACK * met.pursuer.turn_radius):
            limit = away + inside
            met = replace(met, min_separation=limit, slot_distance=max(met.slot_distance, limit))
            assert arrival_time(met) <= left + ALIKE
