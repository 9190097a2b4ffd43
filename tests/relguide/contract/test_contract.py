"""What outsiders send: situations and commands, and how bad ones are refused."""

import copy
import json
from dataclasses import replace
from math import atan2, hypot, pi
from typing import Any, get_args

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pydantic import TypeAdapter
from pyproj import Geod

from relguide import LEFT, RIGHT, Arc, FlyStraight, NoPlan, Situation, TurnTo, check, plan
from relguide.contract.answers import answer, answer_line
from relguide.contract.bodies import Unanchored, plan_to_wire, situation_from_json
from relguide.contract.messages import (
    Command,
    FlightRequest,
    PlanAnswer,
    ScenarioFlightRequest,
    SituationFlightRequest,
)
from relguide.contract.refusal import ContractError
from relguide.flying.cards import plan_card
from relguide.planning.frames import LocalPlane
from relguide.planning.plan import Plan
from relguide.units import DEG

BODY: dict[str, Any] = {
    "pursuer": {
        "x_m": -40000,
        "y_m": 40000,
        "heading_deg": 90,
        "tas_mps": 235,
        "max_bank_deg": 25,
    },
    "leader": {
        "x_m": 0,
        "y_m": 0,
        "heading_deg": 90,
        "tas_mps": 200,
        "intent": [
            {"straight_s": 60},
            {"turn_to_heading_deg": 135, "direction": "right", "bank_deg": 20},
        ],
    },
    "slot_distance_m": 12000,
    "min_separation_m": 9260,
    "wind": {"from_deg": 270, "speed_mps": 15},
}


def changed(path: str, value: Any) -> dict[str, Any]:
    """BODY with one field set, or removed if the value is `...`."""
    body = copy.deepcopy(BODY)
    *way, last = path.split(".")
    here: Any = body
    for step in way:
        here = here[int(step)] if step.isdigit() else here[step]
    if value is ...:
        del here[last]
    else:
        here[last] = value
    return body


def on_earth(pursuer: tuple[float, float], leader: tuple[float, float]) -> dict[str, Any]:
    body = copy.deepcopy(BODY)
    for name, (lat, lon) in (("pursuer", pursuer), ("leader", leader)):
        del body[name]["x_m"], body[name]["y_m"]
        body[name] |= {"lat_deg": lat, "lon_deg": lon}
    return body


def problem_of(body: Any) -> tuple[str, str]:
    with pytest.raises(ContractError) as caught:
        situation_from_json(body)
    return caught.value.problems[0]


def test_the_contracts_example() -> None:
    situation, anchor = situation_from_json(json.dumps(BODY))
    assert anchor == Unanchored()
    assert (situation.pursuer.x, situation.pursuer.y) == (-40000.0, 40000.0)
    assert situation.pursuer.heading == pytest.approx(0.5 * pi)
    assert situation.pursuer.max_bank == pytest.approx(25.0 * DEG)
    straight, turn = situation.leader.intent
    assert straight == FlyStraight(duration=60.0)
    assert isinstance(turn, TurnTo)
    assert turn.turn == RIGHT
    assert turn.heading == pytest.approx(0.75 * pi)
    assert (situation.slot_distance, situation.min_separation) == (12000.0, 9260.0)
    assert (situation.wind.east, situation.wind.north) == pytest.approx((15.0, 0.0))


def test_intent_and_wind_may_be_left_out() -> None:
    body = changed("leader.intent", ...)
    del body["wind"]
    situation, _ = situation_from_json(body)
    assert situation.leader.intent == ()
    assert situation.wind.speed == 0.0
    assert situation_from_json(changed("leader.intent", []))[0].leader.intent == ()


def test_a_left_turn_is_a_left_turn() -> None:
    situation, _ = situation_from_json(changed("leader.intent.1.direction", "left"))
    turn = situation.leader.intent[1]
    assert isinstance(turn, TurnTo)
    assert turn.turn == LEFT


