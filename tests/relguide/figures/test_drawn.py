"""Files of figures: the same bytes each time, coordinates no longer than they need to be."""

import re
from io import BytesIO
from xml.etree import ElementTree

import pytest

from relguide.figures.catalogue import FIGURES
from relguide.figures.drawn import Drawn, NamedFigure, as_png, as_svg, draw
from relguide.figures.style import DOTS, empty_figure
from relguide.planning.extras import MissingExtra


def test_the_same_figure_gives_the_same_bytes() -> None:
    once, again = (draw(FIGURES["fig_2"]) for _ in range(2))
    assert as_svg(once) == as_svg(again)
    assert as_png(once) == as_png(again)
    assert once.caption == again.caption


@pytest.mark.slow
@pytest.mark.parametrize("name", ["fig_6b", "fig_7"])
def test_flown_figures_do_so_too(name: str) -> None:
    once, again = (draw(FIGURES[name]) for _ in range(2))
    assert as_svg(once) == as_svg(again)


def test_letters_stay_letters_and_coordinates_short() -> None:
    figure = empty_figure(4.0, 3.0)
    axes = figure.subplots()
    axes.plot([0.0, 1.0 / 3.0], [0.0, 2.0 / 7.0])
    axes.set_title("0.123456 stays")
    text = as_svg(Drawn(figure, "")).decode()
    assert ElementTree.fromstring(text).tag.endswith("svg")
    assert ">0.123456 stays</text>" in text
    assert not re.search(r' d="[^"]*\.\d\d', text)


def test_pixels_are_as_many_as_asked_for() -> None:
    from PIL import Image

    figure = empty_figure(4.0, 3.0)
    figure.subplots()
    assert Image.open(BytesIO(as_png(Drawn(figure, "")))).size == (4 * DOTS, 3 * DOTS)


def test_what_is_missing_is_named_before_anything_is_drawn() -> None:
    def never(step: object) -> Drawn:
        raise AssertionError

    needy = NamedFigure(name="x", title="X", seconds=1.0, draw=never, needs=("no_such_package",))
    with pytest.raises(KeyError):
        draw(needy)
    torchless = NamedFigure(name="x", title="X", seconds=1.0, draw=never, needs=("quickjs",))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("relguide.planning.extras.is_installed", lambda name: False)
        with pytest.raises(MissingExtra, match=r"pip install 'relguide\[pictures\]'"):
            draw(torchless)
