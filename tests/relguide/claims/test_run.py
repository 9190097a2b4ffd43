"""Commands of claims run once, and what does not hold or does not run is never a success."""

import re
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import pytest

from relguide.claims import run
from relguide.claims.claim import Claim, Reading, all_claims
from relguide.claims.run import Checked, arguments_of, check_claims, total_minutes
from tests.pages import ROOT

CLAIM = Claim(
    name="version",
    sentence="It prints its version.",
    page="README.md",
    said="two commands",
    command="relguide --version",
    reading=Reading(pattern=r"relguide (\d+)"),
    expected=0.0,
    at_most=9.0,
    minutes=0.1,
    test="tests/test_pages.py::test_links_lead_somewhere",
    runs="quick",
)


def check(claims: Sequence[Claim], root: Path | None = ROOT) -> tuple[Checked, ...]:
    *_, last = check_claims(claims, root)
    return last.checked


def test_claims_of_one_command_run_it_once(monkeypatch: pytest.MonkeyPatch) -> None:
    begun = list[list[str]]()
    popen = subprocess.Popen

    def counted(arguments: list[str], **options: object) -> object:
        begun.append(arguments)
        return popen(arguments, **options)  # type: ignore[call-overload]

    monkeypatch.setattr(subprocess, "Popen", counted)
    twice = replace(CLAIM, name="again")
    assert total_minutes([CLAIM, twice]) == 0.1
    assert [one.ok for one in check([CLAIM, twice])] == [True, True]
    assert begun == [[sys.executable, "-m", "relguide", "--version"]]


def test_what_is_out_of_tolerance_fails() -> None:
    (one,) = check([replace(CLAIM, at_most=None, at_least=10.0)])
    assert (one.ok, one.failed, one.ran) == (False, True, True)


@pytest.mark.parametrize(
    ("command", "why"),
    [
        ("relguide --help", "did not print what matches"),
        ("relguide fly no_such_flight", "exit status 2.*no_such_flight"),
        ("python -m tests.no_such_program", "No module named tests.no_such_program"),
    ],
)
def test_a_command_that_gives_no_number_fails_with_what_it_says(command: str, why: str) -> None:
    (one,) = check([replace(CLAIM, command=command)])
    assert one.failed
    assert re.search(why, one.why), one.why


def test_what_is_printed_before_a_mistake_is_no_result(monkeypatch: pytest.MonkeyPatch) -> None:
    program = "print('relguide 0', flush=True); 1 / 0"
    monkeypatch.setattr(run, "arguments_of", lambda _: [sys.executable, "-c", program])
    (one,) = check([CLAIM])
    assert one.failed
    assert one.why == "It ended with the exit status 1. ZeroDivisionError: division by zero"


def test_after_what_fails_the_rest_is_checked(monkeypatch: pytest.MonkeyPatch) -> None:
    programs = {
        "killed": "import os; os.abort()",
        "garbled": "import sys; sys.stdout.buffer.write(bytes([255]))",
        "share": """print('{"part": 0, "whole": 0}')""",
        "out": "print('relguide 10')",
        "holds": "print('relguide 9')",
    }
    monkeypatch.setattr(
        run, "arguments_of", lambda said: [sys.executable, "-c", programs[said.split()[1]]]
    )
    rows = [replace(CLAIM, name=name, command=f"relguide {name}") for name in programs]
    rows[2] = replace(rows[2], reading=Reading(json="part", over="whole"))
    table = replace(CLAIM, name="table", runs="kept", reading=Reading(table="no_such.csv"))
    *failed, last = check([table, *rows])
    assert [one.claim.name for one in failed if one.failed] == ["table", *programs][:-1]
    assert last.ok
    assert failed[0].why == "There is no table no_such.csv."
    assert "share of nothing" in failed[3].why


def test_from_a_wheel_what_needs_a_clone_does_not_run() -> None:
    alone, file, benchmark = check(
        [
            CLAIM,
            replace(CLAIM, name="file", command="relguide plan examples/situation.json"),
            replace(CLAIM, name="benchmark", command="python -m benchmarks.deadline"),
        ],
        None,
    )
    assert alone.ok
    for one in (file, benchmark):
        assert (one.ok, one.failed, one.ran) == (False, False, False)
        assert one.why == "It needs a clone of the repository."


def test_a_missing_package_is_no_failure(monkeypatch: pytest.MonkeyPatch) -> None:
    program = "import sys; sys.exit('relguide: pip install relguide[learn] brings torch.')"
    refuse = [
        sys.executable,
        "-c",
        program.replace("sys.exit(", "sys.stderr.write(") + "; sys.exit(2)",
    ]
    monkeypatch.setattr(run, "arguments_of", lambda _: refuse)
    (one,) = check([CLAIM])
    assert (one.ok, one.failed, one.ran) == (False, False, False)
    assert "relguide[learn]" in one.why


def test_how_far_it_is_never_falls_and_ends_at_all_minutes() -> None:
    twice = [CLAIM, replace(CLAIM, name="other", command="relguide --help")]
    reached = [now.minutes for now in check_claims(twice, ROOT)]
    assert reached == sorted(reached)
    assert reached[-1] == pytest.approx(total_minutes(twice))


def test_what_does_not_run_counts_as_done() -> None:
    two = [CLAIM, replace(CLAIM, name="benchmark", command="python -m benchmarks.deadline")]
    *_, last = check_claims(two, None)
    assert last.minutes == pytest.approx(total_minutes(two))


def test_what_a_command_obtained_is_known_before_the_next_begins() -> None:
    second = replace(CLAIM, name="other", command="relguide --help")
    known = [len(now.checked) for now in check_claims([CLAIM, second], ROOT) if now.command]
    assert known[-1] == 2
    begun = [now for now in check_claims([CLAIM, second], ROOT) if now.command == CLAIM.command]
    assert (len(begun[-1].checked), begun[-1].minutes) == (1, CLAIM.minutes)


def test_every_command_can_be_run_by_this_python() -> None:
    for claim in all_claims():
        if claim.runs != "kept":
            assert arguments_of(claim.command)[0] == sys.executable
    with pytest.raises(ValueError, match="make is not run from here"):
        arguments_of("make bench")
