"""The air that aircraft fly in: the ICAO standard atmosphere, somewhat warmer or colder, and wind.

Altitudes are pressure altitudes [m], above the 1013.25 hPa surface, as altimeters give them en
route: pressure follows from altitude alone, temperature is the standard one plus a deviation ΔT.

    T = T₀ − L h + ΔT,                p = p₀ ((T₀ − L h)/T₀)^(g/(R L))       up to 11 km
    T = T₁₁ + ΔT,                     p = p₁₁ exp(−g (h − 11 km)/(R T₁₁))    from there to 20 km
    ρ = p/(R T),   a = √(γ R T),   M = V/a
    q = p ((1 + (γ−1)/2 M²)^(γ/(γ−1)) − 1)                                  impact pressure, M < 1
    CAS = a₀ √(2/(γ−1) ((1 + q/p₀)^((γ−1)/γ) − 1))

Constants and formulas of ICAO Doc 7488 (third edition, 1993). Calibrated airspeed is the speed with
the same impact pressure at sea level in the standard atmosphere.
"""

from dataclasses import dataclass
from math import exp, log, sqrt

from relguide.flying.wind_profile import WindProfile
from relguide.planning.inputs import Range, expect, expect_within
from relguide.planning.reprs import as_code
from relguide.planning.wind import CALM, Wind
from relguide.units import G0, Metre, MetrePerSecond, Second

GAMMA = 1.4
"""Ratio of the specific heats of air, γ."""
GAS_CONSTANT = 287.05287
"""Specific gas constant of dry air, R [m²/(K s²)]."""
SEA_LEVEL_TEMPERATURE = 288.15
"""T₀ [K]."""
SEA_LEVEL_PRESSURE = 101_325.0
"""p₀ [Pa]."""
SEA_LEVEL_SOUND_SPEED: MetrePerSecond = sqrt(GAMMA * GAS_CONSTANT * SEA_LEVEL_TEMPERATURE)
"""a₀ = 340.294 m/s."""
LAPSE_RATE = 0.0065
"""Temperature lost on the way up through the troposphere, L [K/m]."""
TROPOPAUSE: Metre = 11_000.0
"""Where temperature stops falling [m]."""
LOWEST_ALTITUDE: Metre = -1_000.0
"""Lowest accepted altitude [m]: airports below sea level in high pressure."""
HIGHEST_ALTITUDE: Metre = 20_000.0
"""Highest accepted altitude [m]: above it the standard atmosphere grows warmer."""
ISA_DEVIATION = Range(-60.0, 60.0, "K")
"""Accepted ΔT: beyond the coldest and the hottest air on record."""
GUSTS = Range(0.0, 10.0, "m/s")
"""Accepted σ of gusts: severe turbulence of MIL-F-8785C has 6.4 m/s."""

_TROPOPAUSE_TEMPERATURE = SEA_LEVEL_TEMPERATURE - LAPSE_RATE * TROPOPAUSE
_PRESSURE_EXPONENT = G0 / (GAS_CONSTANT * LAPSE_RATE)
_TROPOPAUSE_PRESSURE: float = (
    SEA_LEVEL_PRESSURE * (_TROPOPAUSE_TEMPERATURE / SEA_LEVEL_TEMPERATURE) ** _PRESSURE_EXPONENT
)


