"""A picture is carried on between samples at their rate, and stands when none come."""

from dataclasses import replace

import pytest
from relguide_server.scene.extrapolation import FRAME, HELD, Glide

from relguide.flying.documents import Sample
from tests.server.flown import ideal_flight

FIRST = next(d for d in ideal_flight() if isinstance(d, Sample))


def glide_at(rate: float) -> Glide:
    """After a second of samples, twenty of them."""
    glide = Glide()
    for k in range(21):
        glide.note([replace(FIRST, t=rate * k / 20.0)], k / 20.0)
    return glide


def test_at_ten_times_the_pace_it_is_carried_on_each_fiftieth_of_a_second() -> None:
    glide = glide_at(10.0)
    assert glide.patience(1.01) == FRAME
    assert glide.ahead(1.02) == pytest.approx(0.2, rel=0.01)


def test_at_the_pace_of_life_the_samples_are_enough() -> None:
    assert glide_at(1.0).patience(1.01) is None


def test_without_samples_it_stands() -> None:
    glide = glide_at(10.0)
    assert glide.patience(1.01 + HELD) is None
    assert glide.ahead(5.0) == pytest.approx(10.0 * HELD, rel=0.01)
    glide.note([replace(FIRST, t=10.5)], 5.0)
    assert glide.patience(5.01) is None
