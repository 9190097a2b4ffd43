"""Whole flights by network and by the exact planner: `python -m tests.bench.loop --flights 200`.

Both fly the same flights at 1 Hz, with rolling aircraft and a leader who changes course. What the
network loses is told in join time, what it costs in the time of a decision.
"""

import argparse
import sys
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path
from time import thread_time_ns

import numpy as np
from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.table import Table

from relguide import Plan, Planner, Situation, plan
from relguide.flying.documents import FlightEnded
from relguide.flying.flight import Scenario, fly
from relguide.learn.network import SHIPPED, load_network
from relguide.learn.planner import network_planner
from relguide.learn.visited import draw_flight
from relguide.planning.plan import NoPlan
from relguide.progress import progress_bar
from tests.bench.options import positive

SEED = 1903
"""Of the flights: the same every time."""
NAMES = ("exact", "network")
LONGEST = 3600.0
"""A flight that has not joined by then has not joined [s]."""
BREACH = 0.99
"""Below this share of d_min is a breach. Guidance plans with 0.1 NM more, for rolling late."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Flown:
    """A flight, and what its planner was asked."""

    end: FlightEnded
    kept: float
    """Least separation [d_min]."""
    spent: tuple[float, ...]
    """Time of each decision, of this thread alone [µs]."""
    handed_over: int
    """Answers of the exact planner in place of the network."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Pair:
    """A flight by both planners."""

    number: int
    intent_known: bool
    exact: Flown
    network: Flown

    @property
    def loss(self) -> float | None:
        """How much later the network joins, relative; `None` if one of them does not join."""
        if not (self.exact.end.joined and self.network.end.joined):
            return None
        return self.network.end.join_time / self.exact.end.join_time - 1.0


def main(arguments: Sequence[str] | None = None) -> int:
    """Fly them and print the tables; 1 if the network is worse in what must not be worse.

    Ctrl-C ends it with the tables of what was flown.
    """
    parser = argparse.ArgumentParser(prog="python -m tests.bench.loop", description=__doc__)
    parser.add_argument("--flights", metavar="N", type=positive, default=200)
    parser.add_argument("--weights", metavar="FILE", type=Path, default=SHIPPED)
    chosen = parser.parse_args(arguments)
    by_network = network_planner(load_network(chosen.weights))
    flown(replace(flight(0), duration_limit=5.0), plan)  # compiled before it is measured
    flown(replace(flight(0), duration_limit=5.0), by_network)
    pairs: list[Pair] = []
    with suppress(KeyboardInterrupt), progress_bar("flying", total=chosen.flights) as count:
        for number in range(chosen.flights):
            pairs.append(pair(number, by_network))
            count(1.0)
    if not pairs:
        return 130
    console = Console(width=100)
    console.print(planners_table(pairs))
    console.print(losses_table(pairs))
    worse = failures(pairs)
    for sentence in worse:
        console.print(sentence, highlight=False, soft_wrap=True)
    return 1 if worse else 0


def flight(number: int) -> Scenario:
    """One of the flights."""
    drawn = draw_flight(np.random.default_rng([SEED, number]))
    return replace(drawn, duration_limit=LONGEST)


def pair(number: int, by_network: Planner) -> Pair:
    """Fly one by both planners."""
    scenario = flight(number)
    return Pair(
        number=number,
        intent_known=scenario.intent_known,
        exact=flown(scenario, plan),
        network=flown(scenario, by_network),
    )


def flown(scenario: Scenario, planner: Planner) -> Flown:
    """Fly a scenario, and measure its planner."""
    spent: list[float] = []
    handed_over = 0

    def measured(situation: Situation) -> Plan | NoPlan:
        nonlocal handed_over
        begun = thread_time_ns()
        answer = planner(situation)
        spent.append((thread_time_ns() - begun) * 1e-3)
        handed_over += isinstance(answer, Plan) and answer.fell_back
        return answer

    *_, end = fly(scenario, measured, sample_period=1.0)
    assert isinstance(end, FlightEnded)
    kept = end.least_separation / scenario.situation.min_separation
    return Flown(end=end, kept=kept, spent=tuple(spent), handed_over=handed_over)


def planners_table(pairs: Sequence[Pair]) -> Table:
    """What each planner does."""
    table = Table(box=SIMPLE_HEAD, title=f"{len(pairs)} flights at 1 Hz", title_justify="left")
    table.add_column("planner")
    for heading in (
        "joined", "breaches, intent told", "not told", "least sep., d_min",
        "asked", "handed over, %", "p50, µs", "p99, µs",
    ):  # fmt: skip
        table.add_column(heading, justify="right")
    for name in NAMES:
        flights: list[Flown] = [getattr(both, name) for both in pairs]
        spent = np.concatenate([one.spent for one in flights])
        handed_over = sum(one.handed_over for one in flights)
        table.add_row(
            name,
            f"{sum(one.end.joined for one in flights)}",
            *(f"{_breaches(pairs, name, told=told)}" for told in (True, False)),
            f"{min(one.kept for one in flights):.3f}",
            f"{len(spent):,}",
            f"{100.0 * handed_over / len(spent):.2f}",
            *(f"{value:,.0f}" for value in np.percentile(spent, (50.0, 99.0))),
        )
    return table


def losses_table(pairs: Sequence[Pair]) -> Table:
    """What the network loses in join time."""
    table = Table(box=SIMPLE_HEAD, title="Join time by network", title_justify="left")
    for heading in (
        "flights",
        "same",
        "mean loss, %",
        "median, %",
        "worst, %",
        "worst, s",
        "best, s",
    ):
        table.add_column(heading, justify="right")
    losses = np.array([both.loss for both in pairs if both.loss is not None])
    later = np.array(
        [
            both.network.end.join_time - both.exact.end.join_time
            for both in pairs
            if both.loss is not None
        ]
    )
    if len(losses):
        table.add_row(
            f"{len(losses)}",
            f"{int((later == 0.0).sum())}",
            f"{100.0 * losses.mean():.4f}",
            f"{100.0 * float(np.median(losses)):.4f}",
            f"{100.0 * losses.max():.3f}",
            f"{later.max():.0f}",
            f"{later.min():.0f}",
        )
    return table


def failures(pairs: Sequence[Pair]) -> list[str]:
    """Where the network does not join, or comes too close, and the exact planner does not."""
    found = []
    for both in pairs:
        if both.exact.end.joined and not both.network.end.joined:
            found.append(f"Flight {both.number} joins by the exact planner only.")
        if both.network.kept < BREACH <= both.exact.kept:
            found.append(
                f"Flight {both.number} comes within {both.network.kept:.3f} d_min by network, "
                f"{both.exact.kept:.3f} by the exact planner."
            )
    return found


def _breaches(pairs: Sequence[Pair], name: str, *, told: bool) -> int:
    flights: list[Flown] = [getattr(both, name) for both in pairs if both.intent_known == told]
    return sum(one.kept < BREACH for one in flights)


if __name__ == "__main__":
    sys.exit(main())
