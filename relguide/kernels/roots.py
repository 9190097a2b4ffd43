"""All roots of the one kind of equation that every word leads to.

    f(u) = q₂u² + q₁u + q₀ + (p·u + s) sin u + c cos u

A caller hands over cuts between which f′ has at most one zero (it knows them in closed form). Then
every zero of f′ is found by a change of sign, f is monotone between those, and so every root of f
is found, tangential ones included: no grid, nothing to miss.
"""

from math import cos, sin

import numpy as np
from numba import njit

FloatArray = np.ndarray[tuple[int, ...], np.dtype[np.float64]]

MAX_CUTS = 16
"""Room for the cuts of one equation, its two ends included."""
TOUCH = 1e-12
"""|f| at an extremum that still counts as a (double) root: some hundred roundings of f's terms."""


@njit(cache=True, nogil=True)
def _value(k: FloatArray, u: float) -> float:
    return float(k[0] * u * u + k[1] * u + k[2] + (k[3] * u + k[4]) * sin(u) + k[5] * cos(u))


@njit(cache=True, nogil=True)
def _slope(k: FloatArray, u: float) -> float:
    return float(2.0 * k[0] * u + k[1] + (k[3] - k[5]) * sin(u) + (k[3] * u + k[4]) * cos(u))


@njit(cache=True, nogil=True)
def _bend(k: FloatArray, u: float) -> float:
    return float(2.0 * k[0] + (2.0 * k[3] - k[5]) * cos(u) - (k[3] * u + k[4]) * sin(u))


@njit(cache=True, nogil=True)
def _zero_between(
    k: FloatArray, of_slope: bool, low: float, high: float, f_low: float, tolerance: float
) -> float:
    """The one zero of f (or f′) in [low, high]: Newton kept inside a bracket."""
    u = 0.5 * (low + high)
    for _ in range(100):
        if of_slope:
            value, slope = _slope(k, u), _bend(k, u)
        else:
            value, slope = _value(k, u), _slope(k, u)
        if value == 0.0:
            return u
        if (value < 0.0) == (f_low < 0.0):
            low = u
        else:
            high = u
        step_to = u - value / slope if slope != 0.0 else low
        if not low < step_to < high:
            step_to = 0.5 * (low + high)
        if abs(step_to - u) <= tolerance or high - low <= tolerance:
            return step_to
        u = step_to
    return u


@njit(cache=True, nogil=True)
def all_roots(k: FloatArray, cuts: FloatArray, n_cuts: int, out: FloatArray) -> int:
    """All roots of f on [cuts[0], cuts[n_cuts − 1]], in ascending order.

    Args:
        k: q₂, q₁, q₀, p, s, c.
        cuts: ascending; between two neighbours f′ has at most one zero. shape (≥ n_cuts,)
        n_cuts: how many of them, ≥ 2.
        out: takes the roots. shape (≥ 2·n_cuts,)

    Returns:
        how many roots.
    """
    n = 0
    left, f_left = cuts[0], _value(k, cuts[0])
    if abs(f_left) <= TOUCH:
        out[n] = left
        n += 1
    slope_low = _slope(k, cuts[0])
    for i in range(1, n_cuts):
        low, high = cuts[i - 1], cuts[i]
        slope_high = _slope(k, high)
        turning = (slope_low < 0.0) != (slope_high < 0.0)
        # an end of the last interval closes a monotone stretch, and so does an extremum
        for stretch in range(2):
            if stretch == 0:
                if not turning:
                    continue
                # 1e-9: f at the extremum is then right to 1e-17
                right = _zero_between(k, True, low, high, slope_low, 1e-9)
            else:
                if i < n_cuts - 1:
                    break
                right = high
            f_right = _value(k, right)
            if abs(f_right) <= TOUCH:
                out[n] = right
                n += 1
            elif abs(f_left) > TOUCH and (f_left < 0.0) != (f_right < 0.0):
                out[n] = _zero_between(k, False, left, right, f_left, 1e-15)
                n += 1
            left, f_left = right, f_right
        slope_low = slope_high
    return n


@njit(cache=True, nogil=True)
def insert_cut(cuts: FloatArray, n_cuts: int, u: float) -> int:
    """Insert u into the ascending cuts if strictly between the ends; returns the new count."""
    if not cuts[0] < u < cuts[n_cuts - 1]:
        return n_cuts
    i = n_cuts
    while cuts[i - 1] > u:
        cuts[i] = cuts[i - 1]
        i -= 1
    cuts[i] = u
    return n_cuts + 1
