"""Tables that were measured, as the wheel carries them and `benchmarks/results` holds them."""

import csv
from pathlib import Path

HERE = Path(__file__).parent
FOLDERS = (HERE / "tables", HERE.parents[1] / "benchmarks" / "results")
"""Where they are in the wheel when installed, in the source tree otherwise."""


def read_results(name: str) -> list[dict[str, str]]:
    """The rows of a table, by its headings.

    Raises:
        ValueError: if it was not installed, in a sentence.
    """
    for folder in FOLDERS:
        if (folder / name).is_file():
            with (folder / name).open(newline="", encoding="utf-8") as file:
                return list(csv.DictReader(file))
    raise ValueError(
        f"The table {name} is missing: neither this installation nor a source tree holds it."
    )
