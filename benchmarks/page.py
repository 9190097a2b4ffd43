"""Where figures stand: in benchmarks/results as CSV, in a page between two markers, as pictures."""

from pathlib import Path

DOCS = Path(__file__).parents[1] / "docs"
RESULTS = Path(__file__).parent / "results"
PAGE, FOLDER = DOCS / "planner.md", DOCS / "figures"
PICTURE, GALLERY = "contact.svg", FOLDER / "gallery"
COMMAND = "make planner-figures"
"""Makes the tables and pictures of docs/planner.md anew."""


def with_block(page: str, name: str, written: str) -> str:
    """The page with what stands between a block's markers exchanged; the rest is written by hand.

    Raises:
        ValueError: if it does not have both markers, once each and in order.
    """
    begin, end = f"<!-- {name}: begin -->", f"<!-- {name}: end -->"
    before, found, rest = page.partition(begin)
    _, closed, after = rest.partition(end)
    if not found or not closed or begin in rest or end in after:
        raise ValueError(f"The page must hold {begin} and then {end}, once each.")
    return f"{before}{begin}\n\n{written}\n\n{end}{after}"
