"""What a campaign is, and its TOML file.

[campaign]
name = "wind"
seed = 7
flights = 1000
family = "declared"             # or a list: a row of the report each
guidance = "trail"              # a baseline; relguide's if it is left out

[vary]                          # drawn for each flight
leader_tas_share = { uniform = [0.6, 0.98] }

[sweep]                         # crossed: a row of the report each
wind_error_mps = [0.0, 5.0, 10.0]

[[crew]]                        # what each pursuer's crew does, a table an order, as in its script;
on = "proposed"                 # guidance is engaged from the start if there is none
after_s = 5.0
engagement = "armed"
"""

import tomllib
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from itertools import product
from pathlib import Path
from typing import Any

from relguide.campaign.distribution import (
    Choice,
    Distribution,
    Fixed,
    Normal,
    Uniform,
    as_table,
    read_distribution,
    within,
)
from relguide.campaign.families import FAMILIES
from relguide.campaign.keys import KEYS
from relguide.contract.orders import crew_of
from relguide.flying.guidances import Guidance, expect_guidance
from relguide.flying.scripted_crew import CrewOrder
from relguide.planning.inputs import Range, expect_whole, text
from relguide.units import Second

LONGEST = Range(1.0, 86_400.0, "s")
FOLLOWED = Range(0.0, 86_400.0, "s")
HEADS = ("name", "seed", "flights", "family", "guidance", "limit_s", "after_joining_s")
"""Keys of [campaign]."""


@dataclass(frozen=True, slots=True)
class Derived:
    """A family that draws the flights of others, and something more of each."""

    bases: tuple[str, ...]
    """By turns."""
    vary: Mapping[str, Distribution]

    def base(self, number: int) -> str:
        """The family that draws the flight of a number."""
        return self.bases[number % len(self.bases)]


SEEN: Mapping[str, Distribution] = {
    "nacp": Choice((7.0, 8.0, 9.0, 10.0)),
    "nacv": Choice((1.0, 2.0)),
    "latency_s": Uniform(0.2, 1.5),
    "loss_share": Uniform(0.0, 0.1),
}
"""By ADS-B as it is: most aircraft broadcast NACp 8 … 10 and NACv 1 or 2."""
ROUGH: Mapping[str, Distribution] = {
    "wind_error_mps": Fixed(5.0),
    "nacp": Fixed(8.0),
    "nacv": Fixed(2.0),
    "latency_s": Fixed(1.0),
    "gusts_mps": Fixed(1.5),
}
"""All that is not exact, at once: winds aloft are wrong by 3 to 8 m/s."""
PILOTS: Mapping[str, Distribution] = {
    "pilot_bandwidth_radps": Uniform(0.5, 1.5),
    "pilot_delay_s": Uniform(0.15, 0.45),
    "pilot_remnant_share": Uniform(0.01, 0.03),
    "pilot_threshold_deg": Uniform(0.5, 1.5),
    "pilot_reaction_s": Uniform(0.75, 2.25),
}
"""Within 50 % of the model's own, which are assumptions."""
DERIVED: Mapping[str, Derived] = {
    "exact": Derived(("declared",), {}),
    "wind_error": Derived(("declared",), {"wind_error_mps": Normal(0.0, 5.0)}),
    "surveillance": Derived(("undeclared",), SEEN),
    "gusts": Derived(("declared",), {"gusts_mps": Uniform(0.0, 1.5)}),
    "mixed": Derived(("declared", "undeclared", "commands"), ROUGH),
    "flight_director": Derived(("declared", "undeclared"), PILOTS),
}
"""By name; to add one, a line. Its flights begin as those of its base with the same number."""
KNOWN = (*FAMILIES, *DERIVED)


@dataclass(frozen=True, slots=True, kw_only=True)
class Point:
    """A row of the report: a family, and a value of each key that is swept."""

    family: str
    values: Mapping[str, float]

    @property
    def name(self) -> str:
        """For people."""
        swept = ", ".join(f"{key} {value:g}" for key, value in self.values.items())
        return f"{self.family}, {swept}" if swept else self.family


@dataclass(frozen=True, slots=True, kw_only=True)
class Campaign:
    """What is flown: each number of flight at each point."""

    name: str
    seed: int
    flights: int
    """At each point."""
    families: tuple[str, ...]
    limit: Second | None = None
    """Of a flight; that of its family if it is left out."""
    after_joining: Second | None = None
    """The same of the time to follow."""
    guidance: Guidance = "relguide"
    crew: tuple[CrewOrder, ...] = ()
    """What each pursuer's crew does; without it guidance is engaged from the start."""
    script: tuple[Mapping[str, Any], ...] = ()
    """The same as the tables of the file."""
    vary: Mapping[str, Distribution]
    sweep: Mapping[str, tuple[float, ...]]

    @property
    def points(self) -> tuple[Point, ...]:
        """All that is crossed."""
        return tuple(
            Point(family=family, values=dict(zip(self.sweep, values, strict=True)))
            for family in self.families
            for values in product(*self.sweep.values())
        )

    @property
    def total(self) -> int:
        """Flights of all points."""
        return self.flights * len(self.points)

    def as_tables(self) -> dict[str, Any]:
        """The file that asks for the same, with what was left out."""
        about: dict[str, Any] = {
            "name": self.name,
            "seed": self.seed,
            "flights": self.flights,
            "family": list(self.families),
        }
        more = {"limit_s": self.limit, "after_joining_s": self.after_joining}
        if self.guidance != "relguide":
            about["guidance"] = self.guidance
        crew = {"crew": [dict(order) for order in self.script]} if self.script else {}
        return crew | {
            "campaign": about | {key: value for key, value in more.items() if value is not None},
            "vary": {key: as_table(made) for key, made in self.vary.items()},
            "sweep": {key: list(values) for key, values in self.sweep.items()},
        }


