"""python -m tests.independent: flights of docs/flight.md, "A second opinion", as a table."""

import sys
from collections.abc import Iterator

from tests.independent.outcome import FAMILIES, NUMBERS, both


def table() -> Iterator[str]:
    """Its lines, each as soon as its flights are flown."""
    yield "| family | flights | joined | later, % | nearer, d_min |"
    yield "| --- | ---: | ---: | ---: | ---: |"
    for family in FAMILIES:
        pairs = [both(family, number) for number in NUMBERS]
        later = [100.0 * pair.later for pair in pairs]
        nearer = [pair.nearer for pair in pairs]
        yield (
            f"| {family} | {len(pairs)} | {sum(pair.a320.joined for pair in pairs)} "
            f"| {min(later):.1f} to {max(later):.1f} | {min(nearer):.4f} to {max(nearer):.4f} |"
        )


if __name__ == "__main__":
    for line in table():
        sys.stdout.write(f"{line}\n")
