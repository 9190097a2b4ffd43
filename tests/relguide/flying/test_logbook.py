"""The documents of a flight, and the figures of its summary."""

from math import hypot

import numpy as np
import pytest

from relguide.flying.documents import (
    ForecastChanged,
)
from relguide.flying.guidance.forecast import BENT, NEVER, STRAIGHT_FOR, Forecast
from relguide.flying.logbook import PairNames, forecast_document
from relguide.flying.perception import SURE, Spread
from relguide.units import DEG

NAMES = PairNames("A", "B")


def forecast_of(headings: list[float], *, t: float = 100.0) -> Forecast:
    """A flight ahead with these headings, a second apart, at 200 m/s."""
    own = np.zeros((len(headings), 7))
    own[:, 2], own[:, 5] = headings, 200.0
    own[1:, 0] = np.cumsum(200.0 * np.sin(headings[:-1]))
    own[1:, 1] = np.cumsum(200.0 * np.cos(headings[:-1]))
    leader = own.copy()
    leader[:, 0] += 9_000.0
    account = np.full((len(headings) - 1, 6), 9_000.0)
    account[:, 1] = t + np.arange(len(account)) + 0.5
    return Forecast(t, own, leader, account, account[:, 0], NEVER)


def test_a_straight_forecast_is_a_point_every_half_minute() -> None:
    document = forecast_document(100.0, "A", forecast_of([0.5] * 121))
    assert isinstance(document, ForecastChanged)
    assert document.times == (100.0, 130.0, 160.0, 190.0, 220.0)
    assert len(document.x) == len(document.y) == len(document.heading) == 5
    assert hypot(document.x[-1], document.y[-1]) == pytest.approx(120 * 200.0)


def test_a_turning_forecast_strays_little_from_its_chords() -> None:
    headings = list(np.radians(np.linspace(0.0, 150.0, 101)))
    document = forecast_document(100.0, "A", forecast_of(headings))
    steps = np.diff(document.heading)
    assert steps.max() <= BENT + 1.5 * DEG  # and what it turns in the second after
    assert len(document.times) > 30
    assert max(np.diff(document.times)) <= STRAIGHT_FOR


def test_a_forecast_that_began_before_is_told_from_now_on() -> None:
    document = forecast_document(130.0, "A", forecast_of([0.0] * 61))
    assert (document.times[0], document.times[-1]) == (130.0, 160.0)
    assert document.y[0] == pytest.approx(30 * 200.0)


def test_a_forecast_says_where_both_will_be_when_they_are_closest() -> None:
    flown = forecast_of([0.0] * 61)
    flown.account[40, 0] = 8_000.0
    document = forecast_document(110.0, "A", flown)
    assert document.least_separation == 8_000.0
    own, leader = document.pursuer_at_closest, document.leader_at_closest
    assert (own.t, leader.t) == (140.5, 140.5)
    assert own.y == pytest.approx(40.5 * 200.0)
    assert (leader.x, leader.y) == (9_000.0, own.y)


def test_a_forecast_at_its_end_is_closest_there() -> None:
    document = forecast_document(160.0, "A", forecast_of([0.0] * 61))
    assert document.least_separation == pytest.approx(9_000.0)
    assert document.pursuer_at_closest.y == pytest.approx(60 * 200.0)


def test_headings_of_a_forecast_are_those_of_a_compass() -> None:
    document = forecast_document(100.0, "A", forecast_of([7.0] * 31))
    assert document.heading[0] == pytest.approx(7.0 - 2.0 * np.pi)


def test_a_path_is_a_line_where_all_is_exact_and_wider_with_time_where_it_is_not() -> None:
    """At the join it may be as far aside as the slot, and as far as the wind carries it."""
    ahead = forecast_of([0.5] * 121)._replace(join_time=220.0)
    assert forecast_document(100.0, "A", ahead).aside == ()
    unsure = Spread(place=50.0, velocity=1.0, wind=0.5)
    aside = forecast_document(100.0, "A", ahead, unsure).aside
    assert aside[0] == 0.0
    assert list(aside) == sorted(aside)
    assert aside[-1] == pytest.approx(SURE * hypot(60.0, hypot(50.0, 120.0)))
