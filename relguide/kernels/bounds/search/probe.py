"""Paths through small cells of contacts: what branch and bound finds while it proves.

A path through the middle of a cell, or from the middle of one to that of another, by a word or a
boundary arc, is flown; if it arrives sooner than any known, it is refined. Slot frame: lengths in
R, times in R/V_P, angles counter-clockwise.
"""

from math import inf
from typing import NamedTuple

import numpy as np
from numba import njit

from relguide.kernels.base.angles import wrap, wrap_signed
from relguide.kernels.base.records import Contact, Pose, Scene, with_time
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.bounds.search.cell_tree import Problem, cell_at
from relguide.kernels.bounds.search.nodes import Search
from relguide.kernels.bounds.words.cells import Cell
from relguide.kernels.contact.best_chain import refine_chains
from relguide.kernels.contact.chain import (
    BOUNDARY_ARC,
    DELAY,
    MAX_CONTACTS,
    MAX_LEGS,
    NAMED,
    WORD,
    chain_of,
)
from relguide.kernels.contact.chain_refinement import fly_links
from relguide.kernels.contact.clear_delay import delay_until_contact
from relguide.kernels.contact.clear_words import best_word
from relguide.kernels.contact.constrained_search import ease_to_start, fly_to_delay
from relguide.kernels.contact.contact import boundary_arc_sense, contact_exists, contact_on, disc_on
from relguide.kernels.contact.kept_chains import no_chains
from relguide.kernels.contact.nodes import IntArray
from relguide.kernels.contact.one_contact import Workspace, descend, through_contact, workspace
from relguide.kernels.contact.passing import words_toward
from relguide.kernels.contact.paths_to_contact import paths_by_words
from relguide.kernels.separation.clearance import piece_at
from relguide.kernels.words.delay import DELAY_PIECES
from relguide.kernels.words.extremals import SIGNS

_SEEN = 4096  # so many probed cells are remembered
_STEPS = 24  # of the search beside such a contact
_MOST_DELAYS = 400  # cells from which a delay path is looked for, 0.3 ms each
PROBED = (0.06, 8e-3, 1e-3)
"""Cells are probed when their bearings differ by this, or down to half as much [rad]."""
_PROBES, _DELAYS, _EVERY = 64, 160, 512
"""So many of each size are made at once, and of those that look for a path that arrives just as the
slot opens; and one more for so many nodes looked at."""


class Find(NamedTuple):
    """The fastest path known."""

    scene: Scene
    """What it has to reckon with; it keeps the limit that the start keeps."""
    best: FloatArray
    """Its arrival [R/V_P] and the number of its legs; 0 if it is not one of these. shape (2,)"""
    legs: FloatArray
    """Its legs, as `chain.Chain`. shape (MAX_LEGS, 6)"""
    room: Workspace
    """To work in."""
    gain: float
    """A path must arrive so much sooner to be taken [R/V_P]."""
    at_release: bool
    """Whether paths are looked for that delay after their last contact and arrive as the slot
    opens, and none but those."""
    seen: IntArray
    """Which cells have been probed. shape (_SEEN + 1,), the last counts them"""


@njit(cache=True, nogil=True)
def begin_find(start: Pose, scene: Scene, time: float, gain: float, at_release: bool) -> Find:
    """Nothing is found yet that arrives before `time`."""
    best = np.zeros(2)
    best[0] = time
    met = with_time(ease_to_start(start, scene), inf)
    seen = np.zeros(_SEEN + 1, np.int64)
    return Find(met, best, np.zeros((MAX_LEGS, 6)), workspace(), gain, at_release, seen)


@njit(cache=True, nogil=True)
def _number(cell: Cell) -> int:
    """A number of the cell's piece, side and bearings, whatever its window of time."""
    return int((cell.bearing + 2.0 * cell.half + 4.0) * 1e6) * 64 + 2 * cell.piece + (cell.side > 0)


