"""False position with the Illinois step: a zero between two ends, without derivatives.

    bracket = Bracket(low, high, gap_low, gap_high, 0)
    while …: u = secant(bracket); bracket = tightened(bracket, u, f(u))

Who calls decides when u is good enough, and what a function without a value at u means.
Source: M. Dowell, P. Jarratt, A modified regula falsi method, BIT 11 (1971).
"""

from typing import NamedTuple

from numba import njit


class Bracket(NamedTuple):
    """An interval in which a rising function crosses zero, for the false position (Illinois)."""

    low: float
    """Its ends …"""
    high: float
    gap_low: float
    """… and the function there, < 0; of an end that stays, half of it and less."""
    gap_high: float
    """> 0, likewise."""
    side: int
    """Which end moved last: −1 the low one, 1 the high one, 0 none yet."""


@njit(cache=True, nogil=True)
def secant(bracket: Bracket) -> float:
    """Where the line through both ends crosses zero."""
    low, high, gap_low, gap_high, _ = bracket
    return (low * gap_high - high * gap_low) / (gap_high - gap_low)


@njit(cache=True, nogil=True)
def tightened(bracket: Bracket, u: float, gap: float) -> Bracket:
    """The bracket, with u and the function there as its new end; an end that stays counts half."""
    low, high, gap_low, gap_high, side = bracket
    if gap < 0.0:
        return Bracket(u, high, gap, gap_high * (0.5 if side < 0 else 1.0), -1)
    return Bracket(low, u, gap_low * (0.5 if side > 0 else 1.0), gap, 1)
