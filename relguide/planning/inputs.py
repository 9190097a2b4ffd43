"""What callers give: numbers become floats, and what is wrong is refused with a sentence.

The kernels are compiled for floats, so an integer or a numpy scalar is made one here, once.
"""

from math import inf, isfinite
from numbers import Integral, Real
from reprlib import repr as brief
from typing import NamedTuple, overload

import numpy as np
from numpy.typing import NDArray

SLACK = 1e-9
"""By so much of itself a bound may be passed: given in degrees, it comes back from radians with its
last digit changed."""


class Range(NamedTuple):
    """What is accepted of a quantity, in the unit that its sentence speaks of."""

    low: float
    high: float
    unit: str
    meant: str = ""
    """What was probably meant by a value outside, as a question."""

    @property
    def ends(self) -> tuple[float, float]:
        """The least and the largest value that are accepted: the bounds, to rounding."""
        return self.low - SLACK * abs(self.low), self.high + SLACK * abs(self.high)

    @property
    def span(self) -> str:
        """The bounds with their unit."""
        return f"{self.low:g} … {self.high:g}{self._behind}"

    @property
    def _behind(self) -> str:
        return f" {self.unit}" if self.unit else ""

    @overload
    def admits(self, value: float) -> bool: ...
    @overload
    def admits(self, value: NDArray[np.float64]) -> NDArray[np.bool_]: ...
    def admits(self, value: float | NDArray[np.float64]) -> bool | NDArray[np.bool_]:
        """Whether a value lies inside, to rounding; of a column, each."""
        low, high = self.ends
        return (value >= low) & (value <= high)

    def refusal(self, value: float) -> str:
        """What is wrong with a value outside; the name of what it is goes before it."""
        if not isfinite(value):
            return f"must be a finite number, not {value}."
        meant = f" {self.meant}" if self.meant else ""
        return f"must lie in {self.span}, not {value:.9g}{self._behind}.{meant}"


def number(name: str, value: object) -> float:
    """A finite float; −0 becomes 0.

    Raises:
        ValueError: for what is not a finite real number; a truth value is not one.
    """
    # isinstance of `Real` takes half a microsecond, and nearly all are floats
    if type(value) is not float:
        if isinstance(value, bool) or not isinstance(value, Real):
            raise ValueError(f"{name} must be a number, not {_describe(value)}.")
        try:
            value = float(value)
        except OverflowError:  # an integer of hundreds of digits
            value = inf
    if not isfinite(value):
        raise ValueError(f"{name} must be a finite number, not {value}.")
    return value + 0.0


def expect_within(
    name: str, value: object, low: float, high: float, unit: str, meant: str = ""
) -> float:
    """A float in [low, high], to rounding.

    Raises:
        ValueError: for what is no number, or lies outside.
    """
    value = number(name, value)
    if low <= value <= high:
        return value
    accepted = Range(low, high, unit, meant)
    if not accepted.admits(value):
        raise ValueError(f"{name} {accepted.refusal(value)}")
    return value


def expect_whole(name: str, value: object, low: int) -> int:
    """A whole number, `low` or more.

    Raises:
        ValueError: for anything else.
    """
    if isinstance(value, Integral) and not isinstance(value, bool) and int(value) >= low:
        return int(value)
    raise ValueError(f"{name} must be a whole number of {low} or more, not {_describe(value)}.")


def text(name: str, value: object) -> str:
    """A text.

    Raises:
        ValueError: for anything else.
    """
    if isinstance(value, str):
        return value
    raise ValueError(f"{name} must be a text, not {_describe(value)}.")


def truth(name: str, value: object) -> bool:
    """A truth value, numpy's too.

    Raises:
        ValueError: for anything else.
    """
    if isinstance(value, bool | np.bool_):
        return bool(value)
    raise ValueError(f"{name} must be True or False, not {_describe(value)}.")


def turn_sign(name: str, value: object) -> int:
    """LEFT (+1) or RIGHT (−1).

    Raises:
        ValueError: for anything else.
    """
    if type(value) is int or (isinstance(value, Integral) and not isinstance(value, bool)):
        if value == 1 or value == -1:
            return int(value)
    raise ValueError(f"{name} must be LEFT (+1) or RIGHT (-1), not {_describe(value)}.")


def expect(name: str, value: object, *kinds: type) -> None:
    """Refuse what is of none of some kinds.

    Raises:
        ValueError: naming what was given instead.
    """
    if not isinstance(value, kinds):
        wanted = " or ".join(_with_article(kind.__name__) for kind in kinds)
        raise ValueError(f"{name} must be {wanted}, not {_describe(value)}.")


def expect_function(name: str, value: object) -> None:
    """Refuse what cannot be called.

    Raises:
        ValueError: naming what was given instead.
    """
    if not callable(value):
        raise ValueError(f"{name} must be a function, not {_describe(value)}.")


def _with_article(noun: str) -> str:
    return f"{'an' if noun[0] in 'AEIOU' else 'a'} {noun}"


def _describe(value: object) -> str:
    """A value with its type, cut short."""
    return f"{brief(value)} ({type(value).__name__})"
