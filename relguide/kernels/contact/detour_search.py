"""The fastest path to the slot that keeps clear of all, where the best one for the leader does not.

Four kinds of seeds: the words of the start; detours by one turn and one straight, on a grid; paths
by way of contacts; and detours from the contacts. The best of them are followed downward, and the
best of all by ever more turns, as long as that gains time. The work is bounded: grids are fixed,
and so is the number of words that are solved for contacts.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import inf

import numpy as np
from numba import njit

from relguide.kernels.base.angles import TWO_PI
from relguide.kernels.base.borrowed import borrowed
from relguide.kernels.base.clock import time_is_up
from relguide.kernels.base.records import Pose
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.contact_chains import (
    MOST_CONTACTS,
    Places,
    add_piece,
    follow_contacts,
    no_places,
    pairs_by_way_of,
)
from relguide.kernels.contact.detours import close_detour, descend, lowest_of, scan_detours
from relguide.kernels.contact.others import Others, first_clear_of_all, words_to_slot
from relguide.kernels.words.extremals import MAX_ROWS, SIGNS

MOST_PAIRS = 3 * MOST_CONTACTS + 4
"""Room for the pairs of turn and straight before the last word."""
_TURNS, _TURNS_ON = 72, 24  # steps of a full turn: from the start, and from contacts
_BEARINGS = 36  # round each of the others
_SEEDS = 6  # of each kind that are followed downward
_MARGIN = 0.5  # so much later than the best one may be as a seed [R/V_P]
_SIZE, _SIZE_AT_CONTACT = 0.15, 0.08  # first steps [rad, R]
_EFFORT = 8_000.0  # words solved to look for contacts
_GAIN = 1e-4  # what another pair has to gain [R/V_P]


@njit(cache=True, nogil=True)
def straights_to_try(step: float, longest: float) -> FloatArray:
    """Lengths of straights from 0 on, by steps that grow with them [R]."""
    found, n = np.empty(200), 1
    found[0] = 0.0
    while n < len(found) and found[n - 1] < longest:
        found[n] = found[n - 1] + max(step, 0.12 * found[n - 1] - 12.0 * step * 0.12)
        n += 1
    return found[:n].copy()


@njit(cache=True, nogil=True)
def fastest_clear_of_all(
    start: Pose, others: Others, pairs: FloatArray, row: FloatArray
) -> tuple[float, int]:
    """The fastest path found that keeps clear of all.

    Args:
        start: where it begins, at t = 0.
        others: what it keeps clear of.
        pairs: takes sign and angle of each turn, and the straight behind it. shape (MOST_PAIRS, 3)
        row: takes the last word, a row of `solve`. shape (5,)

    Returns:
        arrival [R/V_P] and the number of pairs; infinite and −1 if none is found.
    """
    mine = borrowed(others)
    rows, best_pairs = np.empty((MAX_ROWS, 5)), np.zeros((MOST_PAIRS, 3))
    n = words_to_slot(start, 0.0, mine, rows)
    if n == 0:
        return inf, -1
    bound = rows[0, 0]
    best, _ = first_clear_of_all(start, 0.0, rows[:n], mine, inf)
    count = 0
    straights = straights_to_try(0.25, 60.0)
    grid = np.empty((2, _TURNS + 1, len(straights)))
    scanned = scan_detours(start, 0.0, _TURNS, straights, mine, best, _MARGIN, grid)
    lowest = np.empty((_SEEDS, 4))
    seeds = lowest_of(grid, scanned + _MARGIN, lowest)
    trial = np.zeros((MOST_PAIRS, 3))
    for k in range(seeds):
        trial[0, 0], trial[0, 1] = 1.0 - 2.0 * lowest[k, 1], TWO_PI * lowest[k, 2] / _TURNS
        trial[0, 2] = straights[int(lowest[k, 3])]
        time = descend(start, 0.0, trial[:1], _SIZE, mine, lowest[k, 0] + _GAIN, best)
        if time < best:
            best, count = time, 1
            best_pairs[:] = trial
    places = no_places(start, bound, len(mine.limits))
    onward = straights_to_try(0.5, 40.0)
    follow_contacts(places, mine, _BEARINGS, _TURNS_ON, onward, best, _MARGIN, _EFFORT)
    best, count = _follow_down(start, places, mine, best, count, best_pairs)
    best, count = _by_more_turns(start, mine, best, count, best_pairs)
    pairs[:] = best_pairs
    time, k = close_detour(start, 0.0, pairs[:count], mine, inf, rows)
    if k < 0:
        return inf, -1
    row[:] = rows[k]
    return time, count


@njit(cache=True, nogil=True)
def _follow_down(
    start: Pose, places: Places, others: Others, best: float, count: int, best_pairs: FloatArray
) -> tuple[float, int]:
    """Follow the best paths by way of contacts downward, one for each way round the others."""
    n = int(places.used[0])
    order = np.argsort(places.arrivals[:n, 0])
    followed = np.empty(_SEEDS, np.int64)
    done = 0
    trial = np.zeros((MOST_PAIRS, 3))
    for at in order:
        arrival = places.arrivals[at, 0]
        if arrival >= best + _MARGIN or done == _SEEDS or time_is_up(others.until):
            break
        alike = False
        for k in range(done):
            alike = alike or _go_alike(places, at, followed[k])
        if alike:
            continue
        followed[done] = at
        done += 1
        m = pairs_by_way_of(places, at, trial)
        time = descend(start, 0.0, trial[:m], _SIZE_AT_CONTACT, others, arrival + _GAIN, best)
        if time < best:
            best, count = time, m
            best_pairs[:] = trial
    return best, count


@njit(cache=True, nogil=True)
def _go_alike(places: Places, one: int, other: int) -> bool:
    """Whether two paths touch the same on the same sides, one after the other."""
    while one > 0 and other > 0:
        a, b = places.contacts[one], places.contacts[other]
        if a[0] != b[0] or a[3] != b[3]:
            return False
        one, other = int(places.parents[one, 0]), int(places.parents[other, 0])
    return one == other


@njit(cache=True, nogil=True)
def _by_more_turns(
    start: Pose, others: Others, best: float, count: int, best_pairs: FloatArray
) -> tuple[float, int]:
    """The best path with the beginning of its last word free to move as well, while it gains."""
    rows, trial = np.empty((MAX_ROWS, 5)), np.zeros((MOST_PAIRS, 3))
    for _ in range(2):
        if count + 2 > MOST_PAIRS or time_is_up(others.until):
            break
        _, k = close_detour(start, 0.0, best_pairs[:count], others, inf, rows)
        if k < 0:
            break
        word, m = int(rows[k, 1]), count
        trial[:] = best_pairs
        m = add_piece(trial, m, SIGNS[word, 0], rows[k, 2])
        m = add_piece(trial, m, SIGNS[word, 1], 0.5 * rows[k, 3])
        time = descend(start, 0.0, trial[:m], _SIZE_AT_CONTACT, others, best + _GAIN, best)
        if time > best - _GAIN:
            break
        best, count = time, m
        best_pairs[:] = trial
    return best, count
