"""The paper's own form, entered, judged and told."""

import json
from math import pi
from typing import Any

import pytest
from hypothesis import given, settings

from relguide.contract.refusal import ContractError
from relguide.contract.triplets import MAX_TRIPLETS, regular_from_json
from relguide.contract.wire import to_wire
from relguide.flying.regular_card import regular_check
from relguide.flying.verdicts import NotChecked, OptimalityCheck
from relguide.planning.regular import RegularTrajectory, Triplet, regular_from_trajectory
from relguide.planning.trajectory import LEFT, RIGHT
from tests.plans import find_plan, golden_plan, plan_unlimited, straight_behind
from tests.situations import situations

PAIR = {"epsilon": -1, "theta_deg": 90.0, "l_m": 1000}


def test_triplets_are_read_in_the_papers_order() -> None:
    read = regular_from_json(json.dumps({"triplets": [PAIR, {**PAIR, "epsilon": 1, "l_m": 0}]}))
    assert read.triplets == (
        Triplet(turn=RIGHT, turn_angle=0.5 * pi, length=1000.0),
        Triplet(turn=LEFT, turn_angle=0.5 * pi, length=0.0),
    )
    assert regular_from_json({"triplets": []}).order == 1


@pytest.mark.parametrize(
    ("body", "path", "sentence"),
    [
        ({}, "triplets", "is missing: it must be a list."),
        ({"triplets": [{**PAIR, "epsilon": 0}]}, "triplets[0].epsilon", "must be 1 (left)"),
        ({"triplets": [{**PAIR, "epsilon": True}]}, "triplets[0].epsilon", "must be a whole"),
        ({"triplets": [{**PAIR, "theta_deg": -1}]}, "triplets[0].theta_deg", "must be at least 0"),
        ({"triplets": [{**PAIR, "l_m": 1e8}]}, "triplets[0].l_m", "must be at most"),
        ({"triplets": [{**PAIR, "l_km": 1}]}, "triplets[0].l_km", "is not a field"),
        ({"triplets": [PAIR] * (MAX_TRIPLETS + 1)}, "triplets", "must have at most 100"),
    ],
)
def test_each_defect_is_named(body: dict[str, Any], path: str, sentence: str) -> None:
    with pytest.raises(ContractError) as caught:
        regular_from_json(body)
    assert caught.value.problems[0][0] == path
    assert caught.value.problems[0][1].startswith(sentence)


@given(situation=situations(with_intent=False))
@settings(max_examples=30)
def test_a_plan_entered_as_triplets_passes(situation: Any) -> None:
    """There and back through JSON, in wind too."""
    answer = plan_unlimited(situation)
    regular = regular_from_trajectory(answer.trajectory, turn_radius=situation.pursuer.turn_radius)
    first = to_wire(regular_check(regular, situation))
    again = regular_from_json({"triplets": first["triplets"]})
    found = regular_check(again, situation)
    assert found.passed
    assert found.duration == pytest.approx(answer.time_to_converge, rel=1e-9)
    assert (found.nodes[-1].t, found.nodes[-1].x) == (0.0, situation.pursuer.x)
    assert found.nodes[0].t == found.duration
    ends = [found.segments[0].start, *(segment.end for segment in found.segments)]
    for node in found.nodes:  # over the ground, as the segments are
        off = min(abs(node.x - e.x) + abs(node.y - e.y) + abs(node.t - e.t) for e in ends)
        assert off < 1e-3


def test_triplets_rounded_by_hand_still_reach_the_slot_and_tell_by_how_much_they_miss() -> None:
    answer = golden_plan("R001")
    situation = answer.situation
    regular = regular_from_trajectory(answer.trajectory, turn_radius=situation.pursuer.turn_radius)
    body = to_wire(regular_check(regular, situation))["triplets"]
    rounded = [
        {"epsilon": t["epsilon"], "theta_deg": round(t["theta_deg"], 2), "l_m": round(t["l_m"])}
        for t in body
    ]
    found = regular_check(regular_from_json({"triplets": rounded}), situation)
    assert found.reaches_slot
    assert 0.5 < abs(found.final_error.left) < 50.0
    assert isinstance(found.stationarity, OptimalityCheck)
    assert found.stationarity.hamiltonian_residual < 1e-2


def test_what_misses_the_slot_is_refused() -> None:
    found = regular_check(
        RegularTrajectory(triplets=(Triplet(turn=LEFT, turn_angle=0.0, length=1e4),)),
        straight_behind(),
    )
    assert (found.passed, found.reaches_slot, found.keeps_separation) == (False, False, True)
    assert isinstance(found.stationarity, NotChecked)
    assert to_wire(found)["stationarity"] == {"not_checked": "It does not reach the slot."}


def test_a_full_circle_more_reaches_the_slot_and_so_does_order_1() -> None:
    """What is not the fastest may meet every condition."""
    situation = straight_behind()
    radius = situation.pursuer.turn_radius
    time = (31_000.0 + 2.0 * pi * radius) / 40.0
    onward = time * 220.0 - 2.0 * pi * radius
    circle = Triplet(turn=LEFT, turn_angle=2.0 * pi, length=onward)
    found = regular_check(RegularTrajectory(triplets=(circle,)), situation)
    assert found.passed
    assert found.duration > find_plan(situation).time_to_converge
