"""What the benchmark of simulators rests on: the planner is asked, and what is absent is said."""

import sys
from pathlib import Path
from subprocess import CalledProcessError

import pytest

from benchmarks import simulators
from benchmarks.simulators import (
    ASKED,
    NOTE,
    Measured,
    Row,
    absence,
    install,
    our_rate,
    questions,
    table,
    table_cells,
    their_rows,
)
from relguide.flying.guidance.settings import DEFAULT


@pytest.mark.slow
def test_the_planner_is_asked_each_second_until_the_route_is_captured() -> None:
    asked = {name: questions("fig_6b", settings) for name, settings in ASKED.items()}
    assert asked["when needed"] < 10
    assert 800 < asked["each second"] < 1037, "seconds of converging, of all those flown"


def test_a_rate_counts_simulated_seconds(monkeypatch: pytest.MonkeyPatch) -> None:
    times = iter((10.0, 12.0))
    monkeypatch.setattr(simulators, "process_time", lambda: next(times))
    assert our_rate("fig_6b", DEFAULT) == pytest.approx(1037.0 / 2.0, rel=0.05)


def test_rows_are_compared_with_bluesky_as_it_comes() -> None:
    rows = [
        Row(name="relguide", flies="two", step=0.05, asked=907, rate=5000.0),
        Row(name="bluesky-simulator 1.1.1, as it comes", flies="two", step=0.05, rate=100.0),
        Row(name="bluesky-simulator 1.1.1", flies="two", step=1.0, rate=1000.0),
    ]
    cells = table_cells(rows)
    assert cells[0] == ["relguide", "two", "0.05", "907", "5,000", "50.0"]
    assert [row[-1] for row in cells] == ["50.0", "1.0", "10.0"]
    assert [row[-1] for row in table_cells(rows[:1])] == [""], "nothing to compare with"
    assert "OpenAP" in NOTE
    assert table(Measured(rows=rows, absent=[])).caption == NOTE


def test_a_peer_that_cannot_be_installed_is_named_with_the_reason(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(simulators, "PEERS", {"bluesky": "no such requirement"})
    monkeypatch.setattr(simulators, "FOLDER", tmp_path)
    monkeypatch.setattr(simulators, "our_rows", lambda runs: [])
    (tmp_path / "bin").mkdir()
    (tmp_path / "bin" / "python").symlink_to(sys.executable)
    measured = simulators.measure(1)
    assert measured.rows == []
    (said,) = measured.absent
    assert said.startswith("no such requirement could not be installed and run here: ")
    assert said in str(table(measured).caption)


def test_a_peer_that_does_not_run_is_named_too() -> None:
    with pytest.raises(CalledProcessError) as caught:
        their_rows("minisky", sys.executable, 1)
    assert "ModuleNotFoundError" in absence("minisky==0.0.2", caught.value)


def test_an_environment_that_cannot_be_made_is_an_error(tmp_path: Path) -> None:
    (tmp_path / "taken").write_text("")
    with pytest.raises(CalledProcessError):
        install("minisky==0.0.2", tmp_path / "taken")
