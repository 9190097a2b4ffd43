"""The planner against situations solved by others, or by itself with more effort.

See tests/golden/README.md: 294 by an independent program, 43 of exact coincidences.
"""

import json
from typing import Any

import pytest

from relguide import NoPlan, Plan, Situation, plan
from tests.oracle import arrival_error
from tests.situations import GOLDEN, golden

BEATEN = ("RW012", "RW018", "RW039")
"""Answers that are not optimal: a path that waits for the slot to open is faster (README there)."""


def cases(name: str, *statuses: str) -> list[Any]:
    lines = (GOLDEN / f"{name}.answers.jsonl").read_text().splitlines()
    return [
        pytest.param(name, i, id=answer["id"])
        for i, answer in enumerate(map(json.loads, lines))
        if answer["status"] in statuses
    ]


def fly_plan(situation: Situation) -> Plan:
    answer = plan(situation)
    assert isinstance(answer, Plan), answer
    return answer


@pytest.mark.parametrize(("name", "i"), cases("reference", "optimal") + cases("wind", "optimal"))
def test_a_proven_time_is_met_and_proved(name: str, i: int) -> None:
    situation, expected = golden(name)[i]
    answer = fly_plan(situation)
    if expected["id"] in BEATEN:
        assert answer.time_to_converge < expected["time_to_converge_s"] - 1.0
    else:
        assert answer.time_to_converge == pytest.approx(
            expected["time_to_converge_s"], abs=expected["tolerance_s"]
        )
    assert answer.certificate.holds
    # of RW021, reachable before the slot opens, it is proved that no path has that exact length
    assert answer.optimality.proof == "relaxation"


@pytest.mark.parametrize(
    ("name", "i"),
    [p for p in cases("reference", "optimal") if p.values[1] % 6 == 0]
    + [p for p in cases("wind", "optimal") if p.values[1] % 6 == 0 or p.id in BEATEN],
)
def test_a_plan_flown_by_scipy_arrives_at_the_slot(name: str, i: int) -> None:
    situation, _ = golden(name)[i]
    answer = fly_plan(situation)
    distance, heading_error, least = arrival_error(situation, answer.trajectory)
    assert distance < 0.02  # the golden plans themselves end within 2 cm
    assert heading_error < 1e-6
    # 1 m: separation is interpolated between samples a second apart
    assert answer.certificate.lower_bound - 1.0 < least < answer.certificate.least_separation + 30.0


@pytest.mark.parametrize(("name", "i"), cases("reference", "best_known"))
def test_with_the_limit_active_the_best_known_time_is_met_or_beaten(name: str, i: int) -> None:
    situation, expected = golden(name)[i]
    answer = fly_plan(situation)
    assert answer.certificate.holds
    assert answer.time_to_converge <= expected["time_to_converge_s"] + 0.05
    assert answer.optimality.proof == "bound"
    assert answer.optimality.lower_bound == pytest.approx(expected["unlimited_time_s"], abs=1e-4)
    assert answer.time_to_converge >= answer.optimality.lower_bound


@pytest.mark.parametrize(
    ("name", "i"), cases("coincidence", "optimal") + cases("coincidence", "best_known")
)
def test_numbers_that_are_equal_to_the_last_digit_cost_nothing(name: str, i: int) -> None:
    situation, expected = golden(name)[i]
    answer = fly_plan(situation)
    assert answer.certificate.holds
    assert answer.arrival.holds
    proved = expected["status"] == "optimal"
    assert answer.optimality.proof == ("relaxation" if proved else "bound")
    assert answer.optimality.lower_bound == pytest.approx(expected["unlimited_time_s"], abs=1e-4)
    # no other word, nor more effort, is sooner; less than the tolerance may be gained
    assert answer.time_to_converge == pytest.approx(
        expected["time_to_converge_s"], abs=expected["tolerance_s"]
    )


@pytest.mark.parametrize(
    ("name", "i"), [p for p in cases("reference", "best_known") if p.values[1] % 3 == 0]
)
def test_a_constrained_path_flown_by_scipy_arrives_and_keeps_its_distance(
    name: str, i: int
) -> None:
    situation, _ = golden(name)[i]
    answer = fly_plan(situation)
    distance, heading_error, least = arrival_error(situation, answer.trajectory)
    assert distance < 0.02
    assert heading_error < 1e-6
    assert least > situation.min_separation - 1.0  # 1 m: interpolated a second apart


@pytest.mark.parametrize(("name", "i"), cases("reference", "infeasible", "infeasible_separation"))
def test_what_cannot_be_flown_is_refused_with_the_right_reason(name: str, i: int) -> None:
    situation, expected = golden(name)[i]
    answer = plan(situation)
    assert isinstance(answer, NoPlan)
    if expected["status"] == "infeasible_separation":
        assert answer.reason == "separation_unavoidable"
    elif expected["method"] == "d0 < d_min":
        assert answer.reason == "separation_already_lost"
    else:
        assert answer.reason == "slot_unreachable"
