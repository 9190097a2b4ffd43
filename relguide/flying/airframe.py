"""What an aircraft type can do: numbers from `types/*.toml`, each with its source.

A file holds one type, in the units that its sources use, every key with its unit, and a table
`[sources]` with one sentence a key. `airframe("A306")` gives one of ours, `load_airframe(path)`
one's own.
"""

import re
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from difflib import get_close_matches
from functools import cache
from importlib.resources import files
from os import PathLike
from pathlib import Path
from typing import NamedTuple

from relguide.flying.air import HIGHEST_ALTITUDE, STANDARD_AIR, Air
from relguide.planning.inputs import expect_within, text
from relguide.units import (
    DEG,
    FT,
    KT,
    Metre,
    MetrePerSecond,
    Radian,
    RadianPerSecond,
    Second,
)


class TasRange(NamedTuple):
    """The true airspeeds that can be flown at one level."""

    least: MetrePerSecond
    """Slowest [m/s]."""
    most: MetrePerSecond
    """Fastest [m/s]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Airframe:
    """An aircraft type, flown clean by its autopilot."""

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
    max_acceleration: MetrePerSecond
    """Along the path in level flight, at climb thrust [m/s²]."""
    idle_deceleration: MetrePerSecond
    """Along the path in level flight, at idle thrust without speed brakes [m/s²], > 0."""
    max_deceleration: MetrePerSecond
    """The same with all that brakes in flight [m/s²], > 0."""
    least_cas: MetrePerSecond
    """Lowest manoeuvring speed without flaps, calibrated [m/s]."""
    v_mo: MetrePerSecond
    """Maximum operating speed V_MO, calibrated [m/s]."""
    m_mo: float
    """Maximum operating Mach number M_MO."""
    ceiling: Metre
    """Highest pressure altitude [m]."""
    max_climb: MetrePerSecond
    """Highest rate of climb [m/s]."""
    max_descent: MetrePerSecond
    """Highest rate of descent [m/s], > 0."""

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
        if self.idle_deceleration > self.max_deceleration:
            raise ValueError(
                f"idle_deceleration ({self.idle_deceleration:g} m/s²) must not exceed"
                f" max_deceleration ({self.max_deceleration:g} m/s²): brakes add to idle thrust."
            )
        if self.least_cas >= self.v_mo:
            raise ValueError(
                f"least_cas ({self.least_cas / KT:g} kt) must be below"
                f" v_mo ({self.v_mo / KT:g} kt)."
            )
        # at one CAS the Mach number grows on the way up, whatever the temperature
        slowest = STANDARD_AIR.mach(
            STANDARD_AIR.tas_from_cas(self.least_cas, self.ceiling), self.ceiling
        )
        if slowest >= self.m_mo:
            raise ValueError(
                f"ceiling ({self.ceiling / FT:,.0f} ft) must be lower: least_cas"
                f" ({self.least_cas / KT:g} kt) is M {slowest:.2f} up there, and m_mo is"
                f" {self.m_mo:g}."
            )

    def tas_range(self, altitude: Metre, air: Air) -> TasRange:
        """The true airspeeds that can be flown at a level: never empty up to the ceiling.

        Args:
            altitude: pressure altitude [m].
            air: its temperature turns Mach number and calibrated airspeed into true airspeed.

        Returns:
            From `least_cas` to the lower of `v_mo` and `m_mo` there [m/s].
        """
        most = min(air.tas_from_cas(self.v_mo, altitude), air.tas_from_mach(self.m_mo, altitude))
        return TasRange(least=air.tas_from_cas(self.least_cas, altitude), most=most)


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
    Quantity("max_acceleration_mps2", "max_acceleration", 1.0, 0.01, 10.0, "m/s²", "m/s²"),
    Quantity("idle_deceleration_mps2", "idle_deceleration", 1.0, 0.01, 10.0, "m/s²", "m/s²"),
    Quantity("max_deceleration_mps2", "max_deceleration", 1.0, 0.01, 10.0, "m/s²", "m/s²"),
    Quantity("least_cas_kt", "least_cas", KT, 30.0, 400.0, "kt", "m/s"),
    Quantity("v_mo_kt", "v_mo", KT, 50.0, 600.0, "kt", "m/s"),
    Quantity("m_mo", "m_mo", 1.0, 0.1, 0.99, "", ""),
    Quantity("ceiling_ft", "ceiling", FT, 1_000.0, HIGHEST_ALTITUDE / FT, "ft", "m"),
    Quantity("max_climb_fpm", "max_climb", FT / 60.0, 50.0, 30_000.0, "ft/min", "m/s"),
    Quantity("max_descent_fpm", "max_descent", FT / 60.0, 50.0, 30_000.0, "ft/min", "m/s"),
)
"""Every number of an airframe, in the order of the files."""
KEYS = ("designator", "name", *(quantity.key for quantity in QUANTITIES))
"""Every key of a file, but for its sources."""

_TYPES = files("relguide.flying").joinpath("types")


@cache
def known_airframes() -> tuple[str, ...]:
    """Designators of the types that come with the library, sorted."""
    names = (file.name for file in _TYPES.iterdir())
    return tuple(sorted(name[:-5].upper() for name in names if name.endswith(".toml")))


def airframe(designator: str) -> Airframe:
    """A type that comes with the library.

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
    try:
        return Airframe(designator=designator, name=name, **numbers)
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
        wanted = "a text"
    raise ValueError(f"{file}: {key} is missing; it must be {wanted}.")


def _refuse_unknown(table: Mapping[str, object], place: str) -> None:
    """Refuse the first key that no airframe has."""
    for key in table:
        if key not in KEYS:
            near = get_close_matches(key, KEYS, n=1)
            right = f"did you mean {near[0]}?" if near else f"the keys are {', '.join(KEYS)}."
            raise ValueError(f"{place}: {key} is not a key of an airframe; {right}")
