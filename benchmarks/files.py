"""`relguide plan --batch` from file to file: how many situations a second, and how much memory.

    python -m benchmarks.files --count 1000000 --turning 0.3

writes so many situations, of which a share has a leader that turns, and has them answered by the
command. `make bench` does that beside plan() alone on the same situations.
"""

import argparse
import json
import resource
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass, fields
from itertools import islice
from math import degrees
from os import cpu_count
from pathlib import Path
from tempfile import TemporaryDirectory
from threading import Event, Thread
from time import perf_counter, process_time

import numpy as np
from rich.console import Console
from rich.table import Table

from benchmarks.options import positive, share
from benchmarks.throughput import draw_columns
from relguide import Situation, plan
from relguide.contract.bodies import situation_from_json
from relguide.planning.batch import Situations
from relguide.planning.progress import progress_bar

ALONE = 2000
"""Of the situations plan() is asked alone."""
TURNING = 0.3
"""Share of the leaders that turn."""
WRITTEN = 10_000
"""Situations that are drawn at a time."""
LOOK = 0.5
"""Between two looks at how much memory there is [s]."""
RUNS = (
    ("times, JSON lines", "times", "out.jsonl"),
    ("times, to Parquet", "times", "out.parquet"),
    ("plans, JSON lines", "plan", "out.jsonl"),
)
"""What is run: its name, `--fields`, and the file written."""
HEADINGS = ("", "situations", "a second", "CPU of each", "× plan()", "half-way", "most memory")
"""Of the table."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Run:
    """One run, its start included."""

    name: str
    count: int
    """Situations."""
    wall: float
    """[s]."""
    cpu: float
    """CPU time of all its processes [s]."""
    alone: float
    """CPU time of plan() for one of them, in the mean [s]."""
    halfway: float
    """Memory of its own, of all its processes, half-way [MB]."""
    most: float
    """The same at most [MB]."""

    @property
    def ratio(self) -> float:
        """CPU time of a situation in terms of plan() alone."""
        return self.cpu / self.count / self.alone


def measure(count: int, turning: float = TURNING, names: tuple[str, ...] = ()) -> list[Run]:
    """Write situations, and have them answered; with a bar.

    Args:
        count: how many.
        turning: share of the leaders that turn.
        names: of the runs; all if left out.
    """
    runs = [run for run in RUNS if run[0] in names or not names]
    found = []
    with TemporaryDirectory() as folder, progress_bar("Files", total=len(runs)) as done:
        source = Path(folder) / "all.jsonl"
        with source.open("wb") as stream:
            stream.writelines(line + b"\n" for line in draw_lines(count, turning))
        with source.open("rb") as stream:
            alone = _plan_alone([situation_from_json(line)[0] for line in islice(stream, ALONE)])
        for name, wanted, out in runs:
            command = [
                sys.executable, "-m", "relguide", "plan", "--batch", str(source),
                "--fields", wanted, "--out", str(Path(folder) / out),
            ]  # fmt: skip
            before, started, held = _cpu_of_children(), perf_counter(), _follow(command)
            wall, cpu = perf_counter() - started, _cpu_of_children() - before
            found.append(
                Run(
                    name=name, count=count, wall=wall, cpu=cpu, alone=alone,
                    halfway=held[len(held) // 2], most=max(held),
                )
            )  # fmt: skip
            done(1)
    return found


def _follow(command: list[str]) -> list[float]:
    """Run it; the memory of all its processes, again and again [MB]."""
    held, over = [0.0], Event()
    with subprocess.Popen(command, stdout=subprocess.DEVNULL) as process:

        def look() -> None:
            while not over.wait(LOOK):
                held.append(_memory(process.pid))

        looker = Thread(target=look)
        looker.start()
        process.wait()
        over.set()
        looker.join()
    if process.returncode:
        raise subprocess.CalledProcessError(process.returncode, command)
    return held


def _memory(pid: int) -> float:
    """Memory of a process and its children that they share with no other [MB]; 0 if it is gone."""
    try:
        children = Path(f"/proc/{pid}/task/{pid}/children").read_text().split()
        held = 0.0
        for one in (str(pid), *children):
            for line in Path(f"/proc/{one}/smaps_rollup").read_text().splitlines():
                if line.startswith("Pss:"):
                    held += float(line.split()[1]) / 1024.0
    except OSError:
        return 0.0
    return held


def draw_lines(count: int, turning: float) -> Iterator[bytes]:
    """As `draw_columns`, with the limit, a line of JSON each.

    Args:
        count: how many.
        turning: share of the leaders that turn, once or twice.
    """
    rng = np.random.default_rng(4)
    for first in range(0, count, WRITTEN):
        some = min(WRITTEN, count - first)
        drawn = draw_columns(some, seed=first)
        names = [field.name for field in fields(Situations)]
        columns = [np.broadcast_to(getattr(drawn, name), some).tolist() for name in names]
        for row in zip(*columns, strict=True):
            px, py, psi, tas, bank, lx, ly, leading, leader_tas, distance, nearest, _, _ = row
            pursuer = {
                "x_m": px, "y_m": py, "heading_deg": degrees(psi), "tas_mps": tas,
                "max_bank_deg": degrees(bank),
            }  # fmt: skip
            leader = {"x_m": lx, "y_m": ly, "heading_deg": degrees(leading), "tas_mps": leader_tas}
            if rng.random() < turning:
                leader["intent"] = _intent(rng)
            body = {"pursuer": pursuer, "leader": leader, "slot_distance_m": distance,
                    "min_separation_m": nearest}  # fmt: skip
            yield json.dumps(body).encode()


def _intent(rng: np.random.Generator) -> list[dict[str, object]]:
    pieces: list[dict[str, object]] = []
    for _ in range(int(rng.integers(1, 3))):
        pieces.append({"straight_s": float(rng.uniform(20.0, 300.0))})
        pieces.append(
            {
                "turn_to_heading_deg": float(rng.uniform(0.0, 360.0)),
                "direction": "left" if rng.random() < 0.5 else "right",
                "bank_deg": float(rng.uniform(10.0, 25.0)),
            }
        )
    return pieces


def _plan_alone(situations: list[Situation]) -> float:
    """CPU time of plan(), in the mean [s]."""
    plan(situations[0])  # loads the kernels
    started = process_time()
    for situation in situations:
        plan(situation)
    return (process_time() - started) / len(situations)


def _cpu_of_children() -> float:
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def table(runs: list[Run]) -> Table:
    """What was measured, for people."""
    drawn = Table(title=f"relguide plan --batch on {cpu_count()} cores, its start included")
    for heading in HEADINGS:
        drawn.add_column(heading, justify="right" if heading else "left")
    for run in runs:
        drawn.add_row(
            run.name,
            f"{run.count:,}",
            f"{run.count / run.wall:,.0f}",
            f"{run.cpu / run.count * 1e6:,.0f} µs",
            f"{run.ratio:.2f}",
            f"{run.halfway:,.0f} MB",
            f"{run.most:,.0f} MB",
        )
    return drawn


def main(arguments: list[str] | None = None) -> int:
    """Measure, and print the table."""
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.files",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--count", metavar="N", type=positive, default=50_000)
    parser.add_argument("--turning", metavar="SHARE", type=share, default=TURNING)
    parser.add_argument("--run", action="append", choices=[run[0] for run in RUNS], default=[])
    given = parser.parse_args(arguments)
    Console(width=118).print(table(measure(given.count, given.turning, tuple(given.run))))
    return 0


if __name__ == "__main__":
    sys.exit(main())
