"""Tables of figures: kept as CSV in benchmarks/results, shown in pages as Markdown."""

import csv
from collections.abc import Sequence
from pathlib import Path

from benchmarks.page import RESULTS

Cells = list[list[str]]


def write_table(name: str, headings: Sequence[str], cells: Cells, folder: Path = RESULTS) -> None:
    """Keep a table; its numbers lose their thousands separators, so that programs read them."""
    folder.mkdir(exist_ok=True)
    with (folder / name).open("w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(headings)
        writer.writerows([[_plain(cell) for cell in line] for line in cells])


def read_table(name: str, folder: Path = RESULTS) -> tuple[list[str], Cells]:
    """Headings and cells of a table that was kept."""
    with (folder / name).open(newline="") as file:
        headings, *cells = csv.reader(file)
    return headings, cells


def columns(headings: Sequence[str], cells: Cells, names: Sequence[str]) -> tuple[list[str], Cells]:
    """A table with only these of its columns."""
    kept = [headings.index(name) for name in names]
    return list(names), [[line[i] for i in kept] for line in cells]


def markdown(headings: Sequence[str], cells: Cells) -> str:
    """A table for a page: names on the left, numbers on the right."""
    sides = ["---", *("---:" for _ in headings[1:])]
    return "\n".join(f"| {' | '.join(line)} |" for line in [list(headings), sides, *cells])


def _plain(cell: str) -> str:
    number = cell.replace(",", "")
    return number if number.lstrip("+-").replace(".", "", 1).isdigit() else cell
