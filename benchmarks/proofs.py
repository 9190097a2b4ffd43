"""How often, and how soon, is a plan that d_min made longer proved to a tenth of a second?

    python -m benchmarks.proofs --count 100 --seconds 1 --seed 1

draws situations of four kinds in which the separation limit binds, plans each and proves the plan
until the gap is closed or so much CPU time is spent. A plan whose proof is `relaxation` without
that counts as certified at once. The ten plans with the largest gaps are listed, as code to paste.
In pieces, each of which says what all of them have come to:

    python -m benchmarks.proofs --first 0 --count 250 --pieces proofs.jsonl
    python -m benchmarks.proofs --first 250 --count 250 --pieces proofs.jsonl
"""

import argparse
import sys
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from dataclasses import asdict, dataclass, replace
from functools import partial
from json import dumps, loads
from math import inf
from pathlib import Path
from time import thread_time

import numpy as np
from rich.console import Console
from rich.table import Table

from benchmarks import draws
from benchmarks.options import positive
from relguide import CALM, Plan, Situation, plan
from relguide.planning.progress import show_progress
from relguide.planning.prove import CERTIFIED, MAX_SECONDS, bounds

KINDS = ("straight, R ≥ d_min", "straight, R < d_min", "turning, calm", "turning, in wind")
"""Of a turning leader's situations every second one has R < d_min."""
BUDGETS = (0.3, 1.0)
"""Shares are given of the plans certified within this CPU time [s]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Outcome:
    """One plan, and how far it was proved."""

    kind: str
    situation: str
    """As code to paste."""
    relaxed: bool
    """Whether it was proved optimal as it was planned."""
    gap: float
    """What is left of it at the end [s]."""
    cpu: float
    """CPU time until the gap was closed to `CERTIFIED`; infinite if it was not [s]."""


def main(arguments: list[str] | None = None) -> int:
    """Draw, plan, prove, and print a table."""
    wanted = _parser().parse_args(arguments)
    kinds = [kind for kind in KINDS if wanted.kind in kind]
    numbers = range(wanted.first, wanted.first + wanted.count)
    cases = [(kind, number) for kind in kinds for number in numbers]
    outcomes = [
        outcome for outcome in _outcomes(cases, wanted.seed, wanted.seconds, wanted.processes)
        if outcome is not None
    ]  # fmt: skip
    if wanted.pieces is not None:
        with wanted.pieces.open("a") as file:
            file.writelines(dumps(asdict(outcome)) + "\n" for outcome in outcomes)
        outcomes = [Outcome(**loads(line)) for line in wanted.pieces.read_text().splitlines()]
    report(outcomes)
    return 0


def _outcomes(
    cases: list[tuple[str, int]], seed: int, budget: float, processes: int
) -> Iterator[Outcome | None]:
    prove_one = partial(prove_case, seed=seed, budget=budget)
    with ProcessPoolExecutor(processes) as pool:
        finished = enumerate(pool.map(prove_one, cases), 1)
        for _, outcome in show_progress(
            finished, title="Proving", total=len(cases), done=lambda pair: pair[0]
        ):
            yield outcome


def prove_case(case: tuple[str, int], *, seed: int, budget: float) -> Outcome | None:
    """Draw a situation, which kind and number alone decide, plan and prove it.

    Returns:
        what came of it; `None` where there is no plan.
    """
    kind, number = case
    situation = draw(kind, np.random.default_rng([seed, KINDS.index(kind), number]), number)
    planned = plan(situation)
    if not isinstance(planned, Plan):
        return None
    relaxed = planned.optimality.proof == "relaxation"
    gap, cpu = 0.0, 0.0
    if not relaxed:
        gap, cpu = _prove_timed(planned, budget)
    return Outcome(kind=kind, situation=repr(situation), relaxed=relaxed, gap=gap, cpu=cpu)


def _prove_timed(planned: Plan, budget: float) -> tuple[float, float]:
    """The gap that is left, and the CPU time until it was closed."""
    list(bounds(planned, seconds=0.0))  # loads the kernels
    gap, started = inf, thread_time()
    for bound in bounds(planned, seconds=MAX_SECONDS):
        gap, spent = bound.gap, thread_time() - started
        if gap <= CERTIFIED:
            return gap, spent
        if spent > budget:
            break
    return gap, inf


def draw(kind: str, rng: np.random.Generator, number: int) -> Situation:
    """A situation of a kind in which the limit binds."""
    if kind == KINDS[0]:
        return draws.active(rng, tight=False)
    if kind == KINDS[1]:
        return draws.active(rng, tight=True)
    while True:
        situation = draws.near(rng, tight=number % 2 == 0, intent=True)
        if kind == KINDS[2]:
            situation = replace(situation, wind=CALM)
        if draws.is_active(situation):
            return situation


def report(outcomes: list[Outcome]) -> None:
    """Print a table by kind, and the worst ten."""
    table = Table(title=f"Gaps closed to {CERTIFIED:g} s, by CPU time")
    for heading in (
        "", "plans", "by relaxation", *(f"in {budget:g} s" for budget in BUDGETS), "at all",
        "median ms", "95 % ms",
    ):  # fmt: skip
        table.add_column(heading, justify="right" if heading else "left")
    for kind in KINDS:
        some = [outcome for outcome in outcomes if outcome.kind == kind]
        if not some:
            continue
        cpu = np.array([outcome.cpu for outcome in some])
        table.add_row(
            kind,
            str(len(some)),
            str(sum(outcome.relaxed for outcome in some)),
            *(f"{np.mean(cpu <= budget):.1%}" for budget in BUDGETS),
            f"{np.mean(cpu < inf):.1%}",
            *(f"{1e3 * np.percentile(cpu, share, method='higher'):.0f}" for share in (50, 95)),
        )
    Console(width=118).print(table)
    for outcome in sorted(outcomes, key=lambda one: -one.gap)[:10]:
        if outcome.gap > CERTIFIED:
            Console(width=10_000).print(
                f"{outcome.gap:8.2f} s  {outcome.kind}  {outcome.situation}", highlight=False
            )


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.proofs",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--count", type=positive, default=100, help="how many of each kind")
    parser.add_argument("--first", type=int, default=0, help="number of the first of each kind")
    parser.add_argument("--pieces", type=Path, metavar="FILE", help="adds to what it holds")
    parser.add_argument("--seconds", type=float, default=1.0, help="CPU time for each at most")
    parser.add_argument("--seed", type=positive, default=1)
    parser.add_argument("--kind", default="", help="a part of the kinds' names")
    parser.add_argument("--processes", type=positive, default=1)
    return parser


if __name__ == "__main__":
    sys.exit(main())
