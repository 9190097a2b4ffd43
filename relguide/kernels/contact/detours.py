"""Detours to the slot that keep clear of all: turns and straights, and then the exact word.

A detour is a list of (turn, straight) pairs from the start; from its end the fastest word that is
clear of all leads to the slot. So its arrival is a function of turn angles and lengths, which is
scanned on a grid, and then followed downward. Its minimum lies on an edge of what is clear: there
the path touches one of the others. That is why it is followed in all directions, not by axes.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import inf

import numpy as np
from numba import njit

from relguide.kernels.base.clock import time_is_up
from relguide.kernels.base.records import Pose
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.others import (
    Others,
    broken_by,
    first_clear_of_all,
    words_to_slot,
)
from relguide.kernels.words.extremals import MAX_ROWS, fly_piece

_SMALLEST = 2e-4  # last step of a descent [rad, R]: a hundredth of a second
_GROWTH, _SHRINK = 2.0, 0.5  # of a step that leads down, and where none does
_DIRECTIONS = 7  # tried from one place, for each number that is moved
_MOST_TRIES = 2_000
_STEEPEST = 12.0  # an arrival falls no faster than by this much of a step, for long


@njit(cache=True, nogil=True)
def close_detour(
    pose: Pose, t: float, pairs: FloatArray, others: Others, beat: float, rows: FloatArray
) -> tuple[float, int]:
    """When a detour is at the slot, and by which row; infinite and −1 if it is not clear.

    Args:
        pose: where it begins.
        t: when [R/V_P].
        pairs: sign and angle of each turn, and the straight behind it. shape (n, 3)
        others: what it keeps clear of.
        beat: only arrivals before this count [R/V_P].
        rows: takes the words. shape (MAX_ROWS, 5)
    """
    for k in range(len(pairs)):
        sign, turned, straight = pairs[k]
        if turned > 0.0:
            if broken_by(pose, sign, t, turned, others) >= 0:
                return inf, -1
            pose = fly_piece(pose, sign, turned)
            t += turned
        if straight > 0.0:
            if broken_by(pose, 0.0, t, straight, others) >= 0:
                return inf, -1
            pose = fly_piece(pose, 0.0, straight)
            t += straight
    n = words_to_slot(pose, t, others, rows)
    return first_clear_of_all(pose, t, rows[:n], others, beat)


@njit(cache=True, nogil=True)
def scan_detours(
    pose: Pose, t: float, turns: int, straights: FloatArray, others: Others, beat: float,
    margin: float, arrivals: FloatArray,
) -> float:  # fmt: skip
    """Arrivals by way of one turn and one straight, on a grid.

    Args:
        pose: where they begin.
        t: when [R/V_P].
        turns: so many steps make a full turn.
        straights: the lengths, ascending from 0 [R]. shape (m,)
        others: what they keep clear of.
        beat: an arrival already known [R/V_P].
        margin: so much later ones are looked at as well [R/V_P].
        arrivals: takes them, to the left first; infinite where there is none.
            shape (2, turns + 1, m)

    Returns:
        the first of them, or `beat`.
    """
    rows = np.empty((MAX_ROWS, 5))
    step = 2.0 * np.pi / turns
    arrivals[:] = inf
    for side in range(2):
        sign = 1.0 - 2.0 * side
        begun, then = pose, t
        for j in range(turns + 1):
            if j > 0:
                if broken_by(begun, sign, then, step, others) >= 0:
                    break
                begun, then = fly_piece(begun, sign, step), then + step
            here, now = begun, then
            if time_is_up(others.until):
                return beat
            for k in range(len(straights)):
                if k > 0:
                    on = straights[k] - straights[k - 1]
                    if broken_by(here, 0.0, now, on, others) >= 0:
                        break
                    here, now = fly_piece(here, 0.0, on), now + on
                n = words_to_slot(here, now, others, rows)
                # the exact time to go: along any path its sum with the time never falls
                if n == 0 or now + rows[0, 0] >= beat + margin:
                    break
                arrival, _ = first_clear_of_all(here, now, rows[:n], others, beat + margin)
                arrivals[side, j, k] = arrival
                beat = min(beat, arrival)
    return beat


@njit(cache=True, nogil=True)
def lowest_of(arrivals: FloatArray, below: float, places: FloatArray) -> int:
    """The lowest places of a grid of `scan_detours` that have no lower neighbour.

    Args:
        arrivals: of the grid.
        below: only such arrivals [R/V_P].
        places: takes arrival, side, and the numbers of turn and straight; lowest first.
            shape (·, 4)

    Returns:
        how many.
    """
    n = 0
    _, turns, lengths = arrivals.shape
    for side in range(2):
        for j in range(turns):
            for k in range(lengths):
                here = arrivals[side, j, k]
                if not here < below or (n == len(places) and here >= places[n - 1, 0]):
                    continue
                if _has_lower(arrivals, side, j, k):
                    continue
                at = min(n, len(places) - 1)
                n = min(n + 1, len(places))
                while at > 0 and places[at - 1, 0] > here:
                    places[at] = places[at - 1]
                    at -= 1
                places[at, 0], places[at, 1], places[at, 2], places[at, 3] = here, side, j, k
    return n


@njit(cache=True, nogil=True)
def _has_lower(arrivals: FloatArray, side: int, j: int, k: int) -> bool:
    """Whether one of eight neighbours is lower; of equal ones only the first is lowest."""
    _, turns, lengths = arrivals.shape
    here = arrivals[side, j, k]
    for dj in range(-1, 2):
        for dk in range(-1, 2):
            other, at, along = side, j + dj, k + dk
            if at < 0:
                other, at = 1 - side, -at
            if at >= turns or not 0 <= along < lengths or (dj == 0 and dk == 0):
                continue
            there = arrivals[other, at, along]
            if there < here or (there == here and (dj < 0 or (dj == 0 and dk < 0))):
                return True
    return False


@njit(cache=True, nogil=True)
def descend(
    pose: Pose, t: float, pairs: FloatArray, size: float, others: Others, beat: float,
    known: float,
) -> float:  # fmt: skip
    """Follow a detour downward, until it touches or its arrival falls no more.

    Args:
        pose: where it begins.
        t: when [R/V_P].
        pairs: as in `close_detour`; takes the best found. shape (n, 3)
        size: first step [rad, R].
        others: what it keeps clear of.
        beat: what it arrives at, or infinite [R/V_P].
        known: another arrival; where steps have become too small to reach it, it ends [R/V_P].

    Returns:
        when the best arrives [R/V_P].
    """
    n = len(pairs)
    rows, trial, way = np.empty((MAX_ROWS, 5)), pairs.copy(), np.empty((n, 2))
    best, seed, tries, first = beat, 1, 0, size
    while size > _SMALLEST and tries < _MOST_TRIES and best - _STEEPEST * size < known:
        improved = False
        for attempt in range(2 * n * _DIRECTIONS):
            if attempt < 4 * n:
                # axes first
                way[:] = 0.0
                way[attempt // 4, (attempt // 2) % 2] = 1.0 - 2.0 * (attempt % 2)
            else:
                for k in range(n):
                    for m in range(2):
                        seed = (seed * 1_103_515_245 + 12_345) % 2_147_483_648
                        way[k, m] = 2.0 * seed / 2_147_483_648 - 1.0
            _move(pairs, way, size, trial)
            tries += 1
            arrival, _ = close_detour(pose, t, trial, others, best - 1e-7, rows)
            if arrival < best:
                best, improved = arrival, True
                pairs[:] = trial
                break
        if time_is_up(others.until):
            break
        size = min(size * _GROWTH, first) if improved else size * _SHRINK
    return best


@njit(cache=True, nogil=True)
def _move(pairs: FloatArray, way: FloatArray, size: float, trial: FloatArray) -> None:
    """Pairs moved some way; a turn through 0 is one to the other side."""
    for k in range(len(pairs)):
        trial[k, 0] = pairs[k, 0]
        trial[k, 1] = pairs[k, 1] + size * way[k, 0]
        trial[k, 2] = max(pairs[k, 2] + size * way[k, 1], 0.0)
        if trial[k, 1] < 0.0:
            trial[k, 0], trial[k, 1] = -trial[k, 0], -trial[k, 1]
