"""What README and docs tell as measured is a claim, or exempt for a reason that is given."""

import re
from collections.abc import Iterator

import pytest

from relguide.claims.claim import all_claims
from relguide.claims.page import claims_page
from relguide.claims.uncovered import all_uncovered
from tests.pages import ROOT

MEASURED = re.compile(
    r"(?<![\w.])[\d,.]*\d\s?(?:%|µs|ms\b|kB|MB|GB)|\b\d[\d,]* of \d|[Oo]f \d[\d,]{2,}\b"
    r"|\d a second|\bnone of\b"
)
"""Shares, short times, sizes, rates and counts; longer times and lengths are settings mostly."""
NUMBER = re.compile(r"\d[\d,]*\.?\d*")
PAGES = ["README.md", *(f"docs/{p.name}" for p in sorted((ROOT / "docs").glob("*.md")))]
for made in ("docs/claims.md", "docs/gallery.md"):  # by commands, of what they measure
    PAGES.remove(made)


def parts(page: str) -> Iterator[str]:
    """Rows of tables, points of lists and sentences of a page, without its code blocks."""
    text = re.sub(r"^```.*?^```", "", page, flags=re.DOTALL | re.MULTILINE)
    for paragraph in re.split(r"\n\s*\n|\n(?=\s*[-|] ?)", text):
        words = " ".join(paragraph.split())
        yield from [words] if words.startswith("|") else re.split(r"(?<=[.;]) ", words)


def uncovered(page: str) -> list[str]:
    """What is measured and no claim of the page says."""
    said = [" ".join(claim.said.split()) for claim in all_claims() if claim.page == page]
    numbers = {number for one in said for number in NUMBER.findall(one) if len(number) > 1}
    return [
        part
        for part in parts((ROOT / page).read_text("utf-8"))
        if MEASURED.search(re.sub(r"`[^`]*`", "", part))
        and not numbers.intersection(NUMBER.findall(part))
        and not any(one in part for one in said)
    ]


@pytest.mark.parametrize("page", PAGES)
def test_measured_numbers_are_claims(page: str) -> None:
    exempt = [words for rows in all_uncovered() for words in rows.words.get(page, ())]
    left = uncovered(page)
    assert [part for part in left if not any(words in part for words in exempt)] == []
    assert [words for words in exempt if not any(words in part for part in left)] == []


def test_the_page_lists_what_was_measured_and_is_not_checked() -> None:
    page = claims_page(all_claims(), {}).partition("## Told, not checked")[2]
    for rows in all_uncovered():
        for words in (one for told in rows.words.values() for one in told):
            assert (words in page) == rows.measured, words
