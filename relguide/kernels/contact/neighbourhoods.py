"""Chains beside a refined one, round a leader that turns: whatever is sooner takes its place.

The arrival of a chain has a cliff where a turn between two contacts would have to be less than
none, since it is a full one there. The least arrival often lies at the foot of one cliff, or of
two, and they move with the time at which the contacts are reached. So bearings that are moved one
after another get stuck. Four moves change more than a bearing, and refine the chain again:

- `add_boundary_arcs` begins a boundary arc after each contact, or puts one in place of each hop
  along one side: a graph of contacts often hops where it would better slide, since its arcs begin
  and end at nodes of the grid.
- `take_other_words` comes to a contact, or to one beside it, by another word than the soonest, and
  leaves out contacts before it: a path that comes to a contact later may be ahead there.
- `slide_from_touches` flies straight until the path touches the disc, slides on from there, and
  goes on at any later contact. The straight leaves the start, a contact, or a boundary arc.
- `search_nearby` begins the chain again a few degrees away: with one bearing or two moved, with a
  contact on the leader's piece before or after, with another word, or with a straight that touches
  behind a contact.

All take a chain and its arrival, and return those of the best. Chains that were refined but were
not the best are kept as well (`keep_chain`): begun again, one of them may be. Slot frame: lengths
in R, times in R/V_P, angles counter-clockwise; a chain is as in `chain`.
"""

from math import inf
from typing import NamedTuple

import numpy as np
from numba import njit

from relguide.kernels.base.angles import TWO_PI, wrap_signed
from relguide.kernels.base.clock import time_is_up
from relguide.kernels.base.records import Contact, Pose, Scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.chain import (
    BOUNDARY_ARC,
    LEFT_TO_TOUCH,
    MAX_CONTACTS,
    NAMED,
    RIGHT_TO_TOUCH,
    Chain,
    chain_of,
    link_by,
)
from relguide.kernels.contact.chain_refinement import (
    Move,
    fly_links,
    move_bearing,
    refine_chain,
)
from relguide.kernels.contact.clear_words import word_clears
from relguide.kernels.contact.contact import (
    boundary_arc_rates,
    boundary_arc_sense,
    contact_at,
    contact_exists,
    disc_on,
    slide_within,
)
from relguide.kernels.contact.nodes import IntArray
from relguide.kernels.contact.paths_to_contact import not_before_slot, paths_to_contact
from relguide.kernels.contact.tangent import MAX_TANGENTS, straight_touches
from relguide.kernels.separation.clearance import piece_at, piece_end
from relguide.kernels.words.extremals import MAX_ROWS, WORDS

_WORTH = 1e-4  # how much sooner a chain has to be [R/V_P]: 5 ms
_LATER = 0.3  # a chain that is so much later at first is not refined [R/V_P] …
_LATE = 0.1  # … nor one that is so much later with the bearings beside the change moved [R/V_P] …
_STILL_LATER = 0.03  # … nor one that is so much later once it has been moved roughly [R/V_P]
_ARC_ROUNDS, _TOUCH_ROUNDS, _NEARBY_ROUNDS = 4, 3, 2  # so many changes of each kind at most
_SHORT, _LONG = 0.05, 0.5  # boundary arcs as they are begun [rad]
_MOMENT = 1e-3  # so soon a path has not left [R/V_P]
_BY_WORDS = (-0.5, -0.2, 0.0, 0.2, 0.5)  # how far beside a contact words lead [rad]
_STEP = 0.2  # from one end of a new boundary arc to the next, in time [R/V_P]
_APART = 0.4  # from one place where a boundary arc is left to the next, in time [R/V_P]
_MOST = 40  # places along a boundary arc
_SWEEPS = 4  # over all bearings, roughly
_LITTLE = 1e-3  # ends them [R/V_P]
_NO_LATER = 1e-6  # so much may be lost if there is one bearing less to be moved [R/V_P]: 50 µs
_TOWARD_START, _TOWARD_END = 0, 8  # changes of the piece
_SLIDING = 7  # and a boundary arc over a contact
_MOVED = (0, 1, 1, 2, 2, 1, 1, 0, 0, 1, 1, 2, 2)  # how many bearings the others move,
_BY = (0.0, -0.1, 0.1, -0.1, 0.1, -0.35, 0.35, 0.0, 0.0, -0.2, 0.2, -0.2, 0.2)  # how far [rad]
_BESIDE = (0.0, -0.1, 0.1, -0.2, 0.2)  # where a straight is begun that touches the disc [rad]
_BY_WORD = len(_MOVED)  # and, one for each word, that this one leads to it
_CHANGES = _BY_WORD + len(WORDS)


