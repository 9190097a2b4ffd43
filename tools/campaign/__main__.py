"""Fly the campaign, print its flights, and make its tables: `python -m tools.campaign --help`.

    python -m tools.campaign fly --families declared follow --flights 100 --out declared.jsonl
    python -m tools.campaign show follow 17
    python -m tools.campaign table declared.jsonl
    python -m tools.campaign report declared.jsonl

A flight is drawn from its family and number alone. Flights that a file has already are not flown
again, so a run that was stopped goes on where it was; a file of another version of the library is
refused. `report` computes the margins and step responses of docs/flight.md anew, and keeps the
tables of the files named in benchmarks/results; without files the campaign stays as it is.
"""

import argparse
import sys
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from os import cpu_count
from pathlib import Path
from signal import SIG_IGN, SIGINT, signal

from benchmarks.options import positive
from relguide.planning.progress import show_progress
from tools.campaign import tables
from tools.campaign.families import FAMILIES, draw
from tools.campaign.flights import failed_row, fly_case
from tools.campaign.row import Row, append_row, begin_file, read_rows

FLIGHTS = 100
OUT = Path("build/campaign.jsonl")


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command; 1 if a flight ended with an exception."""
    given = _parser().parse_args(arguments)
    command = {"fly": _fly, "show": _show, "table": _table, "report": _report}[given.command]
    try:
        return command(given)
    except (ValueError, OSError) as refusal:
        print(refusal, file=sys.stderr)  # noqa: T201
        return 2


def _fly(given: argparse.Namespace) -> int:
    begin_file(given.out)
    known = {(row.family, row.number) for row in read_rows(given.out)}
    numbers = range(given.first, given.first + given.flights)
    missing = [
        (family, number)
        for number in numbers
        for family in given.families
        if (family, number) not in known
    ]
    stopped = False
    try:
        for row in fly_flights(missing, given.processes):
            append_row(given.out, row)
    except KeyboardInterrupt:
        stopped = True
    asked = [
        row
        for row in read_rows(given.out)
        if row.family in given.families and row.number in numbers
    ]
    asked.sort(key=lambda row: (given.families.index(row.family), row.number))
    if not asked:
        return 130
    _print(tables.page(asked))
    errors = [row for row in asked if row.error]
    for row in errors:
        _print(f"{row.name}: {row.error}")
    return 130 if stopped else 1 if errors else 0


def fly_flights(wanted: Sequence[tuple[str, int]], processes: int) -> Iterator[Row]:
    """Rows of flights, as they are finished; an exception is a row that says so."""
    # Ctrl-C is ours to handle: the workers learn of it between two flights
    pool = ProcessPoolExecutor(processes, initializer=signal, initargs=(SIGINT, SIG_IGN))
    try:
        flights = {pool.submit(flown_by_name, *one): one for one in wanted}
        finished = enumerate(as_completed(flights), 1)
        for _, future in show_progress(
            finished, title="Flying", total=len(wanted), done=lambda pair: pair[0]
        ):
            error = future.exception()
            yield failed_row(draw(*flights[future]), error) if error else future.result()
    finally:
        pool.shutdown(cancel_futures=True)


def flown_by_name(family: str, number: int) -> Row:
    """One flight, drawn where it is flown."""
    return fly_case(draw(family, number))


def _show(given: argparse.Namespace) -> int:
    _print(draw(given.family, given.number).as_code())
    return 0


def _table(given: argparse.Namespace) -> int:
    _print(tables.page(_rows(given.files)))
    return 0


def _report(given: argparse.Namespace) -> int:
    # python-control and matplotlib take a second to import, which flying does not need
    from tools.campaign import report

    rows = _rows(given.files) if given.files else []
    report.write_loops()
    if rows:
        report.write_campaign(rows)
    _print(f"Shown in {report.PAGE}, with its pictures: look at them.")
    return 0


def _rows(files: Sequence[Path]) -> list[Row]:
    rows = [row for file in files for row in read_rows(file)]
    if not rows:
        raise ValueError(f"There are no flights in {', '.join(map(str, files))}.")
    families = list(FAMILIES)
    return sorted(rows, key=lambda row: (families.index(row.family), row.number))


def _print(text: str) -> None:
    print(text, flush=True)  # noqa: T201


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="python -m tools.campaign",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    commands = parser.add_subparsers(dest="command", required=True)
    fly = commands.add_parser("fly", help="fly, and print the tables")
    fly.add_argument(
        "--families", nargs="+", choices=FAMILIES, default=list(FAMILIES), metavar="FAMILY",
        help=f"of {', '.join(FAMILIES)} (all)",
    )  # fmt: skip
    fly.add_argument("--flights", type=positive, default=FLIGHTS, help="of each family")
    fly.add_argument("--first", type=int, default=0, metavar="N", help="number of the first")
    fly.add_argument("--processes", type=positive, default=cpu_count() or 1)
    fly.add_argument("--out", type=Path, default=OUT, metavar="FILE", help=f"lines ({OUT})")
    show = commands.add_parser("show", help="print a flight as code")
    show.add_argument("family", choices=FAMILIES)
    show.add_argument("number", type=int)
    table = commands.add_parser("table", help="the tables of files flown")
    table.add_argument("files", type=Path, nargs="+", metavar="FILE")
    report = commands.add_parser("report", help="keep, draw and show the figures of docs/flight.md")
    report.add_argument("files", type=Path, nargs="*", metavar="FILE")
    return parser


if __name__ == "__main__":
    sys.exit(main())
