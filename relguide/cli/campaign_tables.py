"""A campaign's report for people and for programs."""

from collections.abc import Callable, Mapping
from dataclasses import astuple
from math import isfinite
from pathlib import Path
from typing import Any

from relguide.campaign.campaign_file import Campaign, Point
from relguide.campaign.keys import Key
from relguide.campaign.report import CampaignReport, Estimate, PointReport
from relguide.campaign.row import FIGURES, Figure
from relguide.cli.output import write
from relguide.cli.shared_tables import percent, print_table, table, with_interval
from relguide.learn.training.shares import Share, share_as_json

SHARES: Mapping[str, Callable[[Share], str]] = {
    "joined": with_interval,
    "lost": with_interval,
    "lost_unannounced": percent,
    "failed": percent,
}
"""Shares in the table, and how they are written; JSON has more."""
SHOWN = {figure.name: figure for figure in FIGURES}


def command(folder: Path, flight: int | str) -> str:
    """What flies a flight again."""
    return f"relguide campaign show {folder} {flight}"


def print_keys(keys: Mapping[str, Key]) -> None:
    """Print what a campaign may vary or sweep, in the units of the names."""
    shown = table("key of vary, sweep")
    for heading in ("least", "most"):
        shown.add_column(heading, justify="right", no_wrap=True)
    shown.add_column("what it is")
    for name, key in keys.items():
        shown.add_row(name, f"{key.limits.low:,.9g}", f"{key.limits.high:,.9g}", key.says)
    print_table(shown)


def print_report(asked: Campaign, found: CampaignReport, folder: Path) -> None:
    """Print shares, figures, differences and the worst flights."""
    write(f"{asked.name}: {asked.total:,} flights\n")
    shares = table("share of flights, %")
    for name in SHARES:
        shares.add_column(name.replace("_", " "), justify="right", no_wrap=True)
    for point in found.points:
        cells = (written(point.shares[name]) for name, written in SHARES.items())
        shares.add_row(point.point.name, *cells)
    print_table(shares)
    for point in found.points:
        _print_point(point)
        _print_differences(point.point, found)
    worst = table("worst flights")
    worst.add_column("flight (what it has)")
    for name, named in found.worst.items():
        figure = SHOWN[name]
        flights = [f"{one.flight} ({_digits(figure, value)})" for value, one in named]
        worst.add_row(figure.heading, ", ".join(flights))
    print_table(worst)
    write(f"{command(folder, 'N')} flies one again, replay records it.\n")


def _print_point(point: PointReport) -> None:
    shown = table(point.point.name)
    for heading in ("mean", "median", "95 %", "its 95 % interval", "99 %", "worst"):
        shown.add_column(heading, justify="right", no_wrap=True)
    for name, found in point.figures.items():
        figure = SHOWN[name]
        median, most, nearly_all = found.quantiles.values()
        shown.add_row(
            figure.heading,
            _digits(figure, found.mean),
            _digits(figure, median.value),
            _digits(figure, most.value),
            _interval(figure, most),
            _digits(figure, nearly_all.value),
            _digits(figure, found.worst),
        )
    print_table(shown)
    if point.why_not_joined:
        reasons = ", ".join(f"{reason} {often}" for reason, often in point.why_not_joined.items())
        write(f"not joined: {reasons}\n")


def _print_differences(point: Point, found: CampaignReport) -> None:
    """What differs from the first point of the family."""
    own = [one for one in found.differences if one.point == point and any(astuple(one.mean))]
    if not own:
        return
    shown = table("more than in the same flights at first")
    for heading in ("pairs", "mean", "its 95 % interval"):
        shown.add_column(heading, justify="right", no_wrap=True)
    for one in own:
        figure = SHOWN[one.figure]
        shown.add_row(
            figure.heading,
            f"{one.pairs:,}",
            _digits(figure, one.mean.value),
            _interval(figure, one.mean),
        )
    print_table(shown)


def _interval(figure: Figure, found: Estimate) -> str:
    return f"{_digits(figure, found.low)} … {_digits(figure, found.high)}"


def _digits(figure: Figure, value: float) -> str:
    return f"{value:,.{figure.decimals}f}"


def report_as_json(asked: Campaign, found: CampaignReport, folder: Path) -> dict[str, Any]:
    """The same for programs; a figure by its unit as the table has it, shares of 1."""
    return {
        **asked.as_tables(),
        "points": [
            _about(point)
            | {"flights": point.flights}
            | {"shares": {name: share_as_json(share) for name, share in point.shares.items()}}
            | {
                "figures": {
                    SHOWN[name].heading: {
                        "flights": figure.flights,
                        "mean": figure.mean,
                        "quantiles": {
                            f"{share:g}": _estimate(made)
                            for share, made in figure.quantiles.items()
                        },
                        "worst": figure.worst,
                    }
                    for name, figure in point.figures.items()
                },
                "why_not_joined": dict(point.why_not_joined),
            }
            for point in found.points
        ],
        "differences": [
            {
                "figure": SHOWN[one.figure].heading,
                "family": one.point.family,
                "at": dict(one.point.values),
                "pairs": one.pairs,
                "mean": _estimate(one.mean),
            }
            for one in found.differences
        ],
        "worst": {
            SHOWN[name].heading: [
                {"flight": one.flight, "value": value, "command": command(folder, one.flight)}
                for value, one in named
            ]
            for name, named in found.worst.items()
        },
    }


def _about(point: PointReport) -> dict[str, Any]:
    return {"family": point.point.family, "at": dict(point.point.values)}


def _estimate(found: Estimate) -> Mapping[str, Any]:
    interval = [found.low, found.high] if isfinite(found.low) else None
    return {"value": found.value, "interval_95": interval}
