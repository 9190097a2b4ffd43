"""Every extremal without the separation limit: all six words, all their roots, in order of time.

Pontryagin's principle leaves these words only (a turn, a straight or a turn, a turn), and all their
roots are found, so the first row is the global optimum of the unlimited problem.
"""

from math import inf

import numpy as np
from numba import njit

from relguide.kernels.base.angles import mirror_heading
from relguide.kernels.base.norm import norm
from relguide.kernels.base.records import Pose, Velocity, Window
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.base.sine import sine_and_cosine
from relguide.kernels.words.ccc import lrl
from relguide.kernels.words.csc import lsl, lsr

WORDS = ("LSL", "RSR", "LSR", "RSL", "LRL", "RLR")
"""The words by their number in `solve`."""
ALL_WORDS = 63
"""All six, as a sum of 2 to the power of their numbers."""
SIGNS = np.array([[1.0, 0.0, 1.0], [-1.0, 0.0, -1.0], [1.0, 0.0, -1.0], [-1.0, 0.0, 1.0],
                  [1.0, -1.0, 1.0], [-1.0, 1.0, -1.0]])  # fmt: skip
"""ε of each piece of each word: +1 left, −1 right, 0 straight. shape (6, 3)"""
MAX_ROWS = 96
"""Room for all roots of all words: at most 8 + 2·16 + 2·24."""
CLOSURE = 1e-7
"""Largest end error of an accepted path [R]; ≈ 1 mm at R = 12 km."""


@njit(cache=True, nogil=True)
def fly_piece(pose: Pose, sign: float, amount: float) -> Pose:
    """The end of one piece: a turn (sign ±1, amount in rad) or a straight (sign 0, in R)."""
    x, y, h = pose
    s, c = sine_and_cosine(h)
    if sign == 0.0:
        return Pose(x + amount * c, y + amount * s, h)
    end = h + sign * amount
    end_s, end_c = sine_and_cosine(end)
    return Pose(x + sign * (end_s - s), y - sign * (end_c - c), end)


@njit(cache=True, nogil=True)
def solve(pose: Pose, alpha: float, t_release: float, rows: FloatArray) -> int:
    """All extremals that reach the slot at or after t_release, by time.

    Args:
        pose: the pursuer's, seen from the slot; its heading in [0, 2π).
        alpha: V_L/V_P, ≥ 0; 0 is a slot at rest, and the first row then Dubins' shortest path.
        t_release: earliest arrival [R/V_P].
        rows: takes (τ, word number, first, middle, last) [R/V_P; rad or R]. shape (MAX_ROWS, 5)

    Returns:
        how many rows.
    """
    return solve_toward(pose, Velocity(alpha, 0.0), t_release, rows)


@njit(cache=True, nogil=True)
def solve_and_measure(
    x: float, y: float, h: float, alpha: float, t_release: float, rows: FloatArray
) -> tuple[int, float]:
    """As `solve`, and how far the slot's place at t_release is, for one call from Python a plan.

    Args:
        x: the pursuer ahead of the slot [R].
        y: and left of it [R].
        h: its heading [rad], in [0, 2π).
        alpha: V_L/V_P.
        t_release: earliest arrival [R/V_P].
        rows: as in `solve`.

    Returns:
        how many rows, and the length of the shortest path to where the slot opens [R]; infinite if
        that is more than t_release in a straight line.
    """
    n, end_x = solve(Pose(x, y, h), alpha, t_release, rows), alpha * t_release
    if t_release <= 0.0 or norm(end_x - x, y) > t_release:
        return n, inf
    to_place = np.empty((MAX_ROWS, 5))
    solve(Pose(x - end_x, y, h), 0.0, 0.0, to_place)
    return n, to_place[0, 0]


@njit(cache=True, nogil=True)
def solve_toward(pose: Pose, target: Velocity, t_release: float, rows: FloatArray) -> int:
    """As `solve`, for a target with any velocity, met on heading 0."""
    return solve_words(pose, target, ALL_WORDS, Window(t_release, inf), rows)


@njit(cache=True, nogil=True)
def solve_words(pose: Pose, target: Velocity, words: int, window: Window, rows: FloatArray) -> int:
    """As `solve_toward`, of some words.

    Args:
        pose: as in `solve`.
        target: how it moves.
        words: which, as a sum of 2 to the power of their numbers.
        window: when they arrive; some that arrive later may be there, too.
        rows: as in `solve`.

    Returns:
        how many rows.
    """
    found, n = np.empty((MAX_ROWS, 4)), 0
    for word in range(6):
        if words & (1 << word):
            n = solve_word(pose, target, window, word, found, rows, n)
    return n


@njit(cache=True, nogil=True)
def solve_word(
    pose: Pose, target: Velocity, window: Window, word: int, found: FloatArray,
    rows: FloatArray, n: int,
) -> int:  # fmt: skip
    """All extremals of one word, put among others by time.

    Args:
        pose: as in `solve`.
        target: as in `solve_toward`.
        window: as in `solve_words`.
        word: its number.
        found: room to work in. shape (MAX_ROWS, 4)
        rows: contains n rows already, in order of time.
        n: how many.

    Returns:
        how many rows there are now.
    """
    start, toward = pose, target
    if word % 2 == 1:
        # RSR, RSL and RLR are mirror images
        start = Pose(pose.x, -pose.y, mirror_heading(pose.h))
        toward = Velocity(target.ahead, -target.left)
    if word < 2:
        end = lsl(start, toward, window.beat, found, 0)
    elif word < 4:
        end = lsr(start, toward, window.beat, found, 0)
    else:
        end = lrl(start, toward, window.beat, found, 0)
    for i in range(end):
        time = found[i, 0]
        if time < window.earliest - 1e-9 or not closes(pose, target, word, found[i]):
            continue
        at = n
        while at > 0 and rows[at - 1, 0] > time:
            rows[at] = rows[at - 1]
            at -= 1
        rows[at, 0] = time
        rows[at, 1] = word
        rows[at, 2] = found[i, 1]
        rows[at, 3] = found[i, 2]
        rows[at, 4] = found[i, 3]
        n += 1
    return n


@njit(cache=True, nogil=True)
def closes(pose: Pose, target: Velocity, word: int, row: FloatArray) -> bool:
    """Whether a path ends at the target: one of a root next to a tangency may not."""
    # as `fly_piece`, with sine and cosine of each heading found once
    x, y, h = pose
    s, c = sine_and_cosine(h)
    for piece in range(3):
        sign, amount = SIGNS[word, piece], row[piece + 1]
        if sign == 0.0:
            x, y = x + amount * c, y + amount * s
            continue
        h += sign * amount
        end_s, end_c = sine_and_cosine(h)
        x, y = x + sign * (end_s - s), y - sign * (end_c - c)
        s, c = end_s, end_c
    miss = norm(x - target.ahead * row[0], y - target.left * row[0])
    # far away the last digits of τ are worth more than CLOSURE
    return bool(miss <= CLOSURE + 1e-12 * row[0])
