"""The networks beside the search: whole certified answers, without the limit and where it binds.

One query, then the same in a batch. How many times as fast they are is said twice: by the medians,
and by what all queries take together, in which the slow ones count.

python -m benchmarks.network --count 400
"""

import argparse
import sys
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import islice

import numpy as np
from rich.console import Console
from rich.table import Table

from benchmarks import network_batch
from benchmarks.draws import active, anywhere, is_active
from benchmarks.options import positive
from benchmarks.timing import time_call
from relguide import Plan, Planner, Situation, plan
from relguide.learn.network_planner import network_planner
from relguide.learn.words.branch_network import load_network
from relguide.planning.progress import show_progress

REPEATS = 5
LATER = 0.1
"""Answers later than the search's by more than this are counted [s]."""
SEED = 20
TURNING = "it binds, the leader turns"
"""A kind of situation."""
HEADINGS = (
    "", "cases", "by network", "median µs", "99 % µs", "plan() µs", "99 % µs", "×", "× by sums",
    f"> {LATER} s later", "99 % s", "worst s",
)  # fmt: skip
"""Of the table."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Pair:
    """Both answers to one situation, where there is one."""

    by_network: bool
    """Whether the networks answered, or passed it on to `plan`."""
    late: float
    """How much later than the search's the answer is [s]."""
    network_cpu: float
    """CPU time of a whole answer [s]."""
    plan_cpu: float
    """The same of `plan` [s]."""


def draw_situations(count: int) -> dict[str, list[Situation]]:
    """So many situations each: where the limit does not bind, and where it does.

    In the last kind the leader turns, in wind: no network knows the way round it.
    """
    rng = np.random.default_rng(SEED)
    sources = {
        "it does not bind": _free(rng),
        "it binds, R > d_min": _active(rng, tight=False),
        "it binds, R < d_min": _active(rng, tight=True),
        TURNING: _active_behind_turns(rng),
    }
    return {
        name: list(_with_bar(islice(source, count), count, f"Drawing, {name}"))
        for name, source in sources.items()
    }


def _free(rng: np.random.Generator) -> Iterator[Situation]:
    """Situations in which the limit does not bind, without end."""
    while True:
        situation = anywhere(rng)
        if not is_active(situation):
            yield situation


def _active(rng: np.random.Generator, *, tight: bool) -> Iterator[Situation]:
    """Those in which it does."""
    while True:
        yield active(rng, tight=tight)


def _active_behind_turns(rng: np.random.Generator) -> Iterator[Situation]:
    """The same behind a leader that turns, R < d_min in every other one."""
    while True:
        for tight in (False, True):
            yield active(rng, tight=tight, intent=True)


def measure(asked: dict[str, list[Situation]]) -> dict[str, list[Pair]]:
    """Ask both planners the same, in turns; with bars."""
    ours = network_planner(load_network())
    measured: dict[str, list[Pair]] = {}
    for name, situations in asked.items():
        shown = _with_bar(situations, len(situations), f"Networks, {name}")
        pairs = [_pair(situation, ours) for situation in shown]
        measured[name] = [pair for pair in pairs if pair is not None]
    return measured


def _with_bar(situations: Iterable[Situation], count: int, title: str) -> Iterator[Situation]:
    """One after the other, with a bar."""
    numbered = show_progress(
        enumerate(situations), title=title, total=count, done=lambda pair: pair[0]
    )
    return (situation for _, situation in numbered)


def _pair(situation: Situation, ours: Planner) -> Pair | None:
    ours(situation), plan(situation)  # what was compiled is read from disk
    network_cpu, found = time_call(lambda: ours(situation), REPEATS)
    plan_cpu, exact = time_call(lambda: plan(situation), REPEATS)
    if not (isinstance(found, Plan) and isinstance(exact, Plan)):
        return None
    return Pair(
        by_network=found.planner == "network",
        late=found.time_to_converge - exact.time_to_converge,
        network_cpu=network_cpu,
        plan_cpu=plan_cpu,
    )


def table(measured: dict[str, list[Pair]]) -> Table:
    """What was measured, for people. Times are of all answers, those that were passed on too."""
    drawn = Table(title="Networks beside the search: whole certified answers; CPU time")
    for heading in HEADINGS:
        drawn.add_column(heading, justify="right" if heading else "left")
    for name, pairs in measured.items():
        drawn.add_row(name, *_cells(pairs))
    return drawn


def _cells(pairs: list[Pair]) -> list[str]:
    ours, theirs = (
        1e6 * np.array([getattr(pair, name) for pair in pairs])
        for name in ("network_cpu", "plan_cpu")
    )
    late = np.array([pair.late for pair in pairs])
    return [
        f"{len(pairs)}",
        f"{np.mean([pair.by_network for pair in pairs]):.1%}",
        *(f"{np.percentile(ours, share):,.0f}" for share in (50, 99)),
        *(f"{np.percentile(theirs, share):,.0f}" for share in (50, 99)),
        f"{np.median(theirs) / np.median(ours):.1f}",
        f"{theirs.sum() / ours.sum():.1f}",
        f"{np.sum(late > LATER)}",
        f"{max(np.percentile(late, 99), 0.0):.2f}",
        f"{max(late.max(), 0.0):.1f}",
    ]


def main(arguments: list[str] | None = None) -> int:
    """Measure, and print the table."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.network", description=__doc__)
    parser.add_argument("--count", metavar="N", type=positive, default=400)
    situations = draw_situations(parser.parse_args(arguments).count)
    console = Console(width=128)
    console.print(table(measure(situations)))
    console.print(network_batch.table(network_batch.measure(situations)))
    return 0


if __name__ == "__main__":
    sys.exit(main())
