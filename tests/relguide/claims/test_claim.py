"""Each row of the registry names what exists, and its page says its number."""

import ast
import csv
import re
from functools import cache
from importlib.util import find_spec
from pathlib import Path

import pytest

from relguide.__main__ import COMMANDS
from relguide.claims.claim import Claim, Reading, all_claims, named_claims
from tests.pages import ROOT
from tests.relguide.claims.test_run import CLAIM

WORDS = {"none": 0, "no": 0, "never": 0, "nothing": 0}
"""Numbers that pages write as words; `all` stands for the number that is told before it."""
each = pytest.mark.parametrize("claim", all_claims(), ids=lambda claim: claim.name)


@cache
def text_of(page: str) -> str:
    return " ".join((ROOT / page).read_text("utf-8").split())


def numbers_in(said: str) -> set[float]:
    told = {
        float(n.replace(",", "")) for n in re.findall(r"-?\d[\d,]*\.?\d*", said.replace("−", "-"))
    }
    return told | {float(n) for word, n in WORDS.items() if re.search(rf"\b{word}\b", said, re.I)}


@each
def test_its_page_says_its_number(claim: Claim) -> None:
    assert " ".join(claim.said.split()) in text_of(claim.page), claim.page
    assert claim.expected in numbers_in(claim.said)


@each
def test_its_test_exists(claim: Claim) -> None:
    file, _, name = claim.test.partition("::")
    tree = ast.parse((ROOT / file).read_text("utf-8"))
    assert name in {node.name for node in tree.body if isinstance(node, ast.FunctionDef)}


@each
def test_its_command_parses(claim: Claim) -> None:
    program, *words = claim.command.split()
    if program == "relguide":
        assert words[0] in COMMANDS
    elif program == "make":
        assert f"\n{words[0]}:" in (ROOT / "Makefile").read_text("utf-8")
    else:
        assert words[0] == "-m"
        assert find_spec(words[1]) is not None
    for word in words:
        if word.startswith("examples/"):
            assert (ROOT / word).is_file()


@each
def test_its_bound_admits_what_it_tells(claim: Claim) -> None:
    assert claim.holds(claim.expected)


def test_claims_of_one_command_agree_on_its_minutes() -> None:
    minutes = {(claim.command, claim.minutes) for claim in all_claims() if claim.runs != "kept"}
    assert len(minutes) == len({command for command, _ in minutes})


def test_a_row_of_a_table_was_measured_by_the_command_that_its_claim_names() -> None:
    for claim in all_claims():
        reading = claim.reading
        if claim.runs != "kept" or reading.table not in ("effort.csv", "proofs.csv"):
            continue
        with (ROOT / "benchmarks" / "results" / reading.table).open(encoding="utf-8") as file:
            rows = [row for row in csv.DictReader(file) if matches(row, reading)]
        assert rows, claim.name
        for row in rows:
            assert row["command"].startswith(claim.command.partition(" (seeds")[0]), claim.name


def matches(row: dict[str, str], reading: Reading) -> bool:
    return all(re.fullmatch(told, row[name]) for name, told in reading.where)


def test_quick_ones_take_five_minutes_at_most() -> None:
    quick = {claim.command: claim.minutes for claim in all_claims() if claim.runs == "quick"}
    assert sum(quick.values()) <= 5.0


def test_a_tolerance_is_a_distance_and_bounds_are_one_sided() -> None:
    reading = {"at_most": None, "at_least": None, "tolerance": None}
    near = Claim(**{**vars(CLAIM), **reading, "expected": 10.0, "tolerance": 0.5})
    assert [near.holds(x) for x in (9.4, 9.5, 10.5, 10.6)] == [False, True, True, False]
    low = Claim(**{**vars(CLAIM), **reading, "expected": 10.0, "at_least": 9.0})
    assert [low.holds(x) for x in (8.9, 9.0, 99.0)] == [False, True, True]
    high = Claim(**{**vars(CLAIM), **reading, "expected": 10.0, "at_most": 11.0})
    assert [high.holds(x) for x in (-1.0, 11.0, 11.1)] == [True, True, False]
    assert not any(one.holds(float("nan")) for one in (near, low, high))


@pytest.mark.parametrize(
    ("wrong", "why"),
    [
        ({"at_least": 0.0}, "give one of tolerance, at_most, at_least, not 2"),
        ({"at_most": None}, "not 0 of them"),
        ({"runs": "often"}, "must be quick, all or kept, not often"),
        ({"command": "bash run.sh"}, "begins with relguide, python -m or make"),
        ({"runs": "kept"}, "what is kept is read from a table"),
        ({"reading": Reading(table="a.csv")}, "what runs is read from what it prints"),
    ],
)
def test_a_wrong_row_is_refused(wrong: dict[str, object], why: str) -> None:
    with pytest.raises(ValueError, match=why):
        Claim(**{**vars(CLAIM), **wrong})


def test_a_name_that_does_not_exist_is_refused_with_the_one_that_was_meant() -> None:
    assert [claim.name for claim in named_claims(["fig-6a-joins"])] == ["fig-6a-joins"]
    with pytest.raises(ValueError, match=r'no claim "fig-6a-join": is fig-6a-joins meant\?'):
        named_claims(["fig-6a-join"])
    with pytest.raises(ValueError, match=r"docs/claims\.md lists all"):
        named_claims(["zzzzzzzzzz"])
    with pytest.raises(ValueError, match='There is no claim "":'):
        named_claims([""])


def test_the_registry_goes_with_the_library() -> None:
    assert (Path(find_spec("relguide.claims").origin).parent / "claims.toml").is_file()  # type: ignore[union-attr, arg-type]
