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
from benchmarks.tables import Cells, columns, markdown, read_table
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
    """What was kept, as a reader needs it."""
    without = columns(*read_table(WITHOUT, folder), ("name", "cases", "median µs", OFF, "worst s"))
    (_, _, free, _), (_, _, bound, _) = read_table(BATCHES, folder)[1]
    return "\n\n".join(
        (
            f"Without the limit:\n\n{markdown(*without)}",
            f"Where it binds:\n\n{markdown(BESIDE_IPOPT, _pairs(*read_table(WITH, folder)))}",
            f"`plan_arrays()` plans {int(free):,} situations a second without the limit, and "
            f"{bound} where it binds.",
        )
    )


OFF = "off by > 0.1 s"
BESIDE_IPOPT = (
    "", "cases", "plan(), ms", "99 % ms", "later", "IPOPT, ms", "later", "none",
)  # fmt: skip
"""Headings of the table where the limit binds."""


def _pairs(headings: list[str], cells: Cells) -> Cells:
    """A line for each kind of situation, our row and that of IPOPT side by side."""
    _, ours = columns(headings, cells[::2], ("name", "cases", "median ms", "99 % ms", "later"))
    _, theirs = columns(headings, cells[1::2], ("median ms", "later", "none"))
    return [
        [name.removeprefix("plan(), "), *line, *beside]
        for (name, *line), beside in zip(ours, theirs, strict=True)
    ]


if __name__ == "__main__":
    sys.exit(main())
