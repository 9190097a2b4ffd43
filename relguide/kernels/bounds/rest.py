"""What is left of all words from a set of poses: there those from a part of the set are looked for.

The poses of a cell's half are among the cell's. So what the word bound has ruled out for the cell
need not be looked at again; intervals of the unknown that were left are kept for both halves. That
takes it that they are kept however late the words are, up to what is to be beaten. Lengths in R,
times in R/V_P, angles counter-clockwise.
"""

from typing import NamedTuple

import numpy as np
from numba import njit

from relguide.kernels.base.roots import FloatArray

SAME_TURNS, OPPOSITE_TURNS, THREE_TURNS = 0, 1, 2
"""What kind a word is: LSL, LSR or LRL, and with 3 more in the mirror."""
LEFT_OUT = 6
"""Added to the kind of words that certainly break the limit."""
MOST = 48
"""Intervals that are kept of a set at most."""
COLUMNS = 5
"""Of what is kept of one: kind of word, middle of the interval and half its width, heading of the
set's middle as the word sees it, and full turns, see `word_bound`."""
UNKNOWN = -1
"""Instead of a row: all words are to be looked at, or nothing is to be kept."""


class Rest(NamedTuple):
    """Intervals that were left, and room for those that are left now."""

    table: FloatArray
    """Intervals, those of each set together. A row before them begins with how many they are.
    shape (·, COLUMNS)"""
    known: int
    """That row of a set that holds this one, or `UNKNOWN`."""
    room: int
    """And where there is room, or `UNKNOWN`."""


@njit(cache=True, nogil=True)
def no_rest() -> Rest:
    """Nothing is known, and nothing is to be kept."""
    return Rest(np.empty((0, COLUMNS)), UNKNOWN, UNKNOWN)


@njit(cache=True, nogil=True)
def begin_rest(rest: Rest) -> None:
    """Nothing is kept so far."""
    if rest.room >= 0:
        rest.table[rest.room, 0] = 0.0


@njit(cache=True, nogil=True)
def keep(rest: Rest, word: int, mid: float, half: float, heading: float, around: float) -> None:
    """Keep an interval, if there is room."""
    table, room = rest.table, rest.room
    table[room, 0] += 1.0
    n = int(table[room, 0])
    if n <= MOST:
        n += room
        table[n, 0], table[n, 1], table[n, 2] = word, mid, half
        table[n, 3], table[n, 4] = heading, around
