"""Situations are read as the contract's models read them, plain or not."""

import json
from time import monotonic
from typing import Any

import pytest
from hypothesis import given, settings
from relguide_server.http.errors import Refusal
from relguide_server.planning.tasks import plan_body, read_situation

from relguide.client.bodies import body_of
from relguide.contract.bodies import situation_from_json
from relguide.contract.refusal import ContractError
from relguide.planning.situation import Situation
from tests.bodies import BODY
from tests.situations import situations

LEADER = BODY["leader"]
PLACED: dict[str, Any] = {
    **BODY,
    "pursuer": {k: v for k, v in BODY["pursuer"].items() if k not in ("x_m", "y_m")}
    | {"lat_deg": 50.3, "lon_deg": 8.0},
    "leader": {k: v for k, v in LEADER.items() if k not in ("x_m", "y_m")}
    | {"lat_deg": 50.0, "lon_deg": 8.0},
}
WRONG = (
    {**BODY, "id": "case 1"},
    {**BODY, "slot_distance_m": 1.0},
    {**BODY, "news": 1},
    {**BODY, "wind": {"from_deg": 0.0, "speed_mps": 1e4}},
    {**BODY, "leader": {**LEADER, "tas_mps": "200"}},
    {**BODY, "leader": {**LEADER, "intent": [{"straight_s": True}]}},
    {},
)


@given(situation=situations())
@settings(max_examples=100, deadline=None)
def test_plain_situations_are_read_as_models_read_them(situation: Situation) -> None:
    text = json.dumps(body_of(situation)).encode()
    assert read_situation(text) == situation_from_json(text)


def test_so_are_those_on_the_earth() -> None:
    text = json.dumps(PLACED).encode()
    assert read_situation(text) == situation_from_json(text)


@pytest.mark.parametrize("body", WRONG)
def test_what_is_wrong_is_said_as_models_say_it(body: dict[str, Any]) -> None:
    text = json.dumps(body).encode()
    with pytest.raises(ContractError) as said:
        situation_from_json(text)
    with pytest.raises(Refusal) as refused:
        read_situation(text)
    assert [(e.path, e.message) for e in refused.value.errors] == list(said.value.problems)
    assert refused.value.status_code == 422


@pytest.mark.parametrize("text", [b'{"a": 1, "a": 2}', b"[1, NaN]", b"{", b"\xff"])
def test_what_is_no_json_is_refused(text: bytes) -> None:
    with pytest.raises(Refusal) as refused:
        read_situation(text)
    assert refused.value.status_code == 400


SLOW = {
    "pursuer": {
        "x_m": -396_611.0,
        "y_m": -883_764.0,
        "heading_deg": 0.0,
        "tas_mps": 397.0,
        "max_bank_deg": 60.0,
    },
    "leader": {
        "x_m": 0.0,
        "y_m": 0.0,
        "heading_deg": 90.0,
        "tas_mps": 400.0,
        "intent": [
            {"turn_to_heading_deg": -146.0, "direction": "right", "bank_deg": 7.0},
            {"straight_s": 600.0},
            {"turn_to_heading_deg": 360.0, "direction": "left", "bank_deg": 1.0},
        ],
    },
    "slot_distance_m": 1000.0,
    "min_separation_m": 1000.0,
}
"""The search for a way round takes more than a second, and there is none."""


def test_what_was_not_found_by_its_time_was_cut_short_however_little_it_took() -> None:
    tried = plan_body(json.dumps(SLOW).encode(), "exact", (), monotonic() + 60.0, 0.05)
    assert (tried.reason, tried.cut) == ("deadline", True)
    whole = plan_body(json.dumps(SLOW).encode(), "exact", (), monotonic() + 60.0, 50.0)
    assert (whole.reason, whole.cut) == ("separation_unavoidable", False)
