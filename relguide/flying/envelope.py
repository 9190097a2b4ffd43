"""Can an aircraft fly so fast, so slow, so banked at a level? And at which level could it?"""

from math import ceil, floor

from relguide.flying.air import Air
from relguide.flying.airframe import Airframe
from relguide.planning.inputs import expect_within
from relguide.planning.limits import TAS
from relguide.units import DEG, FT, KT, Metre, MetrePerSecond, Radian

FL310: Metre = 9449.0
"""Where flights take place unless something asks for another level [m]."""
LEVEL_STEP: Metre = 1000.0 * FT
"""Between cruising levels of both directions [m]."""
LOWEST_LEVEL: Metre = 1000.0 * FT
"""Lowest level that is offered [m]."""
SLOW_MARGIN = 1.02
"""How far above its least speed an aircraft is sent: wind and thrust make speed vary a little."""
LEVEL_SLACK: Metre = 1.0
"""How far above the ceiling a level may lie [m]: levels are often given in whole metres."""
SPEED_SLACK = 1e-9
"""Relative; a bound given in knots comes back from m/s with its last digit changed."""


def envelope_fault(
    airframe: Airframe,
    altitude: Metre,
    air: Air,
    *,
    tas: MetrePerSecond,
    bank: Radian = 0.0,
) -> str:
    """Why something cannot be flown, in one sentence in a crew's units; empty if it can.

    Args:
        airframe: the type.
        altitude: pressure altitude [m].
        air: its temperature counts, its wind does not.
        tas: true airspeed [m/s].
        bank: to either side [rad].
    """
    who = f"The {airframe.designator}"
    if altitude > airframe.ceiling + LEVEL_SLACK:
        top = flight_level(airframe.ceiling)
        return f"{who} cannot fly at {flight_level(altitude)}: choose {top}, its ceiling, or below."
    if abs(bank) > airframe.max_bank * (1.0 + SPEED_SLACK):
        most = f"{airframe.max_bank / DEG:g}°"
        return f"{who} cannot bank by {abs(bank) / DEG:g}°: choose {most} or less."
    least, most_tas = airframe.tas_range(altitude, air)
    if tas > most_tas * (1.0 + SPEED_SLACK):
        return f"{who} {_too_fast(airframe, altitude, air, tas)}"
    if tas < least * (1.0 - SPEED_SLACK):
        return f"{who} {_too_slow(airframe, altitude, air, tas)}"
    return ""


def level_for(
    airframe: Airframe,
    air: Air,
    *,
    slowest: MetrePerSecond,
    fastest: MetrePerSecond,
    preferred: Metre = FL310,
) -> Metre:
    """The level nearest to the preferred one at which two speeds can both be flown.

    Args:
        airframe: the type.
        air: its temperature counts, its wind does not.
        slowest: true airspeed [m/s]; it keeps 2 % from the least speed.
        fastest: true airspeed [m/s], not below `slowest`.
        preferred: pressure altitude [m]; the others are whole thousands of feet.

    Returns:
        A pressure altitude [m] from FL010 to the ceiling; of two equally near the lower.

    Raises:
        ValueError: if there is no such level, with what would be right.
    """
    slowest = expect_within("slowest", slowest, *TAS)
    fastest = expect_within("fastest", fastest, slowest, TAS.high, TAS.unit)
    levels = _levels(airframe, preferred)
    slow = [level for level in levels if _slow_enough(airframe, level, air, slowest)]
    fast = [level for level in levels if _fast_enough(airframe, level, air, fastest)]
    both = [level for level in slow if level in fast]
    if both:
        return both[0]
    who = f"The {airframe.designator}"
    if not slow:
        low = min(levels)
        least = SLOW_MARGIN * airframe.tas_range(low, air).least
        raise ValueError(
            f"{who} can fly {_knots(slowest)} at no level: choose {ceil(least / KT)} kt or more,"
            f" its slowest at {flight_level(low)} with 2 % in hand."
        )
    if not fast:
        best = max(levels, key=lambda level: airframe.tas_range(level, air).most)
        most = airframe.tas_range(best, air).most
        raise ValueError(
            f"{who} can fly {_knots(fastest)} at no level: choose {floor(most / KT)} kt or less,"
            f" its fastest at {flight_level(best)}."
        )
    raise ValueError(
        f"{who} can fly both {_knots(slowest)} and {_knots(fastest)} at no level: the one needs"
        f" {_span(slow, levels)}, the other {_span(fast, levels)}; choose speeds closer together."
    )


