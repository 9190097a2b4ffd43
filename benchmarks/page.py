"""The page that quotes what is measured: docs/planner.md, its pictures and its tables' place."""

from pathlib import Path

DOCS = Path(__file__).parents[1] / "docs"
PAGE, FOLDER = DOCS / "planner.md", DOCS / "figures"
PICTURES = ("contact.svg", "distributions.svg")
COMMAND = "make planner-figures"
"""Makes all of it anew."""
BEGIN, END = "<!-- measured: begin -->", "<!-- measured: end -->"
"""The tables stand between these; the rest is written by hand."""


def with_block(page: str, written: str) -> str:
    """The page with what stands between its markers exchanged.

    Raises:
        ValueError: if it does not have both markers, once each and in order.
    """
    before, begin, rest = page.partition(BEGIN)
    _, end, after = rest.partition(END)
    if not begin or not end or BEGIN in rest or END in after:
        raise ValueError(f"The page must hold {BEGIN} and then {END}, once each.")
    return f"{before}{BEGIN}\n\n{written}\n\n{END}{after}"
