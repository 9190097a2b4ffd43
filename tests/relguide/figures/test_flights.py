"""Flights in columns: one row a second, headings without jumps, what was promised."""

from dataclasses import replace

import numpy as np

from relguide.figures.flights import flown
from relguide.flying.scenarios import own_scenario
from relguide.planning.aircraft import Leader, Pursuer
from relguide.planning.situation import Situation
from relguide.units import DEG


def test_a_flight_in_columns() -> None:
    near = Situation(
        pursuer=Pursuer(x=-20_000.0, y=0.0, heading=350.0 * DEG, tas=230.0, max_bank=25.0 * DEG),
        leader=Leader(x=0.0, y=0.0, heading=20.0 * DEG, tas=205.0),
        slot_distance=10_000.0,
        min_separation=5_000.0,
    )
    flight = flown(replace(own_scenario(near), after_joining=0.0))
    own, leader = flight.courses["PURSUER"], flight.courses["LEADER"]
    assert np.all(np.diff(flight.t) == 1.0)
    apart = np.hypot(own.x - leader.x, own.y - leader.y)
    assert np.allclose(apart, flight.separation["PURSUER"], atol=1e-6)
    assert np.abs(np.diff(own.heading)).max() < 0.1
    assert flight.result.joined