def flight_level(altitude: Metre) -> str:
    """A pressure altitude as crews say it: `FL310`."""
    return f"FL{round(altitude / (100.0 * FT)):03d}"


def _levels(airframe: Airframe, near: Metre) -> list[Metre]:
    """A level, if below the ceiling, and all whole thousands of feet: the nearest to it first."""
    top = airframe.ceiling + LEVEL_SLACK
    steps = range(round(LOWEST_LEVEL / LEVEL_STEP), floor(top / LEVEL_STEP) + 1)
    others = [step * LEVEL_STEP for step in steps if abs(step * LEVEL_STEP - near) > LEVEL_SLACK]
    levels = [near, *others] if LOWEST_LEVEL - LEVEL_SLACK <= near <= top else others
    return sorted(levels, key=lambda level: (abs(level - near), level))


def _slow_enough(airframe: Airframe, level: Metre, air: Air, tas: MetrePerSecond) -> bool:
    return tas >= SLOW_MARGIN * airframe.tas_range(level, air).least * (1.0 - SPEED_SLACK)


def _fast_enough(airframe: Airframe, level: Metre, air: Air, tas: MetrePerSecond) -> bool:
    return tas <= airframe.tas_range(level, air).most * (1.0 + SPEED_SLACK)


def _too_fast(airframe: Airframe, altitude: Metre, air: Air, tas: MetrePerSecond) -> str:
    """What is wrong and what would be right, after "The A306"."""
    by_mach = air.tas_from_mach(airframe.m_mo, altitude)
    by_cas = air.tas_from_cas(airframe.v_mo, altitude)
    limits = (
        (by_mach, f"M {airframe.m_mo:g} allows {floor(by_mach / KT)} kt there"),
        (by_cas, f"{airframe.v_mo / KT:g} kt CAS allows {floor(by_cas / KT)} kt there"),
    )
    most, why = min(limits)
    fast = [
        level
        for level in _levels(airframe, altitude)
        if _fast_enough(airframe, level, air, tas) and tas >= airframe.tas_range(level, air).least
    ]
    instead = f", or {flight_level(fast[0])}" if fast else ""
    return (
        f"cannot fly {_knots(tas)} at {flight_level(altitude)}: {why};"
        f" choose {floor(most / KT)} kt or less{instead}."
    )


def _too_slow(airframe: Airframe, altitude: Metre, air: Air, tas: MetrePerSecond) -> str:
    """What is wrong and what would be right, after "The A306"."""
    least = airframe.tas_range(altitude, air).least
    levels = _levels(airframe, altitude)
    slow = [level for level in levels if tas >= airframe.tas_range(level, air).least]
    instead = f", or {flight_level(slow[0])} or below" if slow else ""
    return (
        f"cannot fly {_knots(tas)} at {flight_level(altitude)}: its least speed,"
        f" {airframe.least_cas / KT:.0f} kt CAS, is {ceil(least / KT)} kt there;"
        f" choose {ceil(least / KT)} kt or more{instead}."
    )


def _span(some: list[Metre], levels: list[Metre]) -> str:
    """Levels in a row, in words: `FL090 or below`, `FL260 … FL310`."""
    low, high = min(some), max(some)
    if low == min(levels):
        return f"{flight_level(high)} or below"
    if high == max(levels):
        return f"{flight_level(low)} or above"
    return f"{flight_level(low)} … {flight_level(high)}"


def _knots(tas: MetrePerSecond) -> str:
    return f"{tas / KT:.0f} kt"
