"""Whatever a public function is given, only a ValueError comes out, with a sentence."""

from typing import Any

import pytest
from hypothesis import given, settings

import relguide
from tests.calls import CALLS
from tests.junk import junk

ANSWERS = {
    "Alert", "Alternative", "Arrival", "Candidate", "Certificate", "Document", "EngagementChanged",
    "FanChanged", "FlightEnded", "FlightStarted", "ForecastChanged", "Isochrones", "LeaderChanged",
    "LeaderRoute", "ModeChanged", "NoPlan", "Optimality", "OptimalityReport", "Picture", "Plan",
    "PlanChanged",
    "PlanProposed", "PlanRefused", "PlanUnavailable", "Planner", "Pose", "PromiseChanged", "Reason",
    "Sample", "Samples", "SeparationLost", "TimeRow", "Times", "Unable",
}  # fmt: skip
"""What calls give back, and is not asked for."""
UNIONS = {"Command"}
"""What is one of several that are called."""
PARTS = {"Arc", "BoundaryArc", "DeclaredLeader", "Guided", "RecordedTrack", "Straight"}
"""What a `Trajectory` or a `Scenario` checks as it is made of them."""
FILES = {
    "Flight", "load_airframe", "load_grib", "load_profile", "load_settings", "load_track",
    "picture", "replay",
}  # fmt: skip
"""What reads a file or a flight's documents: tests of its own say what it refuses."""
METHODS = {"from_trajectory", "over_ground", "pose_at", "sample"}
ARGUMENTS = [(name, argument) for name, (_, given) in CALLS.items() for argument in given]


def test_all_that_can_be_called_is() -> None:
    public = {name for name in relguide.__all__ if name not in ("CALM", "LEFT", "RIGHT")}
    assert public == (set(CALLS) | ANSWERS | UNIONS | PARTS | FILES) - METHODS


@pytest.mark.parametrize("name", CALLS)
def test_right_arguments_are_answered(name: str) -> None:
    call, right = CALLS[name]
    call(**right)


@pytest.mark.parametrize(("name", "argument"), ARGUMENTS)
@settings(max_examples=40)
@given(wrong=junk)
def test_a_wrong_argument_is_refused_with_a_sentence(name: str, argument: str, wrong: Any) -> None:
    call, right = CALLS[name]
    try:
        call(**{**right, argument: wrong})
    except ValueError as refusal:
        said = str(refusal)
    else:
        return
    assert said.endswith(".")
    assert any(
        word in said
        for word in ("must", "at least", "at most", "reaches", "headway", "there are", "choose")
    )
