"""A figure of the catalogue: its name, what draws it, and the files that come of it."""

import re
from collections.abc import Callable
from dataclasses import dataclass
from io import BytesIO
from typing import TYPE_CHECKING

from relguide.figures.style import DOTS, house_style
from relguide.planning.extras import need

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Step = Callable[[float], None]
"""Called with each advance; they sum up to 1 at most."""
DIGITS = 1
"""Of coordinates in an SVG, behind the point [px]."""
NUMBERS = re.compile(r'(?<=[\s(])(?:d|x|y|width|height|points)="[^"]*"')
LONG = re.compile(rf"-?\d+\.\d{{{DIGITS + 1},}}")


@dataclass(frozen=True, slots=True)
class Drawn:
    """What was drawn, and what is to be said of it."""

    picture: "Figure | str"
    """Of matplotlib, or the text of an SVG."""
    caption: str
    """With numbers as they were computed, in plain text."""


@dataclass(frozen=True, slots=True, kw_only=True)
class NamedFigure:
    """A figure as it is listed, and how to draw it."""

    name: str
    """Also of its files."""
    title: str
    seconds: float
    """What drawing it takes of one processor, about [s]."""
    draw: Callable[[Step], Drawn]
    needs: tuple[str, ...] = ("matplotlib",)
    """Packages, by their names in `EXTRAS`."""

    @property
    def command(self) -> str:
        """What draws it."""
        return f"relguide figures {self.name}"


def draw(figure: NamedFigure, step: Step = lambda _: None) -> Drawn:
    """Draw one.

    Raises:
        MissingExtra: if a package that it needs is not installed.
    """
    need(*figure.needs)
    with house_style():
        return figure.draw(step)


def as_svg(drawn: Drawn) -> bytes:
    """The same drawing gives the same bytes."""
    if isinstance(drawn.picture, str):
        return drawn.picture.encode()
    file = BytesIO()
    with house_style():
        drawn.picture.savefig(file, format="svg", dpi=DOTS, metadata={"Date": None})
    lines = NUMBERS.sub(lambda found: _rounded(found[0]), file.getvalue().decode()).splitlines()
    return "\n".join(line.rstrip() for line in lines).encode() + b"\n"


def as_png(drawn: Drawn) -> bytes:
    """The same drawing gives the same bytes."""
    if isinstance(drawn.picture, str):
        need("resvg_py")
        from relguide.pictures.picture import Picture

        return Picture(drawn.picture).png()
    file = BytesIO()
    with house_style():
        drawn.picture.savefig(file, format="png", dpi=DOTS)
    return file.getvalue()


def _rounded(attribute: str) -> str:
    return LONG.sub(lambda found: f"{float(found[0]):.{DIGITS}f}", attribute)
