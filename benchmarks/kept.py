"""What was kept in benchmarks/results, drawn and shown in docs/planner.md.

`python -m benchmarks.kept` does it. Pictures and page are made of the files alone, so they always
show the same run.
"""

import sys
from pathlib import Path

import numpy as np
from rich.console import Console

from benchmarks import drawings
from benchmarks.cases import limited_cases
from benchmarks.drawings import Spread
from benchmarks.page import FOLDER, PAGE, PICTURES, RESULTS, with_block
from benchmarks.sweep import sweep
from benchmarks.tables import markdown, read_table

WITHOUT, WITH, BATCHES = "without_limit.csv", "with_limit.csv", "batches.csv"
COST = "cost_of_limit.csv"
EXAMPLE = "R061"
"""The golden case that is drawn: one contact, four basins."""
BEARINGS = 721
"""Of the sweep: every half degree."""
MICRO, MILLI = 1e-6, 1e-3
OURS = ("kernel", "plan()")
"""How the names of our own rows begin."""


def main() -> int:
    """Draw and show."""
    FOLDER.mkdir(exist_ok=True)
    contact, distributions = (FOLDER / name for name in PICTURES)
    draw_example(contact)
    draw_distributions(distributions)
    PAGE.write_text(with_block(PAGE.read_text(), "measured", block()))
    Console(stderr=True).print(f"Drawn into {FOLDER}, shown in {PAGE}: look at both.")
    return 0


def draw_example(file: Path) -> None:
    """A path that touches the limit, and what it costs to touch it elsewhere."""
    (example,) = [case for case in limited_cases(0, tight=False) if case.name == EXAMPLE]
    swept = sweep(example, count=BEARINGS)
    with drawings.figure(file) as (_, (left, right)):
        drawings.seen_from_leader(left, swept)
        drawings.arrival_by_bearing(right, swept)


def draw_distributions(file: Path) -> None:
    """What the limit costs, and what answers take."""
    (_, *kinds), cells = read_table(COST)
    quantiles = np.array(cells, float)
    costs = {kind: quantiles[:, 1 + i] for i, kind in enumerate(kinds)}
    with drawings.figure(file) as (_, (left, right)):
        drawings.cost_of_the_limit(left, quantiles[:, 0], costs)
        drawings.times(right, spreads())


def spreads() -> list[Spread]:
    """CPU times of answers [s] as the tables have them."""
    return [
        Spread(name, name.startswith(OURS), unit * float(median), unit * float(late))
        for file, unit in ((WITHOUT, MICRO), (WITH, MILLI))
        for name, _, median, late, *_ in read_table(file)[1]
    ]


def block(folder: Path = RESULTS) -> str:
    """The tables that were kept, in Markdown."""
    told = ((WITHOUT, "Without the limit:"), (WITH, "Where it binds:"), (BATCHES, "In batches:"))
    return "\n\n".join(f"{title}\n\n{markdown(*read_table(name, folder))}" for name, title in told)


if __name__ == "__main__":
    sys.exit(main())
