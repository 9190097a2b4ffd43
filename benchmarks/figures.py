"""Measure, draw the pictures of docs/planner.md and write its tables: `make planner-figures`.

The tables go between two markers in the page; what stands around them is written by hand.
"""

import argparse
import sys
from math import inf

import numpy as np
from rich.console import Console

from benchmarks import detours, drawings, throughput, unlimited
from benchmarks.__main__ import add_counts, counts_from
from benchmarks.cases import limited_cases
from benchmarks.drawings import Floats
from benchmarks.options import positive
from benchmarks.page import FOLDER, PAGE, PICTURES, with_block
from benchmarks.results import Results, measure
from benchmarks.sweep import sweep
from relguide import Plan, candidates, plan
from relguide.planning.progress import show_progress

EXAMPLE = "R061"
"""The golden case that is drawn: one contact, four basins."""
COSTS = "situations of each kind to draw the cost of the limit from (500)"
"""What `--costs` is."""
BEARINGS = 721
"""Of the sweep: every half degree."""
TEMPLATES = {"R > d_min": False, "R < d_min: the tight corner": True}
"""Kinds of situations with the limit active, and whether they are tight."""


def main(arguments: list[str] | None = None) -> int:
    """Measure, draw, write."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.figures", description=__doc__)
    parser.add_argument("--costs", type=positive, default=500, metavar="N", help=COSTS)
    add_counts(parser)
    given = parser.parse_args(arguments)
    results = measure(counts_from(given))
    costs, without = _costs(given.costs)
    FOLDER.mkdir(exist_ok=True)
    draw(results, costs)
    PAGE.write_text(with_block(PAGE.read_text(), block(results, costs, without)))
    Console(stderr=True).print(f"Drawn into {FOLDER}, written into {PAGE}: look at both.")
    return 0


def draw(results: Results, costs: dict[str, Floats], *, suffix: str = ".svg") -> None:
    """Both pictures."""
    contact, distributions = ((FOLDER / name).with_suffix(suffix) for name in PICTURES)
    (example,) = [case for case in limited_cases(0, tight=False) if case.name == EXAMPLE]
    swept = sweep(example, count=BEARINGS)
    with drawings.figure(contact) as (_, (left, right)):
        drawings.seen_from_leader(left, swept)
        drawings.arrival_by_bearing(right, swept)
    with drawings.figure(distributions) as (_, (left, right)):
        drawings.cost_of_the_limit(left, costs)
        drawings.times(right, *_times(results))


def _costs(count: int) -> tuple[dict[str, Floats], int]:
    """By kind, how much later plans arrive than without the limit [s]; and how many have none."""
    costs, without = {}, 0
    for name, tight in TEMPLATES.items():
        cases = limited_cases(count, tight=tight)[-count:]
        numbered = show_progress(
            enumerate(cases), title=f"Cost of the limit, {name}", total=count, done=lambda n: n[0]
        )
        found = [plan(case.situation) for _, case in numbered]
        plans = [answer for answer in found if isinstance(answer, Plan)]
        without += len(found) - len(plans)
        costs[name] = np.array([p.time_to_converge - candidates(p.situation).bound for p in plans])
    return costs, without


def _times(results: Results) -> tuple[dict[str, Floats], dict[str, Floats]]:
    """CPU times [s] for the picture: ours, and those that stand beside."""
    rows = {name: np.array(row.times) for name, row in results.rows.items()}
    contests = [contest for group in results.groups.values() for contest in group]
    ours = {
        "the kernel": rows[unlimited.KERNEL],
        "plan()": rows[unlimited.PLAN],
        "plan(), limit active": np.array([contest.our_cpu for contest in contests]),
    }
    theirs = {
        "dubins + bisection": rows[unlimited.DUBINS],
        "every word scanned": rows[unlimited.EXHAUSTIVE],
        "OMPL": rows[unlimited.OMPL],
        "IPOPT × 3, limit active": np.array([contest.their_cpu for contest in contests]),
    }
    return ours, theirs


def block(results: Results, costs: dict[str, Floats], without: int) -> str:
    """The tables, in Markdown."""
    golden = sum(case.optimum is not None for case in results.cases)
    told = [
        f"Without the limit ({len(results.cases)} situations, {golden} of them golden):",
        _markdown(unlimited.HEADINGS, unlimited.table_cells(results.rows)),
        "Where the limit binds:",
        _markdown(detours.HEADINGS, detours.table_cells(results.groups)),
        _duel(results),
        "In batches:",
        _markdown(throughput.HEADINGS, throughput.table_cells(results.batches)),
        "What the limit costs:",
        _markdown(("", "plans", "median s", "95 % s", "worst s"), _cost_cells(costs)),
    ]
    if without:
        told.append(f"({without} more have no plan that keeps d_min, or none was found.)")
    return "\n\n".join(told)


def _duel(results: Results) -> str:
    beaten = results.beaten
    total = sum(len(group) for group in results.groups.values())
    if not beaten:
        return (
            f"IPOPT was faster in none of the {total}, its paths flown again and the limit kept "
            "all the way."
        )
    worst = beaten[0]
    by = worst.ours - worst.honest
    how = "where plan() found none" if by == inf else f"by up to {by:.1f} s"
    return f"IPOPT was faster in {len(beaten)} of the {total}, {how}."


def _cost_cells(costs: dict[str, Floats]) -> list[list[str]]:
    return [
        [name, str(len(cost)), *(f"{np.percentile(cost, share):,.0f}" for share in (50, 95, 100))]
        for name, cost in costs.items()
    ]


def _markdown(headings: tuple[str, ...], rows: list[list[str]]) -> str:
    lines = [headings, ("---", *("---:" for _ in headings[1:])), *rows]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)


if __name__ == "__main__":
    sys.exit(main())
