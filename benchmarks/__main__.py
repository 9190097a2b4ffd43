"""How fast and how good the planner is beside what else there is, in one run: `make bench`."""

import argparse
import sys
from dataclasses import fields

from rich.console import Console

from benchmarks import (
    amid_others,
    detours,
    files,
    inference,
    network,
    network_batch,
    simulators,
    throughput,
    unlimited,
)
from benchmarks.detours import Contest
from benchmarks.measured import Counts, Results, measure
from benchmarks.options import positive

RATIO = 40.0
"""How many times slower than the kernel OMPL is at least: a ratio holds on any machine."""


def main(arguments: list[str] | None = None) -> int:
    """Run it all and print the tables; 1 if the planner missed an optimum."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks", description=__doc__)
    add_counts(parser)
    simulators.add_runs(parser)
    amid_others.add_cases(parser, 5)
    given = parser.parse_args(arguments)
    results = measure(counts_from(given))
    console = Console(width=118)
    console.print(unlimited.table(results.rows, results.cases))
    console.print(detours.table(results.groups))
    console.print(throughput.table(results.batches))
    console.print(network.table(results.pairs))
    console.print(network_batch.table(results.network_batches))
    console.print(inference.table(results.rates))
    console.print(files.table(results.file_runs))
    console.print(simulators.table(simulators.measure(given.runs)))
    console.print(amid_others.table(*amid_others.measure(given.amid)))
    for contest in results.beaten:
        console.print(_show_beaten(contest), soft_wrap=True, highlight=False)
    failures = _failures(results)
    for sentence in failures:
        console.print(sentence)
    return 1 if failures else 0


def add_counts(parser: argparse.ArgumentParser) -> None:
    """An option for each of `Counts`."""
    for count in fields(Counts):
        option = f"--{count.name.replace('_', '-')}"
        told = f"{count.metadata['help']} ({count.default:,})"
        parser.add_argument(option, type=positive, default=count.default, metavar="N", help=told)


def counts_from(given: argparse.Namespace) -> Counts:
    """What the options say."""
    return Counts(**{count.name: getattr(given, count.name) for count in fields(Counts)})


def _show_beaten(contest: Contest) -> str:
    """A situation in which IPOPT found something better, as code to paste."""
    return (
        f"IPOPT beats plan() by {contest.ours - contest.honest:.2f} s "
        f"({contest.honest:.2f} s, not {contest.ours:.2f} s): {contest.case.situation!r}"
    )


def _failures(results: Results) -> list[str]:
    """What must hold on any machine, and does not."""
    failures = [
        f"Missed {results.rows[name].misses} optima: {name}."
        for name in (unlimited.KERNEL, unlimited.PLAN)
        if results.rows[name].misses
    ]
    ratio = unlimited.slowness(results.rows, unlimited.OMPL)
    if ratio < RATIO:
        failures.append(f"OMPL took only {ratio:.0f} times as long as the kernel, not {RATIO:.0f}.")
    return failures


if __name__ == "__main__":
    sys.exit(main())
