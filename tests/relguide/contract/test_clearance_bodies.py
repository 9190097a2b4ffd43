"""Requests for clearances: what is read, and what is refused with a sentence."""

from typing import Any

import pytest
from pydantic import RootModel

from relguide.contract.clearance_bodies import (
    ClearanceAnswer,
    ClearanceRequest,
    DistanceGoal,
    FlightClearanceRequest,
    IntentClearanceRequest,
    TimeGoal,
    expect_goal,
)
from relguide.contract.refusal import ContractError, parse

INTENT: dict[str, Any] = {
    "aircraft": {
        "ident": "RG 06", "lat_deg": 52.0, "lon_deg": 5.0,
        "heading_deg": 90.0, "tas_mps": 235.0, "max_bank_deg": 25.0,
    },
    "intent": [{"straight_s": 60.0}],
    "traffic_id": "BAW12",
    "assigned_spacing_goal": {"type": "distance", "value_m": 9_260.0},
    "min_separation_m": 9_260.0,
}  # fmt: skip


class AnyRequest(RootModel[ClearanceRequest]):
    pass


def read(body: dict[str, Any]) -> FlightClearanceRequest | IntentClearanceRequest:
    request: FlightClearanceRequest | IntentClearanceRequest = parse(AnyRequest, body).root
    return request


def test_a_flight_needs_its_id_alone() -> None:
    request = read({"flight_id": "3f2a9c0d71be"})
    assert isinstance(request, FlightClearanceRequest)
    assert request.clearance_type == "capture_then_maintain"


def test_a_reason_that_is_none_is_refused_once() -> None:
    with pytest.raises(
        ContractError, match=r"^reason: must be 'separation', .* not the text"
    ) as no:
        parse(ClearanceAnswer, {"answer": "unable", "reason": "late"})
    assert no.value.count == 1


def test_the_goal_names_its_unit_by_its_type() -> None:
    by_distance = read(INTENT)
    assert isinstance(by_distance, IntentClearanceRequest)
    assert by_distance.assigned_spacing_goal == DistanceGoal(type="distance", value_m=9_260.0)
    by_time = read({**INTENT, "assigned_spacing_goal": {"type": "time", "value_s": 90.0}})
    assert isinstance(by_time, IntentClearanceRequest)
    assert by_time.assigned_spacing_goal == TimeGoal(type="time", value_s=90.0)


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        ({"traffic_id": None}, "traffic_id: must be a text"),
        ({"intent": []}, "intent: must have at least 1"),
        ({"assigned_spacing_goal": {"type": "time", "value_m": 1.0}}, "did you mean value_s"),
        ({"assigned_spacing_goal": {"type": "height", "value_m": 1.0}}, "type: must be one of"),
        ({"clearance_type": "maintain"}, "clearance_type: must be 'capture_then_maintain'"),
        ({"aircraft": {**INTENT["aircraft"], "tas_mps": 1.0}}, "aircraft.tas_mps: must lie in"),
        ({"flight_id": "x"}, "is not a field of the contract"),
    ],
)
def test_what_is_wrong_is_named(wrong: dict[str, Any], said: str) -> None:
    with pytest.raises(ContractError, match=said):
        read({**INTENT, **wrong})


def test_nothing_at_all_is_told_what_there_could_be() -> None:
    with pytest.raises(ContractError, match="flight_id, or an aircraft and its intent"):
        read({})


def test_a_goal_below_the_minimum_is_refused() -> None:
    request = read({**INTENT, "min_separation_m": 9_300.0})
    assert isinstance(request, IntentClearanceRequest)
    with pytest.raises(ContractError, match=r"value_m: must be at least min_separation"):
        expect_goal(request)
