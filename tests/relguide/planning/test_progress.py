"""A bar for people who wait, and nothing for anybody else."""

import sys
from time import sleep

import pytest

from relguide.planning import progress
from relguide.planning.progress import progress_bar, show_progress


class _Terminal:
    """Standard error as a terminal, with what was written to it."""

    def __init__(self) -> None:
        self.text = ""

    def write(self, text: str) -> int:
        self.text += text
        return len(text)

    def flush(self) -> None:
        pass

    def isatty(self) -> bool:
        return True


def _at_a_terminal(monkeypatch: pytest.MonkeyPatch) -> _Terminal:
    """To be called within the test: pytest sets standard error anew for each phase."""
    terminal = _Terminal()
    monkeypatch.setattr(sys, "stderr", terminal)
    monkeypatch.setattr(progress, "PATIENCE", 0.05)
    monkeypatch.setenv("TERM", "xterm")
    return terminal


def test_a_bar_comes_when_it_takes_long(monkeypatch: pytest.MonkeyPatch) -> None:
    terminal = _at_a_terminal(monkeypatch)
    with progress_bar("planning", total=20) as count:
        for _ in range(20):
            sleep(0.02)
            count(1)
    assert "planning" in terminal.text


def test_what_is_quick_shows_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    terminal = _at_a_terminal(monkeypatch)
    with progress_bar("planning", total=1) as count:
        count(1)
    assert terminal.text == ""


def test_a_file_gets_no_bar(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(progress, "PATIENCE", 0.0)
    with progress_bar("planning", total=2) as count:
        for item in show_progress(range(2), title="planning", total=2, done=float):
            sleep(0.01)
            count(item)
    assert capsys.readouterr().err == ""


def test_a_log_gets_a_line_now_and_then(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(progress, "LOGGED", 0.1)
    for _ in show_progress(range(1, 41), title="auditing", total=40, done=float):
        sleep(0.02)
    lines = capsys.readouterr().err.splitlines()
    assert 2 <= len(lines) <= 10
    assert all(line.startswith("auditing ") and line.endswith(" s left") for line in lines)


def test_it_says_how_far_and_is_taken_away(monkeypatch: pytest.MonkeyPatch) -> None:
    terminal = _at_a_terminal(monkeypatch)
    monkeypatch.setattr(progress, "PATIENCE", 0.0)
    monkeypatch.setattr(progress, "REFRESH", 0.0)
    monkeypatch.setenv("COLUMNS", "100")
    for _ in show_progress(
        range(1, 5), title="proving", total=4, done=float, state=lambda n: f"gap {n}"
    ):
        while not terminal.text:
            sleep(0.01)
    lines = [line.rstrip() for line in terminal.text.split("\r")]
    assert "proving …" in lines
    (half,) = {line for line in lines if "gap 2" in line}
    assert f"proving gap 2 {20 * '━'}{20 * '╌'}  50%, 0 s left" == half
    assert max(map(len, lines)) < 100
    assert lines[-2:] == ["", ""]


def test_where_the_end_is_not_known_it_says_so_much(monkeypatch: pytest.MonkeyPatch) -> None:
    terminal = _at_a_terminal(monkeypatch)
    with progress_bar("explaining gaps", total=0.0) as count:
        while not terminal.text:
            sleep(0.01)
        count(1)
    assert "explaining gaps …" in terminal.text
    assert "%" not in terminal.text
