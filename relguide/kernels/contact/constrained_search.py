"""Paths to the slot that touch d = d_min: the search where the best one without it breaks it.

Three searches follow each other: paths through one contact (see `one_contact`); a graph of contacts
joined by words and boundary arcs (see `contact_graph`); and the refinement of the best chains of it
(see `chain_refinement`).

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise. The work is bounded: pieces × 2
× bearings contacts, each a few words, and a fixed number of basins, hops and sweeps. If the scene
says until when, all of it ends by then, with the best path so far.
"""

from math import hypot, inf

import numpy as np
from numba import njit

from relguide.kernels.base.angles import TWO_PI
from relguide.kernels.base.clock import time_is_up
from relguide.kernels.base.records import Contact, Pose, Scene, with_limit, with_time
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.best_chain import AGAIN, begin_again, refine_chains
from relguide.kernels.contact.chain import (
    BOUNDARY_ARC,
    DELAY,
    MAX_CONTACTS,
    MAX_LEGS,
    WORD,
    Chain,
    chain_of,
)
from relguide.kernels.contact.chain_refinement import fly_links
from relguide.kernels.contact.clear_delay import delay_until_release
from relguide.kernels.contact.clear_words import word_clears
from relguide.kernels.contact.contact import contact_at, contact_exists
from relguide.kernels.contact.contact_graph import best_chains
from relguide.kernels.contact.graph_chains import LATE
from relguide.kernels.contact.graph_labels import Effort
from relguide.kernels.contact.kept_chains import are_alike, keep_chain, no_chains
from relguide.kernels.contact.looped_word import looped_word
from relguide.kernels.contact.nodes import BoolArray, Nodes, contact_nodes, nodes_closer
from relguide.kernels.contact.one_contact import descend_basins, scan_contacts
from relguide.kernels.contact.paths_to_contact import paths_to_contact
from relguide.kernels.separation.clearance import leader_at, piece_at
from relguide.kernels.words.delay import DELAY_PIECES

_AT_LIMIT = 1.02  # a slot less far out, in d_min, is reached by boundary arcs of a few degrees
_CHAINS = 4  # of the graph, refined
_BESIDE = 0.1  # contacts this close lead to the same places: 6° [rad]
_CLOSER = 8  # steps from one bearing to the next where it is looked closer
_STRIDE = 0.44  # least first step of a bearing round a leader that turns, of what is beside: 2.5°
_TRIES = 8  # times the places hopped from: so many contacts are left by a delay path, 0.3 ms each
_HOPS_CLOSER = 2  # of contacts, to others, where it is looked closer
_MOST_ALIVE = 10  # contacts that may still matter: of more it is not looked closer
_SPARE, _SPARE_AT_LIMIT = 2, 3  # other chains that are begun again as well
_AGAIN, _AGAIN_AT_LIMIT = 120, 250  # effort to begin the best chain again from nearby …
_AGAIN_STRAIGHT = 50  # … round a leader that keeps straight
_WORTH = 2e-3  # how much sooner a contact has to promise an arrival for it [R/V_P]: 0.1 s


@njit(cache=True, nogil=True)
def ease_to_start(start: Pose, scene: Scene) -> Scene:
    """The same scene, with the limit that the start itself keeps.

    On a boundary arc a start lies on d_min but for rounding, and counts as keeping it to
    `clearance.SLACK`. Nothing that begins there could keep more.
    """
    at = leader_at(scene, piece_at(scene.leader, 0.0), 0.0)
    return with_limit(scene, min(scene.d_min, hypot(start.x - at.x, start.y - at.y)))


