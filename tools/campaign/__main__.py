"""The figures of docs/flight.md: `python -m tools.campaign [DIR]`.

Margins, step responses and their pictures are computed in a minute. The campaign's tables and
picture are of the folder of `relguide campaign examples/campaign.toml --out DIR`, the table of what
is not exact of that of `examples/mixed.toml`, and that of flights by hand of that of
`examples/flight_director.toml`; without a folder they stay as they are.
"""

import argparse
from collections.abc import Sequence
from pathlib import Path

from relguide.campaign.parts import read_table, row_of_record
from tools.campaign import report


def main(arguments: Sequence[str] | None = None) -> None:
    """Compute, keep, draw and show them."""
    parser = argparse.ArgumentParser(prog="python -m tools.campaign", description=__doc__)
    parser.add_argument("folder", type=Path, nargs="?", metavar="DIR")
    given = parser.parse_args(arguments)
    report.write_loops()
    if given.folder is not None:
        rows = [row_of_record(record) for record in read_table(given.folder).to_pylist()]
        if any(row.family == "mixed" for row in rows):
            report.write_inexact(rows)
        elif any(row.family == "flight_director" for row in rows):
            report.write_by_hand(rows)
        else:
            families = list(dict.fromkeys(row.family for row in rows))
            report.write_campaign(sorted(rows, key=lambda row: families.index(row.family)))
    print(f"Shown in {report.PAGE}, with its pictures: look at them.")  # noqa: T201


if __name__ == "__main__":
    main()
