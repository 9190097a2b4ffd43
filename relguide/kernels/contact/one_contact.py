"""Paths through one contact with d = d_min: the disc is scanned, and its best bearings refined.

A path that the limit bends touches the forbidden disc. Up to a contact and from it on it is an
extremal without the limit, and the state at the contact is fixed by its bearing, for each piece of
the leader's intent and each side. So the arrival is a function of that bearing, searched on a grid
first and then downward.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import inf
from typing import NamedTuple

import numpy as np
from numba import njit

from relguide.kernels.base.angles import wrap_signed
from relguide.kernels.base.clock import time_is_up
from relguide.kernels.base.records import Contact, Pose, Scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.chain import link_by
from relguide.kernels.contact.chain_refinement import FINEST, GAIN, vertex
from relguide.kernels.contact.clear_words import first_clear, to_slot_frame, word_clears
from relguide.kernels.contact.contact import (
    contact_at,
    contact_exists,
    contact_on,
    slides_back,
)
from relguide.kernels.contact.nodes import BoolArray, Nodes, contact_of, neighbours
from relguide.kernels.contact.passing import words_toward
from relguide.kernels.contact.paths_to_contact import (
    earliest_arrival,
    not_before_slot,
    paths_by_words,
)
from relguide.kernels.words.extremals import MAX_ROWS, solve
from relguide.kernels.words.fastest import may_arrive_before
from relguide.kernels.words.sooner import Scratch, make_scratch

_BASINS = 8  # refined: the best of them wins in every reference case; the rest is insurance
_HIDDEN = 0.14  # how much a basin may fall below what the scan sees of it [R/V_P]
_JUMP = 2e-3  # what is less may be a bend [R/V_P]: 0.1 s
_ALMOST = 0.3  # a word that turns less at its end than this ends almost straight [rad]
_AT_RELEASE = 1e-6  # what arrives so soon after t_release is not bettered [R/V_P]: 50 µs
_HALVINGS = 10  # of the bearings between a node and a neighbour without an arrival: to 0.005°


class Workspace(NamedTuple):
    """Room for `through_contact`, and what it finds."""

    rows: FloatArray
    """Words to the contact. shape (MAX_ROWS, 5)"""
    onward: FloatArray
    """Words from there to the slot. shape (MAX_ROWS, 5)"""
    path: FloatArray
    """Takes the two rows of the path found. shape (2, 5)"""
    reached: FloatArray
    """Takes the earliest time at which the contact is reached with the limit kept, and a lower
    bound of the arrival from there; infinite if that is too late. Then the last time from which the
    slot could be reached as it opens, or 0. shape (3,)"""
    ahead: FloatArray
    """Where the leader turns faster than one slides along the disc, who is later at a contact is
    ahead of who was there before; and elsewhere who had time to spare may spend it before. Takes
    when it is reached last, there by a word that ends almost straight, as before a boundary arc, if
    there is one; a lower bound of the arrival from there; and by which word, as `chain.link_by`.
    Infinite if it is not reached later than first. shape (3,)"""
    scratch: Scratch
    """Room for `may_arrive_before`."""


@njit(cache=True, nogil=True)
def workspace() -> Workspace:
    """Room, empty."""
    return Workspace(
        np.empty((MAX_ROWS, 5)), np.empty((MAX_ROWS, 5)), np.empty((2, 5)), np.empty(3),
        np.empty(3), make_scratch(),
    )  # fmt: skip


@njit(cache=True, nogil=True)
def scan_contacts(
    start: Pose, scene: Scene, nodes: Nodes, fresh: BoolArray, beat: float, path: FloatArray
) -> float:
    """The fastest path through one of many contacts, those that may be reached soonest first.

    Args:
        start: where the path begins, at t = 0.
        scene: what it has to reckon with.
        nodes: the contacts; takes what is found of each.
        fresh: which are looked at. shape (n,)
        beat: an arrival already known [R/V_P].
        path: takes the two rows of the fastest path. shape (2, 5)

    Returns:
        its arrival [R/V_P]; `beat` if none is earlier.
    """
    room = workspace()
    soonest = _soonest_arrivals(start, scene, nodes, fresh)
    best = beat
    for n in np.argsort(soonest):
        if soonest[n] >= best + _HIDDEN or time_is_up(scene.until):
            break
        arrival = through_contact(start, scene, contact_of(nodes, n), best + _HIDDEN, room)
        nodes.time[n], nodes.lower[n], nodes.latest[n] = room.reached
        nodes.ahead[n] = room.ahead
        nodes.arrival[n] = arrival if arrival < best + _HIDDEN else inf
        if arrival < best:
            best = arrival
            path[:] = room.path
    return best


@njit(cache=True, nogil=True)
def _soonest_arrivals(start: Pose, scene: Scene, nodes: Nodes, fresh: BoolArray) -> FloatArray:
    """No path through a contact that is looked at is at the slot before its time here [R/V_P].

    shape (n,)
    """
    count = len(nodes.bearings)
    soonest = np.full(count, inf)
    for n in range(count):
        contact = contact_of(nodes, n)
        if fresh[n] and contact_exists(contact.bearing, scene.alpha):
            t = earliest_arrival(start, 0.0, scene, contact, inf)
            soonest[n] = max(t, scene.t_release)
            if contact.piece + 1 == len(scene.leader):
                # on the final leg the contact keeps its place from the slot
                there = contact_at(scene, t, contact.bearing, contact.side)
                soonest[n] = not_before_slot(there, t, scene)
    return soonest


@njit(cache=True, nogil=True)
def descend_basins(
    start: Pose, scene: Scene, nodes: Nodes, fresh: BoolArray, width: float, best: float,
    path: FloatArray,
) -> float:  # fmt: skip
    """From the least arrivals that a scan has seen, downward between its bearings.

    Args:
        start: where the path begins, at t = 0.
        scene: what it has to reckon with.
        nodes: the contacts, from `scan_contacts`.
        fresh: which have been looked at since this was last done. shape (n,)
        width: from one bearing of the grid to the next [rad].
        best: the least arrival so far [R/V_P].
        path: takes the two rows of a faster path. shape (2, 5)

    Returns:
        the least arrival [R/V_P].
    """
    room, nearby, enough = workspace(), np.empty((2, 5)), scene.t_release + _AT_RELEASE
    taken = np.zeros(len(nodes.bearings))
    for n in range(len(taken)):
        before, after = neighbours(nodes, n)
        if not (fresh[n] or fresh[before] or fresh[after]):
            taken[n] = 1.0
    for _ in range(_BASINS):
        at = _lowest_basin(nodes, taken)
        if at < 0 or best <= enough:
            break
        taken[at] = 1.0
        here, contact = nodes.arrival[at], contact_of(nodes, at)
        if here > best and here - _hidden_below(nodes, at, width) >= best:
            continue
        least = descend(start, scene, contact, here, 0.5 * width, room, nearby)
        if least < best:
            best = least
            path[:] = nearby
    # while the leader turns windows are narrow: it may fall towards the end of one
    if len(scene.leader) > 1:
        for n in range(len(nodes.bearings)):
            if best <= enough:
                break
            for beside in neighbours(nodes, n):
                if (
                    nodes.arrival[n] < inf
                    and nodes.arrival[beside] == inf
                    and (fresh[n] or fresh[beside])
                ):
                    away = wrap_signed(nodes.bearings[beside] - nodes.bearings[n])
                    contact = contact_of(nodes, n)
                    stride = 0.25 * width
                    best = _descend_edge(start, scene, contact, away, stride, best, room, path)
                elif (fresh[n] or fresh[beside]) and _falls_to_jump(nodes, n, beside, best):
                    here, contact = nodes.arrival[n], contact_of(nodes, n)
                    least = descend(start, scene, contact, here, 0.25 * width, room, nearby)
                    if least < best:
                        best = least
                        path[:] = nearby
    return best


@njit(cache=True, nogil=True)
def _falls_to_jump(nodes: Nodes, n: int, ahead: int, best: float) -> bool:
    """Whether the arrival seems to fall from a node below the best, and to jump before the next.

    There one word ends that was sooner than the other: what is ahead lies above the line through
    the node and the one behind, and bends down.
    """
    before, after = neighbours(nodes, n)
    behind = before if ahead == after else after
    before, after = neighbours(nodes, ahead)
    beyond = after if before == n else before
    arrival = nodes.arrival
    here, there = arrival[n], arrival[ahead]
    if not (arrival[behind] < inf and here < inf and there < inf and arrival[beyond] < inf):
        return False
    straight_on = 2.0 * here - arrival[behind]
    bend = here - 2.0 * there + arrival[beyond]
    return bool(straight_on < min(best, there - _JUMP) and bend < 0.0)


@njit(cache=True, nogil=True)
def _lowest_basin(nodes: Nodes, taken: FloatArray) -> int:
    """The node of least arrival, not taken yet, whose neighbours are no lower; −1 if none is."""
    at, arrival = -1, nodes.arrival
    for n in range(len(arrival)):
        if arrival[n] < inf and taken[n] == 0.0 and (at < 0 or arrival[n] < arrival[at]):
            before, after = neighbours(nodes, n)
            if arrival[n] <= arrival[after] and arrival[n] <= arrival[before]:
                at = n
    return at


@njit(cache=True, nogil=True)
def _hidden_below(nodes: Nodes, at: int, width: float) -> float:
    """How much lower it may be between a node and its neighbours.

    What a parabola says, or the rise to them where an edge may hide more.
    """
    before, after = neighbours(nodes, at)
    arrival = nodes.arrival
    _, promised = vertex(arrival[before], arrival[at], arrival[after], width)
    rise = max(arrival[after], arrival[before]) - arrival[at]
    return 1.5 * promised + 0.01 if promised > 0.0 else min(rise, _HIDDEN)


@njit(cache=True, nogil=True)
def _descend_edge(
    start: Pose, scene: Scene, contact: Contact, away: float, stride: float, best: float,
    room: Workspace, path: FloatArray,
) -> float:  # fmt: skip
    """The least arrival between a contact and a bearing with none, so far away: best or less.

    The edge is bisected, and the least arrival seen on the way descended from.
    """
    piece, inside, side = contact
    outside = inside + away
    least, there, nearby = inf, inside, np.empty((2, 5))
    for _ in range(_HALVINGS):
        bearing, beat = 0.5 * (inside + outside), best + _HIDDEN
        value = through_contact(start, scene, Contact(piece, bearing, side), beat, room)
        if value >= beat:
            outside = bearing
            continue
        inside = bearing
        if value < least:
            least, there = value, bearing
            nearby[:] = room.path
    if least < inf:
        least = descend(start, scene, Contact(piece, there, side), least, stride, room, nearby)
    if least < best:
        best = least
        path[:] = nearby
    return best


@njit(cache=True, nogil=True)
def descend(
    start: Pose, scene: Scene, contact: Contact, here: float, stride: float, room: Workspace,
    path: FloatArray,
) -> float:  # fmt: skip
    """The least arrival near a contact whose own is `here`; `path` takes the path if it is less.

    Args:
        start: where the path begins, at t = 0.
        scene: what it has to reckon with.
        contact: where it begins to look.
        here: the arrival through that [R/V_P].
        stride: how far is looked at first [rad].
        room: to work in.
        path: takes the two rows of a faster path. shape (2, 5)
    """
    piece, bearing, side = contact
    while stride > FINEST:
        moved = False
        values = (inf, inf)
        for direction in range(2):
            there = bearing + stride * (2.0 * direction - 1.0)
            found = through_contact(start, scene, Contact(piece, there, side), here + 0.2, room)
            values = (values[1], found)
            if found < here:
                here, bearing, moved = found, there, True
                path[:] = room.path
                break
        if moved:
            continue
        shift, promised = vertex(values[0], here, values[1], stride)
        if promised == 0.0:
            stride *= 0.4
            continue
        there = bearing + shift
        found = through_contact(start, scene, Contact(piece, there, side), here, room)
        smooth = abs(here - found - promised) <= 0.1 * promised + GAIN
        if found < here:
            here, bearing = found, there
            path[:] = room.path
        if smooth and promised < GAIN:
            break
        stride *= 0.1 if smooth else 0.4
    return here


@njit(cache=True, nogil=True)
def through_contact(
    start: Pose, scene: Scene, contact: Contact, beat: float, room: Workspace
) -> float:
    """Arrival by the fastest path through one contact that keeps d_min, if it is before `beat`.

    Args:
        start: where the path begins, at t = 0.
        scene: what it has to reckon with.
        contact: that it goes through.
        beat: arrivals from here on do not matter [R/V_P].
        room: to work in; takes the path, and when it is at the contact.

    Returns:
        arrival time; infinite if there is no contact, `beat` if no path arrives before, or the
        time for the search is up.
    """
    reached, onward, ahead = room.reached, room.onward, room.ahead
    reached[:2], reached[2] = inf, 0.0
    ahead[:] = inf
    if not contact_exists(contact.bearing, scene.alpha):
        return inf
    if time_is_up(scene.until):
        return beat
    final = contact.piece + 1 == len(scene.leader)
    if final:
        # the cheapest test of all: not even if nothing had to be turned on the way there?
        t = earliest_arrival(start, 0.0, scene, contact, inf)
        there = to_slot_frame(contact_on(scene, contact, t), t, scene.alpha)
        if not may_arrive_before(there, scene.alpha, beat - t, room.scratch):
            return beat
    words = words_toward(scene, contact)
    n = paths_by_words(start, 0.0, scene, contact, words, 0.0, beat, room.rows)
    m, back, last = -1, slides_back(scene, contact), (0.0, 0.0, 0.0)
    for k in range(n):
        t = room.rows[k, 0]
        if t >= beat:
            continue
        there = contact_on(scene, contact, t)
        if not_before_slot(there, t, scene) >= beat:
            continue
        if m < 0 or not final:
            # the cheap tests first: could it be in time at all?
            seen = to_slot_frame(there, t, scene.alpha)
            if not may_arrive_before(seen, scene.alpha, beat - t, room.scratch):
                continue
            if not word_clears(start, 0.0, room.rows[k], scene):
                continue
            # on the final leg the paths on are the same at any time
            m = solve(seen, scene.alpha, 0.0, onward)
        elif m == 0 or t + onward[0, 0] >= beat or not word_clears(start, 0.0, room.rows[k], scene):
            continue
        if m == 0:
            continue
        # what is too early may be delayed
        lower = max(t + onward[0, 0], scene.t_release)
        if lower >= beat:
            continue
        if t < reached[0]:
            reached[0], reached[1] = t, lower
        if back and room.rows[k, 4] < _ALMOST and (t > ahead[0] or ahead[0] == inf):
            ahead[0], ahead[1], ahead[2] = t, lower, link_by(room.rows[:n], k)
        if t > last[0]:
            last = (t, lower, link_by(room.rows[:n], k))
        if lower == scene.t_release:
            reached[2] = max(reached[2], t)
        arrival, j = first_clear(there, t, onward[:m], scene, beat)
        if j >= 0:
            beat = arrival
            room.path[0] = room.rows[k]
            room.path[1] = onward[j]
    if ahead[0] <= reached[0] or ahead[0] == inf:
        ahead[:] = inf
        if last[0] > reached[0]:
            ahead[0], ahead[1], ahead[2] = last
    return beat
