"""Heights, other traffic and cells for people: how near a plan comes to them."""

from collections.abc import Iterable

from rich.console import Console

from relguide.cli.shared_tables import clock, miles, table
from relguide.flying.plan_documents import LevelChangeCard, Separation, VerticalCard
from relguide.units import FT


def print_levels(console: Console, levels: Iterable[LevelChangeCard]) -> None:
    """Print the changes of level that a plan has."""
    for level in levels:
        console.print(
            f"At {clock(level.at)} it leaves for {level.to_altitude / FT:,.0f} ft, "
            f"{level.rate / FT * 60.0:,.0f} ft a minute."
        )


def print_others(console: Console, separation: Separation) -> None:
    """Print when height keeps the leader apart, and a row for each of the others."""
    if separation.vertical:
        console.print(f"Height keeps the leader apart {_by_height(separation.vertical)}.")
    if not separation.others:
        return
    shown = table("keeps clear of")
    for heading in ("least", "to keep", "at", "proved above"):
        shown.add_column(heading, justify="right", no_wrap=True)
    kept_by_height = any(other.vertical for other in separation.others)
    if kept_by_height:
        shown.add_column("height keeps it apart")
    for other in separation.others:
        limit = miles(other.min_separation) if other.min_separation else "out of it"
        row = miles(other.least), limit, clock(other.at), miles(other.proved_above)
        height = (_by_height(other.vertical),) if kept_by_height else ()
        shown.add_row(other.ident, *row, *height)
    console.print(shown)


def _by_height(kept: Iterable[VerticalCard]) -> str:
    return ", ".join(
        f"by {part.least / FT:,.0f} ft from {clock(part.from_)} to {clock(part.to)}"
        for part in kept
    )
