"""Chains of contacts: paths to the slot that touch d = d_min several times, or slide along it.

A chain has a row for each contact: the leader's piece, the side, the bearing, and whether a word or
a boundary arc leads to it from the contact before (the leader may go on to its next pieces
meanwhile). Between contacts the path is the earliest extremal that keeps d_min, or the earliest of
one word, so the arrival is a function of the bearings alone.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import inf
from typing import NamedTuple

import numpy as np
from numba import njit

from relguide.kernels.base.records import Contact, Pose, Scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.clear_words import word_clears
from relguide.kernels.contact.passing import words_toward
from relguide.kernels.contact.paths_to_contact import paths_by_words
from relguide.kernels.words.extremals import MAX_ROWS, WORDS

WORD, BOUNDARY_ARC, DELAY = 0.0, 1.0, 2.0
"""How a contact is reached, or the slot: in the last case by a path of just the right length. Of a
leg to a contact that is not the slot its piece, side, bearing and time follow."""
NAMED = 3.0
"""And with a word's number in `extremals` more, how a contact is reached: by this word only. While
the leader turns, who is later at a contact than by the soonest word may be ahead of that."""
LEFT_TO_TOUCH, RIGHT_TO_TOUCH = 9.0, 10.0
"""Or by a turn and a straight that touches the disc: where, the contact before it decides."""
AGAIN = -1.0
"""Or, with a word's number less, by this word when it leads there for the second time; with as much
less as there are words for each time more. While the leader turns, a word may lead to a contact at
several times, and who has time to spare may come to it later."""
MAX_CONTACTS = 16
"""Longest chain."""
MAX_LEGS = MAX_CONTACTS + 1
"""Legs of the longest path."""
_THREE_TURNS, _APART = 16 + 32, 4  # LRL and RLR, as in `passing`, behind LSL and RSR


class Chain(NamedTuple):
    """A chain, and room to fly it."""

    contacts: FloatArray
    """Piece, side and bearing of each contact, and how it is reached. If by a straight that touches
    the disc the bearing is near the one that it comes to, which it takes. shape (n, 4)"""
    legs: FloatArray
    """Takes WORD and a row of `solve`, or BOUNDARY_ARC, side, first and last bearing and the
    leader's piece at its end, or DELAY, for each leg. shape (≥ n + 1, 6)"""
    rows: FloatArray
    """Room for words. shape (MAX_ROWS, 5)"""


@njit(cache=True, nogil=True)
def chain_of(contacts: FloatArray, legs: FloatArray) -> Chain:
    """A chain of these contacts that puts its legs there."""
    return Chain(contacts, legs, np.empty((MAX_ROWS, 5)))


@njit(cache=True, nogil=True)
def with_contacts(chain: Chain, contacts: FloatArray) -> Chain:
    """Other contacts, in the same room."""
    return Chain(contacts, chain.legs, chain.rows)


@njit(cache=True, nogil=True)
def earliest_contact(
    pose: Pose, t: float, scene: Scene, contact: Contact, words: int, earliest: float, beat: float,
    rows: FloatArray,
) -> tuple[float, int]:  # fmt: skip
    """The earliest arrival at a contact with d_min kept on the way, and its row.

    `words` are those that may lead on from the pose and to the contact, as in `passing`, and none
    arrives before `earliest`, as of `paths_by_words`. Infinite and −1 if none arrives before
    `beat`.
    """
    best, at = beat, -1
    # while the leader turns, words with the same outer turns are found together
    alike = words | (words & _THREE_TURNS) >> _APART
    n = paths_by_words(pose, t, scene, contact, alike, earliest, beat, rows)
    for k in range(n):
        asked = words & (1 << int(rows[k, 1]))
        if asked and rows[k, 0] < best and word_clears(pose, t, rows[k], scene):
            best, at = rows[k, 0], k
    return (best, at) if at >= 0 else (inf, -1)


@njit(cache=True, nogil=True)
def link_by(rows: FloatArray, k: int) -> float:
    """How a contact is reached by row k, of all words that lead to it: by which word, and when."""
    word, before = rows[k, 1], 0
    for row in rows:
        if row[1] == word and row[0] < rows[k, 0]:
            before += 1
    return float(NAMED + word if before == 0 else AGAIN - word - len(WORDS) * (before - 1))


@njit(cache=True, nogil=True)
def contact_by(
    pose: Pose, t: float, scene: Scene, contact: Contact, link: float, onward: int, beat: float,
    rows: FloatArray,
) -> tuple[float, int]:  # fmt: skip
    """As `earliest_contact`, by way of a link of `link_by` or by any word.

    `onward` are the words that may lead on from the pose.
    """
    words = onward & words_toward(scene, contact)
    if link == WORD or link >= NAMED:
        if link >= NAMED:
            words &= 1 << int(link - NAMED)
        return earliest_contact(pose, t, scene, contact, words, 0.0, beat, rows)
    word = int(AGAIN - link) % len(WORDS)
    words &= 1 << word
    alike = words | (words & _THREE_TURNS) >> _APART
    n = paths_by_words(pose, t, scene, contact, alike, 0.0, beat, rows)
    for k in range(n):
        asked = rows[k, 1] == word and link_by(rows[:n], k) == link
        if asked and rows[k, 0] < beat and word_clears(pose, t, rows[k], scene):
            return float(rows[k, 0]), k
    return inf, -1
