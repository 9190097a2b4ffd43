"""A bar for people who wait, and nothing for anybody else."""

import sys
from time import sleep

import pytest

from relguide.planning import progress
from relguide.planning.progress import progress_bar, watched


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
        for item in watched(range(2), title="planning", total=2, done=float):
            sleep(0.01)
            count(item)
    assert capsys.readouterr().err == ""
