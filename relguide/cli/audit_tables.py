"""Tables of audits, and how shares stand in them."""

from typing import TYPE_CHECKING

from relguide.learn.training.shares import Share

if TYPE_CHECKING:
    from rich.table import Table

WIDTH = 100
"""Of what is printed."""


def table(first: str, *, right: bool = False) -> "Table":
    """A table that has one column yet.

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
    """Print it, as wide as it may be."""
    from rich.console import Console

    Console(width=WIDTH).print(shown)


def percent(share: Share, digits: int = 2) -> str:
    """A share [%]; of nothing, a dash."""
    return f"{100.0 * share.value:.{digits}f}" if share.of else "–"


def with_interval(share: Share) -> str:
    """A share and its 95 % interval [%]."""
    low, high = share.interval
    return f"{percent(share)} ({100.0 * low:.2f}–{100.0 * high:.2f})"


def short(value: float) -> str:
    """Two digits of a number below 100."""
    return f"{value:,.0f}" if value >= 100.0 else f"{value:.2g}"
