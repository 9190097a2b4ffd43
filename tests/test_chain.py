"""One case the whole way: JSON → situation → plan → flight → documents → recording → replay.

Readable as a demonstration: each step is a line of the chain, and what it hands to the next.
"""

from collections.abc import Iterable
from math import radians
from pathlib import Path

import pytest

from relguide import Plan, candidates, certify, plan
from relguide.contract.bodies import situation_from_json
from relguide.contract.recorder import record, replay
from relguide.contract.wire import to_wire
from relguide.flying.cards import plan_card
from relguide.flying.documents import (
    Document,
    FlightEnded,
    FlightStarted,
    LeaderChanged,
    LeaderRoute,
    ModeChanged,
    PlanChanged,
    Sample,
)
from relguide.flying.flight import Command, LeaderHeading, fly
from relguide.flying.scenarios import scenario

SECTION_5 = """{
  "pursuer": {"x_m": -40000, "y_m": 40000, "heading_deg": 90, "tas_mps": 240, "max_bank_deg": 25},
  "leader": {"x_m": 0, "y_m": 0, "heading_deg": 90, "tas_mps": 200, "intent": [
    {"straight_s": 60}, {"turn_to_heading_deg": 135, "direction": "right", "bank_deg": 20}]},
  "slot_distance_m": 10000, "min_separation_m": 9260
}"""


def test_from_json_to_a_proved_plan_and_back_to_json() -> None:
    situation, _ = situation_from_json(SECTION_5)

    fastest = next(iter(candidates(situation)))
    assert fastest.word == "RSR"
    certificate = certify(fastest.trajectory, situation)
    assert certificate.holds

    answer = plan(situation)
    assert isinstance(answer, Plan)
    assert answer.trajectory == fastest.trajectory
    assert answer.optimality.proof == "relaxation"

    body = to_wire(plan_card(answer))
    assert body["status"] == "planned"
    assert body["time_to_converge_s"] == pytest.approx(1082.3, abs=0.1)
    assert [segment["kind"] for segment in body["segments"]] == ["turn", "straight", "turn"]
    assert body["segments"][0]["start"] == {
        "t_s": 0.0,
        "x_m": -40_000.0,
        "y_m": 40_000.0,
        "heading_deg": pytest.approx(90.0),
    }
    assert body["separation"]["proved_above_m"] >= 9_260.0


def test_from_a_scenario_to_a_replay(tmp_path: Path) -> None:
    told = iter([LeaderHeading(heading=radians(110.0), direction="right")])

    def commands(t: float) -> Iterable[Command]:
        return [next(told)] if t == 100.0 else []

    recording = tmp_path / "flight.jsonl"
    flown: list[Document] = list(
        record(
            fly(scenario("fig_6b"), plan, commands=commands, sample_period=1.0),
            recording,
            sample_rate=None,
        )
    )

    assert isinstance(flown[0], FlightStarted)
    assert isinstance(flown[-1], FlightEnded)
    kinds = {type(document) for document in flown}
    assert kinds >= {Sample, PlanChanged, ModeChanged, LeaderRoute, LeaderChanged}
    times = [document.t for document in flown]
    assert times == sorted(times)

    changed = [d for d in flown if isinstance(d, PlanChanged)]
    assert [d.reason for d in changed[:2]] == ["engaged", "leader_turned"]
    assert changed[1].t <= 101.0
    (end,) = flown[-1].results
    assert end.joined
    assert end.least_separation >= 9_260.0

    again = list(replay(recording))
    assert len(again) == len(flown)
    assert [round_off(to_wire(d)) for d in again] == [round_off(to_wire(d)) for d in flown]


def round_off(value: object) -> object:
    """Without the last digits, which degrees and radians do not agree on."""
    match value:
        case float():
            return round(value, 6)
        case dict():
            return {name: round_off(item) for name, item in value.items()}
        case list():
            return [round_off(item) for item in value]
        case _:
            return value
