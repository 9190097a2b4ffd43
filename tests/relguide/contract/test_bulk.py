"""Many situations: each answer is what `plan` gives, and a bad one spoils no other."""

import json
from copy import deepcopy
from math import inf, nan
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from relguide import FlyStraight, NoPlan, Plan, plan
from relguide.contract.bodies import NamedSituationBody, situation_from_body, situation_from_json
from relguide.contract.bulk import Wanted, answer_all, answer_line
from relguide.contract.columns import columns_of, row_of
from relguide.contract.refusal import ContractError, parse
from tests.bodies import AMID, BODY, change, on_earth, put

PLAIN = change("leader.intent", ...)
TIMES, PLANS = Wanted(planner=plan, fields="times"), Wanted(planner=plan)


def drawn(seed: int) -> dict[str, Any]:
    """A plain situation within 60 km: the limit is active in some."""
    rng = np.random.default_rng(seed)
    tas = float(rng.uniform(180.0, 250.0))
    return {
        "id": seed,
        "pursuer": {
            "x_m": float(rng.uniform(-60e3, 60e3)),
            "y_m": float(rng.uniform(-60e3, 60e3)),
            "heading_deg": float(rng.uniform(-360.0, 720.0)),
            "tas_mps": tas,
            "max_bank_deg": float(rng.uniform(15.0, 30.0)),
        },
        "leader": {
            "x_m": 0,
            "y_m": 0.0,
            "heading_deg": float(rng.uniform(0.0, 360.0)),
            "tas_mps": tas * float(rng.uniform(0.6, 1.05)),
        },
        "slot_distance_m": float(rng.uniform(9_300.0, 20e3)),
        "min_separation_m": 9_260,
        "wind": {"from_deg": 20.0, "speed_mps": float(rng.uniform(0.0, 30.0))},
    }


def one(content: Any, wanted: Wanted = PLANS) -> dict[str, Any]:
    (answer,) = answer_all([(1, content)], wanted)
    return answer


@pytest.mark.slow
def test_times_of_many_are_those_of_plan_one_by_one() -> None:
    bodies = [drawn(seed) for seed in range(150)]
    bodies += [
        {**BODY, "id": -1},
        on_earth((48.0, 2.0), (48.3, 2.5)),
        change("leader.tas_mps", 300),
    ]
    answers = answer_all(enumerate(bodies, start=1), TIMES)
    seen = set()
    for body, answer in zip(bodies, answers, strict=True):
        body = {name: value for name, value in body.items() if name != "id"}
        planned = plan(situation_from_json(body)[0])
        seen.add(answer.get("reason", answer.get("optimality", {}).get("proof")))
        if isinstance(planned, NoPlan):
            assert (answer["status"], answer["reason"]) == ("no_plan", planned.reason)
            assert answer["lower_bound_s"] == pytest.approx(planned.lower_bound)
            continue
        assert isinstance(planned, Plan)
        assert answer["status"] == "planned"
        assert answer["time_to_converge_s"] == pytest.approx(planned.time_to_converge, abs=1e-6)
        proved = planned.optimality
        assert answer["optimality"]["proof"] == proved.proof
        assert answer["optimality"]["lower_bound_s"] == pytest.approx(proved.lower_bound, abs=1e-6)
    assert {"relaxation", "bound", "slot_unreachable", "separation_already_lost"} <= seen
    assert [answer.get("id") for answer in answers] == [*range(150), -1, None, None]


@pytest.mark.parametrize("wanted", [TIMES, PLANS])
def test_a_bad_record_spoils_itself_alone(wanted: Wanted) -> None:
    wrong = [
        ContractError([("", "This is not JSON.")]),
        [1],
        {"id": "x"},
        change("pursuer.tas_mps", "fast"),
        change("slot_distance_m", 5_000),
        change("wind.speed_mps", -1),
        {**PLAIN, "id": True},
        {**PLAIN, "slot_distance_m": 10**400},
        {**PLAIN, "leader": {**PLAIN["leader"], "intent": None}},
        {**PLAIN, "more": 1},
    ]
    records: list[tuple[int, object]] = [(1, PLAIN)]
    for line, content in enumerate(wrong, start=1):
        records += [(10 * line, content), (10 * line + 1, {"id": line, **PLAIN})]
    answers = answer_all(records, wanted)
    assert len(answers) == len(records)
    assert {answer["status"] for answer in answers[0::2]} == {"planned"}
    for line, answer in enumerate(answers[1::2], start=1):
        assert (answer["status"], answer["line"]) == ("invalid", 10 * line)
        assert answer["message"].endswith(".")
    assert [answer.get("id") for answer in answers[2::2]] == list(range(1, len(wrong) + 1))
    assert answers[5]["id"] == "x"
    assert "slot_distance_m: must be at least min_separation" in answers[9]["message"]


