"""Chains of contacts: how they are flown, and how their bearings are moved until nothing is gained.

The arrival is smooth but for edges, where a word between two contacts ceases to exist or a piece
begins to break the limit. Bearings are moved one after another, by parabolas where the arrival is
smooth and by smaller steps at edges; then two together, along an edge.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise; a chain is as in `chain`.
"""

from math import inf
from typing import NamedTuple

import numpy as np
from numba import njit

from relguide.kernels.base.clock import time_is_up
from relguide.kernels.base.records import Contact, Pose, Scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.boundary_arc import boundary_arc_arrival
from relguide.kernels.contact.chain import (
    BOUNDARY_ARC,
    LEFT_TO_TOUCH,
    WORD,
    Chain,
    contact_by,
    with_contacts,
)
from relguide.kernels.contact.clear_words import best_word, word_clears
from relguide.kernels.contact.contact import contact_at, contact_exists
from relguide.kernels.contact.passing import words_onward
from relguide.kernels.contact.touch_straight import touch_straight
from relguide.kernels.words.extremals import ALL_WORDS

FINEST = 1e-7
"""Bearing steps end here: 1 mm at R = 12 km, 10 µs where the time has an edge."""
GAIN = 1e-8
"""Or where a parabola promises less than this [R/V_P]: 1 µs."""
_SWEEPS = 16  # over all bearings of a chain
_NEAR = 0.3  # values farther above the least say nothing about a minimum [R/V_P]
_BESIDE = 5e-3  # an edge is looked for this near to a contact [rad] …
_CLIFF = 2e-3  # … where to both sides together the arrival rises by more than this [R/V_P]
_NARROW = 1e-3  # it is followed in steps down to this [rad]
_ACROSS = 3  # places looked at on either side of a valley
_WHOLE = 0.99  # of a stride: that is a whole step, but for rounding
_MOST_WHOLE = 256  # whole steps one after another, before they are made longer


class Move(NamedTuple):
    """Which bearing of a chain is moved, and how."""

    k: int
    """Number of the contact."""
    last: int
    """The last link that depends on it; the arrival falls by as much as the end of that link."""
    stride: float
    """First step [rad]."""
    finest: float
    """Least step [rad]."""


@njit(cache=True, nogil=True)
def fly_links(
    pose: Pose, t: float, scene: Scene, chain: Chain, first: int, last: int, beat: float
) -> tuple[Pose, float]:
    """Fly some links of a chain: link k leads to contact k, and one more to the slot.

    Args:
        pose: where link `first` begins.
        t: when [R/V_P].
        scene: what the path has to reckon with.
        chain: its contacts; takes the legs, and the bearings at which straights touch.
        first: link to begin with.
        last: link to end with, at most n.
        beat: arrivals from here on do not matter [R/V_P].

    Returns:
        where the last link ends, and when; the time is infinite if it cannot be flown before
        `beat`, or the time for the search is up.
    """
    contacts, legs, rows = chain
    if time_is_up(scene.until):
        return pose, inf
    for k in range(first, min(last + 1, len(contacts))):
        side, bearing = contacts[k, 1], contacts[k, 2]
        legs[k, 0] = BOUNDARY_ARC if contacts[k, 3] == BOUNDARY_ARC else WORD
        if not contact_exists(bearing, scene.alpha):
            return pose, inf
        if contacts[k, 3] == BOUNDARY_ARC:
            begun = contacts[k - 1, 2]
            piece = int(contacts[k, 0])
            t = boundary_arc_arrival(scene, t, begun, bearing, side, piece)
            legs[k, 1], legs[k, 2], legs[k, 3], legs[k, 4] = side, begun, bearing, piece
            if t >= beat:
                return pose, inf
        else:
            t_start = t
            contact = Contact(int(contacts[k, 0]), bearing, side)
            onward = ALL_WORDS
            if k > 0:
                onward = words_onward(scene, contacts[k - 1, 2], contacts[k - 1, 1], t)
            if contacts[k, 3] >= LEFT_TO_TOUCH:
                turn = 1.0 if contacts[k, 3] == LEFT_TO_TOUCH else -1.0
                bearing, t = touch_straight(pose, t, scene, contact, turn, rows[0])
                at = 0 if t < beat and onward & (1 << int(rows[0, 1])) else -1
                if at < 0 or not word_clears(pose, t_start, rows[0], scene):
                    return pose, inf
                contacts[k, 2] = bearing
            else:
                link = contacts[k, 3]
                t, at = contact_by(pose, t, scene, contact, link, onward, beat, rows)
            if at < 0:
                return pose, inf
            legs[k, 1:6] = rows[at]
            legs[k, 1] = t - t_start
        pose = contact_at(scene, t, bearing, side)
    if last == len(contacts):
        legs[last, 0] = WORD
        t, at = best_word(pose, t, scene, beat, rows)
        if at >= 0:
            legs[last, 1:6] = rows[at]
    return pose, t


