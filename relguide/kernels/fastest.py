"""The fastest extremal alone, for maps: words that cannot win are not solved.

LSL and RSR cost a tenth of the others and are solved first; their time T̂ is to be beaten. Symbols
as in `csc` and `ccc`: d(τ) is the way between the centres of the first and the last circle.

LSR. A root means τ = A + l with l² = |d(τ)|² − 4, and the course of the straight is β = arg d +
asin(2/|d|). So from any A₀ ≤ A follows (τ − A₀)² ≥ |d(τ)|² − 4, a quadratic in τ that bounds it
below; while τ runs from that bound to T̂, d runs along a straight line and β within an interval, in
which A(β) has a least value: a better A₀. If the bound passes T̂ the word cannot win.

LRL. A root means |d(τ)| ≤ 4 at some τ ≤ T̂.
"""

from math import asin, atan2, cos, hypot, sin, sqrt

from numba import njit

from relguide.kernels.angles import TWO_PI, wrap
from relguide.kernels.extremals import solve_word
from relguide.kernels.roots import FloatArray

_ROUNDS = 3  # more gain nothing
_ROUNDING = 1e-6  # of angles and of times [R/V_P]: a word this close to winning is solved


@njit(cache=True, nogil=True)
def fastest(
    x: float, y: float, h: float, alpha: float, t_open: float, found: FloatArray, rows: FloatArray
) -> int:
    """The first row of `solve`, and some of the others.

    Args:
        x: pursuer ahead of the slot [R].
        y: pursuer left of it [R].
        h: its heading, counter-clockwise from the leader's [rad], in [0, 2π).
        alpha: V_L/V_P.
        t_open: earliest arrival [R/V_P].
        found: room to work in. shape (MAX_ROWS, 4)
        rows: takes the extremals as `solve` does. shape (MAX_ROWS, 5)

    Returns:
        how many rows; 0 only if `solve` gives none.
    """
    n = 0
    for word in range(6):
        if word >= 2 and n > 0 and alpha < 1.0:
            side = 1.0 if word % 2 == 0 else -1.0  # RSL and RLR are mirror images
            turned = h if side > 0.0 or h == 0.0 else TWO_PI - h
            if word < 4:
                slower = _lsr_is_slower(x, side * y, turned, alpha, t_open, rows[0, 0])
            else:
                slower = _lrl_is_slower(x, side * y, turned, alpha, t_open, rows[0, 0])
            if slower:
                continue
        n = solve_word(x, y, h, alpha, 0.0, t_open, word, found, rows, n)
    return n


@njit(cache=True, nogil=True)
def _lsr_is_slower(x: float, y: float, h: float, alpha: float, t_open: float, beat: float) -> bool:
    """Whether no LSR path is as fast as `beat`, for α < 1. May say no where it is so."""
    east, north = -(x - sin(h)), -1.0 - (y + cos(h))
    beat += _ROUNDING
    least_turn = 0.0
    for _ in range(_ROUNDS):
        start = max(_not_before(east, north, alpha, least_turn), t_open) - _ROUNDING
        if start > beat:
            return True
        near, far = alpha * max(start, 0.0) + east, alpha * beat + east
        least = abs(north) if near < 0.0 < far else min(hypot(near, north), hypot(far, north))
        if least < 2.0 + _ROUNDING:
            return False
        bearings = atan2(north, near), atan2(north, far)
        low = min(bearings) + asin(2.0 / max(hypot(near, north), hypot(far, north))) - _ROUNDING
        width = max(bearings) + asin(2.0 / least) + _ROUNDING - low
        # A(β) rises but where β passes h or 0: there a turn falls from 2π to nothing
        turn = wrap(low - h) + wrap(low)
        if wrap(h - low) <= width:
            turn = min(turn, h)
        if wrap(-low) <= width:
            turn = min(turn, wrap(-h))
        if turn - _ROUNDING <= least_turn:
            return False
        least_turn = turn - _ROUNDING
    return bool(_not_before(east, north, alpha, least_turn) - _ROUNDING > beat)


@njit(cache=True, nogil=True)
def _not_before(east: float, north: float, alpha: float, turn: float) -> float:
    """The least τ ≥ A₀ with (τ − A₀)² ≥ |d(τ)|² − 4."""
    across = north * north - 4.0
    if (alpha * turn + east) ** 2 + across <= 0.0:
        return turn
    one_less = 1.0 - alpha * alpha
    half = turn + alpha * east
    gap = half * half + one_less * (east * east + across - turn * turn)
    if gap < 0.0:
        return turn
    return float(max((half + sqrt(gap)) / one_less, turn))


@njit(cache=True, nogil=True)
def _lrl_is_slower(x: float, y: float, h: float, alpha: float, t_open: float, beat: float) -> bool:
    """Whether no LRL path is as fast as `beat`. May say no where it is so."""
    east, north = -(x - sin(h)), 1.0 - (y + cos(h))
    within = 16.0 + _ROUNDING - north * north
    if within < 0.0:
        return True
    # d comes within reach at −half, and leaves it at +half
    half = sqrt(within)
    if alpha == 0.0:
        return abs(east) > half
    return (-half - east) / alpha > beat + _ROUNDING or (half - east) / alpha < t_open - _ROUNDING