@pytest.mark.parametrize("name", ["a", "", 7, "é"])
@pytest.mark.parametrize("wanted", [TIMES, PLANS])
def test_an_answer_carries_its_id(name: Any, wanted: Wanted) -> None:
    reply = one({"id": name, **PLAIN}, wanted)
    assert (reply["id"], reply["status"]) == (name, "planned")
    refused = one({"id": name}, wanted)
    assert (refused["id"], refused["status"]) == (name, "invalid")
    assert "pursuer: is missing: it must be an object with x_m, " in refused["message"]


@pytest.mark.parametrize("name", [True, 1.5, None, [], 2**70, "\ud800", "a" * 201])
@pytest.mark.parametrize("wanted", [TIMES, PLANS])
def test_an_id_that_is_none_makes_the_line_invalid(name: Any, wanted: Wanted) -> None:
    reply = one({"id": name, **PLAIN}, wanted)
    assert set(reply) == {"status", "line", "message"}
    assert "id" in reply["message"]


def test_what_is_included_is_in_each_plan() -> None:
    reply = one({"id": 1, **BODY}, Wanted(planner=plan, include=["optimality", "alternatives"]))
    assert reply["optimality"]["stationary"] is True
    assert reply["alternatives"]
    no_plan = one(change("leader.tas_mps", 300), Wanted(planner=plan, include=["optimality"]))
    assert set(no_plan) == {"status", "reason", "message", "lower_bound_s"}
    assert "alternatives" not in one(BODY)


def test_a_line_alone_is_answered_as_one_of_many() -> None:
    reply = answer_line(json.dumps({"id": 1, **BODY}).encode(), plan, include=["optimality"])
    assert (reply["id"], reply["optimality"]["stationary"]) == (1, True)
    assert answer_line(b"{", plan)["message"].startswith("This is not JSON: ")
    assert answer_line(b'{"id": 1}', plan).keys() == {"id", "status", "message"}


def test_times_are_a_plans_fields_without_its_path() -> None:
    for body in (BODY, PLAIN):
        alone, whole = one(body, TIMES), one(body)
        assert set(alone) == {"status", "time_to_converge_s", "optimality"}
        assert alone["optimality"] == pytest.approx(whole["optimality"])
        assert alone["time_to_converge_s"] == pytest.approx(whole["time_to_converge_s"], abs=1e-6)


# --- columns ------------------------------------------------------------------------------------


RANGES = {
    "pursuer.x_m": 1e6, "pursuer.y_m": 1e6, "pursuer.heading_deg": 360.0, "pursuer.tas_mps": 400.0,
    "pursuer.max_bank_deg": 60.0, "leader.x_m": 1e6, "leader.y_m": 1e6, "leader.heading_deg": 360.0,
    "leader.tas_mps": 400.0, "slot_distance_m": 200e3, "min_separation_m": 200e3,
    "wind.from_deg": 360.0, "wind.speed_mps": 150.0, "leader.intent.0.straight_s": 86_400.0,
    "leader.intent.1.turn_to_heading_deg": 360.0, "leader.intent.1.bank_deg": 60.0,
}  # fmt: skip
"""Where values of a field end, or wrap."""
values = st.one_of(
    st.floats(-1.1, 1.1),
    st.sampled_from([1.0, -1.0, 0.0, -0.0, 1.0 + 5e-10, 1.0 + 3e-9, -1e-320, 1e200, 0.1, 1 / 60]),
)


@given(
    changes=st.dictionaries(st.sampled_from(list(RANGES)), values, max_size=3),
    whole=st.booleans(),
    turns=st.booleans(),
)
@settings(max_examples=300)
def test_columns_hold_what_the_library_reads(
    changes: dict[str, float], whole: bool, turns: bool
) -> None:
    content = deepcopy(BODY if turns else PLAIN)
    for path, share in changes.items():
        if turns or "intent" not in path:
            put(content, path, round(share * RANGES[path]) if whole else share * RANGES[path])
    try:
        body = parse(NamedSituationBody, content)
    except ContractError:
        return
    row = row_of(body)
    assert row is not None
    columns, intents, sound = columns_of([row])
    try:
        situation = situation_from_body(body)[0]
    except ContractError:
        assert not sound[0]
        return
    p, l, wind = situation.pursuer, situation.leader, situation.wind
    if sound[0]:  # what it does not take is planned alone
        assert [float(column[0]) for column in columns.full_columns()] == [
            p.x, p.y, p.heading, p.tas, p.max_bank, l.x, l.y, l.heading, l.tas,
            situation.slot_distance, situation.min_separation, wind.east, wind.north,
        ]  # fmt: skip
        assert intents.pieces.tolist() == [
            [0.0, piece.duration, 0.0]
            if isinstance(piece, FlyStraight)
            else [piece.turn, piece.heading, piece.bank]
            for piece in l.intent
        ]
        assert intents.final_headings(np.array([l.heading]))[0] == l.final_heading
    assert changes or sound[0]


