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
from relguide.kernels.base.records import Contact, Pose, Scene, with_limit, with_time
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.chain import (
    BOUNDARY_ARC,
    DELAY,
    MAX_CONTACTS,
    MAX_LEGS,
    WORD,
    Chain,
    chain_of,
)
from relguide.kernels.contact.chain_refinement import fly_links, refine_chains
from relguide.kernels.contact.clear_words import word_clears
from relguide.kernels.contact.contact import contact_at, contact_exists
from relguide.kernels.contact.contact_graph import best_chains
from relguide.kernels.contact.delay_after_contact import delay_until_release
from relguide.kernels.contact.nodes import contact_nodes
from relguide.kernels.contact.one_contact import descend_basins, scan_contacts
from relguide.kernels.contact.paths_to_contact import paths_to_contact
from relguide.kernels.separation.clearance import leader_at, piece_at
from relguide.kernels.words.delay import DELAY_PIECES

_AT_LIMIT = 1.02  # a slot less far out, in d_min, is reached by boundary arcs of a few degrees
_CHAINS = 4  # of the graph, refined
_PER_HOP = 2  # so many bearings on the disc let one contact be followed to all others
_NEARLY = 0.07  # how much a chain may fall below what the graph sees of it [R/V_P]


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
    """The fastest path to the slot that touches the disc.

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
    best, count = _search(start, scene, bearings, tangents, beat, legs)
    if narrow and scene.d_min > 1.0 and best > scene.t_release:
        # more bearings do not include the fewer ones, nor find all that these do
        finer, more = np.zeros_like(legs), bearings * 7 // 5 if keeps_straight else 2 * bearings
        time, found = _search(start, scene, more, tangents, best, finer)
        if found > 0:
            best, count = time, found
            legs[:] = finer
    return best, count


@njit(cache=True, nogil=True)
def _search(
    start: Pose, scene: Scene, bearings: int, tangents: FloatArray, beat: float, legs: FloatArray
) -> tuple[float, int]:
    """As `best_constrained_path`, with so many bearings."""
    nodes = contact_nodes(scene, bearings, tangents)
    path = np.empty((2, 5))
    best = scan_contacts(start, scene, nodes, beat, path)
    best = descend_basins(start, scene, nodes, TWO_PI / bearings, best, path)
    found = 0
    if best < beat:
        found = 2
        legs[:2, 0] = WORD
        legs[:2, 1:6] = path
    chains = np.empty((_CHAINS, MAX_CONTACTS + 1, 4))
    hops, reached, lower = bearings // _PER_HOP, nodes.time.copy(), nodes.lower.copy()
    kept = best_chains(scene, nodes, best, _NEARLY, hops, True, chains)
    if kept > 0 and chains[0, 0, 0] == scene.t_release:
        contacts = int(chains[0, 0, 1])
        chain = chain_of(chains[0, 1 : contacts + 1], np.zeros((MAX_LEGS, 6)))
        if fly_to_delay(start, with_time(scene, inf), chain):
            legs[: contacts + 1] = chain.legs[: contacts + 1]
            return scene.t_release, contacts + 1
        nodes.time[:], nodes.lower[:] = reached, lower
        kept = best_chains(scene, nodes, best, _NEARLY, hops, False, chains)
    time, count = refine_chains(start, scene, chains[:kept], 0.5 * TWO_PI / bearings, best, legs)
    return (time, count) if count > 0 else (best, found)


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
