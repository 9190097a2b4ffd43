"""Distributions that a quantity is drawn from, as a campaign's file gives them."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from relguide.planning.inputs import Range, expect_within, number

TRIES = 1_000
"""Draws beyond the limits are made again; a share of 1 % within them is enough."""


@dataclass(frozen=True, slots=True)
class Uniform:
    """Evenly between two values."""

    low: float
    high: float
    kind: Literal["uniform"] = "uniform"

    def draw(self, rng: np.random.Generator, limits: Range) -> float:
        """A value."""
        return float(rng.uniform(self.low, self.high))


@dataclass(frozen=True, slots=True)
class Normal:
    """Normally about a mean; what is beyond the limits of the quantity is drawn again."""

    mean: float
    deviation: float
    kind: Literal["normal"] = "normal"

    def draw(self, rng: np.random.Generator, limits: Range) -> float:
        """A value."""
        for _ in range(TRIES):
            value = float(rng.normal(self.mean, self.deviation))
            if limits.low <= value <= limits.high:
                return value
        raise ValueError(
            f"normal = [{self.mean:g}, {self.deviation:g}] is hardly ever within "
            f"{limits.low:g} … {limits.high:g} {limits.unit}."
        )


@dataclass(frozen=True, slots=True)
class Choice:
    """One of some values, each as likely."""

    values: tuple[float, ...]
    kind: Literal["choice"] = "choice"

    def draw(self, rng: np.random.Generator, limits: Range) -> float:
        """A value."""
        return self.values[int(rng.integers(len(self.values)))]


@dataclass(frozen=True, slots=True)
class Fixed:
    """Always the same."""

    value: float
    kind: Literal["fixed"] = "fixed"

    def draw(self, rng: np.random.Generator, limits: Range) -> float:
        """The value."""
        return self.value


Distribution = Uniform | Normal | Choice | Fixed
FORMS = "{ uniform = [LOW, HIGH] }, { normal = [MEAN, DEVIATION] }, { choice = […] } or a number"


def read_distribution(name: str, given: object, limits: Range) -> Distribution:
    """A distribution from its table.

    Raises:
        ValueError: naming the key, and what would be right.
    """
    match given:
        case {"uniform": [low, high], **rest} if not rest:
            made = Uniform(within(name, low, limits), within(name, high, limits))
            if made.low > made.high:
                raise ValueError(
                    f"{name}: uniform must be [LOW, HIGH], not from {made.low:g} down to "
                    f"{made.high:g}."
                )
            return made
        case {"normal": [mean, deviation], **rest} if not rest:
            spread = number(f"{name}: the deviation of normal", deviation)
            if spread < 0.0:
                raise ValueError(f"{name}: the deviation of normal must be 0 or more.")
            return Normal(within(name, mean, limits), spread)
        case {"choice": [_, *_] as values, **rest} if not rest:
            return Choice(tuple(within(name, value, limits) for value in values))
        case {"fixed": value, **rest} if not rest:
            return Fixed(within(name, value, limits))
        case bool() | str() | list() | Mapping():
            raise ValueError(f"{name} must be {FORMS}, not {given!r}.")
        case _:
            return Fixed(within(name, given, limits))


def within(name: str, given: object, limits: Range) -> float:
    """A number within the limits of its quantity."""
    return expect_within(name, given, *limits)


def as_table(made: Distribution) -> Mapping[str, float | Sequence[float]]:
    """A distribution as its table."""
    match made:
        case Uniform(low, high):
            return {"uniform": [low, high]}
        case Normal(mean, deviation):
            return {"normal": [mean, deviation]}
        case Choice(values):
            return {"choice": list(values)}
        case Fixed(value):
            return {"fixed": value}
