"""The wind by altitude, and CSV files that give it."""

import csv
from bisect import bisect_right
from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise
from math import isfinite
from pathlib import Path
from typing import NamedTuple

from relguide.planning.inputs import Range, expect, expect_within
from relguide.planning.limits import COMPASS
from relguide.planning.reprs import as_code
from relguide.planning.wind import Wind, wind_from
from relguide.units import DEG, FT, KT, Metre

LEVELS = Range(-1_000.0, 50_000.0, "m")
"""Accepted levels: forecasts reach far above all aircraft."""
ALTITUDES = {"altitude_m": 1.0, "altitude_ft": FT, "flight_level": 100.0 * FT}
"""Columns of a file that may give the altitude, and their unit [m]."""
SPEEDS = {"speed_mps": 1.0, "speed_kt": KT}
"""Columns that may give the speed beside `from_deg`, and their unit [m/s]."""
COMPONENTS = (("east_mps", "north_mps"), ("u_mps", "v_mps"), ("u", "v"))
"""Pairs of columns that may give the wind's velocity in place of these [m/s]."""
READ = (
    "read are altitude_m, altitude_ft or flight_level, with from_deg and speed_mps or speed_kt, "
    "or with u_mps and v_mps (east_mps and north_mps)"
)
"""What a refusal says of the columns."""


class WindLevel(NamedTuple):
    """The wind at one altitude."""

    altitude: Metre
    """Pressure altitude [m]."""
    wind: Wind
    """There."""


@dataclass(frozen=True, slots=True, kw_only=True, repr=False)
class WindProfile:
    """Winds at some altitudes, linear in between, constant below the lowest and above the highest.

    East and north are interpolated each, so a wind that veers by 180° passes through calm.

    Examples:
        >>> low, high = (3_000.0, rg.Wind(east=10.0)), (9_000.0, rg.Wind(east=30.0))
        >>> rg.WindProfile(levels=(low, high)).at(6_000.0)
        Wind(east=20.0)
    """

    levels: tuple[WindLevel, ...]
    """By altitude, upward; any pairs of altitude [m] and wind, in any order."""

    __repr__ = as_code

    def __post_init__(self) -> None:
        """Sort the levels; refuse none, two at one altitude, and what is no wind."""
        expect("levels", self.levels, tuple, list)
        if not self.levels:
            raise ValueError("levels must have at least one altitude with its wind.")
        for level in self.levels:
            if not (isinstance(level, tuple) and len(level) == 2):
                raise ValueError("levels must be pairs of an altitude [m] and a Wind.")
            expect("wind of a level", level[1], Wind)
        levels = sorted(
            (WindLevel(expect_within("altitude", altitude, *LEVELS), wind)
             for altitude, wind in self.levels),
            key=lambda level: level.altitude,
        )  # fmt: skip
        for low, high in pairwise(levels):
            if low.altitude == high.altitude:
                raise ValueError(f"levels must have one wind at {low.altitude:g} m, not two.")
        object.__setattr__(self, "levels", tuple(levels))

    def at(self, altitude: Metre) -> Wind:
        """The wind at a pressure altitude [m]."""
        above = bisect_right(self.levels, altitude, key=lambda level: level.altitude)
        if above == 0 or above == len(self.levels):
            return self.levels[max(above - 1, 0)].wind
        (bottom, low), (top, high) = self.levels[above - 1], self.levels[above]
        share = (altitude - bottom) / (top - bottom)
        east = low.east + share * (high.east - low.east)
        return Wind(east=east, north=low.north + share * (high.north - low.north))

    def shifted(self, more: Wind) -> "WindProfile":
        """The same with a wind added at every level.

        Raises:
            ValueError: where the sum is a wind that no atmosphere has.
        """
        return WindProfile(
            levels=tuple(
                WindLevel(at, Wind(east=wind.east + more.east, north=wind.north + more.north))
                for at, wind in self.levels
            )
        )


def load_profile(path: Path | str) -> WindProfile:
    """A profile from a CSV file: a row a level, below a header that names columns and units.

    An altitude (`altitude_m`, `altitude_ft` or `flight_level`), and a wind: `from_deg` with
    `speed_mps` or `speed_kt`, or `u_mps` and `v_mps` (also `east_mps`, `north_mps`, `u`, `v`),
    toward the east and the north. Commas or semicolons separate; with semicolons a comma may be the
    decimal sign. Capitals make no difference, and other columns are not read.

    Examples:
        >>> from pathlib import Path
        >>> _ = Path("winds.csv").write_text('''altitude_m,from_deg,speed_mps
        ... 3000,270,10
        ... 9449,240,30''')
        >>> round(rg.load_profile("winds.csv").at(9_449.0).speed)  # [m/s]
        30

    Args:
        path: the file.

    Raises:
        ValueError: naming the line and the column that is wrong.
        OSError: if the file cannot be opened.
    """
    try:
        lines = Path(path).read_text(encoding="utf-8-sig").splitlines()
    except UnicodeDecodeError:
        raise ValueError(f"{path} is not UTF-8 text.") from None
    separator = ";" if lines and ";" in lines[0] else ","
    rows = csv.reader(lines, delimiter=separator)
    columns = [name.strip().lower() for name in next(rows, [])]
    read = _reader(columns, separator, str(path))
    levels = []
    for row in rows:
        if not any(cell.strip() for cell in row):
            continue
        where = f"{path}, line {rows.line_num}"
        if len(row) != len(columns):
            raise ValueError(f"{where}: it has {len(row)} columns, its header {len(columns)}.")
        try:
            levels.append(read(dict(zip(columns, row, strict=True))))
        except ValueError as error:
            raise ValueError(f"{where}: {error}") from None
    try:
        return WindProfile(levels=tuple(levels))
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from None


def _reader(columns: list[str], separator: str, path: str) -> Callable[[dict[str, str]], WindLevel]:
    """What makes a level of a row's cells."""
    altitude = next((name for name in ALTITUDES if name in columns), None)
    speed = next((name for name in SPEEDS if name in columns), None)
    pair = next((pair for pair in COMPONENTS if set(pair) <= set(columns)), None)
    found = ", ".join(filter(None, columns)) or "nothing"
    if altitude is None:
        raise ValueError(f"{path}, line 1: no column gives the altitude: it has {found}; {READ}.")
    if pair is None and not (speed and "from_deg" in columns):
        raise ValueError(f"{path}, line 1: no columns give the wind: it has {found}; {READ}.")

    def read(cells: dict[str, str]) -> WindLevel:
        height = _number(cells, altitude, separator) * ALTITUDES[altitude]
        if pair is not None:
            east, north = (_number(cells, name, separator) for name in pair)
            wind = Wind(east=east, north=north)
        else:
            assert speed is not None
            given = _number(cells, "from_deg", separator)
            direction = expect_within("from_deg", given, *COMPASS) * DEG
            wind = wind_from(direction, _number(cells, speed, separator) * SPEEDS[speed])
        return WindLevel(expect_within("altitude", height, *LEVELS), wind)

    return read


def _number(cells: dict[str, str], name: str, separator: str) -> float:
    """A cell as a number."""
    text = cells[name].strip()
    try:
        value = float(text.replace(",", ".") if separator == ";" else text)
    except ValueError:
        raise ValueError(f"column {name}: {text[:40]!r} is not a number.") from None
    if not isfinite(value):
        raise ValueError(f"column {name}: {text[:40]!r} is not a finite number.")
    return value
