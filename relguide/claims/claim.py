"""What a claim is, and all claims of `claims.toml`."""

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, fields
from difflib import get_close_matches
from functools import cache
from importlib.resources import files
from math import isfinite
from typing import Any, Literal, get_args

Runs = Literal["quick", "all", "kept"]
"""When a claim is checked: by `--quick`, by `--all` alone, or never run, its table being kept."""
BOUNDS = ("tolerance", "at_most", "at_least")
"""What a claim gives beside its expected value, one of them: how far off it may be, in its unit;
or the bound that must hold."""
STARTS = ("relguide ", "python -m ", "make ")
"""How a command begins."""


@dataclass(frozen=True, kw_only=True)
class Reading:
    """Where the number of a claim stands; see `reading.read`.

    Attributes:
        json: path in the JSON object that the command prints, `plans_by.exact`; `#` counts a list.
        pattern: regular expression, whose group is the number; beside `table`, of the cell.
        table: file in benchmarks/results.
        where: what the cells of a row must match, by column, as regular expressions.
        column: the column that is read.
        take: what is made of several rows: `one` refuses them.
        over: what the number is a share of [%]: a path, or a column, both summed.
        divide_by: the number of metres, seconds … in the claim's unit.
    """

    json: str = ""
    pattern: str = ""
    table: str = ""
    where: tuple[tuple[str, str], ...] = ()
    column: str = ""
    take: str = "one"
    over: str = ""
    divide_by: float = 1.0


@dataclass(frozen=True, kw_only=True)
class Claim:
    """A number that README or a page tells.

    Attributes:
        name: of the row.
        sentence: what is claimed.
        page: where it is said, from the folder of the project.
        said: the words there that hold the number.
        command: what measures it, as it is typed.
        reading: where the number stands then.
        expected: the number, in `unit`.
        tolerance: how far off it may be, in `unit`; or
        at_most: a bound that it must not exceed, or
        at_least: one that it must reach. Two of the three are absent.
        unit: of all these; empty for a count.
        minutes: that the command takes on two cores.
        test: what holds it beside this, as pytest names it.
        runs: when it is checked.
    """

    name: str
    sentence: str
    page: str
    said: str
    command: str
    reading: Reading
    expected: float
    tolerance: float | None = None
    at_most: float | None = None
    at_least: float | None = None
    unit: str = ""
    minutes: float
    test: str
    runs: Runs

    def __post_init__(self) -> None:
        given = [name for name in BOUNDS if getattr(self, name) is not None]
        if len(given) != 1:
            bounds = ", ".join(BOUNDS)
            raise ValueError(f"{self.name}: give one of {bounds}, not {len(given)} of them.")
        if self.runs not in get_args(Runs):
            raise ValueError(f"{self.name}: runs must be quick, all or kept, not {self.runs}.")
        if not self.command.startswith(STARTS):
            raise ValueError(f"{self.name}: a command begins with relguide, python -m or make.")
        if self.runs == "kept" and not self.reading.table:
            raise ValueError(f"{self.name}: what is kept is read from a table.")
        if self.runs != "kept" and self.reading.table:
            raise ValueError(f"{self.name}: what runs is read from what it prints.")

    @property
    def needs_clone(self) -> bool:
        """Whether files are read that a wheel does not bring."""
        words = self.command.split()
        return words[0] != "relguide" or any("/" in word for word in words) or self.runs == "kept"

    def holds(self, obtained: float) -> bool:
        """Whether what was obtained is within the tolerance."""
        if not isfinite(obtained):
            return False
        if self.at_most is not None:
            return obtained <= self.at_most
        if self.at_least is not None:
            return obtained >= self.at_least
        return abs(obtained - self.expected) <= (self.tolerance or 0.0) * (1.0 + 1e-12)


@cache
def all_claims() -> tuple[Claim, ...]:
    """Every row of `claims.toml`, in its order.

    Raises:
        ValueError: if a row is wrong, or two have one name.
    """
    content = tomllib.loads(files(__package__).joinpath("claims.toml").read_text("utf-8"))
    claims = tuple(
        _claim(common | row)
        for group in content["command"]
        for common in [{key: value for key, value in group.items() if key != "claim"}]
        for row in group["claim"]
    )
    names = [claim.name for claim in claims]
    if twice := {name for name in names if names.count(name) > 1}:
        raise ValueError(f"Two claims are called {min(twice)}.")
    return claims


def named_claims(names: list[str]) -> tuple[Claim, ...]:
    """The claims of these names, in their order in the file.

    Raises:
        ValueError: if there is no such claim, with the name that was meant.
    """
    known = {claim.name: claim for claim in all_claims()}
    for name in names:
        if name not in known:
            near = get_close_matches(name, known, n=1, cutoff=0.5)
            meant = f": is {near[0]} meant?" if near else ": docs/claims.md lists all."
            raise ValueError(f'There is no claim "{name}"{meant}')
    return tuple(claim for claim in known.values() if claim.name in names)


def _claim(row: Mapping[str, Any]) -> Claim:
    read = {field.name for field in fields(Reading)}
    told = {key: value for key, value in row.items() if key in read}
    told["where"] = tuple(told.get("where", {}).items())
    rest = {key: value for key, value in row.items() if key not in read}
    return Claim(reading=Reading(**told), **rest)
