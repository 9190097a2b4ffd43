"""What an aircraft type can do: numbers from `types/*.toml`, each with its source.

A file holds one type, in the units that its sources use, every key with its unit, and a table
`[sources]` with one sentence a key. `airframe("A306")` gives one of ours, `load_airframe(path)`
one's own.
"""

import re
import tomllib
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from difflib import get_close_matches
from functools import cache, lru_cache
from importlib.resources import files
from math import inf
from os import PathLike
from pathlib import Path
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

        Args:
            altitude: pressure altitude [m].
            tas: true airspeed [m/s].
            air: its temperature gives the Mach number.
            weight: [kg]; 0 for the reference weight.
            bank: of a turn [rad], either way.
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
TABLES = (
    "usable_lift_machs",
    "usable_lift",
    "thrust_levels_ft",
    "thrust_machs",
    "climb_thrust_kn",
    "idle_thrust_kn",
)
"""Every table of an airframe, in the order of the files."""
KEYS = ("designator", "name", *(quantity.key for quantity in QUANTITIES), *TABLES)
"""Every key of a file, but for its sources."""

_TYPES = files("relguide.flying").joinpath("types")


@cache
def known_airframes() -> tuple[str, ...]:
    """Designators of the types that come with the library, sorted."""
    names = (file.name for file in _TYPES.iterdir())
    return tuple(sorted(name[:-5].upper() for name in names if name.endswith(".toml")))


def airframe(designator: str) -> Airframe:
    """A type that comes with the library.

    Examples:
        >>> rg.airframe("A306").name
        'Airbus A300-600R'

    Raises:
        ValueError: for any other, naming those there are.
    """
    return _known_airframe(text("designator", designator))


@cache
def _known_airframe(designator: str) -> Airframe:
    if designator not in known_airframes():
        known = ", ".join(known_airframes())
        raise ValueError(
            f"There is no airframe {designator!r}: choose one of {known},"
            " or load one of your own with load_airframe(path)."
        )
    name = f"{designator.lower()}.toml"
    return _parse_airframe(_TYPES.joinpath(name).read_text(encoding="utf-8"), f"types/{name}")


def load_airframe(path: str | PathLike[str]) -> Airframe:
    """A type from a TOML file of one's own: the keys of `KEYS`, and `[sources]` as far as wanted.

    Examples:
        >>> from importlib.resources import files
        >>> own = rg.load_airframe(files("relguide.flying") / "types" / "a306.toml")
        >>> round(own.max_roll_rate, 3)  # [rad/s]
        0.065

    Raises:
        OSError: where the file cannot be read.
        ValueError: for what it should not hold, naming file and key, and what would be right.
    """
    try:
        content = Path(path).read_text(encoding="utf-8")
    except UnicodeDecodeError as error:
        raise ValueError(f"{path} must be a text in UTF-8: {error}.") from None
    return _parse_airframe(content, str(path))


def _parse_airframe(content: str, file: str) -> Airframe:
    """The airframe of a TOML document; `file` names it in refusals."""
    try:
        table = tomllib.loads(content)
    except tomllib.TOMLDecodeError as error:
        raise ValueError(f"{file} must be TOML: {error}.") from None
    sources = table.pop("sources", {})
    if not isinstance(sources, dict):
        raise ValueError(f"{file}: sources must be a table with one sentence a key.")
    _refuse_unknown(table, file)
    _refuse_unknown(sources, f"{file}, in [sources]")
    for key, sentence in sources.items():
        text(f"{file}: sources.{key}", sentence)
    designator, name = (text(f"{file}: {key}", _require(table, key, file)) for key in KEYS[:2])
    numbers = {
        quantity.field: quantity.scale
        * expect_within(
            f"{file}: {quantity.key}",
            _require(table, quantity.key, file),
            quantity.low,
            quantity.high,
            quantity.unit,
        )
        for quantity in QUANTITIES
    }
    rows = {key: _list(f"{file}: {key}", _require(table, key, file)) for key in TABLES}
    try:
        lift = UsableLift(
            machs=_numbers("usable_lift_machs", rows["usable_lift_machs"]),
            lift=_numbers("usable_lift", rows["usable_lift"]),
        )
        thrust = Thrust(
            levels=_numbers("thrust_levels_ft", rows["thrust_levels_ft"], FT),
            machs=_numbers("thrust_machs", rows["thrust_machs"]),
            climb=_rows("climb_thrust_kn", rows["climb_thrust_kn"]),
            idle=_rows("idle_thrust_kn", rows["idle_thrust_kn"]),
        )
        return Airframe(
            designator=designator, name=name, usable_lift=lift, thrust=thrust, **numbers
        )
    except ValueError as error:
        raise ValueError(f"{file}: {error}") from None


def _require(table: Mapping[str, object], key: str, file: str) -> object:
    """What a file says under a key that it must have."""
    if key in table:
        return table[key]
    for quantity in QUANTITIES:
        if quantity.key == key:
            unit = f" {quantity.unit}" if quantity.unit else ""
            wanted = f"a number of {quantity.low:g} … {quantity.high:g}{unit}"
            break
    else:
        wanted = "a list" if key in TABLES else "a text"
    raise ValueError(f"{file}: {key} is missing; it must be {wanted}.")


def _refuse_unknown(table: Mapping[str, object], place: str) -> None:
    """Refuse the first key that no airframe has."""
    for key in table:
        if key not in KEYS:
            near = get_close_matches(key, KEYS, n=1)
            right = f"did you mean {near[0]}?" if near else f"the keys are {', '.join(KEYS)}."
            raise ValueError(f"{place}: {key} is not a key of an airframe; {right}")


def _list(name: str, value: object) -> list[object]:
    """The value, if it is a list."""
    if not isinstance(value, list):
        raise ValueError(f"{name} must be a list, not {value!r}.")
    return value


def _numbers(name: str, values: list[object], scale: float = 1.0) -> tuple[float, ...]:
    """A list of numbers, in SI units."""
    return tuple(scale * number(name, value) for value in values)


def _rows(name: str, rows: list[object]) -> tuple[tuple[float, ...], ...]:
    """A list of lists of kilonewtons [N]."""
    return tuple(_numbers(name, _list(name, row), 1_000.0) for row in rows)
