"""The caption says what docs/flight.md says of the same table."""

from pathlib import Path

from relguide.figures.drawn import draw
from relguide.figures.ours.intent import FIGURE

PAGE = (Path(__file__).parents[4] / "docs" / "flight.md").read_text("utf-8")


def test_the_caption_and_the_page_agree() -> None:
    row = next(line for line in PAGE.splitlines() if line.startswith("| intent unknown |"))
    _, _, mean, most, *_ = (cell.strip() for cell in row.split("|"))
    assert f"ours joins {mean} later on average, {most} at most" in draw(FIGURE).caption