@njit(cache=True, nogil=True)
def _is_new(find: Find, number: int) -> bool:
    """Whether a cell has not been probed yet, as far as is remembered; it is now."""
    place = number % _SEEN
    if find.seen[place] == number or (find.at_release and find.seen[_SEEN] == _MOST_DELAYS):
        return False
    find.seen[place] = number
    find.seen[_SEEN] += 1
    return True


@njit(cache=True, nogil=True)
def probe(start: Pose, find: Find, cell: Cell) -> None:
    """Take a path through the middle bearing of a cell, refined, if it is faster than any known."""
    if not _is_new(find, _number(cell)):
        return
    incumbent = find.best[0] - find.gain
    if find.at_release:
        _probe_delay(start, find, _contacts_of(cell, cell)[:1])
        return
    contact, path = Contact(cell.piece, cell.bearing, cell.side), np.empty((2, 5))
    arrival = through_contact(start, find.scene, contact, incumbent, find.room)
    if arrival >= incumbent:
        return
    path[:] = find.room.path
    arrival = descend(start, find.scene, contact, arrival, cell.half, find.room, path)
    find.best[0], find.best[1] = arrival, 2.0
    find.legs[:2, 0], find.legs[:2, 1:6] = WORD, path


@njit(cache=True, nogil=True)
def probe_spare(start: Pose, find: Find, cell: Cell) -> None:
    """Take a path to a contact near the middle of a cell that has time to spare before it.

    It comes there by a delay path and goes on by the soonest word: so bearing and time are searched
    for the soonest arrival, in ever smaller steps.
    """
    if find.at_release or not _is_new(find, 31 * _number(cell) + int(1e5 * cell.start)):
        return
    bearing, t = cell.bearing, 0.5 * (cell.start + cell.end)
    step, moment = cell.half, 0.5 * (cell.end - cell.start)
    found = False
    for _ in range(_STEPS):
        better = False
        for k in range(5):
            # the middle itself once, then beside it in both, and sooner and later
            if k == 0 and found:
                continue
            along, later = step * ((k == 1) - (k == 2)), moment * ((k == 3) - (k == 4))
            if _take_spare(start, find, cell, bearing + along, t + later):
                bearing, t, better, found = bearing + along, t + later, True, True
        if not found:
            return
        if not better:
            step, moment = 0.5 * step, 0.5 * moment


@njit(cache=True, nogil=True)
def _take_spare(start: Pose, find: Find, cell: Cell, bearing: float, t: float) -> bool:
    """Take the path to a contact at a time with time to spare, if it is faster than any known."""
    scene, contact = find.scene, Contact(cell.piece, bearing, cell.side)
    if not contact_exists(bearing, scene.alpha) or piece_at(scene.leader, t) != cell.piece:
        return False
    there, rows = contact_on(scene, contact, t), find.room.rows
    arrival, k = best_word(there, t, scene, find.best[0] - find.gain, rows)
    if k < 0:
        return False
    pieces = np.empty((DELAY_PIECES, 2))
    if not delay_until_contact(start, 0.0, scene, there, t, pieces):
        return False
    find.best[0], find.best[1] = arrival, 2.0
    find.legs[0, 0], find.legs[0, 1], find.legs[0, 2] = DELAY, cell.piece, cell.side
    find.legs[0, 3], find.legs[0, 4] = bearing, t
    find.legs[1, 0], find.legs[1, 1:6] = WORD, rows[k]
    return True


@njit(cache=True, nogil=True)
def probe_between(start: Pose, find: Find, cell: Cell, other: Cell) -> None:
    """The same for a path from the middle of one cell to that of another."""
    if not _is_new(find, 31 * _number(cell) + _number(other)):
        return
    _probe_links(start, find, cell, other, cell.bearing, WORD)
    if len(find.scene.leader) == 1 or find.at_release:
        return
    # a path that is later at the first contact may be ahead; a word may end anywhere in the cell
    rows = find.room.rows
    for k in range(-1, 2):
        contact = Contact(cell.piece, cell.bearing + k * cell.half, cell.side)
        if not contact_exists(contact.bearing, find.scene.alpha):
            continue
        words = words_toward(find.scene, contact)
        n = paths_by_words(start, 0.0, find.scene, contact, words, 0.0, cell.end, rows)
        named = 0
        for j in range(n):
            if rows[j, 0] >= cell.start:
                named |= 1 << int(rows[j, 1])
        for word in range(len(SIGNS)):
            if named & (1 << word):
                _probe_links(start, find, cell, other, contact.bearing, NAMED + word)


