"""What README and docs tell as measured is a claim, or exempt for a reason that is given."""

import re
from collections.abc import Iterator

import pytest

from relguide.claims.claim import all_claims
from tests.pages import ROOT

MEASURED = re.compile(
    r"(?<![\w.])[\d,.]*\d\s?(?:%|µs|ms\b|kB|MB|GB)|\b\d[\d,]* of \d|[Oo]f \d[\d,]{2,}\b"
    r"|\d a second|\bnone of\b"
)
"""Shares, short times, sizes, rates and counts; longer times and lengths are settings mostly."""
NUMBER = re.compile(r"\d[\d,]*\.?\d*")
EXEMPT = {
    "a setting, a bound or how others are measured": {
        "docs/campaign.md": ("30 % off what guidance believes", "Wilson's 95 % interval"),
        "docs/flight.md": (
            "draw them within 50 %",
            "median and 95 %",
            "95 % intervals in brackets",
        ),
        "docs/network.md": ("Of 100,000 fresh situations",),
        "docs/planner.md": ("compares plans with the best of 10,000 detours",),
        "docs/proof.md": ("until the gap is below 1 ms",),
        "docs/records.md": ("keeps 32 MB meanwhile",),
        "docs/scaling.md": ("what a watcher gets of 20 a second",),
        "docs/batch.md": ("d_min binds in 2 %",),
        "docs/service.md": (
            "more than 40 a second",
            "may have 64 kB",
            "20 a second, with all others",
            "200 MB each",
        ),
    },
    "held by a test": {
        "docs/cockpit.md": ("below 45 kB",),  # tests/browser/test_embed.py
        "docs/service.md": ("to 2 s or 1 %",),  # it is named there
        "docs/network.md": ("fastest path in 97 %",),  # a claim with more digits, above it
    },
    "of an empty machine, or of a load that needs a quiet one": {
        "docs/start.md": (
            "500 MB, and 41 MB",
            "about 300 MB",
            "0.23 GB",
            "0.28 GB",
            "0.47 GB",
            "0.68 GB",
            "takes 34 MB",
            "some 550 MB",
            "at 1 GB each",
            "builds a wheel of",
            "`pip wheel .` makes one",
        ),
        "docs/scaling.md": ("331 MB", "332 MB"),
        "docs/service.md": ("4 → 4–7 ms", "3 → 97 ms"),
        "docs/batch.md": ("22,383 a second", "A million took 242 MB"),
    },
    "of a run whose table is not kept": {
        "docs/atc.md": ("Of 641 manoeuvres refused",),
        "docs/flight.md": ("up to 7 % sooner", "none of 278 flights"),
        "docs/network.md": ("one gap of 120 %",),
        "docs/records.md": ("takes 723 kB",),
    },
}
"""Words of what no command measures, by the reason and the page."""
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
    exempt = [words for pages in EXEMPT.values() for words in pages.get(page, ())]
    left = uncovered(page)
    assert [part for part in left if not any(words in part for words in exempt)] == []
    assert [words for words in exempt if not any(words in part for part in left)] == []
