"""Flying behind every recorded leader of the Paris data: `python -m benchmarks.leaders`.

Each is found by its name, as `relguide fly quickstart:NAME` finds it, and flown as that does. What
became of each goes to benchmarks/results/leaders.csv; how many joined, and how many lost d_min, is
printed.
"""

import argparse
import sys
from collections import Counter
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from os import cpu_count

from benchmarks.options import positive
from benchmarks.tables import markdown, write_table
from benchmarks.unable import unable_at_the_end
from relguide import plan
from relguide.campaign import recordings
from relguide.flying.documents import FlightEnded
from relguide.flying.flight import fly
from relguide.flying.scenarios import scenario_behind
from relguide.planning.progress import show_progress
from relguide.units import NM

NAME = "leaders.csv"
HEADINGS = ("leader", "seconds", "joined, s", "least, NM", "losses", "why not")
LAST = "the recording ends"
"""What became of a flight that neither joined nor was unable."""


def main(arguments: list[str] | None = None) -> int:
    """Fly them all, keep the table, and print how many joined."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.leaders", description=__doc__)
    parser.add_argument("--processes", type=positive, default=cpu_count() or 1)
    rows = list(fly_all(parser.parse_args(arguments).processes))
    write_table(NAME, HEADINGS, [cells for cells, _ in rows])
    counted = Counter(outcome for _, outcome in rows)
    shown = markdown(
        ("", "leaders"),
        [
            ["flown", f"{len(rows)}"],
            *([outcome, f"{count}"] for outcome, count in counted.most_common()),
            ["lost d_min", f"{sum(cells[4] != '0' for cells, _ in rows)}"],
        ],
    )
    print(shown)  # noqa: T201
    return 0


def fly_all(processes: int) -> Iterator[tuple[list[str], str]]:
    """The cells of each leader, and what became of it, as they are flown."""
    count = recordings.count()
    with ProcessPoolExecutor(processes) as pool:
        flown = enumerate(pool.map(fly_behind, range(count), chunksize=8), 1)
        for _, row in show_progress(
            flown, title="Flying leaders", total=count, done=lambda one: one[0]
        ):
            yield row


def fly_behind(number: int) -> tuple[list[str], str]:
    """One of them."""
    track = recordings.track(number)
    documents = list(fly(scenario_behind(track), plan, sample_period=1.0))
    ended = documents[-1]
    assert isinstance(ended, FlightEnded)
    (result,) = ended.results
    why = unable_at_the_end(documents)
    said = "joined" if result.joined else why.message if why else LAST
    outcome = "joined" if result.joined else f"unable: {why.reason}" if why else LAST
    return [
        track.ident,
        f"{track.duration:.0f}",
        f"{result.join_time:.0f}" if result.joined else "",
        f"{result.least_separation / NM:.2f}",
        f"{len(result.losses)}",
        said,
    ], outcome


if __name__ == "__main__":
    sys.exit(main())