@pytest.mark.parametrize(
    ("path", "value", "where", "sentence"),
    [
        ("pursuer.tas_mps", ..., "pursuer.tas_mps", "is missing."),
        ("pursuer.tas_mps", True, "pursuer.tas_mps", "must be a number, not true."),
        ("pursuer.tas_mps", "235", "pursuer.tas_mps", 'must be a number, not the text "235".'),
        ("pursuer.tas_mps", None, "pursuer.tas_mps", "must be a number, not null."),
        ("pursuer.tas_mps", 29.9, "pursuer.tas_mps", "must be at least 30, not 29.9."),
        ("leader.tas_mps", 400.1, "leader.tas_mps", "must be at most 400, not 400.1."),
        ("pursuer.tas_kt", 1, "pursuer.tas_kt", "is not a field of the contract."),
        ("pursuer.x_m", 10**400, "pursuer.x_m", "is too large a number."),
        ("pursuer.x_m", 1000001, "pursuer.x_m", "must be at most 1000000, not 1000001."),
        ("pursuer.y_m", float("nan"), "pursuer.y_m", "must be a finite number, not nan."),
        ("pursuer.max_bank_deg", 60.1, "pursuer.max_bank_deg", "must be at most 60, not 60.1."),
        ("pursuer.max_bank_deg", 0.9, "pursuer.max_bank_deg", "must be at least 1, not 0.9."),
        ("pursuer", [], "pursuer", "must be an object with fields, not a list."),
        ("leader.intent.1.direction", "up", "leader.intent[1].direction", "must be 'left' or"),
        ("leader.intent.1.bank_deg", 61, "leader.intent[1].bank_deg", "must be at most 60"),
        ("leader.intent.0.straight_s", -1, "leader.intent[0].straight_s", "must be at least 0"),
        ("leader.intent", [{}], "leader.intent[0].straight_s", "is missing."),
        ("leader.intent", [7], "leader.intent[0]", "must be an object with fields, not 7."),
        ("leader.intent", [{"straight_s": 1}] * 21, "leader.intent", "must have at most 20"),
        ("leader.intent", None, "leader.intent", "must be a list, not null."),
        ("wind", None, "wind", "must be an object with fields, not null."),
        ("wind.speed_mps", 151, "wind.speed_mps", "must be at most 150, not 151."),
        ("min_separation_m", -1, "min_separation_m", "must be at least 0, not -1."),
        ("min_separation_m", 12001, "slot_distance_m", "must be at least min_separation_m"),
        ("slot_distance_m", 200001, "slot_distance_m", "must be at most 200000"),
        ("id", "a", "id", "is not a field of the contract."),
    ],
)
def test_each_defect_is_named(path: str, value: Any, where: str, sentence: str) -> None:
    found, message = problem_of(changed(path, value))
    assert found == where
    assert message.startswith(sentence)


@pytest.mark.parametrize("bank", [1, 60, 60.0])
def test_the_bounds_themselves_are_accepted(bank: float) -> None:
    assert situation_from_json(changed("pursuer.max_bank_deg", bank))


@pytest.mark.parametrize("heading", [-720.0, 450, 1e308])
def test_any_finite_heading_is_accepted(heading: float) -> None:
    situation, _ = situation_from_json(changed("pursuer.heading_deg", heading))
    assert 0.0 <= situation.pursuer.heading <= 2.0 * pi


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        (b"", "This is not JSON"),
        (b'{"pursuer": ', "This is not JSON: Expecting value at line 1, column 13."),
        (b"[" * 100_000, "This is nested too deeply to be read."),
        (b'{"a":' * 100_000, "This is nested too deeply to be read."),
        (b"1" * 10_000, "A number in this has too many digits."),
        (b"\xff\xfe{}", "This is not UTF-8 text"),
        (b'{"wind": NaN}', "NaN is not a number that JSON has."),
        (b'{"wind": -Infinity}', "-Infinity is not a number that JSON has."),
        (b"null", "This must be an object with fields, not null."),
        (b"[]", "This must be an object with fields, not a list."),
    ],
)
def test_what_is_not_json_is_refused(text: bytes, sentence: str) -> None:
    path, message = problem_of(text)
    assert path == ""
    assert message.startswith(sentence)


def test_a_field_given_twice_is_refused() -> None:
    text = json.dumps(BODY).replace('"x_m": 0', '"x_m": 0, "x_m": 1')
    assert problem_of(text) == ("x_m", "is given more than once.")


def test_an_overflowing_number_is_refused() -> None:
    text = json.dumps(BODY).replace("-40000", "-1e400")
    assert problem_of(text) == ("pursuer.x_m", "must be a finite number, not -inf.")


