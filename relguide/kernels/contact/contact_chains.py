"""Paths amid others by way of contacts with any of them, the most promising first.

A path that others bend touches them. Up to the first contact, between contacts and from the last
one on it is a word: to a contact with one of the others as to one with the leader, but in the frame
of that one, and to the slot as ever. So contacts are tried from the start, then from each contact
found, in the order of how soon the slot could be reached from there with nothing in the way: no
path by way of a contact is faster than that. The best chains are refined in their bearings.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import inf
from typing import NamedTuple

import numpy as np
from numba import njit

from relguide.kernels.base.angles import TWO_PI, wrap_signed
from relguide.kernels.base.clock import time_is_up
from relguide.kernels.base.records import Contact, Pose
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.contact import contact_at, contact_exists, contact_on
from relguide.kernels.contact.detours import scan_detours
from relguide.kernels.contact.nodes import BoolArray
from relguide.kernels.contact.others import (
    Others,
    counts_at,
    first_clear_of_all,
    is_disc,
    scene_with,
    word_broken_by,
    words_to_slot,
)
from relguide.kernels.contact.paths_to_contact import (
    earliest_arrival,
    not_before_slot,
    paths_to_contact,
)
from relguide.kernels.words.extremals import MAX_ROWS, SIGNS

MOST_CONTACTS = 3
"""Longest chain."""
_ROOM = 600  # contacts that are kept
_NEAR = 1e-3  # a contact so soon after another is the same [R/V_P]
_ALIKE_BEARING, _ALIKE_TIME = 0.25, 0.3  # contacts so near each other lead to the same places
_WORDS = 3  # of the words to a contact, so many that are clear are followed
_SMALLEST = 2e-4  # last step of a bearing [rad]
_DIRECTIONS = 4  # random ones, for each bearing that is moved


class Places(NamedTuple):
    """Contacts found, the start as the first, and how each was come to."""

    poses: FloatArray
    """x, y, heading, time, and no arrival at the slot from there is before this. shape (·, 5)"""
    contacts: FloatArray
    """Which of the others, its piece, bearing and side. shape (·, 4)"""
    words: FloatArray
    """As a row of `paths_to_contact`. shape (·, 5)"""
    parents: FloatArray
    """Number of the contact before it, how many there are before, and 1 once detours from it were
    scanned, 2 if it is like one from which they were. shape (·, 3)"""
    arrivals: FloatArray
    """At the slot straight from there, in place of which a detour may be: arrival, and sign, angle
    and straight of the detour. shape (·, 4)"""
    active: BoolArray
    """Those of the others that were in the way so far: contacts are looked for with them.
    shape (n,)"""
    followed: BoolArray
    """From which contact contacts with which of the others have been looked for. shape (·, n)"""
    used: FloatArray
    """How many there are; how many words were solved. shape (2,)"""


@njit(cache=True, nogil=True)
def no_places(start: Pose, bound: float, n: int) -> Places:
    """Nothing but the start, amid n others."""
    places = Places(
        np.zeros((_ROOM, 5)), np.zeros((_ROOM, 4)), np.zeros((_ROOM, 5)), np.zeros((_ROOM, 3)),
        np.full((_ROOM, 4), inf), np.zeros(n, np.bool_), np.zeros((_ROOM, n), np.bool_),
        np.zeros(2),
    )  # fmt: skip
    poses = places.poses
    poses[0, 0], poses[0, 1], poses[0, 2] = start
    poses[0, 4] = bound
    places.contacts[0, 0] = -1.0
    places.used[0] = 1.0
    return places


@njit(cache=True, nogil=True)
def follow_contacts(
    places: Places, others: Others, bearings: int, turns: int, straights: FloatArray, beat: float,
    margin: float, effort: float,
) -> float:  # fmt: skip
    """Follow the most promising contacts until no other could be sooner, or the effort is spent.

    Contacts are looked for only with those of the others that came in the way of a word so far.

    Args:
        places: with the start in it; takes all contacts found.
        others: what is kept clear of.
        bearings: so many round each of the others.
        turns: of the detours scanned from each contact, steps of a full turn.
        straights: of these detours, as in `scan_detours`.
        beat: an arrival already known [R/V_P].
        margin: so much later arrivals are put down as well [R/V_P].
        effort: how many words are solved at most.

    Returns:
        the first arrival found, or `beat`.
    """
    grid, rows = np.empty((2, turns + 1, len(straights))), np.empty((MAX_ROWS, 5))
    while places.used[1] < effort and not time_is_up(others.until):
        at = _most_promising(places, beat)
        if at < 0:
            break
        if places.parents[at, 2] == 0.0:
            places.parents[at, 2] = 1.0
            if _is_like_followed(places, at):
                continue
            _look_onward(places, at, others, beat, rows)
            if at > 0:
                beat = _scan_from(places, at, others, turns, straights, beat, margin, grid)
        for i in range(len(others.limits)):
            if places.active[i] and not places.followed[at, i]:
                places.followed[at, i] = True
                if places.parents[at, 1] < MOST_CONTACTS and is_disc(others, i):
                    beat = _follow(places, at, i, others, bearings, beat, margin)
    return beat


@njit(cache=True, nogil=True)
def _most_promising(places: Places, beat: float) -> int:
    """The contact with more to look for from which the slot might be reached soonest, or −1."""
    best, at = beat, -1
    for k in range(int(places.used[0])):
        if places.parents[k, 2] != 2.0 and places.poses[k, 4] < best and _has_more(places, k):
            best, at = places.poses[k, 4], k
    return at


@njit(cache=True, nogil=True)
def _has_more(places: Places, k: int) -> bool:
    if places.parents[k, 2] == 0.0:
        return True
    for i in range(len(places.active)):
        if places.active[i] and not places.followed[k, i]:
            return True
    return False


@njit(cache=True, nogil=True)
def _look_onward(
    places: Places, at: int, others: Others, beat: float, rows: FloatArray
) -> None:  # fmt: skip
    """Make those of the others active that are in the way of the fastest words from a contact."""
    pose, t = _pose_of(places, at), places.poses[at, 3]
    n = words_to_slot(pose, t, others, rows)
    for k in range(min(n, _WORDS)):
        if t + rows[k, 0] >= beat:
            break
        broken = word_broken_by(pose, t, rows[k], others)
        if broken < 0:
            break
        places.active[broken] = True


@njit(cache=True, nogil=True)
def _is_like_followed(places: Places, at: int) -> bool:
    """Whether a contact next to this one has been followed already."""
    for k in range(int(places.used[0])):
        if (
            k != at
            and places.parents[k, 2] == 1.0
            and places.parents[k, 1] == places.parents[at, 1]
            and places.contacts[k, 0] == places.contacts[at, 0]
            and places.contacts[k, 3] == places.contacts[at, 3]
            and abs(places.poses[k, 3] - places.poses[at, 3]) < _ALIKE_TIME
            and abs(wrap_signed(places.contacts[k, 2] - places.contacts[at, 2])) < _ALIKE_BEARING
        ):
            places.parents[at, 2] = 2.0
            return True
    return False


@njit(cache=True, nogil=True)
def _pose_of(places: Places, at: int) -> Pose:
    x, y, h, _, _ = places.poses[at]
    return Pose(x, y, h)


@njit(cache=True, nogil=True)
def _scan_from(
    places: Places, at: int, others: Others, turns: int, straights: FloatArray, beat: float,
    margin: float, grid: FloatArray,
) -> float:  # fmt: skip
    """Scan detours from a contact; the best is put down in place of the word straight from it."""
    pose, t = _pose_of(places, at), places.poses[at, 3]
    found = scan_detours(pose, t, turns, straights, others, beat, margin, grid)
    places.used[1] += 0.25 * grid.size
    best = places.arrivals[at, 0]
    for side in range(2):
        for j in range(turns + 1):
            for k in range(len(straights)):
                if grid[side, j, k] < best - _NEAR:
                    best = grid[side, j, k]
                    places.arrivals[at, 0], places.arrivals[at, 1] = best, 1.0 - 2.0 * side
                    places.arrivals[at, 2] = TWO_PI * j / turns
                    places.arrivals[at, 3] = straights[k]
    return found


@njit(cache=True, nogil=True)
def _follow(
    places: Places, at: int, i: int, others: Others, bearings: int, beat: float, margin: float
) -> float:
    """All contacts with one of the others that words lead to, if the slot may be reached in time.

    What is in the way of the fastest word to one of them becomes active.
    """
    pose, t = _pose_of(places, at), places.poses[at, 3]
    rows, onward = np.empty((MAX_ROWS, 5)), np.empty((MAX_ROWS, 5))
    scene, to_slot = scene_with(others, i), scene_with(others, 0)
    for piece in range(len(scene.leader)):
        for k in range(2 * bearings):
            contact = Contact(piece, TWO_PI * (k // 2) / bearings, 1.0 - 2.0 * (k % 2))
            if not contact_exists(contact.bearing, scene.alpha):
                continue
            first = earliest_arrival(pose, t, scene, contact, beat)
            if first >= beat:
                continue
            # a contact that is no faster than the pursuer is never nearer to the slot later
            if scene.leader[piece, 4] == 0.0 and scene.alpha <= 1.0:
                there = contact_on(scene, contact, first)
                if not_before_slot(there, first, to_slot) >= beat:
                    continue
            n = paths_to_contact(pose, t, scene, contact, beat, rows)
            places.used[1] += 1.0
            clear, tried = 0, 0
            for r in range(n):
                time = rows[r, 0]
                if time < t + _NEAR or not counts_at(others, i, time):
                    continue
                if time >= beat or clear >= _WORDS:
                    break
                there = contact_at(scene, time, contact.bearing, contact.side)
                m = words_to_slot(there, time, others, onward)
                places.used[1] += 1.0
                if m == 0 or time + onward[0, 0] >= beat:
                    continue
                broken = word_broken_by(pose, t, rows[r], others)
                tried += 1
                if broken >= 0:
                    if tried == 1:
                        places.active[broken] = True
                    continue
                clear += 1
                bound, until = time + onward[0, 0], beat + margin
                arrival, _ = first_clear_of_all(there, time, onward[:m], others, until)
                beat = min(beat, arrival)
                _put(places, at, i, contact, rows[r], there, bound, arrival)
    return beat


@njit(cache=True, nogil=True)
def _put(
    places: Places, parent: int, i: int, contact: Contact, row: FloatArray, there: Pose,
    bound: float, arrival: float,
) -> None:  # fmt: skip
    """Put down a contact; where there is no room, in place of the least promising."""
    n = int(places.used[0])
    if n < _ROOM:
        places.used[0] += 1.0
    else:
        n = -1
        worst = bound
        for k in range(1, _ROOM):
            if places.parents[k, 2] != 1.0 and places.poses[k, 4] > worst:
                worst, n = places.poses[k, 4], k
        if n < 0:
            return
    places.poses[n, 0], places.poses[n, 1], places.poses[n, 2] = there
    places.poses[n, 3], places.poses[n, 4] = row[0], bound
    places.contacts[n, 0], places.contacts[n, 1] = i, contact.piece
    places.contacts[n, 2], places.contacts[n, 3] = contact.bearing, contact.side
    places.words[n] = row
    places.parents[n, 0], places.parents[n, 1] = parent, places.parents[parent, 1] + 1.0
    places.parents[n, 2] = 0.0
    places.followed[n] = False
    places.arrivals[n, 0], places.arrivals[n, 1] = arrival, 1.0
    places.arrivals[n, 2], places.arrivals[n, 3] = 0.0, 0.0


@njit(cache=True, nogil=True)
def pairs_by_way_of(places: Places, at: int, pairs: FloatArray) -> int:
    """The (turn, straight) pairs that lead to a contact and the detour from there: how many.

    Args:
        places: that are known.
        at: number of the contact.
        pairs: takes them. shape (≥ 3·`MOST_CONTACTS` + 1, 3)
    """
    chain = np.empty(MOST_CONTACTS, np.int64)
    m, k = 0, at
    while k > 0:
        chain[m] = k
        m, k = m + 1, int(places.parents[k, 0])
    n = 0
    for c in range(m - 1, -1, -1):
        n = add_word(pairs, n, places.words[chain[c]])
    _, sign, turned, straight = places.arrivals[at]
    return add_piece(pairs, add_piece(pairs, n, sign, turned), 0.0, straight)


@njit(cache=True, nogil=True)
def add_word(pairs: FloatArray, n: int, row: FloatArray) -> int:
    """Add the pieces of a row of `solve` to pairs; how many pairs there are then."""
    for k in range(3):
        n = add_piece(pairs, n, SIGNS[int(row[1]), k], row[2 + k])
    return n


@njit(cache=True, nogil=True)
def add_piece(pairs: FloatArray, n: int, sign: float, amount: float) -> int:
    """Add a piece to pairs of turn and straight; pieces alike that follow each other are one."""
    if amount <= 1e-12:
        return n
    if sign == 0.0:
        if n == 0:
            pairs[0, 0], pairs[0, 1], pairs[0, 2] = 1.0, 0.0, 0.0
            n = 1
        pairs[n - 1, 2] += amount
        return n
    if n > 0 and pairs[n - 1, 2] == 0.0 and pairs[n - 1, 0] == sign:
        pairs[n - 1, 1] += amount
        return n
    pairs[n, 0], pairs[n, 1], pairs[n, 2] = sign, amount, 0.0
    return n + 1