@njit(cache=True, nogil=True)
def _probe_links(
    start: Pose, find: Find, cell: Cell, other: Cell, bearing: float, first: float
) -> None:
    """By a word and by boundary arcs, from a bearing of a cell that is reached in some way."""
    disc = disc_on(find.scene, cell.piece, cell.side)
    sense = boundary_arc_sense(bearing, disc)
    # as the leader begins or ends a turn the bearing may begin to move back
    sensitivity = (
        0.0,
        sense * wrap(sense * (other.bearing - bearing)),
        wrap_signed(other.bearing - bearing),
    )
    for k in range(3):
        contacts = _contacts_of(cell, other)
        contacts[0, 2], contacts[0, 3] = bearing, first
        if k > 0:
            if (
                cell.side != other.side
                or sense == 0.0
                or (k == 2 and sensitivity[2] == sensitivity[1])
            ):
                break
            contacts[1, 2], contacts[1, 3] = bearing + sensitivity[k], BOUNDARY_ARC
        if find.at_release:
            _probe_delay(start, find, contacts)
        else:
            _probe_chain(start, find, contacts, max(cell.half, other.half))


@njit(cache=True, nogil=True)
def _contacts_of(cell: Cell, other: Cell) -> FloatArray:
    """Contacts in the middle of two cells, with words to both, as in `chain.Chain`."""
    contacts = np.empty((2, 4))
    contacts[0, 0], contacts[0, 1], contacts[0, 2] = cell.piece, cell.side, cell.bearing
    contacts[1, 0], contacts[1, 1], contacts[1, 2] = other.piece, other.side, other.bearing
    contacts[:, 3] = WORD
    return contacts


@njit(cache=True, nogil=True)
def _probe_chain(start: Pose, find: Find, contacts: FloatArray, stride: float) -> None:
    """Take a path through two contacts, refined, if it is faster than any known."""
    incumbent = find.best[0] - find.gain
    chains = np.zeros((1, MAX_CONTACTS + 1, 4))
    chains[0, 0, 1], chains[0, 1:3] = 2.0, contacts
    chain = chain_of(contacts, np.zeros((MAX_LEGS, 6)))
    _, arrival = fly_links(start, 0.0, find.scene, chain, 0, 2, incumbent)
    if arrival < incumbent:
        time, count = refine_chains(
            start, find.scene, chains, stride, False, incumbent, find.legs, no_chains(0)
        )
        if count > 0:
            find.best[0], find.best[1] = time, count


@njit(cache=True, nogil=True)
def _probe_delay(start: Pose, find: Find, contacts: FloatArray) -> None:
    """Take a path through contacts, and a delay from the last one, that arrives at t_release."""
    chain = chain_of(contacts, np.zeros((MAX_LEGS, 6)))
    if find.best[1] == 0.0 and fly_to_delay(start, find.scene, chain):
        find.best[0], find.best[1] = find.scene.t_release, len(contacts) + 1.0
        find.legs[:] = chain.legs


@njit(cache=True, nogil=True)
def probe_node(search: Search, problem: Problem, find: Find, n: int, m: int) -> None:
    """Look for a path in a node that has become small."""
    half = max(search.first.cells[n, 3], search.last.cells[m, 3] if m >= 0 else 0.0)
    for k in range(len(PROBED)):
        if 0.5 * PROBED[k] < half <= PROBED[k]:
            most = _DELAYS if find.at_release else _PROBES
            if search.probes[k] >= most + search.size[1] // _EVERY:
                return
            search.probes[k] += 1
            cell = cell_at(search.first, n)
            if m < 0 and search.first.spare[n] and not find.at_release:
                probe_spare(problem.start, find, cell)
            elif m < 0:
                probe(problem.start, find, cell)
            else:
                probe_between(problem.start, find, cell, cell_at(search.last, m))
