"""All roots of the one kind of equation that every word leads to.

    f(u) = q₂u² + q₁u + q₀ + (p·u + s) sin u + c cos u

A caller hands over cuts between which f′ has at most one zero (it knows them in closed form). Then
every zero of f′ is found by a change of sign, f is monotone between those, and so every root of f
is found, tangential ones included: no grid, nothing to miss.
"""

from math import inf

import numpy as np
from numba import njit

from relguide.kernels.base.sine import sine_and_cosine

FloatArray = np.ndarray[tuple[int, ...], np.dtype[np.float64]]

MAX_CUTS = 16
"""Room for the cuts of one equation, its two ends included."""
TOUCH = 1e-12
"""|f| at an extremum that still counts as a (double) root: some hundred roundings of f's terms."""
_DIGITS = 1e-15  # a root is right to this, or to what rounding leaves of f


@njit(cache=True, nogil=True)
def _value_and_slopes(k: FloatArray, u: float) -> tuple[float, float, float]:
    """f, f′ and f″."""
    s, c = sine_and_cosine(u)
    p = k[3] * u + k[4]
    return (
        (k[0] * u + k[1]) * u + k[2] + p * s + k[5] * c,
        2.0 * k[0] * u + k[1] + (k[3] - k[5]) * s + p * c,
        2.0 * k[0] + (2.0 * k[3] - k[5]) * c - p * s,
    )


@njit(cache=True, nogil=True)
def _root_between(k: FloatArray, low: float, high: float, f_low: float) -> float:
    """The one root of f in [low, high]: Newton kept inside a bracket."""
    u = 0.5 * (low + high)
    for _ in range(100):
        value, slope, bend = _value_and_slopes(k, u)
        if value == 0.0:
            return u
        if (value < 0.0) == (f_low < 0.0):
            low = u
        else:
            high = u
        step = value / slope if slope != 0.0 else inf
        if not low < u - step < high:
            step = u - 0.5 * (low + high)
        # what Newton's next step would be, as f″ foretells it, or what the bracket leaves
        elif abs(bend) * step * step <= _DIGITS * abs(slope):
            return u - step
        if high - low <= _DIGITS:
            return u - step
        u -= step
    return u


@njit(cache=True, nogil=True)
def _extremum_between(k: FloatArray, low: float, high: float, slope_low: float) -> float:
    """The one zero of f′ in [low, high], so right that f there is right to 1e-17."""
    u = 0.5 * (low + high)
    for _ in range(100):
        _, slope, bend = _value_and_slopes(k, u)
        if slope == 0.0:
            return u
        if (slope < 0.0) == (slope_low < 0.0):
            low = u
        else:
            high = u
        step_to = u - slope / bend if bend != 0.0 else low
        if not low < step_to < high:
            step_to = 0.5 * (low + high)
        if abs(step_to - u) <= 1e-9 or high - low <= 1e-9:
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
    low = cuts[0]
    f_low, slope_low, _ = _value_and_slopes(k, low)
    n = 0
    if abs(f_low) <= TOUCH:
        out[n] = low
        n += 1
    for i in range(1, n_cuts):
        high = cuts[i]
        f_high, slope_high, _ = _value_and_slopes(k, high)
        touched = abs(f_low) <= TOUCH or abs(f_high) <= TOUCH
        crossed = (f_low < 0.0) != (f_high < 0.0)
        if (slope_low < 0.0) == (slope_high < 0.0):
            if crossed and not touched:
                out[n] = _root_between(k, low, high, f_low)
                n += 1
        elif crossed and not touched:
            # on its way to the far side f may turn, but crosses once
            out[n] = _root_between(k, low, high, f_low)
            n += 1
        elif touched or (f_low < 0.0) != (slope_low < 0.0):
            # toward zero and back: two roots, one, or none
            turn = _extremum_between(k, low, high, slope_low)
            f_turn, _, _ = _value_and_slopes(k, turn)
            if abs(f_turn) <= TOUCH:
                out[n] = turn
                n += 1
            else:
                if abs(f_low) > TOUCH and (f_low < 0.0) != (f_turn < 0.0):
                    out[n] = _root_between(k, low, turn, f_low)
                    n += 1
                if abs(f_high) > TOUCH and (f_turn < 0.0) != (f_high < 0.0):
                    out[n] = _root_between(k, turn, high, f_turn)
                    n += 1
        if abs(f_high) <= TOUCH:
            out[n] = high
            n += 1
        low, f_low, slope_low = high, f_high, slope_high
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
