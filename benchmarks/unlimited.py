"""Without the limit: the kernel and plan() beside other ways to the same optimum."""

from collections.abc import Callable
from dataclasses import dataclass, field
from math import inf
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory

import numpy as np
from rich.table import Table

from benchmarks.cases import Case
from benchmarks.dubins_curves import Length, meeting_time, shortest_length
from benchmarks.exhaustive import least_time
from benchmarks.timing import time_call
from benchmarks.trochoids import Trochoids
from relguide import NoPlan, Plan, plan
from relguide.kernels.words.extremals import MAX_ROWS, solve
from relguide.planning.progress import show_progress

REPEATS = 5
"""Each case is timed this often, and its median counts."""
MISS = 0.1
"""An answer this much off the optimum [s] is a miss."""
KERNEL = "kernel: all extremals, all roots"
PLAN = "plan(): kernel, certificate, proof"
DUBINS = "dubins (PyPI), bisection on T"
EXHAUSTIVE = "every word scanned, signs bisected"
OMPL = "OMPL TrochoidStateSpace"

HEADINGS = (
    "", "cases", "median µs", "99 % µs", "× kernel", f"off by > {MISS:g} s", "worst s",
)  # fmt: skip
"""Of the table."""

Solve = Callable[[], float | None]
"""Answers a case [s]; None when this contender solves another problem there (the limit binds)."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Row:
    """What one contender did, case by case."""

    name: str
    times: list[float] = field(default_factory=list)
    """CPU time of an answer [s]."""
    errors: list[float] = field(default_factory=list)
    """Answer less optimum [s]."""

    @property
    def misses(self) -> int:
        return sum(abs(error) > MISS for error in self.errors)

    @property
    def worst(self) -> float:
        """The largest error, to a tenth and without the sign of a zero [s]."""
        largest: float = max(self.errors, key=abs)
        return round(largest, 1) + 0.0


def measure(cases: list[Case]) -> dict[str, Row]:
    """Set all contenders all cases, in turns: a busy machine is busy for all."""
    with TemporaryDirectory() as folder:
        length = shortest_length(Path(folder))
        contenders: dict[str, Callable[[Case], Solve]] = {
            KERNEL: _kernel,
            PLAN: _full_plan,
            DUBINS: lambda case: _dubins_bisection(case, length),
            EXHAUSTIVE: _exhaustive,
            OMPL: lambda case: Trochoids(case).time,
        }
        rows = {name: Row(name=name) for name in contenders}
        for prepare in contenders.values():
            prepare(cases[0])()  # compiles, loads, fills caches
        for _, case in show_progress(
            enumerate(cases), title="Without the limit", total=len(cases), done=lambda n: n[0]
        ):
            results = {name: time_call(make(case), REPEATS) for name, make in contenders.items()}
            optimum = _best_known(case, length, {name: t for name, (_, t) in results.items()})
            for name, (cpu, answer) in results.items():
                if answer is not None:
                    rows[name].times.append(cpu)
                    rows[name].errors.append(answer - optimum)
    return rows


def _kernel(case: Case) -> Solve:
    frame, rows, unit = case.frame, np.empty((MAX_ROWS, 5)), case.unit

    def answer() -> float:
        found = solve(frame.pose, frame.alpha, frame.t_release, rows)
        return float(rows[0, 0]) * unit if found else inf

    return answer


def _full_plan(case: Case) -> Solve:
    def answer() -> float | None:
        match plan(case.situation):
            case Plan(optimality=optimality, time_to_converge=time):
                return time if optimality.proof == "relaxation" else None
            case NoPlan():
                return None

    return answer


def _dubins_bisection(case: Case, length: Length) -> Solve:
    frame, unit = case.frame, case.unit

    def answer() -> float:
        return meeting_time(length, frame.x, frame.y, frame.h, frame.alpha) * unit

    return answer


def _exhaustive(case: Case) -> Solve:
    frame, unit = case.frame, case.unit

    def answer() -> float:
        return float(least_time(frame.x, frame.y, frame.h, frame.alpha)) * unit

    return answer


def _best_known(case: Case, length: Length, answers: dict[str, float | None]) -> float:
    """The golden optimum; without one, the fastest answer that really flies to the slot [s]."""
    if case.optimum is not None:
        return case.optimum
    names = [KERNEL, EXHAUSTIVE]
    if Trochoids(case).arrives():
        names.append(OMPL)
    frame, by_bisection = case.frame, answers[DUBINS]
    assert by_bisection is not None
    tau = by_bisection / case.unit
    # where the shortest length jumps, bisection ends on a time that no path takes
    if abs(length(frame.x, frame.y, frame.h, frame.alpha * tau) - tau) < 1e-6:
        names.append(DUBINS)
    return min(answer for name in names if (answer := answers[name]) is not None)


def slowness(rows: dict[str, Row], name: str) -> float:
    """A contender's median time over the kernel's."""
    return median(rows[name].times) / median(rows[KERNEL].times)


def table(rows: dict[str, Row], cases: list[Case]) -> Table:
    """What was measured, for people."""
    golden = sum(case.optimum is not None for case in cases)
    drawn = Table(
        title=f"Without the limit: {len(cases)} situations, straight leader, calm, {golden} "
        f"golden, {len(cases) - golden} drawn; CPU time, the median of {REPEATS} runs each",
    )
    for heading in HEADINGS:
        drawn.add_column(heading, justify="right" if heading else "left")
    for cells in table_cells(rows):
        drawn.add_row(*cells)
    return drawn


def table_cells(rows: dict[str, Row]) -> list[list[str]]:
    """Name, cases, median and 99 % [µs], times the kernel's, misses and the worst of them [s]."""
    return [
        [
            row.name,
            str(len(row.times)),
            f"{median(row.times) * 1e6:,.0f}",
            f"{np.percentile(row.times, 99) * 1e6:,.0f}",
            f"{slowness(rows, row.name):,.1f}",
            str(row.misses),
            f"{row.worst:+.1f}",
        ]
        for row in rows.values()
    ]
