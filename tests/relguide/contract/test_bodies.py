"""Situations as outsiders send them, and how bad ones are refused."""

import json
import re
from math import atan2, hypot, pi
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pydantic import TypeAdapter
from pyproj import Geod

from relguide import LEFT, RIGHT, FlyStraight, TurnTo, plan
from relguide.contract.answers import answer
from relguide.contract.bodies import plan_to_wire, situation_from_json
from relguide.contract.document_models import PlanAnswer
from relguide.contract.places import Unanchored
from relguide.contract.refusal import ContractError
from relguide.flying.cards import plan_card
from relguide.planning.frames import LocalPlane
from relguide.planning.outcome import Plan
from relguide.units import DEG
from tests.bodies import BODY, change, on_earth

FIELD = Path(__file__).parents[2] / "golden" / "field"


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
    body = change("leader.intent", ...)
    del body["wind"]
    situation, _ = situation_from_json(body)
    assert situation.leader.intent == ()
    assert situation.wind.speed == 0.0
    assert situation_from_json(change("leader.intent", []))[0].leader.intent == ()


def test_a_left_turn_is_a_left_turn() -> None:
    situation, _ = situation_from_json(change("leader.intent.1.direction", "left"))
    turn = situation.leader.intent[1]
    assert isinstance(turn, TurnTo)
    assert turn.turn == LEFT


@pytest.mark.parametrize(
    ("given", "meant"),
    [("x", "x_m"), ("x_nm", "x_m"), ("tas", "tas_mps"), ("tas_kt", "tas_mps"),
     ("heading", "heading_deg"), ("bank", "max_bank_deg"), ("bank_deg", "max_bank_deg")],
)  # fmt: skip
def test_a_field_without_its_unit_is_asked_about(given: str, meant: str) -> None:
    named = {k: v for k, v in BODY["pursuer"].items() if k != meant} | {given: 1}
    with pytest.raises(ContractError) as refused:
        situation_from_json(json.dumps(BODY | {"pursuer": named}))
    said = f"is not a field of the contract: did you mean {meant}?"
    assert (f"pursuer.{given}", said) in refused.value.problems


@pytest.mark.parametrize(
    ("path", "meant"),
    [("pursuer.altitude_ft", "altitude_m"), ("leader.intents", "intent"), ("wnd", "wind")],
)
def test_a_field_that_may_be_left_out_is_asked_about_too(path: str, meant: str) -> None:
    body = change(path, 1)
    owner = body[path.partition(".")[0]] if "." in path else body
    owner.pop(meant, None)
    assert problem_of(body) == (path, f"is not a field of the contract: did you mean {meant}?")


@pytest.mark.parametrize(
    ("path", "value", "where", "sentence"),
    [
        (
            "pursuer",
            ...,
            "pursuer",
            "is missing: it must be an object with x_m, y_m, heading_deg, ",
        ),
        ("pursuer.tas_mps", ..., "pursuer.tas_mps", "is missing: it must lie in 30 … 400 m/s."),
        (
            "leader.intent.1.direction",
            ...,
            "leader.intent[1].direction",
            "is missing: it must be 'left' or 'right'.",
        ),
        ("pursuer.tas_mps", True, "pursuer.tas_mps", "must be a number, not true."),
        ("pursuer.tas_mps", "235", "pursuer.tas_mps", 'must be a number, not the text "235".'),
        ("pursuer.tas_mps", None, "pursuer.tas_mps", "must be a number, not null."),
        ("pursuer.tas_mps", 29.9, "pursuer.tas_mps", "must lie in 30 … 400 m/s, not 29.9 m/s."),
        ("leader.tas_mps", 400.1, "leader.tas_mps", "must lie in 30 … 400 m/s, not 400.1 m/s."),
        ("pursuer.", 1, 'pursuer.""', "is not a field of the contract: leave it out."),
        ("", 1, '""', "is not a field of the contract: leave it out."),
        ("pursuer.tas_kt", 1, "pursuer.tas_kt", "is not a field of the contract: leave it out."),
        ("pursuer.x_m", 10**400, "pursuer.x_m", "is too large a number to be read."),
        ("pursuer.x_m", 1000001, "pursuer.x_m", "must lie in -1e+06 … 1e+06 m, not 1000001 m."),
        ("pursuer.y_m", float("nan"), "pursuer.y_m", "must be a finite number, not nan."),
        ("pursuer.max_bank_deg", 60.1, "pursuer.max_bank_deg", "must lie in 1 … 60 °, not 60.1 °."),
        ("pursuer.max_bank_deg", 0.9, "pursuer.max_bank_deg", "must lie in 1 … 60 °, not 0.9 °."),
        ("pursuer", [], "pursuer", "must be an object with fields, not a list."),
        ("leader.intent.1.direction", "up", "leader.intent[1].direction", "must be 'left' or"),
        ("leader.intent.1.bank_deg", 61, "leader.intent[1].bank_deg", "must lie in 1 … 60 °"),
        (
            "leader.intent.0.straight_s",
            -1,
            "leader.intent[0].straight_s",
            "must lie in 0 … 86400 s",
        ),
        ("leader.intent", [{}], "leader.intent[0].straight_s", "is missing: it must lie in 0 … 8"),
        ("leader.intent", [7], "leader.intent[0]", "must be an object with fields, not 7."),
        ("leader.intent", [{"straight_s": 1}] * 21, "leader.intent", "must have at most 20"),
        ("leader.intent", None, "leader.intent", "must be a list, not null."),
        ("wind", None, "wind", "must be an object with fields, not null."),
        ("wind.speed_mps", 151, "wind.speed_mps", "must lie in 0 … 150 m/s, not 151 m/s."),
        ("min_separation_m", -1, "min_separation_m", "must lie in 0 … 200000 m, not -1 m."),
        (
            "min_separation_m",
            12001,
            "slot_distance_m",
            "must be at least min_separation (12001 m), not 12000 m",
        ),
        ("slot_distance_m", 200001, "slot_distance_m", "must lie in 0 … 200000 m"),
        ("id", "a", "id", "is not a field of the contract: leave it out."),
    ],
)
def test_each_defect_is_named(path: str, value: Any, where: str, sentence: str) -> None:
    found, message = problem_of(change(path, value))
    assert found == where
    assert message.startswith(sentence)


