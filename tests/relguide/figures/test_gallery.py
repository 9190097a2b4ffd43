"""docs/gallery.md is what the command writes of the catalogue."""

from pathlib import Path

import pytest

from relguide.figures.catalogue import FIGURES
from relguide.figures.drawn import as_svg, draw
from relguide.figures.gallery import FOLDER, page_of

DOCS = Path(__file__).parents[3] / "docs"
PAGE = (DOCS / "gallery.md").read_text("utf-8")
MOST = 2.5e6
"""Of all pictures together [bytes]."""
FRESH = "draw it anew: relguide figures --gallery docs/gallery.md"


def test_a_page_shows_title_picture_caption_and_command() -> None:
    page = page_of([(FIGURES["fig_6a"], "Joined after 1 s.")])
    assert "## Fig. 6a: without the leader's intent\n\n![Fig. 6a" in page
    assert "](figures/gallery/fig_6a.svg)\n\nJoined after 1 s.\n\n`relguide figures fig_6a`" in page


def test_the_gallery_shows_all_of_them_in_order() -> None:
    titles = [line[3:] for line in PAGE.splitlines() if line.startswith("## ")]
    assert titles == [figure.title for figure in FIGURES.values()], FRESH
    files = {file.stem: file for file in (DOCS / FOLDER).iterdir()}
    assert set(files) == set(FIGURES)
    assert sum(file.stat().st_size for file in files.values()) < MOST


@pytest.mark.parametrize("name", ["fig_1", "fig_2", "fig_3", "fig_5", "intent", "planners"])
def test_captions_are_fresh(name: str) -> None:
    drawn = draw(FIGURES[name])
    assert f"\n\n{drawn.caption}\n\n`relguide figures {name}`\n" in PAGE, FRESH
    assert b"<svg" in as_svg(drawn)
