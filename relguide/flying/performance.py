"""Wing and engines of a type: tables over level and Mach number, and what lies between.

Lift, drag and thrust depend on pressure and Mach number only, whatever the temperature:

    q = γ/2 p M²,     m g n = C_L q S,     D = (C_D0 + k C_L²) q S
"""

from bisect import bisect_right
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import cos, pi

from relguide.flying.air import GAMMA
from relguide.units import G0, Metre, MetrePerSecond, Radian

Rows = tuple[tuple[float, ...], ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Thrust:
    """What all engines together give, by level and Mach number; linear between."""

    levels: tuple[Metre, ...]
    """Pressure altitudes of the rows [m], growing."""
    machs: tuple[float, ...]
    """Mach numbers of the columns, growing."""
    climb: Rows
    """The most for a climb [N]."""
    idle: Rows
    """At idle [N]; negative where propellers brake."""

    def __post_init__(self) -> None:
        """Refuse tables with holes, and idle thrust that pushes like a climb."""
        expect_growing("levels", self.levels)
        expect_growing("machs", self.machs)
        for name, rows in (("climb", self.climb), ("idle", self.idle)):
            if [len(row) for row in rows] != [len(self.machs)] * len(self.levels):
                raise ValueError(
                    f"thrust, {name}: there must be {len(self.levels)} rows, one a level, of"
                    f" {len(self.machs)} numbers, one a Mach number."
                )
        for climb, idle in zip(self.climb, self.idle, strict=True):
            if not all(low < high for low, high in zip(idle, climb, strict=True)):
                raise ValueError("thrust: idle must give less than climb, everywhere.")

    def climb_at(self, altitude: Metre, mach: float) -> float:
        """The most for a climb [N]; outside the table that of its edge."""
        return self._at(self.climb, altitude, mach)

    def idle_at(self, altitude: Metre, mach: float) -> float:
        """At idle [N]; outside the table that of its edge."""
        return self._at(self.idle, altitude, mach)

    def _at(self, rows: Rows, altitude: Metre, mach: float) -> float:
        i, up = _place(self.levels, altitude)
        j, along = _place(self.machs, mach)
        low, high = (row[j] + along * (row[j + 1] - row[j]) for row in rows[i : i + 2])
        return low + up * (high - low)


@dataclass(frozen=True, slots=True, kw_only=True)
class UsableLift:
    """The largest lift coefficient that is flown, clean, by Mach number; linear between."""

    machs: tuple[float, ...]
    """Growing."""
    lift: tuple[float, ...]
    """C_L, with what is kept from stall and buffet."""

    def __post_init__(self) -> None:
        """Refuse a table with holes, and lift that no wing gives clean."""
        expect_growing("machs", self.machs)
        if len(self.lift) != len(self.machs):
            raise ValueError(
                f"usable lift: there must be {len(self.machs)} numbers, one a Mach number."
            )
        if not all(0.05 <= lift <= 3.0 for lift in self.lift):
            raise ValueError("usable lift: each must lie in 0.05 … 3.")

    def square(self, mach: float) -> float:
        """C_L M², to which the weight that is carried is in proportion."""
        i, along = _place(self.machs, mach)
        lift = self.lift[i] + along * (self.lift[i + 1] - self.lift[i])
        return lift * mach * mach

    def machs_that_carry(self, square: float) -> tuple[float, float] | None:
        """Between which Mach numbers C_L M² is no less; `None` if nowhere."""
        knots = [self.machs[0] * k / STEPS for k in range(1, STEPS)]
        for low, high in pairwise(self.machs):
            knots += [low + (high - low) * k / STEPS for k in range(STEPS)]
        knots.append(self.machs[-1])
        carry = [k for k, mach in enumerate(knots) if self.square(mach) >= square]
        if not carry:
            return None
        first, last = carry[0], carry[-1]

        def spare(mach: float) -> float:
            return self.square(mach) - square

        slow = root(spare, knots[first], knots[first - 1]) if first else knots[0]
        fast = root(spare, knots[last], knots[last + 1]) if knots[last + 1 :] else knots[-1]
        return slow, fast


STEPS = 4
"""Pieces of each gap of a lift table in which a crossing is looked for."""
HALVINGS = 40
"""Of an interval: to a part in 10¹²."""


def load_factor(bank: Radian) -> float:
    """Lift over weight in a level coordinated turn, n = 1/cos φ."""
    return 1.0 / cos(bank)


def lift_square(weight: float, load: float, static: float, wing_area: float) -> float:
    """C_L M² = 2 n m g/(γ p S) that carries a weight [kg] at a static pressure [Pa]."""
    return 2.0 * load * weight * G0 / (GAMMA * static * wing_area)


def root(spare: Callable[[float], float], good: float, bad: float) -> float:
    """Where a quantity becomes negative, from a place where it is not toward one where it is."""
    for _ in range(HALVINGS):
        middle = 0.5 * (good + bad)
        good, bad = (middle, bad) if spare(middle) >= 0.0 else (good, middle)
    return good


def parabola_through(
    value: Callable[[MetrePerSecond], float], low: MetrePerSecond, high: MetrePerSecond
) -> tuple[float, float, float]:
    """c₀ + c₁ V + c₂ V², equal to a function of V at the three Chebyshev points of an interval."""
    middle, half = 0.5 * (low + high), 0.5 * (high - low) * cos(pi / 6.0)
    a, b, c = value(middle - half), value(middle), value(middle + half)
    slope, curve = (c - a) / (2.0 * half), (a - 2.0 * b + c) / (2.0 * half * half)
    return b - middle * (slope - middle * curve), slope - 2.0 * middle * curve, curve


def expect_growing(name: str, values: Sequence[float]) -> None:
    """Refuse fewer than two numbers, and numbers that do not grow."""
    if len(values) < 2 or any(a >= b for a, b in pairwise(values)):
        raise ValueError(f"{name} must be two or more numbers, each larger than the one before.")


def _place(knots: tuple[float, ...], value: float) -> tuple[int, float]:
    """In which gap of a table a number lies, and at which share of it."""
    i = min(max(bisect_right(knots, value) - 1, 0), len(knots) - 2)
    share = (value - knots[i]) / (knots[i + 1] - knots[i])
    return i, min(max(share, 0.0), 1.0)
