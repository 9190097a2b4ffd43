"""Measure, and keep the figures in benchmarks/results: `make planner-figures`.

`benchmarks.kept` then draws them and shows them in docs/planner.md.
"""

import argparse
import sys
from pathlib import Path

import numpy as np

from benchmarks import detours, kept, throughput, unlimited
from benchmarks.__main__ import add_counts, counts_from
from benchmarks.cases import limited_cases
from benchmarks.drawings import Floats
from benchmarks.measured import Results, measure
from benchmarks.options import positive
from benchmarks.page import RESULTS
from benchmarks.tables import Cells, write_table
from relguide import Plan, candidates, plan
from relguide.planning.progress import show_progress

QUANTILES = np.linspace(0.0, 1.0, 201)
"""A distribution is drawn through these."""
COSTS = "situations of each kind to draw the cost of the limit from (500)"
"""What `--costs` is."""
KINDS = {"R > d_min": False, "R < d_min": True}
"""Kinds of situations with the limit active, and whether they are tight."""


def main(arguments: list[str] | None = None) -> int:
    """Measure, keep, draw, show."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.figures", description=__doc__)
    parser.add_argument("--costs", type=positive, default=500, metavar="N", help=COSTS)
    add_counts(parser)
    given = parser.parse_args(arguments)
    keep(measure(counts_from(given)), _costs(given.costs))
    return kept.main()


def keep(results: Results, costs: dict[str, Floats], folder: Path = RESULTS) -> None:
    """A file for each table, and one for the distributions of what the limit costs."""
    for name, headings, cells in (
        (kept.WITHOUT, unlimited.HEADINGS, unlimited.table_cells(results.rows)),
        (kept.WITH, detours.HEADINGS, detours.table_cells(results.groups)),
        (kept.BATCHES, throughput.HEADINGS, throughput.table_cells(results.batches)),
        (kept.COST, ("", *costs), cost_cells(costs)),
    ):
        write_table(name, ("name", *headings[1:]), cells, folder)


def _costs(count: int) -> dict[str, Floats]:
    """By kind, how much later plans arrive than without the limit [s]."""
    costs = {}
    for name, tight in KINDS.items():
        cases = limited_cases(count, tight=tight)[-count:]
        numbered = show_progress(
            enumerate(cases), title=f"Cost of the limit, {name}", total=count, done=lambda n: n[0]
        )
        found = [plan(case.situation) for _, case in numbered]
        plans = [answer for answer in found if isinstance(answer, Plan)]
        costs[name] = np.array([p.time_to_converge - candidates(p.situation).bound for p in plans])
    return costs


def cost_cells(costs: dict[str, Floats]) -> Cells:
    """A line a quantile: its share of the plans [%], and what it costs in each kind [s]."""
    return [
        [f"{100.0 * share:g}", *(f"{np.quantile(cost, share):.3f}" for cost in costs.values())]
        for share in QUANTILES
    ]


if __name__ == "__main__":
    sys.exit(main())
