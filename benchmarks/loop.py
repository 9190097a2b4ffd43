"""Whole flights by network and by the exact planner: `python -m benchmarks.loop --flights 200`.

Both fly the same flights at 1 Hz, with rolling aircraft and a leader who changes course. What the
network loses is given in join time, what it costs in the time of a decision. With `--only network`
as many flights are flown in a third of the time: what counts then is that none breaks d_min.
"""

import argparse
import sys
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path
from time import thread_time, thread_time_ns

import numpy as np
from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.table import Table

from benchmarks.options import positive
from relguide import Plan, Planner, Situation, plan
from relguide.flying.aircraft_documents import LinkResult
from relguide.flying.documents import FlightEnded
from relguide.flying.flight import Scenario, fly
from relguide.flying.guidance.settings import Settings
from relguide.learn.network_planner import network_planner
from relguide.learn.words.branch_network import SHIPPED, load_network
from relguide.learn.words.visited import STEP, draw_flight
from relguide.planning.outcome import NoPlan
from relguide.planning.progress import progress_bar

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

    number: int
    intent_known: bool
    """Whether the leader's intent was known."""
    result: LinkResult
    kept: float
    """Least separation [d_min]."""
    spent: tuple[float, ...]
    """Time of each decision, of this thread alone [µs]."""
    handed_over: int
    """Answers of the exact planner in place of the network."""
    none: int
    """Answers that there is no plan."""
    cpu: float
    """Time of the whole flight, of this thread alone [s]."""

    @property
    def way(self) -> bool:
        """Whether there was a plan when guidance was engaged."""
        return self.result.planned_time > 0.0


Flights = Mapping[str, Sequence[Flown]]
"""The same flights in the same order, by each planner."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Fly them and print the tables; 1 if something breaks d_min, or the network is worse.

    Ctrl-C ends it with the tables of what was flown.
    """
    parser = argparse.ArgumentParser(prog="python -m benchmarks.loop", description=__doc__)
    parser.add_argument("--flights", metavar="N", type=positive, default=200)
    parser.add_argument(
        "--first", metavar="N", type=positive, default=0, help="number of the first"
    )
    parser.add_argument("--only", choices=NAMES, help="fly by one of the two")
    parser.add_argument("--weights", metavar="FILE", type=Path, default=SHIPPED)
    chosen = parser.parse_args(arguments)
    planners: dict[str, Planner] = {
        "exact": plan,
        "network": network_planner(load_network(chosen.weights)),
    }
    names = (chosen.only,) if chosen.only else NAMES
    for name in names:  # compiled before it is measured
        fly_measured(0, planners[name], longest=5.0)
    flights: dict[str, list[Flown]] = {name: [] for name in names}
    with suppress(KeyboardInterrupt), progress_bar("flying", total=chosen.flights) as count:
        for number in range(chosen.first, chosen.first + chosen.flights):
            by_each = [fly_measured(number, planners[name]) for name in names]
            for name, one in zip(names, by_each, strict=True):
                flights[name].append(one)
            count(1.0)
    if not flights[names[0]]:
        return 130
    console = Console(width=100)
    console.print(flights_table(flights))
    console.print(decisions_table(flights))
    if len(names) > 1:
        console.print(losses_table(flights))
    wrong = failures(flights)
    for sentence in wrong:
        console.print(sentence, highlight=False, soft_wrap=True)
    return 1 if wrong else 0


def flight(number: int, longest: float = LONGEST) -> Scenario:
    """One of the flights."""
    drawn = draw_flight(np.random.default_rng([SEED, number]))
    return replace(drawn, duration_limit=longest)


def fly_measured(number: int, planner: Planner, longest: float = LONGEST) -> Flown:
    """Fly one of them, and measure its planner."""
    scenario = flight(number, longest)
    spent: list[float] = []
    handed_over = none = 0

    def measured(situation: Situation) -> Plan | NoPlan:
        nonlocal handed_over, none
        begun = thread_time_ns()
        answer = planner(situation)
        spent.append((thread_time_ns() - begun) * 1e-3)
        if isinstance(answer, NoPlan):
            none += 1
        else:
            handed_over += answer.fell_back
        return answer

    begun = thread_time()
    each_second = Settings(always_ask=True)
    *_, end = fly(scenario, measured, step=STEP, sample_period=1.0, settings=each_second)
    assert isinstance(end, FlightEnded)
    (result,) = end.results
    return Flown(
        number=number,
        intent_known=scenario.intent_known,
        result=result,
        kept=result.least_separation / scenario.situation.min_separation,
        spent=tuple(spent),
        handed_over=handed_over,
        none=none,
        cpu=thread_time() - begun,
    )


