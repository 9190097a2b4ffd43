"""Rows of a campaign as the tables of docs/flight.md: an overview, distributions, losses."""

from collections.abc import Iterator, Sequence

import numpy as np

from benchmarks.tables import Cells
from relguide.campaign.campaign_file import DERIVED
from relguide.campaign.report import mean_of
from relguide.campaign.row import FIGURES, Figure, Row
from relguide.cli.shared_tables import with_interval
from relguide.learn.training.shares import Share

OVERVIEW = (
    "family", "flights", "planned", "joined", "losses, planned", "losses, not planned",
    "of these avoidable", "losses without a word", "circles", "errors", "simulated s per CPU s",
)  # fmt: skip
OVER_PROMISE = "join over promise, median and 95 %, %"
INEXACT = (
    "the leader", "flights", "joined, %", OVER_PROMISE,
    "plans shown, median and 95 %", "losses with a plan", "without a word",
)  # fmt: skip
BY_HAND = (
    "the leader", "flights", "joined by hand, %", "by the autopilot, %", "later, %",
    "within 2° of the bar, %", "off the autopilot's path, median and 95 %, m",
    "losses with a plan", "without a word",
)  # fmt: skip
DISTRIBUTION = "figure", "flights", "mean", "median", "95 %", "99 %", "worst", "in flight"


def overview(rows: Sequence[Row]) -> Cells:
    """A line for each family: what became of its flights."""
    return [_overview_cells(family, own) for family, own in by_family(rows)]


def _overview_cells(family: str, rows: Sequence[Row]) -> list[str]:
    cpu = sum(row.cpu_s for row in rows)
    flown = sum(row.flown_s for row in rows)
    return [
        family,
        f"{len(rows):,}",
        f"{sum(row.planned for row in rows):,}",
        f"{sum(row.joined for row in rows):,}",
        f"{sum(bool(row.losses) for row in rows if row.planned):,}",
        f"{sum(bool(row.losses) for row in rows if not row.planned):,}",
        f"{sum(row.avoidable for row in rows if not row.planned):,}",
        f"{sum(row.silent_losses > 0 for row in rows):,}",
        f"{sum(row.loops > 0 for row in rows):,}",
        f"{sum(bool(row.error) for row in rows):,}",
        f"{flown / cpu:,.0f}" if cpu > 0.0 else "",
    ]


def inexact(rows: Sequence[Row]) -> Cells:
    """A line for each family that the family `mixed` draws from."""
    cells = []
    for base in DERIVED["mixed"].bases:
        own = [r for r in rows if DERIVED["mixed"].base(r.number) == base and not r.error]
        over = [100.0 * (r.join_over_promise - 1.0) for r in own if r.join_over_promise is not None]
        shown = [r.shown_replans for r in own]
        cells.append(
            [
                base,
                f"{len(own):,}",
                f"{100.0 * sum(r.joined for r in own) / len(own):.1f}",
                f"{np.median(over):.1f}, {np.percentile(over, 95):.1f}",
                f"{np.median(shown):.0f}, {np.percentile(shown, 95):.0f}",
                f"{sum(bool(r.losses) for r in own if r.planned)}",
                f"{sum(r.silent_losses > 0 for r in own)}",
            ]
        )
    return cells


def by_hand(rows: Sequence[Row]) -> Cells:
    """A line for each family that the family `flight_director` draws from, and one for all."""
    family = DERIVED["flight_director"]
    flown = [row for row in rows if not row.error]
    groups = {
        base: [row for row in flown if family.base(row.number) == base] for base in family.bases
    }
    return [_by_hand_cells(name, own) for name, own in {**groups, "all": flown}.items()]


def _by_hand_cells(name: str, rows: Sequence[Row]) -> list[str]:
    later = [100.0 * r.late_share for r in rows if r.late_share is not None]
    late = mean_of(np.array(later)) if later else None
    within = [100.0 * r.within_bar_share for r in rows if r.within_bar_share is not None]
    off = [r.off_autopilot_m for r in rows if r.off_autopilot_m is not None]
    return [
        name,
        f"{len(rows):,}",
        with_interval(Share(hits=sum(r.joined for r in rows), of=len(rows))),
        f"{100.0 * sum(r.autopilot_join_s is not None for r in rows) / len(rows):.1f}",
        f"{late.value:.2f} ({late.low:.2f} … {late.high:.2f})" if late else "",
        f"{np.mean(within):.1f}",
        f"{np.median(off):.0f}, {np.percentile(off, 95):.0f}",
        f"{sum(bool(r.losses) for r in rows if r.planned)}",
        f"{sum(r.silent_losses > 0 for r in rows)}",
    ]


def distributions(rows: Sequence[Row]) -> Cells:
    """A line for each figure."""
    return [_distribution(figure, rows) for figure in FIGURES if figure.values(rows)]


def _distribution(figure: Figure, rows: Sequence[Row]) -> list[str]:
    ranked = ranking(figure, rows)
    values = np.array([value for value, _ in ranked])
    # 95 of 100 flights are no worse than this, whichever way is worse
    shares = (50.0, 5.0, 1.0) if figure.low_is_worse else (50.0, 95.0, 99.0)
    numbers = [values.mean(), *np.percentile(values, shares), values[0]]
    return [
        figure.heading,
        f"{len(values):,}",
        *(f"{number:,.{figure.decimals}f}" for number in numbers),
        str(ranked[0][1].number),
    ]


def ranking(figure: Figure, rows: Sequence[Row]) -> list[tuple[float, Row]]:
    """Values with their rows, the worst first; of equals the flight with the lowest number."""
    sign = 1.0 if figure.low_is_worse else -1.0
    return sorted(figure.values(rows), key=lambda pair: (sign * pair[0], pair[1].number))


def losses(rows: Sequence[Row]) -> Cells:
    """Each loss, the worst first."""
    found = [(loss.separation_m, loss, row) for row in rows for loss in row.losses]
    return [
        [
            row.name,
            "yes" if row.planned else "no",
            f"{loss.t_s:,.0f}",
            f"{loss.separation_m:,.0f}",
            f"{loss.seconds:,.0f}",
            loss.mode,
            "silent" if loss.announced_s is None else f"{loss.announced_s:,.0f}",
            loss.cause,
        ]
        for _, loss, row in sorted(found, key=lambda item: (item[0], item[2].number))
    ]


LOSSES = "flight", "planned", "at s", "least m", "for s", "mode", "announced s before", "cause"


def by_family(rows: Sequence[Row]) -> Iterator[tuple[str, list[Row]]]:
    """Families in the order in which they were flown, with their rows."""
    for family in dict.fromkeys(row.family for row in rows):
        yield family, [row for row in rows if row.family == family]
