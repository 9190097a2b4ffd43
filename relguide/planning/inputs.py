"""What callers give: numbers become floats, and what is wrong is refused with a sentence.

The kernels are compiled for floats, so an integer or a numpy scalar is made one here, once.
"""

from math import inf, isfinite
from numbers import Integral, Real
from reprlib import repr as brief


def number(name: str, value: object) -> float:
    """A finite float; −0 becomes 0.

    Raises:
        ValueError: for what is no real number (a truth value is none), or is not finite.
    """
    # isinstance of `Real` takes half a microsecond, and nearly all are floats
    if type(value) is not float:
        if isinstance(value, bool) or not isinstance(value, Real):
            raise ValueError(f"{name} must be a number, not {_shown(value)}.")
        try:
            value = float(value)
        except OverflowError:  # an integer of hundreds of digits
            value = inf
    if not isfinite(value):
        raise ValueError(f"{name} must be a finite number, not {value}.")
    return value + 0.0


def within(name: str, value: object, low: float, high: float, unit: str) -> float:
    """A float in [low, high], to rounding.

    Raises:
        ValueError: for what is no number, or lies outside.
    """
    value = number(name, value)
    # 1e-9 relative: a bound given in degrees comes back from radians with its last digit changed
    slack = 1e-9 * max(abs(low), abs(high))
    if not low - slack <= value <= high + slack:
        raise ValueError(f"{name} must lie in {low:g} … {high:g} {unit}, not {value:.9g} {unit}.")
    return value


def turn_sign(name: str, value: object) -> int:
    """LEFT (+1) or RIGHT (−1).

    Raises:
        ValueError: for anything else.
    """
    if type(value) is int or (isinstance(value, Integral) and not isinstance(value, bool)):
        if value == 1 or value == -1:
            return int(value)
    raise ValueError(f"{name} must be LEFT (+1) or RIGHT (-1), not {_shown(value)}.")


def expect(name: str, value: object, kind: type) -> None:
    """Refuse what is not of a kind.

    Raises:
        ValueError: naming what was given instead.
    """
    if not isinstance(value, kind):
        article = "an" if kind.__name__[0] in "AEIOU" else "a"
        raise ValueError(f"{name} must be {article} {kind.__name__}, not {_shown(value)}.")


def _shown(value: object) -> str:
    """A value with its type, cut short."""
    return f"{brief(value)} ({type(value).__name__})"