def flights_table(flights: Flights) -> Table:
    """What becomes of the flights.

    Where there was no plan at engagement d_min is lost whatever is flown: two aircraft 9 km apart
    and head-on, say.
    """
    many = len(next(iter(flights.values())))
    table = _table(
        f"{many:,} flights at 1 Hz",
        "joined", "intent known: breaches", "least, d_min", "not known: breaches", "least, d_min",
        "no way when engaged", "breaches",
    )  # fmt: skip
    for name, by_one in flights.items():
        known = [one for one in by_one if one.intent_known and one.way]
        not_known = [one for one in by_one if not one.intent_known and one.way]
        lost = [one for one in by_one if not one.way]
        table.add_row(
            name,
            f"{sum(one.result.joined for one in by_one):,}",
            *(
                cell
                for group in (known, not_known)
                for cell in (
                    f"{_breaches(group)} of {len(group):,}",
                    f"{min((one.kept for one in group), default=0.0):.3f}",
                )
            ),
            f"{len(lost):,}",
            f"{_breaches(lost):,}",
        )
    return table


def decisions_table(flights: Flights) -> Table:
    """What the planners are asked, and what it costs."""
    table = _table(
        "Decisions, CPU time",
        "asked", "handed over, %", "no plan, %", "p50, µs", "p99, µs", "a flight, s",
    )  # fmt: skip
    for name, by_one in flights.items():
        spent = np.concatenate([one.spent for one in by_one])
        table.add_row(
            name,
            f"{len(spent):,}",
            f"{100.0 * sum(one.handed_over for one in by_one) / len(spent):.2f}",
            f"{100.0 * sum(one.none for one in by_one) / len(spent):.2f}",
            *(f"{value:,.0f}" for value in np.percentile(spent, (50.0, 99.0))),
            f"{sum(one.cpu for one in by_one) / len(by_one):.2f}",
        )
    return table


def losses_table(flights: Flights) -> Table:
    """What the network loses in join time, where both join."""
    table = Table(box=SIMPLE_HEAD, title="Join time by network", title_justify="left")
    for heading in (
        "flights", "same", "mean loss, %", "median, %", "worst, %", "worst, s", "best, s",
    ):  # fmt: skip
        table.add_column(heading, justify="right")
    joined = [(a, b) for a, b in _pairs(flights) if a.result.joined and b.result.joined]
    if joined:
        exact, network = (
            np.array([by_one.result.join_time for by_one in column])
            for column in zip(*joined, strict=True)
        )
        later, losses = network - exact, 100.0 * (network / exact - 1.0)
        table.add_row(
            f"{len(joined)}",
            f"{int((later == 0.0).sum())}",
            f"{losses.mean():.4f}",
            f"{float(np.median(losses)):.4f}",
            f"{losses.max():.3f}",
            f"{later.max():.0f}",
            f"{later.min():.0f}",
        )
    return table


def failures(flights: Flights) -> list[str]:
    """Where d_min is lost that could have been kept, or the network fails and the other does not.

    Of a leader who turns without a word nobody can say beforehand what could have been kept.
    """
    found = [
        f"Flight {one.number} comes within {one.kept:.3f} d_min by {name}, knowing what the leader "
        "will do."
        for name, by_one in flights.items()
        for one in by_one
        if one.intent_known and one.way and one.kept < BREACH
    ]
    for exact, network in _pairs(flights):
        if exact.result.joined and not network.result.joined:
            found.append(f"Flight {exact.number} joins by the exact planner only.")
        if network.kept < BREACH <= exact.kept:
            found.append(
                f"Flight {exact.number} comes within {network.kept:.3f} d_min by network, "
                f"{exact.kept:.3f} by the exact planner."
            )
    return found


def _pairs(flights: Flights) -> list[tuple[Flown, Flown]]:
    if not all(name in flights for name in NAMES):
        return []
    return list(zip(*(flights[name] for name in NAMES), strict=True))


def _breaches(flights: Sequence[Flown]) -> int:
    return sum(one.kept < BREACH for one in flights)


def _table(title: str, *headings: str) -> Table:
    table = Table(box=SIMPLE_HEAD, title=title, title_justify="left")
    table.add_column("planner")
    for heading in headings:
        table.add_column(heading, justify="right")
    return table


if __name__ == "__main__":
    sys.exit(main())
