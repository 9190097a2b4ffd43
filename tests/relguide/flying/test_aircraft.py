"""An aircraft's velocity over the ground is that through the air and the wind's."""

from math import atan2, cos, hypot, pi, sin

import pytest
from hypothesis import given
from hypothesis import strategies as st

from relguide.flying.aircraft import AircraftState, GroundVelocity, ground_velocity
from relguide.units import DEG

CRUISE = AircraftState(0.0, 0.0, 0.0, 0.0, 0.0, 240.0, 9449.0)


def test_a_wind_from_the_left_drifts_to_the_right() -> None:
    velocity = ground_velocity(CRUISE, 20.0, -5.0)
    assert velocity == GroundVelocity(20.0, 235.0)
    assert velocity.speed == pytest.approx(hypot(20.0, 235.0))
    assert 0.0 < velocity.track < 10.0 * DEG


@given(st.floats(0.0, 6.28), st.floats(50.0, 300.0), st.floats(-60.0, 60.0), st.floats(-60.0, 60.0))
def test_velocities_add_up(heading: float, tas: float, east: float, north: float) -> None:
    state = CRUISE._replace(heading=heading, tas=tas)
    velocity = ground_velocity(state, east, north)
    assert velocity == pytest.approx((tas * sin(heading) + east, tas * cos(heading) + north))
    assert 0.0 <= velocity.track < 2.0 * pi
    if velocity.speed > 1.0:
        assert (sin(velocity.track), cos(velocity.track)) == pytest.approx(
            (velocity.east / velocity.speed, velocity.north / velocity.speed)
        )
        wanted = atan2(velocity.east, velocity.north) % (2.0 * pi)
        assert abs((velocity.track - wanted + pi) % (2.0 * pi) - pi) < 1e-9