@njit(cache=True, nogil=True)
def best_constrained_path(
    start: Pose, scene: Scene, bearings: int, tangents: FloatArray, beat: float, legs: FloatArray
) -> tuple[float, int]:
    """The fastest path to the slot that touches the disc, or flies a full loop to stay clear of it.

    Args:
        start: where it begins, at t = 0.
        scene: what it has to reckon with.
        bearings: how finely the disc is scanned. If the slot lies hardly outside, twice as finely
            round a leader that keeps straight, and where R < d_min once more.
        tangents: contacts to be looked at besides, from `tangent.tangents`. shape (·, 4)
        beat: an arrival already known [R/V_P]; only earlier ones are looked for.
        legs: takes the legs of the path, as `chain.Chain`. shape (MAX_LEGS, 6)

    Returns:
        arrival time [R/V_P] and the number of legs; `beat` and 0 if no path is faster.
    """
    narrow, keeps_straight = _is_slot_at_limit(scene), len(scene.leader) == 1
    if narrow and keeps_straight:
        bearings *= 2
    spares = 0 if keeps_straight else _SPARE_AT_LIMIT if narrow else _SPARE
    chain, spare = np.zeros((MAX_CONTACTS, 4)), no_chains(spares)
    best, count, may_be_faster = _search(start, scene, bearings, tangents, beat, legs, chain, spare)
    finer = np.zeros_like(legs)
    long_way = narrow and scene.d_min > 1.0
    if long_way and best > scene.t_release:
        # more bearings do not include the fewer ones, nor find all that these do
        other = np.zeros_like(chain)
        more = bearings * 7 // 5 if keeps_straight else 2 * bearings
        # round a leader that turns, chains that are far later at first may be sooner once refined
        known = best if keeps_straight else beat
        time, found, then = _search(start, scene, more, tangents, known, finer, other, spare)
        may_be_faster = may_be_faster or then
        if found > 0 and time < best:
            if count > 2:
                keep_chain(spare, best, chain[: count - 1])
            best, count = time, found
            legs[:], chain[:] = finer, other
        elif found > 2:
            keep_chain(spare, time, other[: found - 1])
    if count > 0 and may_be_faster and (long_way or not keeps_straight):
        stride, work = _STRIDE * _BESIDE, _AGAIN_AT_LIMIT if narrow else _AGAIN
        if keeps_straight:
            work = _AGAIN_STRAIGHT
        # a path through one contact is searched for anew, from the start
        contacts = count - 1 if count > 2 else 0
        was, begun = chain[:contacts].copy(), np.full(AGAIN * (1 + spares), inf)
        time, found = begin_again(start, scene, chain, contacts, best, stride, legs, work, begun)
        if found > 0:
            best, count = time, found
        for k in np.argsort(spare[:, 0, 0]):
            here, contacts = spare[k, 0, 0], int(spare[k, 0, 1])
            if here == inf or time_is_up(scene.until):
                break
            if are_alike(spare[k, 1 : contacts + 1], was):
                continue
            time, found = begin_again(
                start, scene, spare[k, 1:], contacts, here, stride, finer, work, begun
            )
            if found > 0 and time < best:
                best, count = time, found
                legs[:] = finer
    time, looped = looped_word(start, scene, best, legs)
    return (time, looped) if looped > 0 else (best, count)


@njit(cache=True, nogil=True)
def _search(
    start: Pose, scene: Scene, bearings: int, tangents: FloatArray, beat: float, legs: FloatArray,
    chain: FloatArray, spare: FloatArray,
) -> tuple[float, int, bool]:  # fmt: skip
    """As `best_constrained_path`, with so many bearings.

    `chain` takes the contacts if there are two, and `spare` other chains. The third value says
    whether any contact may lead to a path that is faster by what is worth it.

    Round a leader that turns it is looked closer where only a few contacts may still matter, since
    windows of bearings are narrow there.
    """
    nodes, effort = contact_nodes(scene, bearings, tangents), _effort_of(scene, bearings)
    fresh, alive = np.ones(len(nodes.bearings), np.bool_), np.zeros(len(nodes.bearings), np.bool_)
    best, count = _look(start, scene, nodes, fresh, alive, effort, beat, legs, chain, spare)
    keeps_straight, few = len(scene.leader) == 1, 0 < alive.sum() <= _MOST_ALIVE
    if keeps_straight or not few or time_is_up(scene.until):
        return best, count, bool(alive.any())
    step = effort.width / _CLOSER
    closer, added = nodes_closer(nodes, alive, step)
    then_alive, found = np.zeros(len(added), np.bool_), np.zeros_like(legs)
    other = np.zeros_like(chain)
    effort = Effort(step, _HOPS_CLOSER, 0, _TRIES * _HOPS_CLOSER, 1.2 * step)
    time, more = _look(start, scene, closer, added, then_alive, effort, best, found, other, spare)
    if more > 0:
        best, count = time, more
        legs[:], chain[:] = found, other
    return best, count, bool(alive.any())


