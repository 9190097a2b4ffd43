"""`relguide claims` says of each claim whether it holds, and fails where one does not."""

import json
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path

import pytest

from relguide.__main__ import main
from relguide.claims import claim as registry
from relguide.claims import kept, run
from relguide.claims.claim import Claim, Reading
from relguide.claims.run import Running
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
    assert row["measured"]
    assert told.err == "relguide: 1 measured and 0 compared with their tables hold.\n"


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
    assert "1 of 1 claims were not run; the exit status leaves them out" in told.err


def test_what_lacks_a_package_does_not_decide(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    lacking = replace(CLAIM, name="lacking", command="python -m timeit 'import no_such_package'")
    monkeypatch.setattr(registry, "all_claims", lambda: (CLAIM, lacking))
    assert main(["claims", "--quick", "--json"]) == 0
    told = capsys.readouterr()
    assert [row["ok"] for row in json.loads(told.out)["claims"]] == [True, None]
    assert "1 of 2 claims were not run; the exit status leaves them out." in told.err


def test_what_is_kept_is_not_called_measured(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    kept_one = replace(
        CLAIM,
        name="old",
        runs="kept",
        reading=Reading(table="effort.csv", column="late by more than 0.1 s", take="sum"),
    )
    monkeypatch.setattr(registry, "all_claims", lambda: (CLAIM, kept_one))
    assert main(["claims", "--all", "--json"]) == 0
    told = capsys.readouterr()
    assert [row["measured"] for row in json.loads(told.out)["claims"]] == [True, False]
    assert told.err == "relguide: 1 measured and 1 compared with their tables hold.\n"
    assert main(["claims", "old", "--table"]) == 0
    assert [line.split()[-1] for line in capsys.readouterr().out.splitlines() if "(" in line] == [
        "kept"
    ]


def test_a_page_without_its_folder_is_refused_before_anything_runs(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(run, "check_claims", None)  # it would fail if it were called
    folder = tmp_path / "nodir"
    assert main(["claims", "--quick", "--page", str(folder / "x.md")]) == 2
    assert f"There is no folder {folder} for the page" in capsys.readouterr().err


def test_a_run_that_is_stopped_keeps_and_shows_what_it_obtained(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    (tmp_path / "benchmarks" / "results").mkdir(parents=True)
    monkeypatch.setattr(kept, "clone", lambda: tmp_path)
    whole = run.check_claims

    def stopped(claims: Sequence[Claim], root: Path | None) -> Iterator[Running]:
        for now in whole(claims, root):
            yield now
            if now.checked:
                raise KeyboardInterrupt

    monkeypatch.setattr(run, "check_claims", stopped)
    second = replace(FALSE, command="relguide --help")
    monkeypatch.setattr(registry, "all_claims", lambda: (CLAIM, second))
    page = tmp_path / "claims.md"
    assert main(["claims", "--quick", "--json", "--page", str(page)]) == 130
    told = capsys.readouterr()
    assert [row["name"] for row in json.loads(told.out)["claims"]] == ["version"]
    assert "1 of 2 claims were checked. What they obtained is kept." in told.err
    assert kept.read_obtained([CLAIM], tmp_path) == {"version": 0.0}


@pytest.mark.parametrize(
    ("arguments", "why"),
    [
        ([], "Say which claims to check: --quick, --all, or their names."),
        (["version", "--quick"], "Give names, or --quick, or --all."),
        (["versions"], 'There is no claim "versions": is version meant?'),
    ],
)
def test_misuse(arguments: list[str], why: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["claims", *arguments]) == 2
    assert capsys.readouterr().err == f"relguide: {why}\n"
