"""What an aircraft of a world can do at its level and weight."""

import numpy as np

from relguide.flying.air import Air
from relguide.flying.airframe import Airframe
from relguide.flying.world import Aircraft, Guided
from relguide.kernels.flight.energy import idle_deceleration
from relguide.kernels.flight.flight_records import Limits
from relguide.planning.limits import TAS
from relguide.units import MetrePerSecond

LEADERS_ACCELERATION = 0.1
"""A leader speeds up by so much at the least: often it is not of the type taken for it [m/s²]."""


def limits_of(aircraft: Aircraft, airframe: Airframe, air: Air) -> Limits:
    """What an aircraft can do at its level and weight.

    Leaders fly at any speed that is accepted, whatever their type: so they speed up and slow down,
    without brakes, as their type does at the speed nearest to theirs.
    """
    guided = isinstance(aircraft.pilot, Guided)
    rolls = (
        aircraft.autopilot_bank if guided else aircraft.max_bank,
        airframe.max_roll_rate,
        airframe.roll_time_constant,
        airframe.speed_time_constant,
    )
    if guided:
        level, weight = aircraft.altitude, airframe.expect_weight("weight", aircraft.weight)
        slowest, fastest = airframe.tas_range(level, air, weight)
        climb, idle, brakes, induced = airframe.energy(level, air, weight)
        return Limits(*rolls, *climb, *idle, brakes, induced, 1.0, slowest, fastest)
    level = min(aircraft.altitude, airframe.ceiling)
    slowest, fastest = airframe.tas_range(level, air)
    tas = min(max(aircraft.tas, slowest), fastest)
    faster = max(airframe.excess_acceleration(level, tas, air), LEADERS_ACCELERATION)
    slower = airframe.idle_deceleration(level, tas, air)
    return Limits(*rolls, faster, 0.0, 0.0, -slower, 0.0, 0.0, 0.0, 0.0, 1.0, TAS.low, TAS.high)


def dependable_deceleration(limits: Limits, tas: MetrePerSecond) -> float:
    """What idle thrust takes off at any speed from the least to a faster one [m/s²]."""
    speeds = np.linspace(limits.min_tas, max(tas, limits.min_tas), 5).tolist()
    return min(idle_deceleration(limits, speed, 1.0) for speed in speeds)