@njit(cache=True, nogil=True)
def refine_chain(
    start: Pose, scene: Scene, chain: Chain, here: float, stride: float, beat: float
) -> float:
    """The least arrival near a chain, whose bearings are moved.

    Args:
        start: where the path begins, at t = 0.
        scene: what it has to reckon with.
        chain: whose bearings are moved.
        here: its arrival so far [R/V_P].
        stride: how far is looked at first [rad].
        beat: it is given up where the last sweep gained less than what is missing to this [R/V_P].
    """
    contacts = chain.contacts
    strides = np.full(len(contacts), stride)
    finest = 0.1 * stride
    for _ in range(_SWEEPS):
        before = here
        for k in range(len(contacts)):
            if contacts[k, 3] >= LEFT_TO_TOUCH:
                continue
            at, t = fly_links(start, 0.0, scene, chain, 0, k - 1, inf)
            move = Move(k, _last_link_to_fly(scene, t, contacts, k, 1), strides[k], finest)
            here, strides[k] = move_bearing(at, t, scene, chain, move, here)
        gain = before - here
        if here - 2.0 * gain > beat or (gain < GAIN and finest == FINEST):
            break
        finest = max(0.1 * finest, FINEST)
    return here


@njit(cache=True, nogil=True)
def follow_edges(start: Pose, scene: Scene, chain: Chain, here: float, stride: float) -> float:
    """Move two bearings along an edge: where the word between two contacts ceases to exist.

    A chain often leaves the disc straight and comes back to it with nothing left to turn: just
    there its word ends, and neither bearing gets on alone. So one is moved, and for each of its
    places the other one's best is found. Arguments and result as `refine_chain`.
    """
    contacts = chain.contacts
    for k in range(len(contacts) - 1):
        if contacts[k + 1, 3] == BOUNDARY_ARC or contacts[k + 1, 3] >= LEFT_TO_TOUCH:
            continue
        if contacts[k, 3] >= LEFT_TO_TOUCH:
            continue
        at, t = fly_links(start, 0.0, scene, chain, 0, k - 1, inf)
        last = _last_link_to_fly(scene, t, contacts, k, 2)
        _, begun = fly_links(at, t, scene, chain, k, last, inf)
        if _has_edge(at, t, scene, chain, Move(k, last, _BESIDE, _BESIDE), begun):
            move = Move(k, last, stride, _NARROW)
            here -= begun - _follow_edge(at, t, scene, chain, move, begun)
    return here


@njit(cache=True, nogil=True)
def _has_edge(at: Pose, t: float, scene: Scene, chain: Chain, move: Move, begun: float) -> bool:
    """Whether the arrival has an edge close to the contact after one that would be moved."""
    tried = with_contacts(chain, chain.contacts.copy())
    after = move.k + 1
    rise = -2.0 * begun
    for direction in (-1.0, 1.0):
        tried.contacts[after, 2] = chain.contacts[after, 2] + direction * move.stride
        _, there = fly_links(at, t, scene, tried, move.k, move.last, inf)
        rise += there
    return rise > _CLIFF


@njit(cache=True, nogil=True)
def _follow_edge(at: Pose, t: float, scene: Scene, chain: Chain, move: Move, least: float) -> float:
    """Move a bearing and the next one together while the end of the last link falls; its least."""
    tried = with_contacts(chain, np.empty_like(chain.contacts))
    after, step = move.k + 1, move.stride
    while step > move.finest:
        moved = False
        for direction in (-1.0, 1.0):
            tried.contacts[:] = chain.contacts
            tried.contacts[move.k, 2] += direction * step
            found, to = inf, 0.0
            for j in range(-_ACROSS, _ACROSS + 1):
                tried.contacts[after, 2] = chain.contacts[after, 2] + 0.5 * step * j
                beat = min(found, least + _NEAR)
                _, there = fly_links(at, t, scene, tried, move.k, move.last, beat)
                if there < found:
                    found, to = there, tried.contacts[after, 2]
            if found == inf:
                continue
            tried.contacts[after, 2] = to
            between, then = fly_links(at, t, scene, tried, move.k, move.k, inf)
            fine = Move(after, move.last, 0.25 * step, 1e-3 * step)
            found, _ = move_bearing(between, then, scene, tried, fine, found)
            if found < least - GAIN:
                least, moved = found, True
                chain.contacts[:] = tried.contacts
                break
        if not moved:
            step *= 0.4
    return least