LEVEL = {"level_change": {"to_altitude_m": 9_000, "rate_mps": 8}}


@pytest.mark.parametrize(
    "more",
    [
        {"traffic": AMID["traffic"]},
        {"cells": AMID["cells"]},
        {"pursuer": {**BODY["pursuer"], "altitude_m": 9_000}},
        {"leader": {**BODY["leader"], "altitude_m": 9_000}},
        {"leader": {**BODY["leader"], "intent": [LEVEL]}},
    ],
)
def test_what_rows_do_not_hold_is_planned_by_itself(more: dict[str, Any]) -> None:
    body = {**BODY, **more}
    assert row_of(parse(NamedSituationBody, body)) is None
    alone, among = one(body, TIMES), answer_all([(1, BODY), (2, body), (3, PLAIN)], TIMES)
    assert among[1] == alone
    planned = plan(situation_from_json(body)[0])
    assert isinstance(planned, Plan)
    assert alone["time_to_converge_s"] == pytest.approx(planned.time_to_converge)


def in_the_way() -> dict[str, Any]:
    """A situation with a cell across the path that is planned without it."""
    middle = one(BODY)["segments"][1]
    x, y = ((middle["start"][axis] + middle["end"][axis]) / 2.0 for axis in ("x_m", "y_m"))
    cell = {"ident": "CB9", "disc": {"x_m": x, "y_m": y, "radius_m": 15_000}}
    return {**BODY, "cells": [cell]}


@pytest.mark.parametrize("wanted", [TIMES, PLANS])
def test_times_do_not_pass_over_others(wanted: Wanted) -> None:
    plain, amid = (one(body, wanted) for body in (BODY, in_the_way()))
    assert amid.get("time_to_converge_s", inf) > plain["time_to_converge_s"] + 1.0


def test_latitudes_have_no_row() -> None:
    assert row_of(parse(NamedSituationBody, on_earth((48.0, 2.0), (48.3, 2.5)))) is None


@pytest.mark.parametrize(
    "again",
    [b'{"slot_distance_m": 1, ', b'{"id": "a:b", "id": "c", ', b'{"\\u0069d": 1, "id": 2, '],
)
@pytest.mark.parametrize("wanted", [TIMES, PLANS])
def test_a_key_given_twice_makes_the_line_invalid(again: bytes, wanted: Wanted) -> None:
    reply = one(again + json.dumps(PLAIN).encode()[1:], wanted)
    assert (reply["status"], reply["line"]) == ("invalid", 1)
    assert reply["message"].endswith("is given more than once: give it once.")


@pytest.mark.parametrize("line", [b"", b"3", b"null", b"nonsense", b'"\xff"', b"[" * 2000])
def test_text_that_is_no_situation_is_invalid(line: bytes) -> None:
    reply = one(line)
    assert (reply["status"], reply["line"]) == ("invalid", 1)


def with_intent(*pieces: Any) -> dict[str, Any]:
    return change("leader.intent", list(pieces))


TURN = {"turn_to_heading_deg": 90.0, "direction": "left", "bank_deg": 20.0}


@pytest.mark.parametrize(
    "body",
    [
        change("pursuer.x_m", ...),
        change("pursuer.x_m", True),
        change("pursuer.x_m", "1"),
        change("pursuer.x_m", None),
        change("pursuer.heading_deg", inf),
        change("wind.from_deg", nan),
        change("pursuer", []),
        change("wind", None),
        change("wind.speed_mps", ...),
        change("leader.intent", None),
        change("leader.intent", 0),
        change("leader.more", 0),
        {**PLAIN, "more": 0},
        with_intent(None),
        with_intent({}),
        with_intent({"straight_s": True}),
        with_intent({"straight_s": 1.0, "bank_deg": 1.0}),
        with_intent({**TURN, "direction": "up"}),
        with_intent({**TURN, "direction": ["left"]}),
        with_intent({**TURN, "bank_deg": None}),
        with_intent({**TURN, "turn_to_heading_deg": 10**400}),
        with_intent({**TURN, "turn_to_heading_deg": -inf}),
        with_intent(*[TURN] * 21),
    ],
)
def test_what_is_wrong_is_invalid_as_text_too(body: dict[str, Any]) -> None:
    reply = one(body, TIMES)
    assert (reply["status"], reply["line"]) == ("invalid", 1)
    assert one(json.dumps(body).encode(), TIMES)["status"] == "invalid"
