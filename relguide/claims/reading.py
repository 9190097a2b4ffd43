"""A number found in what a command printed, or in a kept table."""

import csv
import json
import re
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from statistics import median
from typing import Any

from relguide.claims.claim import Reading

TAKE: Mapping[str, Callable[[Sequence[float]], float]] = {
    "sum": sum,
    "max": max,
    "min": min,
    "median": median,
}
"""What is made of several rows; `one` and `count` besides."""


def read_printed(reading: Reading, printed: str) -> float:
    """The number in what a command printed.

    Raises:
        ValueError: if it is not there, with what was looked for.
    """
    if reading.json:
        value = _in_json(printed, reading.json) / reading.divide_by
        return _share(value, _in_json(printed, reading.over)) if reading.over else value
    return _in_text(printed, reading.pattern) / reading.divide_by


def read_table(reading: Reading, folder: Path) -> float:
    """The number in a table of benchmarks/results.

    Args:
        reading: what is read of it.
        folder: where the tables are.

    Raises:
        ValueError: if it is not there, with what was looked for.
    """
    with (folder / reading.table).open(encoding="utf-8", newline="") as file:
        rows = [row for row in csv.DictReader(file) if _matches(row, reading)]
    if reading.take == "count":
        return float(len(rows))
    cells = [_cell(row, reading.column, reading) for row in rows]
    if reading.over:
        total = sum(_number(_cell(row, reading.over, reading)) for row in rows)
        return _share(sum(map(_number, cells)), total)
    pattern = reading.pattern
    values = [_in_text(cell, pattern) if pattern else _number(cell) for cell in cells if cell]
    if reading.take in TAKE and values:
        return TAKE[reading.take](values) / reading.divide_by
    if len(values) != 1:
        raise ValueError(f"{reading.table} has {len(values)} such rows, not one.")
    return values[0] / reading.divide_by


def _share(part: float, total: float) -> float:
    """How much of the total that is [%]."""
    if not total:
        raise ValueError("It is a share of nothing: the total is 0.")
    return 100.0 * part / total


def _matches(row: Mapping[str, str], reading: Reading) -> bool:
    return all(re.fullmatch(told, _cell(row, name, reading)) for name, told in reading.where)


def _cell(row: Mapping[str, str], column: str, reading: Reading) -> str:
    if column not in row:
        raise ValueError(f"{reading.table} has no column {column}: it has {', '.join(row)}.")
    return row[column]


def _in_json(printed: str, path: str) -> float:
    try:
        found: Any = json.loads(printed)
    except ValueError:
        raise ValueError("It did not print JSON.") from None
    for step in path.split("."):
        if step == "#" and isinstance(found, list):
            found = len(found)
        elif isinstance(found, list) and step.isdecimal() and int(step) < len(found):
            found = found[int(step)]
        elif isinstance(found, dict) and step in found:
            found = found[step]
        else:
            raise ValueError(f"What it printed has no {path}.")
    if not isinstance(found, int | float):
        raise ValueError(f"{path} is no number: {found}.")
    return float(found)


def _in_text(text: str, pattern: str) -> float:
    found = re.search(pattern, text, re.MULTILINE)
    if found is None:
        raise ValueError(f"It did not print what matches {pattern}")
    return _number(found[1])


def _number(text: str) -> float:
    """The number that a cell begins with: of 1,016 s that is 1016."""
    found = re.match(r"\s*([-+−]?[\d,]*\.?\d+)", text)
    if found is None:
        raise ValueError(f"This begins with no number: {text or 'an empty cell'}.")
    return float(found[1].replace(",", "").replace("−", "-"))
