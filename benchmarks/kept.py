"""What was kept in benchmarks/results, drawn and shown in docs/planner.md.

`python -m benchmarks.kept` does it. Pictures and page are made of the files alone, so they always
show the same run.
"""

import sys
from pathlib import Path

from rich.console import Console

from benchmarks import drawings
from benchmarks.cases import limited_cases
from benchmarks.page import FOLDER, GALLERY, PAGE, PICTURE, RESULTS, with_block
from benchmarks.sweep import sweep
from benchmarks.tables import markdown, read_table
from relguide.figures.drawn import as_svg, draw
from relguide.figures.ours import planners, separation

WITHOUT, WITH, BATCHES = "without_limit.csv", "with_limit.csv", "batches.csv"
COST = "cost_of_limit.csv"
EXAMPLE = "R061"
"""The golden case that is drawn: one contact, four basins."""
BEARINGS = 721
"""Of the sweep: every half degree."""


def main() -> int:
    """Draw and show."""
    FOLDER.mkdir(exist_ok=True)
    draw_example(FOLDER / PICTURE)
    for figure in (planners.FIGURE, separation.FIGURE):
        (GALLERY / f"{figure.name}.svg").write_bytes(as_svg(draw(figure)))
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


def block(folder: Path = RESULTS) -> str:
    """The tables that were kept, in Markdown."""
    told = ((WITHOUT, "Without the limit:"), (WITH, "Where it binds:"), (BATCHES, "In batches:"))
    return "\n\n".join(f"{title}\n\n{markdown(*read_table(name, folder))}" for name, title in told)


if __name__ == "__main__":
    sys.exit(main())
