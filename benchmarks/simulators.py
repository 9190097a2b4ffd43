"""How many seconds a second of CPU time simulates: our closed loop, BlueSky and minisky.

    python -m benchmarks.simulators --runs 9

They do other things, and each row says which. Ours flies two aircraft and plans; the others are
made for the traffic of a whole airspace, and simulate two here because ours does.
"""

import argparse
import json
import sys
from collections.abc import Iterable
from dataclasses import dataclass, replace
from pathlib import Path
from subprocess import CalledProcessError, run
from time import process_time

from rich.console import Console
from rich.table import Table

from benchmarks.options import positive
from relguide.flying.documents import Document
from relguide.flying.flight import fly
from relguide.flying.guidance.settings import DEFAULT, Settings
from relguide.flying.scenarios import scenario
from relguide.planning.outcome import NoPlan, Plan
from relguide.planning.plan import plan
from relguide.planning.situation import Situation

PEERS = {"bluesky": "bluesky-simulator==1.1.1", "minisky": "minisky==0.0.2"}
"""Modules, and what pip installs for them."""
FOLDER = Path(__file__).parents[1] / ".make" / "peers"
"""Their environment: they need other versions of numpy."""
SCRIPT = Path(__file__).with_name("two_aircraft.py")
STEPS = {"bluesky": (0.05, 1.0), "minisky": (0.05, 1.0)}
"""Of the peers' integration [s]; one of the two is each one's default."""
DEFAULTS = {"bluesky": 0.05, "minisky": 1.0}
STEPS_OF_A_RUN = 1200
"""How many steps of a peer are a run: a minute of simulated time at 20 Hz."""
FIGURES = ("fig_6a", "fig_6b")
ASKED = {"when needed": DEFAULT, "each second": replace(DEFAULT, always_ask=True)}
"""When the planner is asked, and the settings for it."""
OURS = "two that roll, one guided; thrust and drag"
THEIRS = "two straight on; no roll, guidance or plan"
"""What flies, and what is left out."""
HEADINGS = ("", "aircraft", "step s", "asked", "simulated s / CPU s", "of BlueSky's")
NOTE = """relguide: autopilot and roll at 20 Hz; guidance, forecasts and a sample each second, all
documents made; "asked" is how often the planner was. It flies level, without fuel.
BlueSky and minisky: level flight with OpenAP's performance, conflict detection off; bank is at once
what is asked for. They are made for many: a step costs hardly more with a hundred aircraft."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Row:
    """One way to simulate two aircraft, measured."""

    name: str
    flies: str
    step: float
    """Of the integration [s]."""
    asked: int = 0
    """How often the planner was, in the whole flight."""
    rate: float
    """Simulated seconds in a second of CPU time, at best."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Measured:
    """All rows of one run."""

    rows: list[Row]
    absent: list[str]
    """Sentences about what could not be measured."""


def measure(runs: int) -> Measured:
    """Simulate each so often; the first time, peers are installed."""
    absent, rows = [], our_rows(runs)
    for name, requirement in PEERS.items():
        try:
            python = install(requirement, FOLDER)
            rows += their_rows(name, python, runs)
        except CalledProcessError as error:
            absent.append(absence(requirement, error))
    return Measured(rows=rows, absent=absent)


def our_rows(runs: int) -> list[Row]:
    """Both figures, the planner asked when needed and each second; in turns."""
    kinds = [(figure, asked) for figure in FIGURES for asked in ASKED]
    counts = {kind: questions(kind[0], ASKED[kind[1]]) for kind in kinds}  # compiles, too
    best = dict.fromkeys(kinds, 0.0)
    for _ in range(runs):
        for figure, asked in kinds:
            rate = our_rate(figure, ASKED[asked])
            best[figure, asked] = max(best[figure, asked], rate)
    return [
        Row(
            name=f"relguide, {figure}, planner asked {asked}",
            flies=OURS,
            step=0.05,
            asked=counts[figure, asked],
            rate=best[figure, asked],
        )
        for figure, asked in kinds
    ]