class Task(NamedTuple):
    """What chains are flown for, and how they are refined."""

    start: Pose
    """Where they begin, at t = 0."""
    scene: Scene
    """What they have to reckon with."""
    stride: float
    """How far bearings are moved at first [rad]."""
    legs: FloatArray
    """Room. shape (MAX_LEGS, 6)"""


@njit(cache=True, nogil=True)
def add_boundary_arcs(
    task: Task, contacts: FloatArray, count: int, here: float
) -> tuple[float, int]:
    """Put boundary arcs into a chain as long as it is sooner by it.

    Args:
        task: what it is flown for.
        contacts: of the chain; takes those of a sooner one. shape (MAX_CONTACTS, 4)
        count: how many they are.
        here: its arrival [R/V_P].

    Returns:
        the arrival then [R/V_P], and how many contacts there are.
    """
    for _ in range(_ARC_ROUNDS):
        found, n = _with_one_more_arc(task, contacts, count, here)
        if n == 0:
            break
        here, count = found, n
    return here, count


@njit(cache=True, nogil=True)
def _with_one_more_arc(
    task: Task, contacts: FloatArray, count: int, here: float
) -> tuple[float, int]:
    """As `add_boundary_arcs`, the best with one more; 0 contacts if none is sooner."""
    scene, legs = task.scene, task.legs
    best, n, won = here, 0, np.empty((MAX_CONTACTS, 4))
    for k in range(count):
        slides_on = k + 1 < count and contacts[k + 1, 3] == BOUNDARY_ARC
        if k + 1 < count and not slides_on and contacts[k, 1] == contacts[k + 1, 1]:
            tried = contacts[:count].copy()
            tried[k + 1, 3] = BOUNDARY_ARC
            time = _with_arc(task, chain_of(tried, legs), k + 1, best)
            if time < best - _WORTH:
                best, n = time, count
                won[:count] = tried
        if slides_on or count == MAX_CONTACTS:
            continue
        piece = int(contacts[k, 0])
        for on in range(piece, min(piece + 2, len(scene.leader))):
            sense = boundary_arc_sense(contacts[k, 2], disc_on(scene, on, contacts[k, 1]))
            for angle in (_SHORT, _LONG):
                if sense == 0.0 or time_is_up(scene.until):
                    break
                tried = np.empty((count + 1, 4))
                tried[: k + 1], tried[k + 2 :] = contacts[: k + 1], contacts[k + 1 : count]
                tried[k + 1, 0], tried[k + 1, 1] = on, contacts[k, 1]
                tried[k + 1, 2], tried[k + 1, 3] = contacts[k, 2] + sense * angle, BOUNDARY_ARC
                time = _with_arc(task, chain_of(tried, legs), k + 1, best)
                if time < best - _WORTH:
                    best, n = time, count + 1
                    won[: count + 1] = tried
    if n > 0:
        contacts[:n] = won[:n]
    return best, n


@njit(cache=True, nogil=True)
def _with_arc(task: Task, chain: Chain, k: int, beat: float) -> float:
    """The arrival of a chain once its bearings have been moved, that of the arc's end k first.

    Infinite if it is far later, or still later with this one moved.
    """
    start, scene, stride, _ = task
    last = len(chain.contacts)
    at, t = fly_links(start, 0.0, scene, chain, 0, k - 1, inf)
    _, here = fly_links(at, t, scene, chain, k, last, beat + _LATER)
    if here == inf:
        return inf
    here, _ = move_bearing(at, t, scene, chain, Move(k, last, stride, 0.1 * stride), here)
    if here > beat + _STILL_LATER:
        return inf
    return refine_chain(start, scene, chain, here, stride, beat)


@njit(cache=True, nogil=True)
def take_other_words(
    task: Task, contacts: FloatArray, count: int, here: float
) -> tuple[float, int]:
    """Come to each contact of a chain by another word, if the chain is sooner by it.

    Arguments and result as of `add_boundary_arcs`.
    """
    start, scene, stride, legs = task
    k = 0
    while k < count:
        first = k
        while contacts[k, 3] != BOUNDARY_ARC and first >= 0 and not time_is_up(scene.until):
            tried = np.empty((count - k + first, 4))
            tried[:first], tried[first:] = contacts[:first], contacts[k:count]
            if _take_word(task, tried, first, here):
                chain = chain_of(tried, legs)
                _, time = fly_links(start, 0.0, scene, chain, 0, len(tried), inf)
                if time < here:
                    here, count = refine_chain(start, scene, chain, time, stride, here), len(tried)
                    contacts[:count] = tried
                    k = first
                    break
            first -= 1
        k += 1
    return here, count


