"""What an aircraft type can do, from the numbers of its kind."""

import re
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from math import inf
from typing import NamedTuple

from relguide.flying.air import GAMMA, HIGHEST_ALTITUDE, STANDARD_AIR, Air, pressure
from relguide.flying.performance import (
    Thrust,
    UsableLift,
    lift_square,
    load_factor,
    parabola_through,
    root,
)
from relguide.planning.inputs import expect, expect_within, number, text
from relguide.units import (
    DEG,
    FT,
    G0,
    KT,
    Kilogram,
    Metre,
    MetrePerSecond,
    Radian,
    RadianPerSecond,
    Second,
)


class TasRange(NamedTuple):
    """The true airspeeds that can be flown at one level; none where the least is the larger."""

    least: MetrePerSecond
    """Slowest [m/s]; infinite where no speed carries the weight."""
    most: MetrePerSecond
    """Fastest [m/s]; 0 where no speed can be kept."""


class Energy(NamedTuple):
    """How an aircraft of one weight speeds up and slows down at one level.

    V̇ = c₀ + c₁ V + c₂ V² − K n²/V²          thrust less zero-lift drag; drag of the lift
    """

    climb: tuple[float, float, float]
    """c at the most thrust for a climb [m/s², 1/s, 1/m]."""
    idle: tuple[float, float, float]
    """c at idle."""
    brakes: float
    """What speed brakes take off c₂ [1/m]."""
    induced: float
    """K [m³/s⁴]."""


class Quantity(NamedTuple):
    """How a file gives one number of an airframe."""

    key: str
    """In the file, unit included."""
    field: str
    """Of `Airframe`."""
    scale: float
    """SI units in one unit of the file."""
    low: float
    """Least accepted value, in the file's unit."""
    high: float
    """Largest accepted value, in the file's unit."""
    unit: str
    """The file's unit, in words."""
    si_unit: str
    """The field's unit, in words."""