def our_rate(figure: str, settings: Settings) -> float:
    """Simulated seconds in a second of CPU time, documents included."""
    started = process_time()
    until = last_of(fly(scenario(figure), plan, sample_period=1.0, settings=settings)).t
    return until / (process_time() - started)


def questions(figure: str, settings: Settings) -> int:
    """How often the planner is asked in a flight."""
    count = 0

    def counting(situation: Situation) -> Plan | NoPlan:
        nonlocal count
        count += 1
        return plan(situation)

    last_of(fly(scenario(figure), counting, sample_period=1.0, settings=settings))
    return count


def last_of(documents: Iterable[Document]) -> Document:
    """The last one, all of them made."""
    *_, last = documents
    return last


def install(requirement: str, folder: Path) -> str:
    """Install a package into an environment, which is made if it is not there.

    Returns:
        the environment's Python.

    Raises:
        CalledProcessError: if that fails; its `stderr` says why.
    """
    python = str(folder / "bin" / "python")
    if not Path(python).exists():
        _output(sys.executable, "-m", "venv", str(folder))
    _output(python, "-m", "pip", "--disable-pip-version-check", "install", "-q", requirement)
    return python


def their_rows(name: str, python: str, runs: int) -> list[Row]:
    """A peer at each of its steps."""
    rows = []
    for step in STEPS[name]:
        given = name, str(step), str(STEPS_OF_A_RUN * step), str(runs)
        *_, last = _output(python, "-P", str(SCRIPT), *given).splitlines()
        default = ", as it comes" if step == DEFAULTS[name] else ""
        row = Row(
            name=PEERS[name].replace("==", " ") + default,
            flies=THEIRS,
            step=step,
            rate=max(json.loads(last)),
        )
        rows.append(row)
    return rows


def _output(*command: str) -> str:
    return run(command, check=True, capture_output=True, text=True).stdout


def absence(requirement: str, error: CalledProcessError) -> str:
    """Why a peer is not in the table."""
    said = (error.stderr or "").strip().splitlines()
    why = said[-1] if said else f"it ended with {error.returncode}"
    return f"{requirement} could not be installed and run here: {why}"


def table(measured: Measured) -> Table:
    """What was measured, for people."""
    drawn = Table(title="Simulating two aircraft, at best: each does other things")
    for heading in HEADINGS:
        drawn.add_column(heading, justify="left" if heading in HEADINGS[:2] else "right")
    for cells in table_cells(measured.rows):
        drawn.add_row(*cells)
    drawn.caption = "\n".join((NOTE, *measured.absent))
    drawn.caption_justify = "left"
    return drawn


def table_cells(rows: list[Row]) -> list[list[str]]:
    """Name, what flies, step, questions, rate, and its ratio to BlueSky's as it comes."""
    theirs = [row.rate for row in rows if row.name.startswith("bluesky") and row.step == 0.05]
    base = theirs[0] if theirs else None
    return [
        [
            row.name,
            row.flies,
            f"{row.step:g}",
            f"{row.asked:,}" if row.asked else "",
            f"{row.rate:,.0f}",
            f"{row.rate / base:,.1f}" if base else "",
        ]
        for row in rows
    ]


def add_runs(parser: argparse.ArgumentParser) -> None:
    """How often to simulate."""
    told = "runs of each simulator, of which the fastest counts (7)"
    parser.add_argument("--runs", metavar="N", type=positive, default=7, help=told)


def main(arguments: list[str] | None = None) -> int:
    """Measure, and print the table."""
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.simulators", description=__doc__.splitlines()[0]
    )
    add_runs(parser)
    Console(width=118).print(table(measure(parser.parse_args(arguments).runs)))
    return 0


if __name__ == "__main__":
    sys.exit(main())