@njit(cache=True, nogil=True)
def _effort_of(scene: Scene, bearings: int) -> Effort:
    """How closely the graph of so many bearings is searched.

    Half as many contacts are followed in a round as there are bearings. Round a leader that turns,
    a third as many again begin with late words; and where the slot lies at the limit the others are
    as many as the bearings, since paths slide and hop along the disc to it.
    """
    hops = tries = bearings // 2
    if len(scene.leader) > 1:
        tries = bearings
        hops = bearings if _is_slot_at_limit(scene) else hops
    return Effort(TWO_PI / bearings, hops, bearings // 3, _TRIES * tries, _BESIDE)


@njit(cache=True, nogil=True)
def _look(
    start: Pose, scene: Scene, nodes: Nodes, fresh: BoolArray, alive: BoolArray, effort: Effort,
    beat: float, legs: FloatArray, chain: FloatArray, spare: FloatArray,
) -> tuple[float, int]:  # fmt: skip
    """As `best_constrained_path`, by way of some nodes.

    Args:
        start: where the path begins, at t = 0.
        scene: what it has to reckon with.
        nodes: the contacts; takes what is found of the fresh ones.
        fresh: paths by way of others alone are known already. shape (n,)
        alive: takes those from which a path without the limit would be faster by what it is worth
            to look closer. shape (n,)
        effort: how closely the graph is searched.
        beat: an arrival already known [R/V_P].
        legs: takes the legs of the path.
        chain: takes its contacts, if there are two or more. shape (MAX_CONTACTS, 4)
        spare: takes other chains, of `kept_chains.no_chains`.
    """
    path = np.empty((2, 5))
    best = scan_contacts(start, scene, nodes, fresh, beat, path)
    best = descend_basins(start, scene, nodes, fresh, effort.width, best, path)
    found = 0
    if best < beat:
        found = 2
        legs[:2, 0] = WORD
        legs[:2, 1:6] = path
    chains = np.empty((_CHAINS + LATE, MAX_CONTACTS + 1, 4))
    reached, lower = nodes.time.copy(), nodes.lower.copy()
    kept = best_chains(scene, nodes, fresh, best, effort, True, chains)
    if kept > 0 and chains[0, 0, 0] == scene.t_release:
        contacts = int(chains[0, 0, 1])
        delayed = chain_of(chains[0, 1 : contacts + 1], np.zeros((MAX_LEGS, 6)))
        if fly_to_delay(start, with_time(scene, inf), delayed):
            legs[: contacts + 1] = delayed.legs[: contacts + 1]
            return scene.t_release, contacts + 1
        nodes.time[:], nodes.lower[:] = reached, lower
        kept = best_chains(scene, nodes, fresh, best, effort, False, chains)
    turns, stride = len(scene.leader) > 1, 0.5 * effort.width
    if turns:
        stride = max(stride, _STRIDE * effort.beside)
    time, count = refine_chains(start, scene, chains[:kept], stride, turns, best, legs, spare)
    alive[:] = nodes.lower < time - _WORTH
    nodes.time[:], nodes.lower[:] = reached, lower
    if count == 0:
        return best, found
    chain[: count - 1] = chains[0, 1:count]
    return time, count


@njit(cache=True, nogil=True)
def _is_slot_at_limit(scene: Scene) -> bool:
    """Whether the slot lies hardly outside the disc."""
    final = scene.leader[len(scene.leader) - 1]
    ahead = final[1] - scene.alpha * final[0]
    return bool(hypot(ahead, final[2]) < _AT_LIMIT * scene.d_min)


@njit(cache=True, nogil=True)
def fly_to_delay(start: Pose, scene: Scene, chain: Chain) -> bool:
    """Fly a chain to a last contact from which a delay path arrives as the slot opens.

    While the leader turns, that may be another word to the contact than the earliest: a later one
    finds the leader elsewhere. `chain` takes the legs; returns whether there is such a path.
    """
    contacts, legs, rows = chain
    last, pieces = len(contacts) - 1, np.empty((DELAY_PIECES, 2))
    legs[last + 1, 0] = DELAY
    pose, t = fly_links(start, 0.0, scene, chain, 0, last - 1, inf)
    if t == inf:
        return False
    if contacts[last, 3] == BOUNDARY_ARC:
        pose, t = fly_links(pose, t, scene, chain, last, last, inf)
        return t < inf and delay_until_release(pose, t, scene, pieces)
    contact = Contact(int(contacts[last, 0]), contacts[last, 2], contacts[last, 1])
    if not contact_exists(contact.bearing, scene.alpha):
        return False
    for k in range(paths_to_contact(pose, t, scene, contact, inf, rows)):
        there = contact_at(scene, rows[k, 0], contact.bearing, contact.side)
        if word_clears(pose, t, rows[k], scene) and delay_until_release(
            there, rows[k, 0], scene, pieces
        ):
            legs[last, 0] = WORD
            legs[last, 1:6] = rows[k]
            legs[last, 1] = rows[k, 0] - t
            return True
    return False