@njit(cache=True, nogil=True)
def _take_word(task: Task, contacts: FloatArray, k: int, beat: float) -> bool:
    """Find the bearing of contact k and the word to it with which a chain is soonest.

    Whether it arrives before `beat` then; `contacts` takes them.
    """
    start, scene, _, legs = task
    chain, rows = chain_of(contacts.copy(), legs), np.empty((MAX_ROWS, 5))
    tried, count, found = chain.contacts, len(contacts), False
    pose, t = fly_links(start, 0.0, scene, chain, 0, k - 1, beat)
    if t == inf:
        return False
    piece, side, bearing = int(contacts[k, 0]), contacts[k, 1], contacts[k, 2]
    best = beat - _WORTH
    for beside in _BY_WORDS:
        tried[k, 2] = bearing + beside
        if not contact_exists(tried[k, 2], scene.alpha):
            continue
        contact = Contact(piece, tried[k, 2], side)
        n = paths_to_contact(pose, t, scene, contact, best, rows)
        for j in range(n):
            row, tried[k, 3] = rows[j], link_by(rows[:n], j)
            at = contact_at(scene, row[0], tried[k, 2], side)
            if not_before_slot(at, row[0], scene) >= best or not word_clears(pose, t, row, scene):
                continue
            _, time = fly_links(at, row[0], scene, chain, k + 1, count, best)
            if time < best:
                best, found = time, True
                contacts[k] = tried[k]
    return found


@njit(cache=True, nogil=True)
def slide_from_touches(
    task: Task, contacts: FloatArray, count: int, here: float
) -> tuple[float, int]:
    """Put straights that touch, and boundary arcs, into a chain as long as it is sooner by it.

    Arguments and result as of `add_boundary_arcs`; there may be no contacts yet.
    """
    scene = task.scene
    for _ in range(_TOUCH_ROUNDS):
        before, k = here, -1
        while k < count and not time_is_up(scene.until):
            left = contacts[: k + 1].copy()
            pose, t = fly_links(task.start, 0.0, scene, chain_of(left, task.legs), 0, k, inf)
            if t >= here or not_before_slot(pose, t, scene) >= here - _WORTH:
                break
            here, count = _touch_after(task, contacts, count, left, k + 1, here)
            if 0 <= k < count - 1 and contacts[k + 1, 3] == BOUNDARY_ARC:
                here, count = _touch_from_arc(task, contacts, count, k, t, here)
            k += 1
        if here > before - _WORTH:
            break
    return here, count


@njit(cache=True, nogil=True)
def _touch_from_arc(
    task: Task, contacts: FloatArray, count: int, k: int, t: float, here: float
) -> tuple[float, int]:
    """As `slide_from_touches`, by one straight from the boundary arc begun at contact k, at t."""
    places, begun, end = np.empty((_MOST, 3)), contacts[k, 2], contacts[k + 1].copy()
    for place in places[: _places_along(task.scene, t, begun, end[1], _APART, places)]:
        beyond = (end[2] - place[1]) * (end[2] - begun) <= 0.0
        if beyond and place[0] >= end[0]:
            break
        left = contacts[: k + 2].copy()
        left[k + 1, 0], left[k + 1, 2] = place[0], place[1]
        time, n = _touch_after(task, contacts, count, left, k + 2, here)
        if time < here:
            return time, n
    return here, count


