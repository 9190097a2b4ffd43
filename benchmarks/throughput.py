"""How many situations a second `plan_arrays` answers, on all cores."""

from dataclasses import dataclass
from functools import partial
from math import pi, radians
from os import cpu_count
from time import perf_counter, process_time

import numpy as np
from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn
from rich.table import Table

from benchmarks.cases import SEED, Case
from relguide.planning.batch import Situations, plan_arrays
from tests.columns import columns_of

COLUMNS = (TextColumn("{task.description}"), BarColumn(), TimeRemainingColumn())
HEADINGS = ("", "situations", "a second", "a second of CPU")
"""Of the table."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Throughput:
    """One batch."""

    name: str
    count: int
    """Situations."""
    wall: float
    """How long it took [s]."""
    cpu: float
    """CPU time of all cores together [s]."""


def measure(count: int, limited: int, active: list[Case]) -> list[Throughput]:
    """Plan a batch without the limit, and one of situations in which it is active.

    Args:
        count: how many are drawn for the first.
        limited: how many make up the second.
        active: which are repeated for the second, the limit active in each.
    """
    repeated = [active[i % len(active)].situation for i in range(limited)]
    batches = (
        ("without the limit", draw_columns(count), False),
        ("where it binds", columns_of(repeated), True),
    )
    plan_arrays(draw_columns(1), limited=False)  # compiles
    plan_arrays(columns_of(repeated[:1]))
    found = []
    for name, situations, keeps in batches:
        size = limited if keeps else count
        bar = Progress(*COLUMNS, console=Console(stderr=True), transient=True)
        task = bar.add_task(f"In batches: {name}", total=size)
        with bar:
            wall, cpu = perf_counter(), process_time()
            plan_arrays(situations, limited=keeps, progress=partial(bar.advance, task))
            took = Throughput(
                name=name, count=size, wall=perf_counter() - wall, cpu=process_time() - cpu
            )
        found.append(took)
    return found


def draw_columns(count: int, seed: int = SEED) -> Situations:
    """As `draws.anywhere`, by the column."""
    rng = np.random.default_rng(seed)
    far, bearing = rng.uniform(15e3, 150e3, count), rng.uniform(0.0, 2.0 * pi, count)
    tas = rng.uniform(180.0, 250.0, count)
    return Situations(
        pursuer_x=far * np.sin(bearing),
        pursuer_y=far * np.cos(bearing),
        pursuer_heading=rng.uniform(0.0, 2.0 * pi, count),
        pursuer_tas=tas,
        max_bank=rng.uniform(radians(15.0), radians(30.0), count),
        leader_heading=rng.uniform(0.0, 2.0 * pi, count),
        leader_tas=tas * rng.uniform(0.6, 0.98, count),
        slot_distance=rng.uniform(10e3, 20e3, count),
        min_separation=rng.uniform(5.5e3, 9.3e3, count),
    )


def table(batches: list[Throughput]) -> Table:
    """What was measured, for people."""
    drawn = Table(title=f"plan_arrays() on {cpu_count()} cores")
    for heading in HEADINGS:
        drawn.add_column(heading, justify="right" if heading else "left")
    for cells in table_cells(batches):
        drawn.add_row(*cells)
    return drawn


def table_cells(batches: list[Throughput]) -> list[list[str]]:
    """Name, situations, how many a second on the wall and of CPU time."""
    return [
        [
            f"plan_arrays(), {batch.name}",
            f"{batch.count:,}",
            f"{batch.count / batch.wall:,.0f}",
            f"{batch.count / batch.cpu:,.0f}",
        ]
        for batch in batches
    ]