@njit(cache=True, nogil=True)
def _last_link_to_fly(scene: Scene, t: float, contacts: FloatArray, k: int, moved: int) -> int:
    """The last link that must be flown to compare chains alike but for contacts k … k + moved − 1.

    On the final leg nothing depends on time: past the next contact all stays as it is.
    """
    n = len(contacts)
    if t >= scene.t_release and contacts[k, 0] == len(scene.leader) - 1:
        last = min(k + moved, n)
        while last < n and contacts[last, 3] >= LEFT_TO_TOUCH:
            last += 1  # where a straight touches depends on the contact before
        return last
    return n


@njit(cache=True, nogil=True)
def simplify_chain(
    start: Pose, scene: Scene, chain: Chain, here: float, stride: float
) -> tuple[float, int]:
    """Leave out contacts without which a chain arrives as early, or earlier.

    Arguments as `refine_chain`; `chain` takes the shorter one. Returns its arrival and how many
    contacts it has.
    """
    contacts = len(chain.contacts)
    k = 0
    while k < contacts and contacts > 1:
        fewer = np.empty((contacts - 1, 4))
        fewer[:k] = chain.contacts[:k]
        fewer[k:] = chain.contacts[k + 1 : contacts]
        left_out = chain.contacts[k, 3]
        slides_on = k < contacts - 1 and fewer[k, 3] == BOUNDARY_ARC
        if slides_on and left_out != BOUNDARY_ARC:
            # the boundary arc that began at k is left out with it
            fewer[k, 3] = left_out if left_out < LEFT_TO_TOUCH else WORD
        shorter = with_contacts(chain, fewer)
        _, there = fly_links(start, 0.0, scene, shorter, 0, contacts - 1, here + _NEAR)
        if there < inf:
            there = refine_chain(start, scene, shorter, there, stride, here)
        if there <= here + GAIN:
            contacts -= 1
            here = there
            chain.contacts[:contacts] = fewer
            k = 0
        else:
            k += 1
    return here, contacts


@njit(cache=True, nogil=True)
def move_bearing(
    at: Pose, t: float, scene: Scene, chain: Chain, move: Move, arrival: float
) -> tuple[float, float]:
    """Move one bearing to where the arrival is least: by parabolas, or by smaller steps at edges.

    Where straights touch depends on where they are begun to be looked for. So that is kept as it
    was at the least arrival, which then is found again.

    Args:
        at: where the link to the contact begins.
        t: when [R/V_P].
        scene: what the path has to reckon with.
        chain: whose bearing is moved.
        move: which one, and how.
        arrival: of the chain so far [R/V_P].

    Returns:
        the arrival now, and a good first step for the next sweep.
    """
    contacts, k = chain.contacts, move.k
    stride, moved_by, whole = move.stride, 0.0, 0
    _, begun = fly_links(at, t, scene, chain, k, move.last, inf)
    here, best, tried = begun, contacts[:, 2].copy(), contacts[:, 2].copy()
    while stride >= move.finest and here < inf:
        bearing, tried[:] = best[k], best
        beat = here + _NEAR
        contacts[k, 2] = bearing - stride
        _, below = fly_links(at, t, scene, chain, k, move.last, beat)
        to, least, smooth = bearing, here, False
        if below < least:
            to, least = bearing - stride, below
            best[:] = contacts[:, 2]
        contacts[:, 2] = tried
        contacts[k, 2] = bearing + stride
        _, above = fly_links(at, t, scene, chain, k, move.last, beat)
        if above < least:
            to, least = bearing + stride, above
            best[:] = contacts[:, 2]
        shift, promised = vertex(below, here, above, stride)
        if promised > 0.0:
            contacts[:, 2] = tried
            contacts[k, 2] = bearing + shift
            _, found = fly_links(at, t, scene, chain, k, move.last, beat)
            smooth = abs(here - found - promised) <= 0.1 * promised + GAIN
            if found < least:
                to, least = bearing + shift, found
                best[:] = contacts[:, 2]
        contacts[:, 2] = best
        whole = whole + 1 if abs(to - bearing) > _WHOLE * stride else 0
        moved_by = max(moved_by, abs(to - bearing))
        here = least
        if smooth and promised < GAIN:
            break
        if smooth:
            stride *= 0.1
        elif whole > _MOST_WHOLE:
            stride *= 2.0
        elif abs(to - bearing) < stride:
            stride *= 0.4
    next_stride = max(2.0 * moved_by, move.finest)
    return (arrival - (begun - here) if here < inf else arrival), next_stride


@njit(cache=True, nogil=True)
def vertex(below: float, here: float, above: float, stride: float) -> tuple[float, float]:
    """The least point of the parabola through three values: how far it is, and what it promises.

    Both 0 where there is none within two strides.
    """
    bend = below - 2.0 * here + above
    if not 0.0 < bend < inf:
        return 0.0, 0.0
    shift = 0.5 * stride * (below - above) / bend
    if abs(shift) > 2.0 * stride:
        return 0.0, 0.0
    return shift, shift * shift * bend / (2.0 * stride * stride)