def test_all_defects_are_told_but_not_endlessly() -> None:
    body = changed("leader.intent", [{"straight_s": -1}] * 15)
    with pytest.raises(ContractError) as caught:
        situation_from_json(body)
    assert len(caught.value.problems) == 15
    assert str(caught.value).endswith("and 7 more")


json_values = st.recursive(
    st.none() | st.booleans() | st.floats() | st.integers() | st.text(max_size=5),
    lambda inner: (
        st.lists(inner, max_size=3)
        | st.dictionaries(
            st.sampled_from(["x_m", "lat_deg", "intent", "straight_s", "from_deg", "\ud800"]),
            inner,
            max_size=3,
        )
    ),
    max_leaves=8,
)
PATHS = [
    *BODY,
    *(f"pursuer.{name}" for name in BODY["pursuer"]),
    *(f"leader.{name}" for name in BODY["leader"]),
    "leader.intent.0",
    "leader.intent.1.direction",
    "wind.speed_mps",
]


@given(path=st.sampled_from(PATHS), value=json_values)
@settings(max_examples=200)
def test_garbage_is_planned_or_refused_in_a_sentence(path: str, value: Any) -> None:
    if path == "leader.intent.0":
        body = changed("leader.intent", [value])
    else:
        body = changed(path, value)
    try:
        situation_from_json(body)
    except ContractError as error:
        str(error).encode()  # can be printed
        assert error.problems  # noqa: PT017


@given(text=st.binary(max_size=60))
@settings(max_examples=100)
def test_noise_is_refused_in_a_sentence(text: bytes) -> None:
    with pytest.raises(ContractError):
        situation_from_json(text)


# --- positions on the earth ---------------------------------------------------------------------


def test_latitudes_come_back_with_the_plan() -> None:
    situation, anchor = situation_from_json(on_earth((49.4, 1.4), (49.0, 2.0)))
    assert (situation.leader.x, situation.leader.y) == (0.0, 0.0)
    assert anchor == LocalPlane(49.0, 2.0)
    planned = plan(situation)
    assert isinstance(planned, Plan)
    reply = plan_to_wire(plan_card(planned), anchor)
    start = reply["segments"][0]["start"]
    assert (start["lat_deg"], start["lon_deg"]) == pytest.approx((49.4, 1.4), abs=1e-9)
    # true north at the pursuer is not the plane's north; what was given comes back
    assert start["heading_deg"] == pytest.approx(90.0, abs=1e-6)
    assert situation.pursuer.heading / DEG == pytest.approx(90.45, abs=0.01)
    TypeAdapter(PlanAnswer).validate_python(reply)


def test_the_plane_is_the_earth_near_the_leader() -> None:
    situation, _ = situation_from_json(on_earth((49.4, 1.4), (49.0, 2.0)))
    azimuth, _, distance = Geod(ellps="WGS84").inv(2.0, 49.0, 1.4, 49.4)
    p = situation.pursuer
    assert hypot(p.x, p.y) == pytest.approx(distance, abs=0.01)
    assert atan2(p.x, p.y) / DEG == pytest.approx(azimuth, abs=1e-6)


@pytest.mark.parametrize("leader", [(90.0, 0.0), (-90.0, 0.0), (0.0, 180.0), (89.9, -180.0)])
def test_poles_and_the_date_line_are_places(leader: tuple[float, float]) -> None:
    lat = leader[0] - 0.5 if leader[0] > 0 else leader[0] + 0.5
    situation, anchor = situation_from_json(on_earth((lat, -leader[1]), leader))
    assert abs(situation.pursuer.y) < 100_000.0
    reply = answer(situation, anchor, plan)
    assert reply["segments"][0]["start"]["heading_deg"] == pytest.approx(90.0, abs=1e-4)


@pytest.mark.parametrize("pole", [90.0, -90.0])
def test_a_pursuer_at_a_pole_has_a_heading(pole: float) -> None:
    situation, anchor = situation_from_json(on_earth((pole, 30.0), (0.99 * pole, 30.0)))
    reply = answer(situation, anchor, plan)
    start = reply["segments"][0]["start"]
    assert abs(start["lat_deg"]) == pytest.approx(90.0)
    # along the meridian of 30° the pole's north is the plane's
    assert situation.pursuer.heading / DEG == pytest.approx(90.0, abs=1e-6)


