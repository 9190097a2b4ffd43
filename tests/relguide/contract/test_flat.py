"""Rows of CSV and Parquet stand for the contract's JSON."""

import json
from typing import Any

import pytest

from relguide import plan
from relguide.contract.answers import answer
from relguide.contract.bodies import NamedSituationBody, situation_from_json
from relguide.contract.flat import (
    SITUATION_COLUMNS,
    answer_columns,
    cells_of_answers,
    check_columns,
    situation_of_row,
)
from relguide.contract.refusal import ContractError, parse
from tests.bodies import AMID, BODY, change, on_earth


def flat(members: dict[str, Any], path: str = "") -> dict[str, Any]:
    cells: dict[str, Any] = {}
    for name, value in members.items():
        if isinstance(value, dict):
            cells |= flat(value, f"{path}{name}.")
        else:
            cells[path + name] = json.dumps(value) if isinstance(value, list) else value
    return cells


@pytest.mark.parametrize(
    "body",
    [
        BODY,
        {"id": "a", **BODY},
        change("wind", ...),
        on_earth((48.0, 2.0), (48.3, 2.5)),
        change("pursuer.altitude_m", 9000),
        AMID,
    ],
)
def test_a_row_is_the_body_that_it_stands_for(body: dict[str, Any]) -> None:
    cells = flat(body)
    assert set(cells) <= set(SITUATION_COLUMNS)
    assert situation_of_row(tuple(cells), tuple(cells.values())) == body
    texts = ["" if cells.get(name) is None else str(cells[name]) for name in SITUATION_COLUMNS]
    assert situation_of_row(SITUATION_COLUMNS, texts) == body


def test_an_intent_may_be_rows_of_its_own() -> None:
    """As Parquet holds it: each piece has all columns."""
    pieces = [
        {"straight_s": 60.0, "turn_to_heading_deg": None, "direction": None, "bank_deg": None},
        {"straight_s": None, "turn_to_heading_deg": 135.0, "direction": "right", "bank_deg": 20.0},
    ]
    body = situation_of_row(("leader.intent",), (pieces,))
    assert body["leader"]["intent"] == BODY["leader"]["intent"]


@pytest.mark.parametrize("text", ["fast", "1_000", "0x10", "1,5", "--1", "1e"])
def test_what_is_no_number_is_refused_as_the_text_it_is(text: str) -> None:
    cells = flat(BODY) | {"pursuer.tas_mps": text}
    body = situation_of_row(tuple(cells), tuple(cells.values()))
    with pytest.raises(ContractError, match=r"pursuer\.tas_mps: must be a number, not the text"):
        parse(NamedSituationBody, body)


@pytest.mark.parametrize("text", ["nan", "inf", "-Infinity", "1e999"])
def test_what_is_not_finite_is_refused(text: str) -> None:
    cells = flat(BODY) | {"pursuer.x_m": text}
    body = situation_of_row(tuple(cells), tuple(cells.values()))
    with pytest.raises(ContractError, match=r"pursuer\.x_m: must be a finite number"):
        parse(NamedSituationBody, body)


def test_an_intent_that_is_no_json_is_refused() -> None:
    with pytest.raises(ContractError, match=r"leader\.intent: This is not JSON"):
        situation_of_row(("leader.intent",), ("left",))
    with pytest.raises(ContractError, match=r"leader\.intent: must be a list"):
        parse(NamedSituationBody, situation_of_row(("leader.intent",), ("7",)))


def test_columns_are_named() -> None:
    check_columns(SITUATION_COLUMNS, "a.csv")
    with pytest.raises(ValueError, match=r"a\.csv has the column speed, and those of situations"):
        check_columns(("id", "speed"), "a.csv")
    with pytest.raises(ValueError, match=r"a\.csv has the column id more than once\."):
        check_columns(("id", "slot_distance_m", "id"), "a.csv")


@pytest.mark.parametrize(
    "include", [(), ("alternatives",), ("alternatives", "optimality", "paths")]
)
def test_an_answer_is_a_row_and_nothing_is_left_out(include: Any) -> None:
    columns = answer_columns("plan", include)
    for body in (BODY, change("leader.tas_mps", 300)):
        reply = answer(*situation_from_json(body), plan, include=include)
        named = {"id": 7, **reply}
        row = [cell for (cell,) in cells_of_answers([named], columns)]
        cells = {name: cell for name, cell in zip(columns, row, strict=True) if cell is not None}
        assert cells.keys() == flat(named).keys()
        for name, cell in cells.items():
            there: Any = named
            for step in name.split("."):
                there = there[step]
            assert (json.loads(cell) if columns[name] == "json" else cell) == there  # type: ignore[arg-type]


def test_others_may_be_rows_of_their_own() -> None:
    """As Parquet holds them: each has all columns, and so have the pieces of its intent."""
    pieces = [{"straight_s": 60.0, "level_change": None}]
    flying = [{"ident": "A", "altitude_m": None, "intent": pieces}, {"ident": "B", "intent": None}]
    assert situation_of_row(("traffic",), (flying,)) == {
        "traffic": [{"ident": "A", "intent": [{"straight_s": 60.0}]}, {"ident": "B"}]
    }


@pytest.mark.parametrize("name", ["traffic", "cells"])
def test_others_that_are_no_json_are_refused(name: str) -> None:
    with pytest.raises(ContractError, match=rf"{name}: This is not JSON"):
        situation_of_row((name,), ("BAW12",))


def test_an_answer_amid_others_is_a_row_and_nothing_is_left_out() -> None:
    columns = answer_columns("plan", (), amid=True)
    plain = answer_columns("plan", ())
    assert [name for name in columns if name in plain] == list(plain)
    assert {
        "separation.others", "separation.vertical", "conflict.ident", "conflict.least_m", "remedies"
    } <= set(columns) - set(plain)  # fmt: skip
    reply = answer(*situation_from_json(AMID), plan)
    row = [cell for (cell,) in cells_of_answers([reply], columns)]
    cells = {name: cell for name, cell in zip(columns, row, strict=True) if cell is not None}
    assert cells.keys() == flat(reply).keys()
    assert json.loads(str(cells["separation.others"])) == reply["separation"]["others"]


def test_times_have_columns_of_their_own() -> None:
    assert list(answer_columns("times", ())) == [
        "id", "line", "status", "time_to_converge_s", "optimality.proof",
        "optimality.lower_bound_s", "reason", "message", "lower_bound_s",
    ]  # fmt: skip


def test_the_flight_of_a_plan_has_its_columns() -> None:
    columns = answer_columns("plan", ("flown",))
    added = {name: kind for name, kind in columns.items() if name.startswith("flown.")}
    assert added["flown.join_s"] == "number"
    assert added["flown.points"] == "json"
    assert not [name for name in answer_columns("plan", ()) if name.startswith("flown.")]
    situation, anchor = situation_from_json(BODY)
    (cells,) = cells_of_answers(
        [answer(situation, anchor, plan, include=["flown"])], {"flown.word": "text"}
    )
    assert cells == ["RSR"]
