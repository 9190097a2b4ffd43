"""The forecast is what cockpits draw as the committed path: what is flown afterwards lies on it."""

from collections.abc import Iterator
from dataclasses import replace
from functools import cache
from math import hypot

import numpy as np
import pytest

from relguide.flying.documents import ForecastChanged
from relguide.flying.scenarios import LEADER_TURNS_AT, fig_6, own_scenario
from relguide.planning.aircraft import Leader, Pursuer
from relguide.planning.situation import Situation
from relguide.planning.wind import wind_from
from relguide.units import DEG, KT, NM, Metre, Second
from tests.flights import Flown, Instant, fly_whole

PIXEL: Metre = 50.0
"""A pixel at the navigation display's shortest range, and a third more [m]."""
AROUND: Second = 60.0
"""A line that crosses itself is compared with only so long before and after an instant [s]."""

HEAD_ON = Situation(
    pursuer=Pursuer(x=30_000.0, y=3_000.0, heading=270 * DEG, tas=240.0, max_bank=25 * DEG),
    leader=Leader(x=0.0, y=0.0, heading=90 * DEG, tas=200.0),
    slot_distance=6.0 * NM,
    min_separation=5.0 * NM,
)
FARTHER = replace(HEAD_ON, pursuer=replace(HEAD_ON.pursuer, x=40_000.0))
IN_WIND = replace(HEAD_ON, wind=wind_from(200 * DEG, 78 * KT))
FLIGHTS = {
    "6a": (fig_6(intent_known=False), LEADER_TURNS_AT, 200.0),
    "6b": (fig_6(intent_known=True), 0.0, 900.0),
    "head-on, 353 degrees of turns": (own_scenario(FARTHER), 0.0, 450.0),
    "78 kt of wind": (own_scenario(IN_WIND), 0.0, 450.0),
}
"""By name: the flight, from when on it is looked at [s], how long one forecast must stand [s]."""


@cache
def flight_of(name: str) -> Flown:
    return fly_whole(FLIGHTS[name][0])


def standing(flight: Flown) -> Iterator[tuple[ForecastChanged, list[Instant]]]:
    """Each forecast, and what was flown until the next one took its place or it ended."""
    forecasts = flight.of(ForecastChanged)
    for k, forecast in enumerate(forecasts):
        until = forecasts[k + 1].t if k + 1 < len(forecasts) else flight.end.t
        until = min(until, forecast.times[-1])
        yield forecast, [s for s in flight.samples if forecast.t <= s.t <= until]


def cross_track(forecast: ForecastChanged, here: Instant) -> Metre:
    """Distance from the drawn line: straight lines between the points of the forecast."""
    times = np.array(forecast.times)
    near = np.abs(times - here.t) <= AROUND
    x, y = np.array(forecast.x)[near], np.array(forecast.y)[near]
    dx, dy = np.diff(x), np.diff(y)
    length = np.maximum(dx**2 + dy**2, 1e-9)
    px, py = here.pursuer.x - x[:-1], here.pursuer.y - y[:-1]
    along = np.clip((px * dx + py * dy) / length, 0.0, 1.0)
    return float(np.min(np.hypot(px - along * dx, py - along * dy)))


@pytest.mark.parametrize("name", FLIGHTS)
def test_what_is_flown_lies_on_the_line_that_was_drawn(name: str) -> None:
    _, since, stands = FLIGHTS[name]
    flight = flight_of(name)
    assert flight.result.joined
    longest = 0.0
    for forecast, instants in standing(flight):
        for here in instants:
            if here.t >= since:
                assert cross_track(forecast, here) <= PIXEL
                longest = max(longest, here.t - forecast.t)
    assert longest >= stands


@pytest.mark.parametrize("name", FLIGHTS)
def test_the_least_separation_of_a_forecast_is_what_is_flown(name: str) -> None:
    _, since, _ = FLIGHTS[name]
    for forecast, instants in standing(flight_of(name)):
        closest = forecast.pursuer_at_closest
        if forecast.t < since or not instants or instants[-1].t < closest.t:
            continue
        here = min(instants, key=lambda one: abs(one.t - closest.t))
        assert here.guidance.separation == pytest.approx(forecast.least_separation, abs=PIXEL)
        assert hypot(
            closest.x - forecast.leader_at_closest.x, closest.y - forecast.leader_at_closest.y
        ) == pytest.approx(forecast.least_separation, abs=1.0)