@pytest.mark.parametrize("pursuer", [(-49.0, -178.0), (10.0, 2.0)])
def test_too_far_apart_on_the_earth(pursuer: tuple[float, float]) -> None:
    path, message = problem_of(on_earth(pursuer, (49.0, 2.0)))
    assert path == "pursuer.lat_deg, pursuer.lon_deg"
    assert message == "must lie within 1000 km of the leader."


def test_both_aircraft_are_placed_alike() -> None:
    body = on_earth((49.4, 1.4), (49.0, 2.0))
    body["leader"] = BODY["leader"]
    assert "in both aircraft alike" in problem_of(body)[1]


def test_both_ways_at_once_are_refused() -> None:
    assert problem_of(changed("pursuer.lat_deg", 1.0))[0] == "pursuer.lon_deg"


# --- answers ------------------------------------------------------------------------------------


def test_a_plan_has_the_contracts_names() -> None:
    situation, anchor = situation_from_json(BODY)
    reply = answer(situation, anchor, plan)
    assert list(reply) == [
        "status",
        "planner",
        "word",
        "time_to_converge_s",
        "length_m",
        "segments",
        "separation",
        "optimality",
        "alternatives",
        "compute_ms",
    ]
    assert set(reply["separation"]) == {"least_m", "at_s", "proved_above_m"}
    assert set(reply["optimality"]) == {"proof", "lower_bound_s"}
    for segment in reply["segments"]:
        names = {
            "turn": {"kind", "direction", "angle_deg", "bank_deg", "radius_m", "duration_s"},
            "straight": {"kind", "length_m", "duration_s"},
        }[segment["kind"]]
        assert set(segment) == names | {"start", "end"}
        assert set(segment["start"]) == {"t_s", "x_m", "y_m", "heading_deg"}
    way = {"time_to_converge_s", "turning_deg", "passes", "side"}
    names_of = {
        "slower": way,
        "separation": way | {"least_separation_m", "at_s"},
        "not_open": {"time_to_converge_s", "opens_s"},
        "no_root": set(),
    }
    for other in reply["alternatives"]:
        assert set(other) == names_of[other["rejected"]] | {"word", "why", "rejected"}
    assert {other["rejected"] for other in reply["alternatives"]} == {"slower", "no_root"}
    TypeAdapter(PlanAnswer).validate_python(reply)


def test_no_plan_has_the_contracts_names() -> None:
    situation, anchor = situation_from_json(changed("leader.tas_mps", 300))
    reply = answer(situation, anchor, plan)
    assert set(reply) == {"status", "reason", "message"}
    assert reply["status"] == "no_plan"
    TypeAdapter(PlanAnswer).validate_python(reply)


@pytest.mark.parametrize("name", ["a", "", 7, "é"])
def test_a_batch_line_carries_its_id(name: Any) -> None:
    reply = answer_line(json.dumps({"id": name, **BODY}).encode(), plan)
    assert (reply["id"], reply["status"]) == (name, "planned")
    refused = answer_line(json.dumps({"id": name}).encode(), plan)
    assert (refused["id"], refused["status"]) == (name, "invalid")
    assert "pursuer: is missing." in refused["message"]


@pytest.mark.parametrize("name", [True, 1.5, None, [], 2**70, "\ud800", "a" * 201])
def test_an_id_that_is_none_makes_the_line_invalid(name: Any) -> None:
    reply = answer_line(json.dumps({"id": name, **BODY}).encode(), plan)
    assert set(reply) == {"status", "message"}
    assert "id" in reply["message"]


# --- flights ------------------------------------------------------------------------------------


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
        {"command": "set_intent_known", "known": True},
    ],
)
def test_commands_are_read(command: dict[str, Any]) -> None:
    read = TypeAdapter(Command).validate_python
    assert read(command).model_dump(exclude_unset=True) == command
    with pytest.raises(ValueError, match="validation error"):
        read({**command, "extra": 1})


def test_every_command_has_its_name() -> None:
    models = get_args(get_args(Command)[0])
    assert len({get_args(m.model_fields["command"].annotation)[0] for m in models}) == 6


# --- optimality on demand -----------------------------------------------------------------------