@njit(cache=True, nogil=True)
def _touch_after(
    task: Task, contacts: FloatArray, count: int, left: FloatArray, after: int, here: float
) -> tuple[float, int]:
    """As `slide_from_touches`, by one straight from the end of another chain, `left`.

    The chain goes on at contact `after`, a later one, or the slot.
    """
    start, scene, stride, legs = task
    n, leader = len(left), scene.leader
    pose, t = fly_links(start, 0.0, scene, chain_of(left.copy(), legs), 0, n - 1, inf)
    if t == inf:
        return here, count
    touches, whole = np.empty((MAX_TANGENTS, 3)), np.empty((MAX_CONTACTS, 4))
    best, won, length = here, np.empty((MAX_CONTACTS, 4)), 0
    whole[:n] = left
    for piece in range(piece_at(leader, t), len(leader)):
        for link in (LEFT_TO_TOUCH, RIGHT_TO_TOUCH):
            turn = 1.0 if link == LEFT_TO_TOUCH else -1.0
            for touch in touches[: straight_touches(pose, t, scene, piece, turn, touches)]:
                if touch[2] < _MOMENT or n + 2 > MAX_CONTACTS or time_is_up(scene.until):
                    continue
                bearing, side = touch[0], touch[1]
                if n > 0 and side == left[n - 1, 1]:
                    bearing = left[n - 1, 2] + wrap_signed(bearing - left[n - 1, 2])
                there = contact_at(scene, t + touch[2], bearing, side)
                if not_before_slot(there, t + touch[2], scene) >= best - _WORTH:
                    continue
                whole[n, 0], whole[n, 1], whole[n, 2], whole[n, 3] = piece, side, bearing, link
                chain = chain_of(whole[: n + 1], legs)
                _, met = fly_links(pose, t, scene, chain, n, n, best)
                if met == inf:
                    continue
                size = _slide_on(scene, met, contacts[after:count], whole, n, best, legs)
                if size == 0:
                    continue
                chain = chain_of(whole[:size], legs)
                _, time = fly_links(start, 0.0, scene, chain, 0, size, inf)
                if time < inf:
                    time = refine_chain(start, scene, chain, time, stride, best)
                if time < best - _WORTH:
                    best, length = time, size
                    won[:size] = whole[:size]
    if length == 0:
        return here, count
    contacts[:length] = won[:length]
    return best, length


@njit(cache=True, nogil=True)
def _slide_on(
    scene: Scene, t: float, onward: FloatArray, whole: FloatArray, n: int, beat: float,
    legs: FloatArray,
) -> int:  # fmt: skip
    """Slide on from a contact, and go on from where that is best.

    Args:
        scene: what the path has to reckon with.
        t: when it is at the contact [R/V_P].
        onward: contacts at one of which it may go on, if not at the slot. shape (·, 4)
        whole: a chain; takes the end of the boundary arc and the contacts after that.
        n: number of the contact in it.
        beat: an arrival already known [R/V_P].
        legs: room. shape (MAX_LEGS, 6)

    Returns:
        how many contacts the chain has; 0 if it arrives far later.
    """
    places, count, side = np.empty((_MOST, 3)), len(onward), whole[n, 1]
    along = places[: _places_along(scene, t, whole[n, 2], side, _STEP, places)]
    best, size = beat + _LATE, 0
    for j in range(count + 1):
        if (j < count and onward[j, 3] == BOUNDARY_ARC) or n + 2 + count - j > MAX_CONTACTS:
            continue
        rest = chain_of(onward[j:].copy(), legs)
        for place in along:
            if place[2] >= best:
                break
            pose = contact_at(scene, place[2], place[1], side)
            if not_before_slot(pose, place[2], scene) >= best:
                continue
            _, time = fly_links(pose, place[2], scene, rest, 0, count - j, best)
            if time < best:
                best, size = time, n + 2 + count - j
                whole[n + 1, 0], whole[n + 1, 1] = place[0], side
                whole[n + 1, 2], whole[n + 1, 3] = place[1], BOUNDARY_ARC
                whole[n + 2 : size] = onward[j:]
    return size


@njit(cache=True, nogil=True)
def _places_along(
    scene: Scene, t: float, bearing: float, side: float, step: float, places: FloatArray
) -> int:
    """Places along a boundary arc: the leader's piece, the bearing and the time; how many.

    The bearing is not wrapped. Just before the leader begins another piece there is one more.
    """
    leader = scene.leader
    i, n = piece_at(leader, t), 0
    while n < len(places):
        disc = disc_on(scene, i, side)
        sense = boundary_arc_sense(bearing, disc)
        if sense == 0.0:
            break
        left = min(step, piece_end(leader, i) - t)
        if left > 0.0:
            to, took = slide_within(bearing, bearing + sense * TWO_PI, disc, left)
            if took == inf or took < left:
                break
            bearing, t = to, t + left
            places[n, 0], places[n, 1], places[n, 2] = i, bearing, t
            if left < step:
                # there, but for rounding
                back = min(_MOMENT, left)
                places[n, 1] -= back * boundary_arc_rates(bearing, disc)[0]
                places[n, 2] -= back
            n += 1
        if left < step:
            i += 1
            t = leader[i, 0]
    return n


