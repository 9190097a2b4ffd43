"""Networks beside the search in batches: certified answers a second, on all cores, in turns."""

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from math import inf
from os import cpu_count
from time import perf_counter

import numpy as np
from rich.table import Table

from benchmarks.network_rows import BY_NETWORK, answer_rows
from relguide import Situation
from relguide.kernels.contact.time_rows import plan_rows
from relguide.learn.boundary.template_network import load_template_network
from relguide.planning.constrained_path import BEARINGS, HARDER
from relguide.planning.progress import progress_bar
from relguide.planning.slot import slot_frame

CHUNK = 32
"""Situations a thread takes at a time."""
REPEATS = 3
"""Each batch is answered this often by both, in turns, and the quickest counts."""
BUSY = 0.5
"""What takes the search less is repeated to take it as long [s]."""
HEADINGS = ("", "situations", "by network", "a second", "plan_rows a second", "×")
"""Of the table."""

Floats = np.ndarray
Work = Callable[[int, int], None]
"""Answers the rows from one number on, up to another."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Batch:
    """Both answers to many situations."""

    name: str
    count: int
    by_network: float
    """Share that the networks answered; the rest they passed on."""
    ours: float
    """Wall time with the networks [s]."""
    exact: float
    """The same of the search alone [s]."""


def measure(drawn: dict[str, list[Situation]]) -> list[Batch]:
    """Answer all of each kind, by networks and by the search alone; with a bar.

    Both kernels are for leaders that keep straight: kinds in which they turn are left out.
    """
    ways = load_template_network()
    batches = []
    drawn = {
        name: situations
        for name, situations in drawn.items()
        if not any(situation.leader.intent for situation in situations)
    }
    with progress_bar("Networks, in batches", total=2 * REPEATS * len(drawn)) as done:
        for name, situations in drawn.items():
            rows = _with_a_plan(np.array([as_row(situation) for situation in situations]))
            asked, exact = np.empty((len(rows), 4)), np.empty((len(rows), 4))
            latest = np.full(len(rows), inf)

            def ask(first: int, last: int, rows: Floats = rows, out: Floats = asked) -> None:
                answer_rows(rows, ways, BEARINGS, first, last, out)

            def search(
                first: int, last: int,
                rows: Floats = rows, latest: Floats = latest, out: Floats = exact,
            ) -> None:  # fmt: skip
                plan_rows(rows, latest, BEARINGS, HARDER, True, first, last, out)

            ask(0, 1)  # compiles
            took: dict[Work, float] = {ask: inf, search: inf}
            for _ in range(REPEATS):
                for work in took:
                    took[work] = min(took[work], _wall(work, len(rows)))
                    done(1)
            batches.append(
                Batch(
                    name=name, count=len(rows),
                    by_network=float(np.mean(asked[:, 2] == BY_NETWORK)),
                    ours=took[ask], exact=took[search],
                )
            )  # fmt: skip
    return batches


def _with_a_plan(rows: Floats) -> Floats:
    """The rows to which there is an answer; where there is none the search decides in any case.

    They come as often as it takes for the search to be busy for a while.
    """
    latest, answers = np.full(len(rows), inf), np.empty((len(rows), 4))

    def search(first: int, last: int) -> None:
        plan_rows(rows, latest, BEARINGS, HARDER, True, first, last, answers)

    search(0, 1)  # what was compiled is read from disk
    wall = _wall(search, len(rows))
    return np.tile(rows[answers[:, 0] < inf], (max(int(BUSY / wall), 1), 1))


def as_row(situation: Situation) -> tuple[float, ...]:
    """As `plan_rows` takes it; calm, behind a leader that keeps straight."""
    frame = slot_frame(situation, situation.leader.trajectory)
    slot, limit = situation.slot_distance / frame.radius, situation.min_separation / frame.radius
    return frame.x, frame.y, frame.h, frame.alpha, slot, 0.0, limit


def _wall(work: Work, count: int) -> float:
    """How long all of it takes on all cores [s]."""
    started = perf_counter()
    with ThreadPoolExecutor() as pool:
        starts = range(0, count, CHUNK)
        list(pool.map(work, starts, (min(start + CHUNK, count) for start in starts)))
    return perf_counter() - started


def table(batches: list[Batch]) -> Table:
    """What was measured, for people."""
    told = Table(
        title=f"Networks beside the search in batches: certified times on {cpu_count()} cores"
    )
    for heading in HEADINGS:
        told.add_column(heading, justify="right" if heading else "left")
    for batch in batches:
        told.add_row(
            batch.name, f"{batch.count:,}", f"{batch.by_network:.1%}",
            *(f"{batch.count / wall:,.0f}" for wall in (batch.ours, batch.exact)),
            f"{batch.exact / batch.ours:.1f}",
        )  # fmt: skip
    return told
