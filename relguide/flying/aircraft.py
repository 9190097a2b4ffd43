"""An aircraft at one instant, as documents and displays show it."""

from math import atan2, cos, hypot, sin
from typing import NamedTuple

from relguide.kernels.base.angles import wrap
from relguide.units import Metre, MetrePerSecond, Radian, RadianPerSecond


class AircraftState(NamedTuple):
    """One aircraft at one instant; a named tuple because forty are made in a flown second."""

    x: Metre
    """East over the ground [m]."""
    y: Metre
    """North over the ground [m]."""
    heading: Radian
    """Clockwise from north [rad], in [0, 2π)."""
    bank: Radian
    """Positive right wing down [rad]."""
    roll_rate: RadianPerSecond
    """Rate of the bank [rad/s]."""
    tas: MetrePerSecond
    """True airspeed [m/s]."""
    altitude: Metre
    """Above the 1013 hPa surface [m]."""


class GroundVelocity(NamedTuple):
    """Velocity over the ground."""

    east: MetrePerSecond
    north: MetrePerSecond

    @property
    def speed(self) -> MetrePerSecond:
        """Ground speed V_G [m/s]."""
        return hypot(self.east, self.north)

    @property
    def track(self) -> Radian:
        """Direction χ, clockwise from north [rad], in [0, 2π)."""
        return wrap(atan2(self.east, self.north))


def ground_velocity(
    state: AircraftState, wind_east: MetrePerSecond, wind_north: MetrePerSecond
) -> GroundVelocity:
    """Air velocity plus wind."""
    return GroundVelocity(
        state.tas * sin(state.heading) + wind_east, state.tas * cos(state.heading) + wind_north
    )
