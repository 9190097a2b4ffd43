"""The plain way to all extremals: scan each word's parameter on a fine grid, bisect sign changes.

This is how planners for the like problem in wind work (a slot at rest in moving air), written here
from the equations and compiled like the planner it stands beside, so that the comparison is one of
methods. What it misses are pairs of roots between two grid points.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise. With first, middle and last
piece a, m, b and the slot at (α T, 0), T = a + m + b, each word leaves one equation in one unknown:

    CSC   the straight starts at heading θ = h + ε₁ a, so b follows from a, and the straight from
          l (cos θ − α) = Δx(a, b),  l sin θ = Δy(a, b);    what is left is their cross product.
    CCC   a + b = m − ε h + 2πk, so T follows from m and k; the end circles' centres are then known,
          and they must be 4 sin(m/2) apart.
"""

from math import atan2, cos, hypot, inf, pi, sin

from numba import njit

GRID = 720
"""Steps round the circle: every half degree."""
TURN = 2.0 * pi
_CLOSURE = 1e-6  # a root whose path ends further from the slot is a jump, not a root [R]


@njit(cache=True, nogil=True)
def least_time(x: float, y: float, h: float, alpha: float) -> float:
    """Least time to a slot that moves along x, open from the start [R/V_P]; infinite if none.

    Args:
        x: pursuer ahead of the slot [R].
        y: and left of it [R].
        h: its heading, counter-clockwise from the leader's [rad].
        alpha: V_L/V_P.
    """
    best = inf
    for first in (1.0, -1.0):
        for last in (1.0, -1.0):
            best = min(best, _csc(x, y, h, alpha, first, last))
        best = min(best, _ccc(x, y, h, alpha, first))
    return best


@njit(cache=True, nogil=True)
def _csc(x: float, y: float, h: float, alpha: float, first: float, last: float) -> float:
    best = inf
    # where the last turn shrinks to nothing it becomes a full one: no root may be looked for across
    jump = (-first * h) % TURN
    for lower, upper in ((0.0, jump), (jump, TURN)):
        gap, straight, time = _csc_gap(x, y, h, alpha, first, last, lower)
        if straight >= -1e-9 and abs(gap) < _CLOSURE and time < best:
            best = time
        steps = int(GRID * (upper - lower) / TURN) + 1
        low, low_value = 0.0, 0.0
        for k in range(steps + 1):
            # just inside the ends, where the last turn still has its value of this side
            high = lower + (upper - lower) * (1e-12 + (1.0 - 2e-12) * k / steps)
            high_value, _, _ = _csc_gap(x, y, h, alpha, first, last, high)
            if k > 0 and low_value * high_value <= 0.0:
                a, b = low, high
                for _ in range(50):
                    middle = 0.5 * (a + b)
                    value, _, _ = _csc_gap(x, y, h, alpha, first, last, middle)
                    if value * low_value > 0.0:
                        a = middle
                    else:
                        b = middle
                gap, straight, time = _csc_gap(x, y, h, alpha, first, last, b)
                if straight >= -1e-9 and abs(gap) < _CLOSURE and time < best:
                    best = time
            low, low_value = high, high_value
    return best


@njit(cache=True, nogil=True)
def _csc_gap(
    x: float, y: float, h: float, alpha: float, first: float, last: float, a: float
) -> tuple[float, float, float]:
    """What is left of the closing equations for a first turn a; the straight and the time then."""
    course = h + first * a
    b = (-last * course) % TURN
    dx = alpha * (a + b) - x - first * (sin(course) - sin(h)) + last * sin(course)
    dy = -y + first * (cos(course) - cos(h)) + last * (1.0 - cos(course))
    rx, ry = cos(course) - alpha, sin(course)
    straight = (dx * rx + dy * ry) / (rx * rx + ry * ry)
    return dx * ry - dy * rx, straight, a + straight + b


@njit(cache=True, nogil=True)
def _ccc(x: float, y: float, h: float, alpha: float, turn: float) -> float:
    best = inf
    for branch in range(-1, 2):
        low, low_value = 0.0, 0.0
        for k in range(GRID + 1):
            high = TURN * k / GRID
            high_value, _ = _ccc_gap(x, y, h, alpha, turn, branch, high)
            if k > 0 and low_value * high_value <= 0.0:
                a, b = low, high
                for _ in range(50):
                    middle = 0.5 * (a + b)
                    value, _ = _ccc_gap(x, y, h, alpha, turn, branch, middle)
                    if value * low_value > 0.0:
                        a = middle
                    else:
                        b = middle
                _, time = _ccc_gap(x, y, h, alpha, turn, branch, b)
                if time < best and _ccc_closes(x, y, h, alpha, turn, b, time):
                    best = time
            low, low_value = high, high_value
    return best


@njit(cache=True, nogil=True)
def _ccc_gap(
    x: float, y: float, h: float, alpha: float, turn: float, branch: int, m: float
) -> tuple[float, float]:
    """How far the end circles' centres are from 4 sin(m/2) apart, and the time of such a word."""
    time = 2.0 * m + (-turn * h) % TURN + TURN * branch
    cx = alpha * time - (x - turn * sin(h))
    cy = turn - (y + turn * cos(h))
    return hypot(cx, cy) - 4.0 * abs(sin(0.5 * m)), time


@njit(cache=True, nogil=True)
def _ccc_closes(
    x: float, y: float, h: float, alpha: float, turn: float, m: float, time: float
) -> bool:
    """Whether turns a, m, b with a and b in [0, 2π) make up this time and end in the slot."""
    cx = alpha * time - (x - turn * sin(h))
    cy = turn - (y + turn * cos(h))
    # the line from the first to the last centre is the chord of the middle turn's two half steps
    course = atan2(cy, cx) + turn * 0.5 * m
    a = (turn * (course - h)) % TURN
    b = time - m - a
    if not (-1e-9 <= b < TURN + 1e-9):
        return False
    for sign, amount in ((turn, a), (-turn, m), (turn, b)):
        end = h + sign * amount
        x += sign * (sin(end) - sin(h))
        y -= sign * (cos(end) - cos(h))
        h = end
    return hypot(x - alpha * time, y) < _CLOSURE and abs(sin(0.5 * h)) < _CLOSURE
