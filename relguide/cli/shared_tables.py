"""Tables for people, and how times, lengths and shares are written in them."""

from collections.abc import Mapping
from typing import TYPE_CHECKING

from relguide.learn.training.shares import Share
from relguide.units import NM

if TYPE_CHECKING:
    from rich.table import Table

    from relguide.learn.audits.latency import Latency

WIDTH = 100
"""Of an audit's tables [characters]."""


def table(first: str, *, right: bool = False) -> "Table":
    """A table that has one column so far.

    Args:
        first: its heading.
        right: whether it holds numbers.
    """
    from rich.box import SIMPLE_HEAD
    from rich.table import Table

    shown = Table(box=SIMPLE_HEAD, pad_edge=False, collapse_padding=True)
    shown.add_column(first, no_wrap=True, justify="right" if right else "left")
    return shown


def print_table(shown: "Table") -> None:
    """Print a table, `WIDTH` characters wide at most."""
    from rich.console import Console

    Console(width=WIDTH).print(shown)


def print_latency(asked: Mapping[str, "Latency"]) -> None:
    """Print what a query takes, a row for each who is asked."""
    shown = table("CPU time of one query, µs")
    for heading in ("median", "mean", "99 %"):
        shown.add_column(heading, justify="right", no_wrap=True)
    for name, found in asked.items():
        shown.add_row(name, *(f"{spent:,.1f}" for spent in found))
    print_table(shown)


def clock(seconds: float) -> str:
    """A time as minutes and seconds: 9:03.4."""
    tenths = round(seconds * 10.0)
    return f"{tenths // 600}:{tenths % 600 / 10.0:04.1f}"


def miles(metres: float) -> str:
    """A length in nautical miles."""
    return f"{metres / NM:.2f} NM"


def percent(share: Share, digits: int = 2) -> str:
    """A share [%]; a dash if it is a share of nothing."""
    return f"{100.0 * share.value:.{digits}f}" if share.of else "–"


def with_interval(share: Share) -> str:
    """A share and its 95 % interval [%]."""
    low, high = share.interval
    return f"{percent(share)} ({100.0 * low:.2f}–{100.0 * high:.2f})"


def short(value: float) -> str:
    """A number below 100 with two digits; others without decimals."""
    return f"{value:,.0f}" if value >= 100.0 else f"{value:.2g}"