# Far wider than any transport needs: the bounds catch another unit or a slip of the keyboard.
QUANTITIES = (
    Quantity("max_bank_deg", "max_bank", DEG, 1.0, 60.0, "deg", "rad"),
    Quantity("max_roll_rate_degps", "max_roll_rate", DEG, 0.5, 200.0, "deg/s", "rad/s"),
    Quantity("roll_time_constant_s", "roll_time_constant", 1.0, 0.01, 5.0, "s", "s"),
    Quantity("speed_time_constant_s", "speed_time_constant", 1.0, 0.5, 60.0, "s", "s"),
    Quantity("least_weight_kg", "least_weight", 1.0, 100.0, 1e6, "kg", "kg"),
    Quantity("reference_weight_kg", "reference_weight", 1.0, 100.0, 1e6, "kg", "kg"),
    Quantity("most_weight_kg", "most_weight", 1.0, 100.0, 1e6, "kg", "kg"),
    Quantity("wing_area_m2", "wing_area", 1.0, 5.0, 2_000.0, "m²", "m²"),
    Quantity("zero_lift_drag", "zero_lift_drag", 1.0, 0.001, 0.2, "", ""),
    Quantity("induced_drag", "induced_drag", 1.0, 0.001, 0.5, "", ""),
    Quantity("speed_brake_drag", "speed_brake_drag", 1.0, 0.0, 0.5, "", ""),
    Quantity("v_mo_kt", "v_mo", KT, 50.0, 600.0, "kt", "m/s"),
    Quantity("m_mo", "m_mo", 1.0, 0.1, 0.99, "", ""),
    Quantity("ceiling_ft", "ceiling", FT, 1_000.0, HIGHEST_ALTITUDE / FT, "ft", "m"),
    Quantity("max_climb_fpm", "max_climb", FT / 60.0, 50.0, 30_000.0, "ft/min", "m/s"),
    Quantity("max_descent_fpm", "max_descent", FT / 60.0, 50.0, 30_000.0, "ft/min", "m/s"),
)
"""Every number of an airframe, in the order of the files."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Airframe:
    """An aircraft type, flown clean by its autopilot.

    Examples:
        >>> can = rg.airframe("A306").tas_range(9_449.0, rg.Air(), bank=0.4)
        >>> round(can.most)  # [m/s]
        248
    """

    designator: str
    """ICAO type designator."""
    name: str
    """As its maker calls it."""
    max_bank: Radian
    """Bank that the autopilot does not exceed [rad]."""
    max_roll_rate: RadianPerSecond
    """Roll rate at full authority of the autopilot [rad/s]."""
    roll_time_constant: Second
    """Roll mode: the roll rate's lag behind the ailerons [s]."""
    speed_time_constant: Second
    """Lag of the autothrust: how fast it goes for the commanded speed when not at a limit [s]."""
    least_weight: Kilogram
    """As light as it flies [kg]."""
    reference_weight: Kilogram
    """Of an aircraft of which nothing else is said [kg]."""
    most_weight: Kilogram
    """As heavy as it flies [kg]."""
    wing_area: float
    """S [m²]."""
    zero_lift_drag: float
    """C_D0, clean [1]."""
    induced_drag: float
    """k of C_D = C_D0 + k C_L² [1]."""
    speed_brake_drag: float
    """What speed brakes add to C_D0 [1]; 0 for an aircraft that has none."""
    v_mo: MetrePerSecond
    """Maximum operating speed V_MO, calibrated [m/s]."""
    m_mo: float
    """Maximum operating Mach number M_MO [1]."""
    ceiling: Metre
    """Highest pressure altitude [m]."""
    max_climb: MetrePerSecond
    """Highest rate of climb [m/s]."""
    max_descent: MetrePerSecond
    """Highest rate of descent [m/s], > 0."""
    usable_lift: UsableLift
    """With what is kept from stall and buffet."""
    thrust: Thrust
    """Of all engines together [N]."""
    thrust_share: float = 1.0
    """How much of `thrust` this aircraft gives [1]: 1 by its type."""

    def __post_init__(self) -> None:
        """Refuse what could not fly, and what is likely given in another unit."""
        if not re.fullmatch("[A-Z][A-Z0-9]{1,3}", text("designator", self.designator)):
            raise ValueError(
                "designator must be the ICAO type designator, 2 to 4 capital letters and digits"
                f" (A306), not {self.designator!r}."
            )
        if not text("name", self.name).strip():
            raise ValueError("name must not be empty: give what the maker calls the type.")
        for quantity in QUANTITIES:
            value = expect_within(
                quantity.field,
                getattr(self, quantity.field),
                quantity.low * quantity.scale,
                quantity.high * quantity.scale,
                quantity.si_unit,
            )
            object.__setattr__(self, quantity.field, value)
        expect("usable_lift", self.usable_lift, UsableLift)
        expect("thrust", self.thrust, Thrust)
        share = expect_within("thrust_share", self.thrust_share, 0.1, 10.0, "")
        object.__setattr__(self, "thrust_share", share)
        if not self.least_weight <= self.reference_weight <= self.most_weight:
            raise ValueError(
                f"reference_weight ({self.reference_weight:,.0f} kg) must lie in least_weight …"
                f" most_weight, {self.weights}."
            )
        slow, fast = self._mach_range_by_lift(self.ceiling, self.reference_weight, 1.0)
        if slow >= fast:
            raise ValueError(
                f"ceiling ({self.ceiling / FT:,.0f} ft) must be lower: no speed within v_mo"
                f" ({self.v_mo / KT:g} kt) and m_mo ({self.m_mo:g}) carries"
                f" {self.reference_weight:,.0f} kg up there."
            )

    @property
    def weights(self) -> str:
        """Between which weights it flies, in words."""
        return f"{self.least_weight:,.0f} … {self.most_weight:,.0f} kg"

    def expect_weight(self, name: str, weight: Kilogram) -> Kilogram:
        """The weight [kg], if the type flies at it; 0 stands for its reference weight."""
        weight = number(name, weight)
        if weight == 0.0:
            return self.reference_weight
        if not self.least_weight <= weight <= self.most_weight:
            raise ValueError(
                f"{name} must lie in {self.weights} for the {self.designator}, or be 0 for its"
                f" reference weight, not {weight:,.0f} kg."
            )
        return weight

    def tas_range(
        self, altitude: Metre, air: Air, weight: Kilogram = 0.0, bank: Radian = 0.0
    ) -> TasRange:
        """The true airspeeds that can be flown at a level.

        Args:
            altitude: pressure altitude [m].
            air: its temperature turns Mach number and calibrated airspeed into true airspeed.
            weight: [kg]; 0 for the reference weight.
            bank: that the lift must allow for [rad]; thrust need not, since turns end.

        Returns:
            From what lift and thrust need to what `v_mo`, `m_mo`, lift and thrust allow [m/s].
        """
        weight = weight or self.reference_weight
        slow, fast = _mach_range(self, altitude, weight, load_factor(bank))
        sound = air.sound_speed(altitude)
        return TasRange(slow * sound, fast * sound)

    def excess_acceleration(
        self,
        altitude: Metre,
        tas: MetrePerSecond,
        air: Air,
        weight: Kilogram = 0.0,
        bank: Radian = 0.0,
    ) -> float:
        """What climb thrust gives along the path in level flight [m/s²]; negative if too little.

        Args:
            altitude: pressure altitude [m].
            tas: true airspeed [m/s].
            air: its temperature gives the Mach number.
            weight: [kg]; 0 for the reference weight.
            bank: of a turn [rad], either way.
        """
        mach = air.mach(tas, altitude)
        weight = weight or self.reference_weight
        return self._excess(altitude, mach, weight, load_factor(bank)) / weight

    def idle_deceleration(
        self,
        altitude: Metre,
        tas: MetrePerSecond,
        air: Air,
        weight: Kilogram = 0.0,
        bank: Radian = 0.0,
    ) -> float:
        """How fast it slows down in level flight at idle, without brakes [m/s²].

        Arguments as of `excess_acceleration`.
        """
        mach = air.mach(tas, altitude)
        weight = weight or self.reference_weight
        idle = self.thrust_share * self.thrust.idle_at(altitude, mach)
        return (self._drag(altitude, mach, weight, load_factor(bank)) - idle) / weight

    def energy(self, altitude: Metre, air: Air, weight: Kilogram = 0.0) -> Energy:
        """Both for all speeds that can be flown, thrust as a parabola of the speed.

        Args:
            altitude: pressure altitude [m].
            air: its temperature gives the Mach number.
            weight: [kg]; 0 for the reference weight.
        """
        weight = weight or self.reference_weight
        sound, per_area = air.sound_speed(altitude), 0.5 * air.density(altitude) / weight
        slow, fast = _mach_range(self, altitude, weight, 1.0)
        share, zero_lift = (
            self.thrust_share / weight,
            per_area * self.wing_area * self.zero_lift_drag,
        )

        def pushed(thrust: Callable[[Metre, float], float]) -> tuple[float, float, float]:
            c0, c1, c2 = parabola_through(
                lambda v: share * thrust(altitude, v / sound), slow * sound, fast * sound
            )
            return c0, c1, c2 - zero_lift

        return Energy(
            climb=pushed(self.thrust.climb_at),
            idle=pushed(self.thrust.idle_at),
            brakes=per_area * self.wing_area * self.speed_brake_drag,
            induced=self.induced_drag * G0 * G0 / (per_area * self.wing_area),
        )

    def _drag(self, altitude: Metre, mach: float, weight: Kilogram, load: float) -> float:
        """D of level flight [N]."""
        static = pressure(altitude)
        lift = lift_square(weight, load, static, self.wing_area) / (mach * mach)
        area = 0.5 * GAMMA * static * mach * mach * self.wing_area
        return (self.zero_lift_drag + self.induced_drag * lift * lift) * area

    def _excess(self, altitude: Metre, mach: float, weight: Kilogram, load: float) -> float:
        """Climb thrust less drag [N]."""
        climb = self.thrust_share * self.thrust.climb_at(altitude, mach)
        return climb - self._drag(altitude, mach, weight, load)

    def _mach_range_by_lift(
        self, altitude: Metre, weight: Kilogram, load: float
    ) -> tuple[float, float]:
        """Mach numbers that lift, V_MO and M_MO allow."""
        most = min(self.m_mo, STANDARD_AIR.mach(
            STANDARD_AIR.tas_from_cas(self.v_mo, altitude), altitude
        ))  # fmt: skip
        needed = lift_square(weight, load, pressure(altitude), self.wing_area)
        carry = self.usable_lift.machs_that_carry(needed)
        return (inf, most) if carry is None else (carry[0], min(carry[1], most))


@lru_cache(maxsize=4096)
def _mach_range(
    airframe: Airframe, altitude: Metre, weight: Kilogram, load: float
) -> tuple[float, float]:
    """Mach numbers that can be flown: within what lift allows, those that thrust can keep."""
    slow, fast = airframe._mach_range_by_lift(altitude, weight, load)
    if slow >= fast:
        return inf, fast

    def spare(mach: float) -> float:
        return airframe._excess(altitude, mach, weight, 1.0)

    if spare(slow) >= 0.0 and spare(fast) >= 0.0:
        return slow, fast
    machs = [slow + (fast - slow) * k / MACH_STEPS for k in range(MACH_STEPS + 1)]
    best = max(machs, key=spare)
    if spare(best) < 0.0:
        return slow, 0.0
    if spare(slow) < 0.0:
        slow = root(spare, best, slow)
    if spare(fast) < 0.0:
        fast = root(spare, best, fast)
    return slow, fast


MACH_STEPS = 24
"""Places where thrust is compared with drag, to find one where it is enough."""