@pytest.mark.parametrize("bank", [1, 60, 60.0])
def test_the_bounds_themselves_are_accepted(bank: float) -> None:
    assert situation_from_json(change("pursuer.max_bank_deg", bank))


@pytest.mark.parametrize("heading", [-720.0, 450, 720.0])
def test_headings_up_to_twice_round_are_accepted(heading: float) -> None:
    situation, _ = situation_from_json(change("pursuer.heading_deg", heading))
    assert 0.0 <= situation.pursuer.heading <= 2.0 * pi


@pytest.mark.parametrize(
    "path", ["pursuer.heading_deg", "leader.intent.1.turn_to_heading_deg", "wind.from_deg"]
)
@pytest.mark.parametrize("heading", [4000, -720.1, 1e308])
def test_headings_further_round_are_refused_as_the_library_does(path: str, heading: float) -> None:
    said = f"must lie in -720 … 720 °, not {heading:.9g} °."
    assert problem_of(change(path, heading))[1] == said
    with pytest.raises(ValueError, match=re.escape(f"heading_deg {said}")):
        TurnTo.from_display(heading_deg=heading, direction="left", bank_deg=20.0)


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        (b"", "This is not JSON"),
        (b'{"pursuer": ', "This is not JSON: Expecting value at line 1, column 13."),
        (b"[" * 100_000, "This is nested too deeply to be read."),
        (b'{"a":' * 100_000, "This is nested too deeply to be read."),
        (b"1" * 10_000, "A number in this has too many digits to be read."),
        (b"\xff\xfe{}", "This is not UTF-8 text"),
        (b'{"wind": NaN}', "NaN is not a number in JSON: give a finite one."),
        (b'{"wind": -Infinity}', "-Infinity is not a number in JSON: give a finite one."),
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
    assert problem_of(text) == ("x_m", "is given more than once: give it once.")


def test_an_overflowing_number_is_refused() -> None:
    text = json.dumps(BODY).replace("-40000", "-1e400")
    assert problem_of(text) == ("pursuer.x_m", "must be a finite number, not -inf.")


def test_all_defects_are_listed_but_not_endlessly() -> None:
    body = change("leader.intent", [{"straight_s": -1}] * 15)
    with pytest.raises(ContractError) as caught:
        situation_from_json(body)
    assert len(caught.value.problems) == 15
    assert str(caught.value).endswith("And 7 more.")


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
        body = change("leader.intent", [value])
    else:
        body = change(path, value)
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


def test_a_latitude_beyond_the_poles_is_refused_with_its_unit() -> None:
    _, message = problem_of(on_earth((91.0, 1.4), (49.0, 2.0)))
    assert message == "must be at most 90 °, not 91.0 °."


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
    assert problem_of(change("pursuer.lat_deg", 1.0))[0] == "pursuer.lon_deg"


def test_a_byte_order_mark_before_json_is_passed_over() -> None:
    text = json.dumps(BODY)
    known = situation_from_json(text)
    assert situation_from_json(b"\xef\xbb\xbf" + text.encode()) == known
    assert situation_from_json("\ufeff" + text) == known


def test_a_heading_kept_as_a_32_bit_number_is_the_heading_turned_to() -> None:
    """`left to 90.1` from 90.09999847 is no full circle."""
    text = (FIELD / "15-float32-heading.json").read_bytes()
    straight = json.loads(text)
    straight["leader"]["intent"] = []
    answers = [plan(situation_from_json(body)[0]) for body in (text, straight)]
    first, second = answers
    assert isinstance(first, Plan)
    assert isinstance(second, Plan)
    assert first.time_to_converge == pytest.approx(second.time_to_converge, abs=1e-3)


def test_a_file_with_a_byte_order_mark_is_read() -> None:
    assert isinstance(plan(situation_from_json((FIELD / "14-bom.json").read_bytes())[0]), Plan)
