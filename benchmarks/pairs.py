"""Our pursuer in the place of real followers: `python -m benchmarks.pairs`.

Each pair of consecutive arrivals of the Paris data is flown from when both are seen: the leader as
it was recorded, its intent unknown; the pursuer from the follower's own place, height, track and
speed, descending with the leader. D is their real distance when the follower was established for
good on the leader's final line, and d_min 3 NM, or less where they were closer. What became of it
goes to benchmarks/results/real_pairs.csv; its figures are printed.
"""

import argparse
import sys
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from os import cpu_count
from statistics import median

import numpy as np

from benchmarks.arrivals import Pair, pairs
from benchmarks.options import positive
from benchmarks.tables import Cells, markdown, write_table
from benchmarks.unable import unable_at_the_end
from relguide import plan
from relguide.flying.air import STANDARD_AIR
from relguide.flying.airframe_files import airframe
from relguide.flying.documents import Document, FlightEnded
from relguide.flying.envelope import flight_level, level_for
from relguide.flying.flight import DEFAULT_TYPE, Scenario, fly
from relguide.planning.aircraft import Leader, Pursuer
from relguide.planning.progress import show_progress
from relguide.planning.situation import Situation
from relguide.units import DEG, NM, Metre, MetrePerSecond, Second

ON_LINE: Metre = 0.25 * NM
"""Nearer than this for good, a follower is established."""
LIMIT: Metre = 3.0 * NM
"""d_min in a terminal area."""
KEPT = 0.98
"""… or this share of what the real pair kept, where that is less."""
NAME = "real_pairs.csv"
HEADINGS = (
    "leader", "follower", "interval, s", "D, NM", "d_min, NM", "level",
    "real: established, s", "real: track, NM", "real: least, NM",
    "ours: joined, s", "ours: track, NM", "ours: least, NM", "why not",
)  # fmt: skip


@dataclass(frozen=True, slots=True, kw_only=True)
class Established:
    """When a real follower was established on its leader's final line, and after how long."""

    t: Second
    track: Metre
    distance: Metre
    """To the leader then: D."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Outcome:
    """What became of a pair, as it was and as ours."""

    pair: Pair
    real: Established
    level: str
    joined: bool
    join_time: Second
    track: Metre
    least: Metre
    lost: bool
    """Whether it lost d_min."""
    why: str
    """Why it did not join; empty if it did."""
    reason: str
    """In a word: what guidance is unable for, or that the recording ended first."""


def main(arguments: list[str] | None = None) -> int:
    """Fly them all, keep the table, and print its figures."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.pairs", description=__doc__)
    parser.add_argument("--processes", type=positive, default=cpu_count() or 1)
    outcomes = list(fly_pairs(parser.parse_args(arguments).processes))
    outcomes.sort(key=lambda outcome: (outcome.pair.leader.start, outcome.pair.leader.ident))
    write_table(NAME, HEADINGS, [_cells(outcome) for outcome in outcomes])
    print(markdown(SHOWN, _figures(outcomes)))  # noqa: T201
    return 0


def fly_pairs(processes: int) -> Iterator[Outcome]:
    """The outcomes, as they are flown."""
    found = pairs()
    with ProcessPoolExecutor(processes) as pool:
        flown = enumerate(pool.map(fly_pair, found), 1)
        for _, outcome in show_progress(
            flown, title="Flying pairs", total=len(found), done=lambda one: one[0]
        ):
            yield outcome


def established(pair: Pair) -> Established:
    """When the real follower was on the line for good."""
    off = np.flatnonzero(np.abs(pair.line.across(pair.follower)) > ON_LINE)
    at = min(int(off[-1]) + 1, len(pair.follower.t) - 1) if off.size else 0
    return Established(
        t=float(pair.follower.t[at]),
        track=float(np.sum(pair.follower.ground_speed[:at])),
        distance=float(pair.separation[at]),
    )


def fly_pair(pair: Pair) -> Outcome:
    """Ours in the place of the follower."""
    real = established(pair)
    try:
        scenario = _scenario(pair, real)
    except ValueError as refused:
        return Outcome(
            pair=pair, real=real, level="", joined=False, join_time=0.0, track=0.0, least=0.0,
            lost=False, why=str(refused), reason="speed",
        )  # fmt: skip
    documents = list(fly(scenario, plan, sample_period=1.0))
    ended = documents[-1]
    assert isinstance(ended, FlightEnded)
    (result,) = ended.results
    why, reason = ("", "") if result.joined else _why(documents)
    return Outcome(
        pair=pair,
        real=real,
        level=flight_level(scenario.altitude),
        joined=result.joined,
        join_time=result.join_time,
        track=result.track,
        least=result.least_separation,
        lost=bool(result.losses),
        why=why,
        reason=reason,
    )