@njit(cache=True, nogil=True)
def search_nearby(
    task: Task, contacts: FloatArray, count: int, here: float, effort: int
) -> tuple[float, int]:
    """Begin a chain again from nearby, as long as it is sooner by it.

    Arguments and result as of `add_boundary_arcs`; `effort` says how many chains are refined: the
    sum of the squares of their contacts.
    """
    tried, left = np.empty((MAX_CONTACTS, 4)), np.array([effort])
    for _ in range(_NEARBY_ROUNDS):
        before = here
        for k in range(count):
            here = _touch_straight(task, contacts[:count], k, here)
        for change in range(_CHANGES):
            k = 0
            while k < count:
                if left[0] < 0 or time_is_up(task.scene.until):
                    return here, count
                n = _change(task.scene, contacts[:count], k, change, tried)
                if n > 0:
                    chain, known = chain_of(tried[:n], task.legs), contacts[:count]
                    time = _refined(task, chain, k, known, here, left)
                    if time < here - _WORTH:
                        here, count = time, n
                        contacts[:n] = tried[:n]
                if change == _TOWARD_START:
                    here, count = _pass_touching(task, contacts, count, k, here, left)
                k += 1
        if here > before - _WORTH:
            break
    return here, count


@njit(cache=True, nogil=True)
def _refined(
    task: Task, chain: Chain, k: int, known: FloatArray, beat: float, left: IntArray
) -> float:
    """The arrival of a chain, changed at contact k, once its bearings have been moved.

    Infinite if it is far later, or comes to a chain that is known.
    """
    start, scene, stride, _ = task
    contacts = chain.contacts
    last = len(contacts)
    _, here = fly_links(start, 0.0, scene, chain, 0, last, beat + _LATER)
    if here == inf:
        return inf
    left[0] -= last * last
    for sweep in range(1 + _SWEEPS):
        before = here
        # at first what is beside the change alone: mostly that shows that it is in vain
        for j in range(last):
            if contacts[j, 3] >= LEFT_TO_TOUCH or (sweep == 0 and abs(j - k) > 1):
                continue
            at, t = fly_links(start, 0.0, scene, chain, 0, j - 1, inf)
            here, _ = move_bearing(at, t, scene, chain, Move(j, last, stride, 0.3 * stride), here)
        if sweep == 0:
            if here > beat + _LATE:
                return inf
            continue
        if before - here < _LITTLE:
            break
        if here - 2.0 * (before - here) > beat:
            return inf
    if here > beat + _STILL_LATER:
        return inf
    if last == len(known):
        same = True
        for j in range(last):
            apart = abs(contacts[j, 2] - known[j, 2])
            same = same and apart < stride and contacts[j, 0] == known[j, 0]
            same = same and contacts[j, 3] == known[j, 3]
        if same:
            return inf
    return refine_chain(start, scene, chain, here, 0.3 * stride, beat)


@njit(cache=True, nogil=True)
def _change(scene: Scene, contacts: FloatArray, k: int, change: int, tried: FloatArray) -> int:
    """Change a chain at contact k; `tried` takes it. How many contacts; 0 if it cannot be."""
    count = len(contacts)
    tried[:count] = contacts
    if change == _SLIDING:
        if k + 2 >= count or contacts[k, 1] != contacts[k + 2, 1]:
            return 0
        tried[k + 1 : count - 1] = contacts[k + 2 :]
        tried[k + 1, 3] = BOUNDARY_ARC
        return count - 1
    if change in (_TOWARD_START, _TOWARD_END):
        tried[k, 0] += 1.0 if change == _TOWARD_END else -1.0
        return count if 0.0 <= tried[k, 0] < len(scene.leader) else 0
    if change >= _BY_WORD:
        link = NAMED + (change - _BY_WORD)
        tried[k, 3] = link
        by_word = contacts[k, 3] != BOUNDARY_ARC and contacts[k, 3] < LEFT_TO_TOUCH
        return count if by_word and link != contacts[k, 3] else 0
    moved = _MOVED[change]
    if k + moved > count:
        return 0
    tried[k : k + moved, 2] += _BY[change]
    return count


