"""Can an aircraft fly so fast, so slow, so banked at a level? And at which level could it?"""

from math import ceil, floor, inf
from typing import NamedTuple

from relguide.flying.air import Air
from relguide.flying.airframe import Airframe, TasRange
from relguide.planning.inputs import expect_within
from relguide.planning.limits import TAS
from relguide.units import DEG, FT, KT, Kilogram, Metre, MetrePerSecond, Radian

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


class Flown(NamedTuple):
    """A type as it is flown: what its speeds depend on, beside the level."""

    airframe: Airframe
    air: Air
    weight: Kilogram
    bank: Radian

    def speeds(self, level: Metre) -> TasRange:
        """What can be flown at a level, in whole knots; none where not even one knot lies within.

        Thrust need not hold the bank, lift must carry it.
        """
        found = self.airframe.tas_range(level, self.air, self.weight, self.bank)
        whole = found.least < inf and ceil(found.least / KT) <= floor(found.most / KT)
        return found if whole else TasRange(inf, 0.0)

    def admits(self, level: Metre, tas: MetrePerSecond) -> bool:
        """Whether a speed can be flown at a level."""
        least, most = self.speeds(level)
        return least * (1.0 - SPEED_SLACK) <= tas <= most * (1.0 + SPEED_SLACK)

    @property
    def banked(self) -> str:
        """` with 25° of bank`; empty where wings are level."""
        return f" with {abs(self.bank) / DEG:.3g}° of bank" if self.bank else ""

    def at(self, level: Metre) -> str:
        """`at FL390 at 140 t`."""
        return f"at {flight_level(level)} at {self.weight / 1000.0:.4g} t"


def envelope_fault(
    airframe: Airframe,
    altitude: Metre,
    air: Air,
    *,
    tas: MetrePerSecond,
    bank: Radian = 0.0,
    weight: Kilogram = 0.0,
) -> str:
    """Why something cannot be flown, in one sentence in a crew's units; empty if it can.

    Args:
        airframe: the type.
        altitude: pressure altitude [m].
        air: its temperature counts, its wind does not.
        tas: true airspeed [m/s].
        bank: to either side [rad].
        weight: [kg]; 0 for the reference weight.
    """
    who = f"The {airframe.designator}"
    if altitude > airframe.ceiling + LEVEL_SLACK:
        top = flight_level(airframe.ceiling)
        return f"{who} cannot fly at {flight_level(altitude)}: choose {top}, its ceiling, or below."
    if abs(bank) > airframe.max_bank * (1.0 + SPEED_SLACK):
        most = f"{airframe.max_bank / DEG:g}°"
        return f"{who} cannot bank by {abs(bank) / DEG:g}°: choose {most} or less."
    flown = Flown(airframe, air, weight or airframe.reference_weight, abs(bank))
    if flown.admits(altitude, tas):
        return ""
    least, most_tas = flown.speeds(altitude)
    if least > most_tas:
        return f"{who} {_too_high(flown, altitude)}"
    why = _too_fast(flown, altitude, tas) if tas > most_tas else _too_slow(flown, altitude, tas)
    return f"{who} {why}"