def load_campaign(file: Path | str) -> Campaign:
    """A campaign from its TOML file.

    Raises:
        OSError: if it cannot be read.
        ValueError: naming file and key, and what would be right.
    """
    path = Path(file)
    try:
        content = tomllib.loads(path.read_text(encoding="utf-8"))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise ValueError(f"{path} must be TOML: {error}.") from None
    try:
        return read_campaign(content, name=path.stem)
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from None


def read_campaign(content: Mapping[str, Any], *, name: str = "campaign") -> Campaign:
    """A campaign from the tables of its file.

    Args:
        content: the tables.
        name: what it is called if it does not say.

    Raises:
        ValueError: naming the key that is wrong, and what would be right.
    """
    _refuse_unknown("", content, ("campaign", "vary", "sweep", "crew"))
    about, vary, sweep = (_table(content, key) for key in ("campaign", "vary", "sweep"))
    _refuse_unknown("campaign.", about, HEADS)
    for key in ("flights", "family"):
        if key not in about:
            wanted = "a whole number" if key == "flights" else f"one of {', '.join(KNOWN)}"
            raise ValueError(f"campaign.{key} is missing; it must be {wanted}.")
    families = _families(about["family"])
    _refuse_unknown("vary.", vary, KEYS)
    _refuse_unknown("sweep.", sweep, KEYS)
    for key in sweep:
        if key in vary:
            raise ValueError(f"{key} is in [vary] and in [sweep]: leave out one of them.")
    for key in (*vary, *sweep):
        if KEYS[key].leader_is_drawn and "recorded" in families:
            raise ValueError(f"{key} says nothing of recorded leaders: leave it out.")
    guidance = about.get("guidance", "relguide")
    expect_guidance(guidance)
    script = _script(content)
    return Campaign(
        name=text("campaign.name", about.get("name", name)),
        seed=expect_whole("campaign.seed", about.get("seed", 0), 0),
        flights=_flights(about["flights"]),
        families=families,
        limit=_seconds(about, "limit_s", LONGEST),
        after_joining=_seconds(about, "after_joining_s", FOLLOWED),
        guidance=guidance,
        crew=crew_of(script),
        script=script,
        vary={key: read_distribution(f"vary.{key}", vary[key], KEYS[key].limits) for key in vary},
        sweep={key: _values(f"sweep.{key}", sweep[key], KEYS[key].limits) for key in sweep},
    )


def _script(content: Mapping[str, Any]) -> tuple[Mapping[str, Any], ...]:
    orders = content.get("crew", [])
    if not isinstance(orders, list) or not all(isinstance(order, Mapping) for order in orders):
        raise ValueError("crew must be a list of tables: write [[crew]] before each order.")
    if "crew" in content and not orders:
        raise ValueError("crew is empty, and a crew's script has one order or more: leave it out.")
    return tuple(orders)


def _flights(given: object) -> int:
    if isinstance(given, float) and given.is_integer():  # 1e5
        given = int(given)
    return expect_whole("campaign.flights", given, 1)


def _families(given: object) -> tuple[str, ...]:
    names = [given] if isinstance(given, str) else given
    if not isinstance(names, list) or not names:
        raise ValueError(f"campaign.family must be one or a list of {', '.join(KNOWN)}.")
    for name in names:
        if name not in KNOWN:
            raise ValueError(f"campaign.family: {_unknown(str(name), KNOWN, 'family')}")
    if len(set(names)) < len(names):
        raise ValueError("campaign.family has a name twice: leave out one of them.")
    return tuple(names)


def _values(name: str, given: object, limits: Range) -> tuple[float, ...]:
    if not isinstance(given, Sequence) or isinstance(given, str) or not given:
        raise ValueError(f"{name} must be a list of numbers, as [0.0, 5.0], not {given!r}.")
    values = tuple(within(name, value, limits) for value in given)
    if len(set(values)) < len(values):
        raise ValueError(f"{name} has a value twice: leave out one of them.")
    return values


def _seconds(table: Mapping[str, object], key: str, limits: Range) -> Second | None:
    return within(f"campaign.{key}", table[key], limits) if key in table else None


def _table(content: Mapping[str, Any], key: str) -> Mapping[str, Any]:
    table = content.get(key, {})
    if not isinstance(table, Mapping):
        raise ValueError(f"{key} must be a table: write [{key}].")
    return table


def _refuse_unknown(place: str, table: Mapping[str, Any], known: Collection[str]) -> None:
    for key in table:
        if key not in known:
            raise ValueError(f"{place}{_unknown(key, tuple(known), 'key')}")


def _unknown(name: str, known: Sequence[str], kind: str) -> str:
    """What is wrong with a name, and what was likely meant."""
    near = get_close_matches(name, known, n=1)
    meant = f"did you mean {near[0]}?" if near else f"there are {', '.join(known)}."
    return f"{name} is not a {kind} of a campaign; {meant}"
