"""Fig. 7: marks lie where the display shows what they stand for."""

from math import pi

import pytest

from relguide.figures.paper.fig_7 import ACROSS, ELEMENTS, OWN, RANGE, _on_display, _row
from relguide.units import NM


def test_marks_are_turned_nose_up() -> None:
    assert _on_display(0.0, 0.0, 1.0) == OWN
    ahead = _on_display(RANGE * NM, 0.0, 0.5 * pi)
    assert ahead == pytest.approx((OWN[0], OWN[1] - ACROSS))
    right = _on_display(0.0, -RANGE * NM, 0.5 * pi)
    assert right == pytest.approx((OWN[0] + ACROSS, OWN[1]))


def test_words_are_escaped() -> None:
    assert "d &lt; d_min" in _row(1, "d < d_min", "")
    assert len({name for name, _ in ELEMENTS}) == len(ELEMENTS)