def level_for(
    airframe: Airframe,
    air: Air,
    *,
    slowest: MetrePerSecond,
    fastest: MetrePerSecond,
    preferred: Metre = FL310,
    bank: Radian = 0.0,
    weight: Kilogram = 0.0,
) -> Metre:
    """The level nearest to the preferred one at which two speeds can both be flown.

    Args:
        airframe: the type.
        air: its temperature counts, its wind does not.
        slowest: true airspeed [m/s]; it keeps 2 % from the least speed.
        fastest: true airspeed [m/s], not below `slowest`.
        preferred: pressure altitude [m]; the others are whole thousands of feet.
        bank: that the lift must allow for [rad].
        weight: [kg]; 0 for the reference weight.

    Returns:
        A pressure altitude [m] from FL010 to the ceiling; of two equally near the lower.

    Raises:
        ValueError: if there is no such level, with what would be right.
    """
    slowest = expect_within("slowest", slowest, *TAS)
    fastest = expect_within("fastest", fastest, slowest, TAS.high, TAS.unit)
    flown = Flown(airframe, air, weight or airframe.reference_weight, bank)
    speeds = {level: flown.speeds(level) for level in _levels(airframe, preferred)}
    levels = list(speeds)
    slow = [level for level in levels if slowest >= _sent(speeds[level]) * (1.0 - SPEED_SLACK)]
    fast = [level for level in levels if fastest <= speeds[level].most * (1.0 + SPEED_SLACK)]
    both = [level for level in slow if level in fast]
    if both:
        return both[0]
    who = f"The {airframe.designator}"
    if not slow:
        low = min(levels)
        raise ValueError(
            f"{who} can fly {_knots(slowest)} at no level: choose {ceil(_sent(speeds[low]) / KT)}"
            f" kt or more, its slowest at {flight_level(low)}{flown.banked} with 2 % in hand."
        )
    if not fast:
        best = max(levels, key=lambda level: speeds[level].most)
        raise ValueError(
            f"{who} can fly {_knots(fastest)} at no level: choose"
            f" {floor(speeds[best].most / KT)} kt or less, its fastest at {flight_level(best)}."
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


def _sent(speeds: TasRange) -> MetrePerSecond:
    """The slowest that an aircraft is sent at [m/s]."""
    return SLOW_MARGIN * speeds.least


def _too_high(flown: Flown, altitude: Metre) -> str:
    """What is wrong and what would be right, after "The A306"."""
    thrust = flown.airframe.tas_range(altitude, flown.air, flown.weight, flown.bank).least < inf
    why = "climb thrust keeps no speed" if thrust else "no speed carries it"
    usable = [
        level
        for level in _levels(flown.airframe, altitude)
        if level < altitude and flown.speeds(level).least < inf
    ]
    right = f"choose {flight_level(usable[0])} or below" if usable else "choose a lower weight"
    return f"cannot fly {flown.at(altitude)}: {why} there{flown.banked}; {right}."


def _too_fast(flown: Flown, altitude: Metre, tas: MetrePerSecond) -> str:
    """What is wrong and what would be right, after "The A306"."""
    airframe, air = flown.airframe, flown.air
    most = flown.speeds(altitude).most
    knots = floor(most / KT)
    by_mach = air.tas_from_mach(airframe.m_mo, altitude)
    by_cas = air.tas_from_cas(airframe.v_mo, altitude)
    where = f"at {flight_level(altitude)}"
    if most < min(by_mach, by_cas) * (1.0 - SPEED_SLACK):
        where, why = flown.at(altitude), f"thrust and lift{flown.banked} allow {knots} kt there"
    elif by_mach < by_cas:
        why = f"M {airframe.m_mo:g} allows {knots} kt there"
    else:
        why = f"{airframe.v_mo / KT:g} kt CAS allows {knots} kt there"
    fast = [level for level in _levels(airframe, altitude) if flown.admits(level, tas)]
    instead = f", or {flight_level(fast[0])}" if fast else ""
    return f"cannot fly {_knots(tas)} {where}: {why}; choose {knots} kt or less{instead}."


def _too_slow(flown: Flown, altitude: Metre, tas: MetrePerSecond) -> str:
    """What is wrong and what would be right, after "The A306"."""
    knots = ceil(flown.speeds(altitude).least / KT)
    slow = [level for level in _levels(flown.airframe, altitude) if flown.admits(level, tas)]
    instead = f", or {flight_level(slow[0])} or below" if slow else ""
    return (
        f"cannot fly {_knots(tas)} {flown.at(altitude)}: the least speed{flown.banked} is"
        f" {knots} kt there; choose {knots} kt or more{instead}."
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
