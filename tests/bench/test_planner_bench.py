"""How fast the planner is beside what else there is, on the same cases in one run: `make bench`."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from math import pi
from pathlib import Path
from statistics import median
from time import perf_counter_ns

import numpy as np
from ompl import base as ob
from rich.console import Console
from rich.table import Table

from relguide import NoPlan, Plan, plan
from relguide.kernels.extremals import MAX_ROWS, solve
from tests.bench.cases import Case, all_cases
from tests.bench.dubins_curves import Length, meeting_time, shortest_length

REPEATS = 5
"""Each case is timed this often, and its median counts."""
MISS = 0.1
"""An answer this much off the optimum [s] is a miss."""
KERNEL, PLAN = "kernel: all extremals, all roots", "plan(): kernel, certificate, proof"
LIMITED = "plan() where the limit binds"
OMPL, DUBINS = "OMPL TrochoidStateSpace", "dubins (PyPI) + bisection on T"

Solve = Callable[[], float | None]
"""Answers a case [s]; None when this contender solves another problem there (the limit binds)."""


@dataclass(frozen=True, slots=True)
class Row:
    """What one contender did."""

    name: str
    times: list[float]
    """One a case [µs]."""
    errors: list[float]
    """Answer less optimum, one a case [s]; empty where there is none to compare with."""

    @property
    def misses(self) -> int:
        return sum(abs(error) > MISS for error in self.errors)


def test_planner_against_its_peers(tmp_path: Path) -> None:
    cases = all_cases()
    length = shortest_length(tmp_path)
    contenders: dict[str, Callable[[Case], Solve]] = {
        KERNEL: kernel,
        PLAN: full_plan,
        OMPL: ompl_trochoid,
        DUBINS: lambda case: dubins_bisection(case, length),
    }
    solvers = {name: [prepare(case) for case in cases] for name, prepare in contenders.items()}
    for one_each in solvers.values():
        one_each[0]()  # compiles, loads, fills caches
    times: dict[str, list[float]] = {name: [] for name in contenders}
    answers: dict[str, list[float | None]] = {name: [] for name in contenders}
    for number in range(len(cases)):
        for name, prepared in solvers.items():  # side by side: a busy machine is busy for all
            microseconds, answer = timed(prepared[number])
            times[name].append(microseconds)
            answers[name].append(answer)
    by_others = zip(*(answers[name] for name in (KERNEL, OMPL, DUBINS)), strict=True)
    pairs = zip(cases, by_others, strict=True)
    optima = [best_known(case, length, *given) for case, given in pairs]
    rows = {row.name: row for name in contenders for row in split(name, times, answers, optima)}
    Console(width=110).print(table(list(rows.values()), cases))

    assert rows[KERNEL].misses == 0
    assert rows[PLAN].misses == 0
    # a ratio within one run holds on any machine
    assert median(rows[OMPL].times) > 40.0 * median(rows[KERNEL].times)


def split(
    name: str,
    times: dict[str, list[float]],
    answers: dict[str, list[float | None]],
    optima: list[float],
) -> Iterator[Row]:
    """A contender's row; and a second one for where the limit binds, which only plan() knows of."""
    all_of_it = list(zip(times[name], answers[name], optima, strict=True))
    compared = [(time, answer - best) for time, answer, best in all_of_it if answer is not None]
    yield Row(name, [time for time, _ in compared], [error for _, error in compared])
    rest = [time for time, answer, _ in all_of_it if answer is None]
    if rest:
        yield Row(LIMITED, rest, [])


def kernel(case: Case) -> Solve:
    frame, rows, unit = case.frame, np.empty((MAX_ROWS, 5)), case.unit

    def answer() -> float:
        found = solve(frame.x, frame.y, frame.h, frame.alpha, frame.t_open, rows)
        return float(rows[0, 0]) * unit if found else float("inf")

    return answer


def full_plan(case: Case) -> Solve:
    def answer() -> float | None:
        match plan(case.situation):
            case Plan(optimality=optimality, time_to_converge=time):
                return time if optimality.proof == "relaxation" else None
            case NoPlan():
                return None

    return answer


def ompl_trochoid(case: Case) -> Solve:
    """The slot at rest and the air moving past it: a wind of −V_L along the leader's heading."""
    space, start, goal = trochoid_problem(case)
    unit = case.unit

    def answer() -> float:
        return float(space.distance(start, goal)) * unit

    return answer


def trochoid_problem(case: Case) -> tuple[ob.TrochoidStateSpace, ob.State, ob.State]:
    frame = case.frame
    space = ob.TrochoidStateSpace(1.0, frame.alpha, pi)
    bounds = ob.RealVectorBounds(2)
    bounds.setLow(-1e6)
    bounds.setHigh(1e6)
    space.setBounds(bounds)
    start, goal = space.allocState(), space.allocState()
    start.setX(frame.x)
    start.setY(frame.y)
    start.setYaw(frame.h if frame.h <= pi else frame.h - 2.0 * pi)
    goal.setX(0.0)
    goal.setY(0.0)
    goal.setYaw(0.0)
    return space, start, goal


def dubins_bisection(case: Case, length: Length) -> Solve:
    frame, unit = case.frame, case.unit

    def answer() -> float:
        return meeting_time(length, frame.x, frame.y, frame.h, frame.alpha) * unit

    return answer


def timed(solver: Solve) -> tuple[float, float | None]:
    times = []
    answer = None
    for _ in range(REPEATS):
        start = perf_counter_ns()
        answer = solver()
        times.append((perf_counter_ns() - start) * 1e-3)
    return median(times), answer


def best_known(
    case: Case, length: Length, by_kernel: float, by_trochoid: float, by_bisection: float
) -> float:
    """The golden optimum; without one, the fastest answer that really flies to the slot [s]."""
    if case.optimum is not None:
        return case.optimum
    times = [by_kernel]
    if trochoid_arrives(case):
        times.append(by_trochoid)
    frame, tau = case.frame, by_bisection / case.unit
    # where the shortest length jumps, bisection ends on a time that no path takes
    if abs(length(frame.x, frame.y, frame.h, frame.alpha * tau) - tau) < 1e-6:
        times.append(by_bisection)
    return min(times)


def trochoid_arrives(case: Case) -> bool:
    """Does OMPL's path end in the slot? Looked at just before its end, which OMPL forces there."""
    space, start, goal = trochoid_problem(case)
    last = space.allocState()
    space.interpolate(start, goal, 1.0 - 1e-7, last)
    # 1e-7 of the longest path here, 300 R
    return bool(abs(last.getX()) < 1e-4 and abs(last.getY()) < 1e-4)


def table(rows: list[Row], cases: list[Case]) -> Table:
    golden = sum(case.optimum is not None for case in cases)
    drawn = Table(
        title=f"{len(cases)} situations, straight leader, calm: {golden} golden, "
        f"{len(cases) - golden} drawn; the median of {REPEATS} runs each",
    )
    drawn.add_column("")
    for heading in ("cases", "median µs", "99 % µs", "× kernel", f"off by > {MISS:g} s", "worst s"):
        drawn.add_column(heading, justify="right")
    base = median(rows[0].times)
    for row in rows:
        drawn.add_row(
            row.name,
            str(len(row.times)),
            f"{median(row.times):.1f}",
            f"{np.percentile(row.times, 99):.1f}",
            f"{median(row.times) / base:.1f}",
            str(row.misses) if row.errors else "",
            f"{max(row.errors, key=abs):+.3f}" if row.errors else "",
        )
    return drawn
