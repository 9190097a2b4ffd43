"""Uniform wind: it moves both aircraft alike, so planning is done in the air mass."""

from dataclasses import dataclass
from math import cos, hypot, sin

from relguide.planning.inputs import expect_within, number
from relguide.planning.limits import HEADING, WIND
from relguide.planning.reprs import as_code
from relguide.units import MetrePerSecond


@dataclass(frozen=True, slots=True, kw_only=True, repr=False)
class Wind:
    """Uniform wind: the velocity of the air mass over the ground.

    Examples:
        >>> rg.Wind(east=20.0, north=-15.0).speed  # [m/s], from north-west
        25.0
    """

    east: MetrePerSecond = 0.0
    """Toward the east [m/s]."""
    north: MetrePerSecond = 0.0
    """Toward the north [m/s]."""

    __repr__ = as_code

    def __post_init__(self) -> None:
        """Refuse a wind that no atmosphere has."""
        object.__setattr__(self, "east", number("wind.east", self.east))
        object.__setattr__(self, "north", number("wind.north", self.north))
        expect_within("wind.speed", hypot(self.east, self.north), *WIND)

    @property
    def speed(self) -> float:
        """Wind speed [m/s]."""
        return hypot(self.east, self.north)


CALM = Wind()
"""No wind."""


def wind_from(direction: float, speed: float) -> Wind:
    """The wind that blows *from* a direction, as reports give it.

    Examples:
        >>> rg.wind_from(0.0, 20.0).north  # from the north
        -20.0

    Args:
        direction: where it comes from, clockwise from north [rad].
        speed: [m/s], ≥ 0.
    """
    direction = expect_within("wind direction", direction, *HEADING)
    speed = expect_within("wind speed", speed, *WIND)
    return Wind(east=-speed * sin(direction), north=-speed * cos(direction))