@njit(cache=True, nogil=True)
def _pass_touching(
    task: Task, contacts: FloatArray, count: int, k: int, here: float, left: IntArray
) -> tuple[float, int]:
    """Put a straight that touches the disc, and slides on, behind contact k or one beside it."""
    scene, legs = task.scene, task.legs
    slides_on = k + 1 < count and contacts[k + 1, 3] == BOUNDARY_ARC
    more = 1 if slides_on else 2
    if count + more > MAX_CONTACTS:
        return here, count
    touches, last = np.empty((MAX_TANGENTS, 3)), len(scene.leader) - 1
    for shift in _BESIDE:
        tried = np.empty((count + more, 4))
        tried[: k + 1], tried[k + 1 + more :] = contacts[: k + 1], contacts[k + 1 : count]
        tried[k, 2] += shift
        before = chain_of(tried[: k + 1], legs)
        at, t = fly_links(task.start, 0.0, scene, before, 0, k, here)
        if t == inf:
            continue
        first = int(contacts[k, 0])
        pieces = int(contacts[k + 1, 0]) if slides_on else first
        for piece in range(first, min(pieces, last) + 1):
            for turn in (LEFT_TO_TOUCH, RIGHT_TO_TOUCH):
                sense = 1.0 if turn == LEFT_TO_TOUCH else -1.0
                for touch in touches[: straight_touches(at, t, scene, piece, sense, touches)]:
                    ahead = wrap_signed(touch[0] - tried[k, 2])
                    if touch[1] != contacts[k, 1] or touch[2] < _MOMENT or time_is_up(scene.until):
                        continue
                    chain = chain_of(tried.copy(), legs)
                    new = chain.contacts[k + 1]
                    new[0], new[1], new[2], new[3] = piece, touch[1], tried[k, 2] + ahead, turn
                    if slides_on:
                        chain.contacts[k + 2] = contacts[k + 1]
                    else:
                        disc = disc_on(scene, piece, touch[1])
                        chain.contacts[k + 2] = new
                        chain.contacts[k + 2, 2] += _SHORT * boundary_arc_sense(new[2], disc)
                        chain.contacts[k + 2, 3] = BOUNDARY_ARC
                    time = _refined(task, chain, k, contacts[:count], here, left)
                    if time < here - _WORTH:
                        contacts[: count + more] = chain.contacts
                        return time, count + more
    return here, count


@njit(cache=True, nogil=True)
def _touch_straight(task: Task, contacts: FloatArray, k: int, here: float) -> float:
    """Come to a boundary arc, begun at contact k, by a straight instead, if that is no later.

    Returns the arrival then [R/V_P].
    """
    start, scene, stride, legs = task
    count = len(contacts)
    if k + 1 == count or contacts[k + 1, 3] != BOUNDARY_ARC:
        return here
    if contacts[k, 3] == BOUNDARY_ARC or contacts[k, 3] >= LEFT_TO_TOUCH:
        return here
    for turn in (LEFT_TO_TOUCH, RIGHT_TO_TOUCH):
        tried = contacts.copy()
        tried[k, 3] = turn
        chain = chain_of(tried, legs)
        _, time = fly_links(start, 0.0, scene, chain, 0, count, here + _LATER)
        if time < inf:
            time = refine_chain(start, scene, chain, time, stride, here)
        if time < here + _NO_LATER:
            contacts[:], here = tried, time
    return here


@njit(cache=True, nogil=True)
def no_chains(room: int) -> FloatArray:
    """Room for some chains, none of which is known yet: shape (room, MAX_CONTACTS + 1, 4).

    The contacts of each come behind a row with its arrival and how many they are.
    """
    spare = np.zeros((room, MAX_CONTACTS + 1, 4))
    spare[:, 0, 0] = inf
    return spare


@njit(cache=True, nogil=True)
def keep_chain(spare: FloatArray, arrival: float, contacts: FloatArray) -> None:
    """Keep a chain, if it is sooner than one that is alike, or than the last one."""
    if len(spare) == 0:
        return
    last = 0
    for k in range(len(spare)):
        if are_alike(spare[k, 1 : int(spare[k, 0, 1]) + 1], contacts):
            last = k
            break
        if spare[k, 0, 0] > spare[last, 0, 0]:
            last = k
    if arrival < spare[last, 0, 0]:
        spare[last, 0, 0], spare[last, 0, 1] = arrival, len(contacts)
        spare[last, 1 : len(contacts) + 1] = contacts


@njit(cache=True, nogil=True)
def are_alike(chain: FloatArray, other: FloatArray) -> bool:
    """Whether two chains have as many contacts, on the same sides and linked the same way."""
    if len(chain) != len(other):
        return False
    for k in range(len(chain)):
        if chain[k, 1] != other[k, 1] or chain[k, 3] != other[k, 3]:
            return False
    return True
