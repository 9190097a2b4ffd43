"""The wind blows, and guidance begins with none."""

from math import pi

import pytest

from relguide.figures.ours.wrong_wind import _in_wind
from relguide.planning.wind import CALM


def test_the_wind_is_not_the_believed_one() -> None:
    asked = _in_wind(0.5 * pi, 30.0)
    assert asked.air.wind.east == pytest.approx(-30.0)
    assert asked.believed_air is not None
    assert asked.believed_air.wind == CALM
