"""What was obtained last, in benchmarks/results/claims.csv of a clone."""

import csv
from collections.abc import Iterable, Mapping
from pathlib import Path

from relguide.claims.claim import Claim
from relguide.claims.reading import read_table

FILE = "claims.csv"


def clone() -> Path | None:
    """The folder of the project, if this relguide is run from one."""
    root = Path(__file__).parents[2]
    return root if (root / "benchmarks" / "results").is_dir() else None


def results(root: Path) -> Path:
    """The folder of the kept tables."""
    return root / "benchmarks" / "results"


def read_obtained(claims: Iterable[Claim], root: Path) -> dict[str, float]:
    """What each claim had last: by its table if that is kept, else by the last run.

    Raises:
        ValueError: if a kept table has no such number.
    """
    kept = {c.name: read_table(c.reading, results(root)) for c in claims if c.runs == "kept"}
    return _read_last(root) | kept


def keep_obtained(claims: Iterable[Claim], new: Mapping[str, float], root: Path) -> None:
    """Put what was obtained now in place of what these claims had; others stay as they are."""
    have = {**_read_last(root), **new}
    path = results(root) / FILE
    part = path.with_suffix(".part")
    with part.open("w", encoding="utf-8", newline="") as file:
        rows = csv.writer(file, lineterminator="\n")
        rows.writerow(["claim", "obtained"])
        for claim in claims:
            if claim.name in have and claim.runs != "kept":
                rows.writerow([claim.name, f"{have[claim.name]:.10g}"])
    part.replace(path)  # whole or not at all, if it is stopped here


def _read_last(root: Path) -> dict[str, float]:
    """What the last runs obtained."""
    path = results(root) / FILE
    if not path.exists():
        return {}
    with path.open(encoding="utf-8", newline="") as file:
        return {row["claim"]: float(row["obtained"]) for row in csv.DictReader(file)}
