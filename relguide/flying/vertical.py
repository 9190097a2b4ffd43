"""How an aircraft climbs and descends, and which speed it keeps meanwhile.

    ḣ → ±min(rate, what its engines give, √(1.8 a |Δh|)),       |ḧ| ≤ a = 0.1 g

What the engines give is a rate of climb of V T/g at an excess T of thrust over weight, climb or
idle. It keeps calibrated airspeed or Mach number: whichever is the less, of the speed held and of
what the type flies at most, so that one goes over to the other at their crossover.
"""

from math import copysign, sqrt
from typing import NamedTuple

import numpy as np

from relguide.flying.air import Air
from relguide.flying.airframe import Airframe
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.flight.energy import full_deceleration, idle_deceleration, most_acceleration
from relguide.kernels.flight.flight_records import Limits
from relguide.planning.intent import SpeedRule
from relguide.units import G0, KT, Metre, MetrePerSecond, Second

PULL = 0.1 * G0
"""How fast a vertical speed changes [m/s²]."""
CAPTURE = 0.9 * PULL
"""The same as it levels off [m/s²]."""
CLIMB_SHARE = 0.8
"""Share of the excess of thrust that a climb takes: the rest is for speed and turns."""
SLOWING_SHARE = 0.5
"""Share of its drag by which an aircraft that is to slow down goes down."""
MACH_IN_HAND = 0.02
"""So far below M_MO the crossover is."""
SPEED_IN_HAND: MetrePerSecond = 10.0 * KT
"""… and so far below V_MO [m/s]."""


class Vertical(NamedTuple):
    """The altitude of an aircraft, and where it is to go."""

    altitude: Metre
    speed: MetrePerSecond
    """Positive up [m/s]."""
    to: Metre
    """The level it climbs or descends to, or flies at [m]."""
    rate: MetrePerSecond
    """How fast it is to go there, > 0 [m/s]."""
    hold: SpeedRule = "tas"
    tas: MetrePerSecond = 0.0
    """Kept by `hold`: what it flew when the change began [m/s] …"""
    cas: MetrePerSecond = 0.0
    """… the same as calibrated airspeed [m/s] …"""
    mach: float = 0.0
    """… and as Mach number."""

    @property
    def is_level(self) -> bool:
        """Whether it flies level, and is to go on so."""
        return self.speed == 0.0 and self.altitude == self.to


def level_at(altitude: Metre) -> Vertical:
    """In level flight."""
    return Vertical(altitude, 0.0, altitude, 1.0)


def level_off(now: Vertical) -> Vertical:
    """To the level that is reached soonest without a step."""
    to = now.altitude + 0.5 * now.speed * abs(now.speed) / PULL
    return now._replace(to=to, rate=max(abs(now.speed), PULL), hold="tas")


def begin_change(
    now: Vertical, to: Metre, rate: MetrePerSecond, hold: SpeedRule, tas: MetrePerSecond, air: Air
) -> Vertical:
    """To another level from now on.

    Args:
        now: as it flies.
        to: that level [m].
        rate: how fast [m/s], > 0.
        hold: what to keep.
        tas: true airspeed now [m/s].
        air: makes calibrated airspeed and Mach number of it.
    """
    cas, mach = air.cas_from_tas(tas, now.altitude), air.mach(tas, now.altitude)
    return Vertical(now.altitude, now.speed, to, rate, hold, tas, cas, mach)


def kept_tas(now: Vertical, airframe: Airframe, air: Air) -> MetrePerSecond:
    """The true airspeed that keeps what is held, at the present level [m/s]."""
    match now.hold:
        case "tas":
            return now.tas
        case "cas":
            crossover = max(airframe.m_mo - MACH_IN_HAND, now.mach)
            by_mach = air.tas_from_mach(crossover, now.altitude)
            return min(air.tas_from_cas(now.cas, now.altitude), by_mach)
        case "mach":
            crossover = max(airframe.v_mo - SPEED_IN_HAND, now.cas)
            by_cas = air.tas_from_cas(crossover, now.altitude)
            return min(air.tas_from_mach(now.mach, now.altitude), by_cas)


def engine_rates(
    limits: Limits, airframe: Airframe, tas: MetrePerSecond, *, slowing: bool
) -> tuple[MetrePerSecond, MetrePerSecond]:
    """The highest rates of climb and of descent, both ≥ 0 [m/s].

    Args:
        limits: what it can do in level flight.
        airframe: its type.
        tas: true airspeed [m/s].
        slowing: whether it is to slow down: then it goes down with half of its drag, brakes and
            all, and slows down with the rest.
    """
    climb = CLIMB_SHARE * tas * most_acceleration(limits, tas, 1.0) / G0
    descent = tas * idle_deceleration(limits, tas, 1.0) / G0
    if slowing:
        descent = SLOWING_SHARE * tas * full_deceleration(limits, tas, 1.0) / G0
    return (
        min(max(climb, 0.0), airframe.max_climb),
        min(max(descent, 0.0), airframe.max_descent),
    )


def commanded_climb(
    now: Vertical, climb: MetrePerSecond, descent: MetrePerSecond, dt: Second
) -> MetrePerSecond:
    """The rate of climb to go for: the autopilot's, and the flight director's [m/s].

    Args:
        now: as it flies.
        climb: the highest rate [m/s].
        descent: the same downward [m/s].
        dt: a step [s].
    """
    most = min(now.rate, climb if now.to > now.altitude else descent)
    return _towards(now.to - now.altitude, now.speed, most, dt)


def _towards(way: Metre, speed: MetrePerSecond, most: MetrePerSecond, dt: Second) -> MetrePerSecond:
    """The rate of climb that levels off at the end of a way [m/s]."""
    left = max(abs(way) - abs(speed) * dt, 0.0)
    return copysign(min(most, sqrt(2.0 * CAPTURE * left)), way)


def climb_by_stick(
    now: Vertical, pitch: float, climb: MetrePerSecond, descent: MetrePerSecond, dt: Second
) -> Vertical:
    """A step on by hand: full deflection pulls 0.1 g, neutral keeps the rate of climb.

    Args:
        now: as it flies.
        pitch: of the stick, −1 … 1, pulled positive.
        climb: the highest rate [m/s].
        descent: the same downward [m/s].
        dt: the step [s].
    """
    speed = min(max(now.speed + pitch * PULL * dt, -descent), climb)
    return now._replace(altitude=now.altitude + 0.5 * (now.speed + speed) * dt, speed=speed)


def fly_vertical(
    now: Vertical, climb: MetrePerSecond, descent: MetrePerSecond, steps: int, dt: Second
) -> tuple[Vertical, FloatArray]:
    """Some steps on.

    Args:
        now: as it flies.
        climb: the highest rate [m/s].
        descent: the same downward [m/s].
        steps: how many.
        dt: each of them [s].

    Returns:
        as it flies then; and the altitudes at each step, the present first. shape (steps + 1,)
    """
    altitudes = np.empty(steps + 1)
    altitude, speed = now.altitude, now.speed
    altitudes[0] = altitude
    most = min(now.rate, climb if now.to > now.altitude else descent)
    for k in range(steps):
        wanted = _towards(now.to - altitude, speed, most, dt)
        before, change = speed, min(max(wanted - speed, -PULL * dt), PULL * dt)
        speed += change
        altitude += 0.5 * (before + speed) * dt
        if abs(now.to - altitude) < PULL * dt and abs(speed) < 3.0 * PULL * dt:
            altitude, speed = now.to, 0.0
        altitudes[k + 1] = altitude
    return now._replace(altitude=float(altitude), speed=float(speed)), altitudes
