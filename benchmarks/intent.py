"""What knowing the leader's intent is worth: `python -m benchmarks.intent`.

Fig. 6 is flown for many times of the leader's turn: with its intent known and unknown, and by the
baselines, which do not plan. All figures go to benchmarks/results/intent.csv, some into
docs/flight.md, and `relguide figures intent` draws them.
"""

import argparse
import sys
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from itertools import product
from os import cpu_count
from statistics import mean
from typing import NamedTuple

from benchmarks.options import positive
from benchmarks.page import DOCS, GALLERY, with_block
from benchmarks.tables import Cells, markdown, write_table
from relguide import plan
from relguide.figures.drawn import as_svg, draw
from relguide.figures.ours.intent import FIGURE
from relguide.flying.documents import FlightEnded
from relguide.flying.flight import fly
from relguide.flying.guidances import Guidance
from relguide.flying.scenarios import fig_6
from relguide.planning.progress import show_progress
from relguide.units import DEG, Metre, Radian, Second

TURNS: tuple[Second, ...] = tuple(
    float(t)
    for t in (*range(60, 721, 60), *range(740, 781, 20), *range(790, 851, 10), 860, 870, 880)
)
"""When the leader begins its turn [s]."""
NAME = "intent.csv"
PAGE, PART = DOCS / "flight.md", "intent"
PICTURE = GALLERY / f"{FIGURE.name}.svg"


class Way(NamedTuple):
    """A way to fly it."""

    name: str
    guidance: Guidance
    intent_known: bool


WAYS = (
    Way("intent known", "relguide", True),
    Way("intent unknown", "relguide", False),
    Way("chasing the slot", "slot_pursuit", False),
    Way("proportional navigation", "pronav", False),
    Way("along the leader's trail", "trail", False),
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Outcome:
    """What became of one flight."""

    way: Way
    turns_at: Second
    joined: bool
    join_time: Second
    swing: Radian
    reversals: int
    least: Metre
    least_share: float
    """Of d_min."""
    losses: int

    @property
    def joined_before(self) -> bool:
        """Whether it joined before the leader turned, on the route that it then left."""
        return self.joined and self.join_time <= self.turns_at


HEADINGS = (
    "leader turns, s", "guidance", "joined, s", "before the turn", "swing, °", "reversals",
    "least, d_min", "losses",
)  # fmt: skip


def main(arguments: list[str] | None = None) -> int:
    """Fly them all, keep the table, draw and show it."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.intent", description=__doc__)
    parser.add_argument("--processes", type=positive, default=cpu_count() or 1)
    outcomes = list(fly_all(parser.parse_args(arguments).processes))
    write_table(NAME, HEADINGS, [_cells(outcome) for outcome in outcomes])
    PICTURE.write_bytes(as_svg(draw(FIGURE)))
    shown = markdown(SHOWN, summary(outcomes))
    PAGE.write_text(with_block(PAGE.read_text("utf-8"), PART, shown), "utf-8")
    print(shown)  # noqa: T201
    return 0


def fly_all(processes: int) -> Iterator[Outcome]:
    """The outcomes, by the leader's turn and then by the way."""
    asked = list(product(TURNS, WAYS))
    with ProcessPoolExecutor(processes) as pool:
        flown = enumerate(pool.map(fly_one, *zip(*asked, strict=True), chunksize=5), 1)
        for _, outcome in show_progress(
            flown, title="Flying Fig. 6", total=len(asked), done=lambda one: one[0]
        ):
            yield outcome


def fly_one(turns_at: Second, way: Way) -> Outcome:
    """One flight."""
    scenario = fig_6(intent_known=way.intent_known, leader_turns_at=turns_at)
    *_, ended = fly(scenario, plan, sample_period=1.0, guidance=way.guidance)
    assert isinstance(ended, FlightEnded)
    (result,) = ended.results
    return Outcome(
        way=way,
        turns_at=turns_at,
        joined=result.joined,
        join_time=result.join_time,
        swing=result.heading_swing,
        reversals=result.bank_reversals,
        least=result.least_separation,
        least_share=result.least_separation / scenario.situation.min_separation,
        losses=len(result.losses),
    )


def _cells(outcome: Outcome) -> list[str]:
    return [
        f"{outcome.turns_at:.0f}",
        outcome.way.name,
        f"{outcome.join_time:.0f}" if outcome.joined else "",
        "yes" if outcome.joined_before else "no",
        f"{outcome.swing / DEG:.0f}",
        f"{outcome.reversals}",
        f"{outcome.least_share:.3f}",
        f"{outcome.losses}",
    ]


SHOWN = "", "later than with intent: mean", "most", "swing, most", "least, d_min"
"""Of the table in the page."""


def summary(outcomes: Sequence[Outcome]) -> Cells:
    """A line a way, over the turns that come before any of the ways has joined."""
    early = {outcome.turns_at for outcome in outcomes if outcome.joined_before}
    counted = [one for one in outcomes if one.turns_at not in early]
    known = {one.turns_at: one.join_time for one in counted if one.way.intent_known}
    return [_line(way, [one for one in counted if one.way == way], known) for way in WAYS]


def _line(way: Way, flown: Sequence[Outcome], known: dict[Second, Second]) -> list[str]:
    later = [one.join_time / known[one.turns_at] - 1.0 for one in flown if one.joined]
    return [
        way.name,
        "–" if way.intent_known else f"{100.0 * mean(later):.1f} %",
        "–" if way.intent_known else f"{100.0 * max(later):.1f} %",
        f"{max(one.swing for one in flown) / DEG:.0f}°",
        f"{min(one.least_share for one in flown):.3f}",
    ]


if __name__ == "__main__":
    sys.exit(main())