def test_without_the_demand_nothing_is_added() -> None:
    situation, anchor = situation_from_json(BODY)
    asked = answer(situation, anchor, plan, optimality=True)
    reply = answer(situation, anchor, plan)
    assert set(reply["optimality"]) == {"proof", "lower_bound_s"}
    assert list(asked) == list(reply)
    asked["optimality"] = {name: asked["optimality"][name] for name in reply["optimality"]}
    asked["compute_ms"] = reply["compute_ms"]
    assert json.dumps(asked) == json.dumps(reply)


def test_on_demand_optimality_has_its_names_and_columns_of_one_length() -> None:
    situation, anchor = situation_from_json(BODY)
    reply = answer(situation, anchor, plan, optimality=True)
    told = reply["optimality"]
    assert list(told) == [
        "proof",
        "lower_bound_s",
        "arrival",
        "hamiltonian_residual",
        "switching_residual_s_per_deg",
        "switching_ok",
        "contacts",
        "rides",
        "panel",
    ]
    assert (told["switching_ok"], told["arrival"]) == (True, "free")
    assert told["hamiltonian_residual"] < 1e-8
    assert list(told["panel"]) == [
        "t_s",
        "hamiltonian",
        "switching_s_per_deg",
        "separation_costate_s_per_m",
        "bearing_costate_s_per_deg",
    ]
    assert {len(column) for column in told["panel"].values()} == {len(told["panel"]["t_s"])}
    # every end of a segment is there twice
    for segment in reply["segments"][1:]:
        start = segment["start"]["t_s"]
        assert sum(t == pytest.approx(start, abs=1e-6) for t in told["panel"]["t_s"]) == 2
    # a card read by its model is the card that was written
    read = TypeAdapter(PlanAnswer).validate_python(reply)
    assert json.loads(read.model_dump_json(exclude_unset=True)) == json.loads(json.dumps(reply))


def test_the_switching_function_is_per_degree_and_turns_as_eq_16_asks() -> None:
    situation, anchor = situation_from_json(BODY)
    planned = plan(situation)
    assert isinstance(planned, Plan)
    history = check(planned, situation).history
    panel = answer(situation, anchor, plan, optimality=True)["optimality"]["panel"]
    assert panel["switching_s_per_deg"] == pytest.approx([s * DEG for s in history.switching])
    assert panel["t_s"] == pytest.approx(history.times)
    # the word is RSR: right turns where λ_ψ < 0, and 0 on the straight
    middle = len(panel["t_s"]) // 2
    first, straight = panel["switching_s_per_deg"][0], panel["switching_s_per_deg"][middle]
    assert first < -1e-3
    assert abs(straight) < 1e-9


def test_a_plan_that_is_not_stationary_says_so() -> None:
    """One that begins with a weave, and is the fastest after it."""
    situation, anchor = situation_from_json(changed("leader.intent", []))
    first = planned_for(situation)
    radius = situation.pursuer.turn_radius
    weave = tuple(Arc(turn=turn, turn_angle=0.3, radius=radius) for turn in (LEFT, RIGHT))
    woven = replace(first.trajectory, segments=weave)
    ours = woven.pose_at(woven.duration)
    theirs = situation.leader.trajectory.pose_at(woven.duration)
    onward = planned_for(
        replace(
            situation,
            pursuer=replace(situation.pursuer, x=ours.x, y=ours.y, heading=ours.heading),
            leader=replace(situation.leader, x=theirs.x, y=theirs.y),
        )
    )
    whole = replace(woven, segments=(*weave, *onward.trajectory.segments))

    def weaving(_: Situation) -> Plan | NoPlan:
        return replace(first, trajectory=whole)

    told = answer(situation, anchor, weaving, optimality=True)["optimality"]
    assert told["switching_ok"] is False
    assert told["switching_residual_s_per_deg"] > 0.01


def planned_for(situation: Situation) -> Plan:
    planned = plan(situation)
    assert isinstance(planned, Plan)
    return planned


def test_a_batch_line_says_it_on_demand() -> None:
    reply = answer_line(json.dumps({"id": 1, **BODY}).encode(), plan, optimality=True)
    assert reply["optimality"]["switching_ok"] is True
    no_plan = answer_line(
        json.dumps(changed("leader.tas_mps", 300)).encode(), plan, optimality=True
    )
    assert set(no_plan) == {"status", "reason", "message"}
