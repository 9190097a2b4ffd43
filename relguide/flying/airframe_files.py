"""Types of aircraft in files: `types/*.toml`, each number with its source, and files of one's own.

A file holds one type, in the units that its sources use, every key with its unit, and a table
`[sources]` with one sentence a key. `airframe("A306")` gives one of ours, `load_airframe(path)`
one's own.
"""

import tomllib
from collections.abc import Mapping
from difflib import get_close_matches
from functools import cache
from importlib.resources import files
from os import PathLike
from pathlib import Path

from relguide.flying.airframe import QUANTITIES, Airframe
from relguide.flying.performance import Thrust, UsableLift
from relguide.planning.inputs import expect_within, number, text
from relguide.units import FT

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