@dataclass(frozen=True, slots=True, kw_only=True, repr=False)
class Air:
    """The air as it is, or as an aircraft believes it to be.

    Examples:
        >>> rg.Air(wind=rg.wind_from(1.5, 20.0), gusts=1.5).gusts
        1.5
    """

    wind: Wind = CALM
    """The same everywhere, unless there is a profile."""
    profile: WindProfile | None = None
    """The wind by altitude, in place of `wind`."""
    isa_deviation: float = 0.0
    """How much warmer than the standard atmosphere, ΔT [K], at every altitude."""
    gusts: MetrePerSecond = 0.0
    """σ of gusts along and across an aircraft's heading [m/s], as in `kernels/flight/gusts.py`."""

    __repr__ = as_code

    def __post_init__(self) -> None:
        """Refuse what no atmosphere has."""
        expect("wind", self.wind, Wind)
        deviation = expect_within("isa_deviation", self.isa_deviation, *ISA_DEVIATION)
        object.__setattr__(self, "isa_deviation", deviation)
        gusts = expect_within("gusts", self.gusts, *GUSTS)
        object.__setattr__(self, "gusts", gusts)
        if self.profile is not None:
            expect("profile", self.profile, WindProfile)
            if self.wind != CALM:
                raise ValueError("wind must be left out where a profile gives it by altitude.")

    def wind_at(self, x: Metre, y: Metre, altitude: Metre, t: Second) -> Wind:
        """The wind at a place and a time, without gusts: only altitude makes a difference.

        Args:
            x: east over the ground [m].
            y: north over the ground [m].
            altitude: pressure altitude [m].
            t: since the flight began [s].
        """
        del x, y, t
        return self.wind if self.profile is None else self.profile.at(altitude)

    def temperature(self, altitude: Metre) -> float:
        """Static air temperature T [K] at a pressure altitude [m]."""
        return standard_temperature(altitude) + self.isa_deviation

    def density(self, altitude: Metre) -> float:
        """Density ρ = p/(R T) [kg/m³] at a pressure altitude [m]."""
        return pressure(altitude) / (GAS_CONSTANT * self.temperature(altitude))

    def sound_speed(self, altitude: Metre) -> MetrePerSecond:
        """Speed of sound a = √(γ R T) [m/s] at a pressure altitude [m]."""
        return sqrt(GAMMA * GAS_CONSTANT * self.temperature(altitude))

    def mach(self, tas: MetrePerSecond, altitude: Metre) -> float:
        """Mach number [1] of a true airspeed [m/s] at a pressure altitude [m]."""
        return tas / self.sound_speed(altitude)

    def tas_from_mach(self, mach: float, altitude: Metre) -> MetrePerSecond:
        """True airspeed [m/s] of a Mach number [1] at a pressure altitude [m]."""
        return mach * self.sound_speed(altitude)

    def tas_from_cas(self, cas: MetrePerSecond, altitude: Metre) -> MetrePerSecond:
        """True airspeed [m/s] of a calibrated airspeed [m/s] at a pressure altitude [m].

        Both are below the speed of sound.
        """
        impact = _impact_pressure(cas / SEA_LEVEL_SOUND_SPEED, SEA_LEVEL_PRESSURE)
        return self.tas_from_mach(_mach_from_impact(impact, pressure(altitude)), altitude)

    def cas_from_tas(self, tas: MetrePerSecond, altitude: Metre) -> MetrePerSecond:
        """Calibrated airspeed [m/s] of a true airspeed [m/s] at a pressure altitude [m].

        Both are below the speed of sound.
        """
        impact = _impact_pressure(self.mach(tas, altitude), pressure(altitude))
        return SEA_LEVEL_SOUND_SPEED * _mach_from_impact(impact, SEA_LEVEL_PRESSURE)

    def with_error(self, *, wind_error: Wind = CALM, isa_error: float = 0.0) -> "Air":
        """The air with so much error, and without gusts, as guidance may believe it.

        Args:
            wind_error: what is added to the wind, at every altitude.
            isa_error: what is added to ΔT [K].

        Raises:
            ValueError: where the sum is a wind or a temperature that no atmosphere has.
        """
        isa_deviation = self.isa_deviation + isa_error
        if self.profile is not None:
            return Air(profile=self.profile.shifted(wind_error), isa_deviation=isa_deviation)
        wind = Wind(east=self.wind.east + wind_error.east, north=self.wind.north + wind_error.north)
        return Air(wind=wind, isa_deviation=isa_deviation)


STANDARD_AIR = Air()
"""The standard atmosphere, without wind."""


def standard_temperature(altitude: Metre) -> float:
    """Temperature of the standard atmosphere [K].

    Raises:
        ValueError: outside LOWEST_ALTITUDE … HIGHEST_ALTITUDE.
    """
    altitude = expect_within("altitude", altitude, LOWEST_ALTITUDE, HIGHEST_ALTITUDE, "m")
    return SEA_LEVEL_TEMPERATURE - LAPSE_RATE * min(altitude, TROPOPAUSE)


def pressure(altitude: Metre) -> float:
    """Static pressure p at a pressure altitude [Pa], whatever the temperature.

    Raises:
        ValueError: outside LOWEST_ALTITUDE … HIGHEST_ALTITUDE.
    """
    if altitude > TROPOPAUSE:
        above = (
            expect_within("altitude", altitude, LOWEST_ALTITUDE, HIGHEST_ALTITUDE, "m") - TROPOPAUSE
        )
        return _TROPOPAUSE_PRESSURE * exp(-G0 * above / (GAS_CONSTANT * _TROPOPAUSE_TEMPERATURE))
    ratio = standard_temperature(altitude) / SEA_LEVEL_TEMPERATURE
    return SEA_LEVEL_PRESSURE * float(ratio**_PRESSURE_EXPONENT)


def pressure_altitude(static: float) -> Metre:
    """The altitude at which the static pressure is so much [Pa]: the inverse of `pressure`."""
    if static < _TROPOPAUSE_PRESSURE:
        scale = GAS_CONSTANT * _TROPOPAUSE_TEMPERATURE / G0
        return TROPOPAUSE + scale * log(_TROPOPAUSE_PRESSURE / static)
    ratio = float((static / SEA_LEVEL_PRESSURE) ** (1.0 / _PRESSURE_EXPONENT))
    return (1.0 - ratio) * SEA_LEVEL_TEMPERATURE / LAPSE_RATE


def _impact_pressure(mach: float, static: float) -> float:
    """What a pitot tube measures above the static pressure [Pa]."""
    rise = (1.0 + 0.5 * (GAMMA - 1.0) * mach * mach) ** (GAMMA / (GAMMA - 1.0)) - 1.0
    return static * float(rise)


def _mach_from_impact(impact: float, static: float) -> float:
    """The Mach number at which a pitot tube measures so much [Pa] at a static pressure."""
    rise = (1.0 + impact / static) ** ((GAMMA - 1.0) / GAMMA) - 1.0
    return sqrt(2.0 / (GAMMA - 1.0) * rise)
