"""What a flight is asked for with, and what it can be told."""

from typing import Any, get_args

import pytest
from pydantic import TypeAdapter

from relguide.contract.commands import Command
from relguide.contract.messages import FlightRequest, ScenarioFlightRequest, SituationFlightRequest
from tests.bodies import BODY


def test_a_flight_is_asked_for_by_scenario_or_situation() -> None:
    read = TypeAdapter(FlightRequest).validate_python
    asked = read({"scenario": "fig_6b", "rate": 10})
    assert isinstance(asked, ScenarioFlightRequest)
    assert (asked.rate, asked.paused, asked.intent_known, asked.seed) == (10.0, False, None, 0)
    assert isinstance(read({"situation": BODY, "paused": True}), SituationFlightRequest)
    for bad in ({}, {"scenario": "a", "situation": BODY}, {"scenario": "a", "rate": 61}):
        with pytest.raises(ValueError, match="validation error"):
            read(bad)


@pytest.mark.parametrize(
    "command",
    [
        {"command": "play"},
        {"command": "pause"},
        {"command": "set_rate", "rate": 60},
        {"command": "leader_heading", "heading_deg": 135},
        {"command": "leader_heading", "heading_deg": 135, "direction": "left"},
        {"command": "leader_speed", "tas_mps": 200},
        {"command": "intent_known", "known": True},
        {"command": "pursuer_bank", "bank_deg": 20},
        {"command": "pursuer_speed", "tas_mps": 230},
        {"command": "pursuer_speed", "tas_mps": None},
        {"command": "set_spacing", "slot_distance_m": 12000},
        {"command": "set_spacing", "slot_distance_m": 12000, "min_separation_m": 5556},
        {"command": "set_autopilot", "on": False},
        {"command": "set_director", "on": True, "ident": "P"},
        {"command": "stick", "roll": -1},
        {"command": "stick", "roll": 0.5, "pitch": 0.25},
    ],
)
def test_commands_are_read(command: dict[str, Any]) -> None:
    read = TypeAdapter(Command).validate_python
    assert read(command).model_dump(exclude_unset=True) == command
    with pytest.raises(ValueError, match="validation error"):
        read({**command, "extra": 1})


def test_every_command_has_its_name() -> None:
    models = get_args(get_args(Command)[0])
    assert len({get_args(m.model_fields["command"].annotation)[0] for m in models}) == 17
