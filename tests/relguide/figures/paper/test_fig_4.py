"""Fig. 4, from a tree so coarse that it is drawn at once."""

from dataclasses import replace

import pytest

from relguide.figures.drawn import as_svg
from relguide.figures.paper.fig_4 import PARAMETERS, draw
from relguide.figures.style import house_style
from relguide.units import DEG


@pytest.mark.slow
def test_it_advances_to_its_end_and_says_what_was_laid() -> None:
    reached: list[float] = []
    coarse = replace(
        PARAMETERS, order=3, delta_theta=20.0 * DEG, delta_l=10e3, cell=10e3, horizon=300.0
    )
    with house_style():
        drawn = draw(reached.append, coarse)
    assert sum(reached) == pytest.approx(1.0)
    assert "regular trajectories of order ≤ 3" in drawn.caption
    assert "reverse dynamic programming" in as_svg(drawn).decode()
