"""The page that shows figures, with their captions and commands."""

from collections.abc import Iterable
from pathlib import Path

from relguide.figures.drawn import NamedFigure

FOLDER = Path("figures") / "gallery"
"""Where the figures are, seen from the page."""
HEAD = """# What do the figures look like?

The paper's figures, then ours. `relguide figures --gallery docs/gallery.md` draws them all and
writes this page.
"""


def page_of(told: Iterable[tuple[NamedFigure, str]]) -> str:
    """The page in Markdown.

    Args:
        told: figures with their captions, in order.
    """
    return HEAD + "".join(
        f"\n## {figure.title}\n\n![{figure.title}]({(FOLDER / figure.name).as_posix()}.svg)\n\n"
        f"{caption}\n\n`{figure.command}`\n"
        for figure, caption in told
    )