def _scenario(pair: Pair, real: Established) -> Scenario:
    leader, follower = pair.leader.state_at(0.0), pair.follower.state_at(0.0)
    least = float(np.min(pair.separation))
    return Scenario(
        name="real_pair",
        title=f"{pair.follower.ident} behind {pair.leader.ident}",
        description="Ours in the place of a real follower.",
        situation=Situation(
            pursuer=Pursuer(
                x=follower.x, y=follower.y, heading=follower.track, tas=follower.ground_speed,
                max_bank=25.0 * DEG,
            ),
            leader=Leader(x=leader.x, y=leader.y, heading=leader.track, tas=leader.ground_speed),
            slot_distance=real.distance,
            min_separation=min(LIMIT, KEPT * least),
        ),
        intent_known=False,
        leader_source=pair.leader,
        leader_ident=pair.leader.ident,
        leader_type=pair.leader.aircraft_type or "unknown",
        altitude=_level(follower.ground_speed, follower.altitude),
        after_joining=0.0,
    )  # fmt: skip


def _level(first: MetrePerSecond, preferred: Metre) -> Metre:
    """Where ours can fly the follower's first speed, nearest to where the follower was."""
    can = airframe(DEFAULT_TYPE)
    return level_for(can, STANDARD_AIR, slowest=first, fastest=first, preferred=preferred)


def _why(documents: list[Document]) -> tuple[str, str]:
    """Why it flies no plan at the end, and its reason in a word."""
    why = unable_at_the_end(documents)
    if why:
        return why.message, why.reason
    return "still converging at the end of the recording", "end"


def _cells(outcome: Outcome) -> list[str]:
    pair, real = outcome.pair, outcome.real
    ours = [f"{outcome.join_time:.0f}", f"{outcome.track / NM:.1f}"] if outcome.joined else ["", ""]
    least = float(np.min(pair.separation))
    return [
        pair.leader.ident,
        pair.follower.ident,
        f"{pair.interval:.0f}",
        f"{real.distance / NM:.2f}",
        f"{min(LIMIT, KEPT * least) / NM:.2f}",
        outcome.level,
        f"{real.t:.0f}",
        f"{real.track / NM:.1f}",
        f"{least / NM:.2f}",
        *ours,
        f"{outcome.least / NM:.2f}" if outcome.level else "",
        outcome.why,
    ]


SHOWN = ("", "pairs", "real, s", "ours, s", "real, NM", "ours, NM")
"""Of the table that is printed: medians."""


def _figures(outcomes: list[Outcome]) -> Cells:
    joined = [outcome for outcome in outcomes if outcome.joined]
    sooner = [outcome for outcome in joined if outcome.join_time < outcome.real.t]
    later = [outcome for outcome in joined if outcome.join_time >= outcome.real.t]
    missed = [outcome for outcome in outcomes if not outcome.joined]
    groups = (
        ("joined", joined),
        ("sooner than the real follower", sooner),
        ("later", later),
        *(
            (
                f"not joined: {reason}",
                [outcome for outcome in missed if outcome.reason == reason],
            )
            for reason in sorted({outcome.reason for outcome in missed})
        ),
    )
    lost = [outcome for outcome in outcomes if outcome.lost]
    return [*(_line(name, some) for name, some in groups if some), _line("lost d_min", lost)]


def _line(name: str, outcomes: list[Outcome]) -> list[str]:
    joined = [outcome for outcome in outcomes if outcome.joined]
    return [
        name,
        f"{len(outcomes)}",
        _middle([outcome.real.t for outcome in outcomes]),
        _middle([outcome.join_time for outcome in joined]),
        _middle([outcome.real.track / NM for outcome in outcomes]),
        _middle([outcome.track / NM for outcome in joined]),
    ]


def _middle(values: list[float]) -> str:
    return f"{median(values):.0f}" if values else "–"


if __name__ == "__main__":
    sys.exit(main())
