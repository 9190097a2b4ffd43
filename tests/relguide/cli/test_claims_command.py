"""`relguide claims` says of each claim whether it holds, and fails where one does not."""

import json
from dataclasses import replace

import pytest

from relguide.__main__ import main
from relguide.claims import claim as registry
from relguide.claims import kept
from tests.relguide.claims.test_run import CLAIM

FALSE = replace(CLAIM, name="false", at_most=None, at_least=10.0)


@pytest.fixture(autouse=True)
def registered(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(registry, "all_claims", lambda: (CLAIM, FALSE))


def test_what_holds(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["claims", "version", "--json"]) == 0
    told = capsys.readouterr()
    (row,) = json.loads(told.out)["claims"]
    assert (row["name"], row["obtained"], row["ok"]) == ("version", 0.0, True)
    assert told.err == "relguide: 1 of 1 claims hold.\n"


def test_what_does_not_hold_is_named_and_fails(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["claims", "--quick", "--table"]) == 1
    told = capsys.readouterr()
    assert [line.split()[-1] for line in told.out.splitlines() if "(" in line] == ["yes", "NO"]
    assert told.err == "relguide: 1 of 2 claims do not hold: false.\n"


def test_where_nothing_runs_nothing_is_passed(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    far = replace(CLAIM, command="python -m benchmarks.deadline")
    monkeypatch.setattr(registry, "all_claims", lambda: (far,))
    monkeypatch.setattr(kept, "clone", lambda: None)
    assert main(["claims", "--all", "--json"]) == 1
    told = capsys.readouterr()
    (row,) = json.loads(told.out)["claims"]
    assert (row["obtained"], row["ok"]) == (None, None)
    assert "1 of 1 claims were not run, so nothing is said of them" in told.err


@pytest.mark.parametrize(
    ("arguments", "why"),
    [
        ([], "Say which claims to check: --quick, --all, or their names."),
        (["version", "--quick"], "Give names, or --quick, or --all."),
        (["versions"], "There is no claim versions: is version meant?"),
    ],
)
def test_misuse(arguments: list[str], why: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["claims", *arguments]) == 2
    assert capsys.readouterr().err == f"relguide: {why}\n"
