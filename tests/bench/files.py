"""`relguide plan --batch` from file to file, beside plan() alone on the same situations."""

import json
import resource
import subprocess
import sys
from dataclasses import dataclass, fields
from math import degrees
from os import cpu_count
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter, process_time

import numpy as np
from rich.table import Table

from relguide import Situation, plan
from relguide.contract.bodies import situation_from_json
from relguide.planning.batch import Situations
from relguide.planning.progress import progress_bar
from tests.bench.throughput import draw_columns

ALONE = 2000
"""Of the situations plan() is asked alone."""
RUNS = (
    ("times, JSON lines", "times", "out.jsonl"),
    ("times, to Parquet", "times", "out.parquet"),
    ("plans, JSON lines", "plan", "out.jsonl"),
)
"""What is run: its name, `--fields`, and the file written."""
HEADINGS = ("", "situations", "a second", "CPU of each", "× plan()")
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

    @property
    def ratio(self) -> float:
        """CPU time of a situation in terms of plan() alone."""
        return self.cpu / self.count / self.alone


def measure(count: int) -> list[Run]:
    """Write situations, and have them answered; with a bar."""
    lines = _lines(count)
    alone = _plan_alone([situation_from_json(line)[0] for line in lines[:ALONE]])
    found = []
    with TemporaryDirectory() as folder, progress_bar("Files", total=len(RUNS)) as done:
        source = Path(folder) / "all.jsonl"
        source.write_bytes(b"".join(line + b"\n" for line in lines))
        for name, wanted, out in RUNS:
            before, started = _cpu_of_children(), perf_counter()
            subprocess.run(
                [
                    sys.executable, "-m", "relguide", "plan", "--batch", str(source),
                    "--fields", wanted, "--out", str(Path(folder) / out),
                ],
                check=True, stdout=subprocess.DEVNULL,
            )  # fmt: skip
            wall, cpu = perf_counter() - started, _cpu_of_children() - before
            found.append(Run(name=name, count=count, wall=wall, cpu=cpu, alone=alone))
            done(1)
    return found


def _lines(count: int) -> list[bytes]:
    """As `draw_columns`, with the limit, a line of JSON each."""
    drawn = draw_columns(count)
    names = [field.name for field in fields(Situations)]
    columns = [np.broadcast_to(getattr(drawn, name), count).tolist() for name in names]
    lines = []
    for row in zip(*columns, strict=True):
        px, py, psi, tas, bank, lx, ly, leading, leader_tas, distance, nearest, _, _ = row
        pursuer = {
            "x_m": px, "y_m": py, "heading_deg": degrees(psi), "tas_mps": tas,
            "max_bank_deg": degrees(bank),
        }  # fmt: skip
        leader = {"x_m": lx, "y_m": ly, "heading_deg": degrees(leading), "tas_mps": leader_tas}
        body = {"pursuer": pursuer, "leader": leader, "slot_distance_m": distance,
                "min_separation_m": nearest}  # fmt: skip
        lines.append(json.dumps(body).encode())
    return lines


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
        )
    return drawn
