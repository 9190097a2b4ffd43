"""The A300-like lateral model: how an aircraft rolls, turns, changes speed and moves.

Roll answers the ailerons as a first-order roll mode, heading follows bank by eq. (8), speed follows
the autothrust within what thrust and drag allow. Height is kept.
"""

from dataclasses import dataclass
from math import atan2, cos, hypot, pi, sin
from typing import NamedTuple

from relguide.kernels.base.angles import wrap
from relguide.kernels.flight.lateral import lateral_step
from relguide.units import DEG, Metre, MetrePerSecond, Radian, RadianPerSecond, Second


@dataclass(frozen=True, slots=True, kw_only=True)
class AircraftModel:
    """What an aircraft type can do."""

    aircraft_type: str
    """ICAO type designator."""
    max_bank: Radian
    """Bank the autopilot does not exceed [rad]."""
    max_roll_rate: RadianPerSecond
    """Roll rate at full autopilot authority [rad/s]."""
    roll_time_constant: Second
    """Roll mode: the roll rate's lag behind the ailerons [s]."""
    max_acceleration: MetrePerSecond
    """Along the path, at climb thrust [m/s²]."""
    max_deceleration: MetrePerSecond
    """Along the path, at idle thrust with speed brakes [m/s²], > 0."""
    speed_time_constant: Second
    """Lag of the autothrust: how fast it goes for the commanded speed when not at a limit [s]."""
    min_tas: MetrePerSecond
    """Slowest true airspeed the autothrust accepts [m/s]."""
    max_tas: MetrePerSecond
    """Fastest [m/s]."""

    def __post_init__(self) -> None:
        """Refuse what could not fly."""
        for name in (
            "max_bank",
            "max_roll_rate",
            "roll_time_constant",
            "max_acceleration",
            "max_deceleration",
            "speed_time_constant",
        ):
            if not getattr(self, name) > 0.0:
                raise ValueError(f"{name} must be above 0, not {getattr(self, name)}.")
        if self.max_bank >= pi / 2.0:
            raise ValueError("max_bank must be below 90°: level flight ends there.")
        if not 0.0 < self.min_tas < self.max_tas:
            raise ValueError("The speed range must satisfy 0 < min_tas < max_tas.")


A300 = AircraftModel(
    aircraft_type="A306",
    max_bank=25.0 * DEG,  # plateau of recorded turns: 24.4 … 25.9° (A320), 20 … 26.7° (A310)
    max_roll_rate=3.75 * DEG,  # median of recorded roll-ins from 5° to 20°, both types
    roll_time_constant=0.5,  # roll mode of a large transport in cruise: 0.4 … 0.8 s
    max_acceleration=0.4,  # thrust above drag left at climb thrust near FL310
    max_deceleration=1.0,  # g / (L/D) = 0.58 m/s² clean at L/D = 17; speed brakes near double it
    speed_time_constant=5.0,  # engines spool in 3 … 6 s at altitude
    min_tas=120.0,  # 210 kt indicated at FL100 is 125 m/s: clean manoeuvring speed, rounded down
    max_tas=250.0,  # M 0.82 at FL310 is 247 m/s
)
"""A300-600R."""


class AircraftState(NamedTuple):
    """One aircraft at one instant; a named tuple because forty are made in a simulated second."""

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


def step(
    model: AircraftModel,
    state: AircraftState,
    *,
    aileron: RadianPerSecond,
    commanded_tas: MetrePerSecond,
    wind_east: MetrePerSecond,
    wind_north: MetrePerSecond,
    duration: Second,
) -> AircraftState:
    """Fly for a short while: `kernels/flight/lateral.py` has the equations.

    Args:
        model: the aircraft's type.
        state: where it is now.
        aileron: the roll rate that the ailerons ask for [rad/s], positive to the right.
        commanded_tas: what the autothrust goes for [m/s].
        wind_east: toward the east [m/s].
        wind_north: toward the north [m/s].
        duration: the step [s]; roll and heading are exact to second order in it.
    """
    x, y, heading, bank, roll_rate, tas = lateral_step(
        *state[:6],
        aileron,
        min(max(commanded_tas, model.min_tas), model.max_tas),
        wind_east,
        wind_north,
        duration,
        model.max_roll_rate,
        model.roll_time_constant,
        model.speed_time_constant,
        model.max_acceleration,
        model.max_deceleration,
    )
    return AircraftState(x, y, heading, bank, roll_rate, tas, state.altitude)


def roll_lead(model: AircraftModel, from_bank: Radian, to_bank: Radian) -> Second:
    """How long before an instantaneous change of bank the roll must begin, to fly the same turn.

    A roll at constant rate turns as much as a jump of bank in the middle of it; the loops that
    command it add their lag.
    """
    return 0.5 * abs(to_bank - from_bank) / model.max_roll_rate + ROLL_LAG


ROLL_LAG: Second = 0.7
"""What the roll mode and the roll loop's soft end add: 0.74 s for 0 → 25°, 0.56 s for −25 → 25°."""
