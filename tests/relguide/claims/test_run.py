"""Commands of claims run once, and what does not hold or does not run is never a success."""

import subprocess
import sys
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import pytest

from relguide.claims.claim import Claim, Reading
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
        ("relguide fly no_such_scenario", "ended with the exit status 2.*no_such_scenario"),
        ("python -c 'raise SystemExit(3)'", "exit status 3"),
    ],
)
def test_a_command_that_breaks_off_fails_with_what_it_says(command: str, why: str) -> None:
    claim = CLAIM
    object.__setattr__(claim := replace(CLAIM), "command", command)
    (one,) = check([claim])
    assert one.failed
    assert pytest.raises(ValueError, match=why).__class__  # the sentence is matched below
    import re

    assert re.search(why, one.why, re.DOTALL), one.why
