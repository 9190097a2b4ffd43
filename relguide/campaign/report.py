"""report(manifest, rows): what became of a campaign's flights, with what chance leaves open.

Shares have Wilson's 95 % interval: none of 10⁵ flights says less than 4 in 10⁵. Quantiles have that
of the bootstrap, drawn exactly: the r-th of n values drawn again is the one at rank ⌈n U⌉, where U
has the distribution Beta(r, n − r + 1). Differences are of flights with the same number.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from math import ceil, sqrt

import numpy as np
from numpy.typing import NDArray

from relguide.campaign.campaign_file import Campaign, Point
from relguide.campaign.row import FIGURES, Figure, Row
from relguide.learn.training.shares import Share, Z

WORST = 10
"""Flights named for each figure."""
QUANTILES = (0.5, 0.95, 0.99)
"""So many flights are no worse."""
RESAMPLES = 4_000
"""Of the bootstrap: its 95 % interval is then certain to 1 % of its width."""
SHARES: Mapping[str, Callable[[Row], bool]] = {
    "joined": lambda row: row.joined,
    "planned": lambda row: row.planned,
    "lost": lambda row: bool(row.losses),
    "lost_unannounced": lambda row: row.silent_losses > 0,
    "circled": lambda row: row.lone_loops > 0,
    "failed": lambda row: bool(row.error),
}
"""What is said of how many flights: joined; had a plan at the start; lost d_min, and without a
word; circled behind a leader that did not; ended with an exception."""
Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class FlownRow:
    """A flight as it is in the table."""

    flight: int
    point: Point
    row: Row


@dataclass(frozen=True, slots=True, kw_only=True)
class Estimate:
    """A number, and where it would lie for all flights that could have been drawn."""

    value: float
    low: float
    high: float


@dataclass(frozen=True, slots=True, kw_only=True)
class FigureReport:
    """What flights have of a figure."""

    flights: int
    mean: float
    quantiles: Mapping[float, Estimate]
    worst: float


@dataclass(frozen=True, slots=True, kw_only=True)
class PointReport:
    """What became of the flights at one point."""

    point: Point
    flights: int
    shares: Mapping[str, Share]
    figures: Mapping[str, FigureReport]
    """By the name of the figure; those that no flight has are left out."""
    why_not_joined: Mapping[str, int]


@dataclass(frozen=True, slots=True, kw_only=True)
class Difference:
    """How much a figure differs from the first point's, flight by flight."""

    figure: str
    point: Point
    pairs: int
    mean: Estimate


@dataclass(frozen=True, slots=True, kw_only=True)
class CampaignReport:
    """What became of a campaign."""

    points: tuple[PointReport, ...]
    differences: tuple[Difference, ...]
    worst: Mapping[str, tuple[tuple[float, FlownRow], ...]]
    """By figure: its worst flights."""


def report(asked: Campaign, flown: Sequence[FlownRow]) -> CampaignReport:
    """What became of the flights of a campaign."""
    found = [[one for one in flown if one.point == point] for point in asked.points]
    return CampaignReport(
        points=tuple(
            _point_report(point, [one.row for one in own])
            for point, own in zip(asked.points, found, strict=True)
            if own
        ),
        differences=tuple(_differences(asked.points, found)),
        worst={figure.name: named for figure in FIGURES if (named := _worst(figure, flown))},
    )


def _point_report(point: Point, rows: Sequence[Row]) -> PointReport:
    reasons = [row.why_not_joined for row in rows if row.why_not_joined]
    return PointReport(
        point=point,
        flights=len(rows),
        shares={
            name: Share(hits=sum(map(holds, rows)), of=len(rows)) for name, holds in SHARES.items()
        },
        figures={
            figure.name: made
            for figure in FIGURES
            if (made := _figure_report(figure, rows)) is not None
        },
        why_not_joined={
            reason: reasons.count(reason)
            for reason in sorted(set(reasons), key=lambda one: (-reasons.count(one), one))
        },
    )


def _figure_report(figure: Figure, rows: Sequence[Row]) -> FigureReport | None:
    values = np.array([value for value, _ in figure.values(rows)])
    if not values.size:
        return None
    return FigureReport(
        flights=len(values),
        mean=float(values.mean()),
        quantiles={share: quantile(values, share, figure.low_is_worse) for share in QUANTILES},
        worst=float(values.min() if figure.low_is_worse else values.max()),
    )


def quantile(values: Floats, share: float, low_is_worse: bool = False) -> Estimate:
    """What so large a share of values is no worse than, with the bootstrap's 95 % interval."""
    n = len(values)
    ranked = np.sort(values)[::-1] if low_is_worse else np.sort(values)
    rank = min(max(ceil(share * n - 1e-9), 1), n)
    drawn = np.random.default_rng(0).beta(rank, n - rank + 1, RESAMPLES)
    again = ranked[np.minimum(np.ceil(n * drawn).astype(int), n) - 1]
    low, high = np.percentile(again, [2.5, 97.5])
    return Estimate(value=float(ranked[rank - 1]), low=float(low), high=float(high))


def _differences(
    points: Sequence[Point], found: Sequence[Sequence[FlownRow]]
) -> "list[Difference]":
    """From the first point of each family, by figure."""
    made = []
    for point, own in zip(points, found, strict=True):
        first = next(i for i, other in enumerate(points) if other.family == point.family)
        if points[first] == point:
            continue
        before = {one.row.number: one.row for one in found[first]}
        pairs = [(before[one.row.number], one.row) for one in own if one.row.number in before]
        for figure in FIGURES:
            both = [
                (theirs[0][0], ours[0][0])
                for a, b in pairs
                if (theirs := figure.values([a])) and (ours := figure.values([b]))
            ]
            if both:
                change = np.array([b - a for a, b in both])
                made.append(
                    Difference(
                        figure=figure.name, point=point, pairs=len(both), mean=mean_of(change)
                    )
                )
    return made


def mean_of(values: Floats) -> Estimate:
    """A mean with its 95 % interval: z s/√n to each side."""
    n = len(values)
    mean = float(values.mean())
    half = Z * float(values.std(ddof=1)) / sqrt(n) if n > 1 else float("inf")
    return Estimate(value=mean, low=mean - half, high=mean + half)


def _worst(figure: Figure, flown: Sequence[FlownRow]) -> tuple[tuple[float, FlownRow], ...]:
    """The worst flights of a figure; where more is worse, none that has nothing to be seen of."""
    named = [
        (value, one)
        for one in flown
        for value, _ in figure.values([one.row])
        if figure.low_is_worse or round(value, figure.decimals) > 0.0
    ]
    sign = 1.0 if figure.low_is_worse else -1.0
    named.sort(key=lambda pair: (sign * pair[0], pair[1].flight))
    return tuple(named[:WORST])
