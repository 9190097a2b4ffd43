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
from relguide.kernels.base.records import Pose, Scene, with_limit, with_time
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.chain import DELAY, MAX_CONTACTS, WORD, chain_of
from relguide.kernels.contact.chain_refinement import fly_links, refine_chains
from relguide.kernels.contact.contact_graph import best_chains
from relguide.kernels.contact.nodes import contact_nodes
from relguide.kernels.contact.one_contact import descend_basins, scan_contacts
from relguide.kernels.separation.clearance import leader_at, piece_at

_AT_LIMIT = 1.02  # a slot less far out, in d_min, is reached by boundary arcs of a few degrees
_CHAINS = 4  # of the graph, refined
_PER_HOP = 5  # so many bearings on the disc let one contact be followed to all others
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
        bearings: how finely the disc is scanned; twice as finely round a leader that keeps
            straight if the slot lies hardly outside.
        tangents: contacts to be looked at besides, from `tangent.tangents`. shape (·, 4)
        beat: an arrival already known [R/V_P]; only earlier ones are looked for.
        legs: takes the legs of the path, as `chain.Chain`. shape (MAX_LEGS, 6)

    Returns:
        arrival time [R/V_P] and the number of legs; `beat` and 0 if no path is faster.
    """
    if len(scene.leader) == 1 and hypot(scene.leader[0, 1], scene.leader[0, 2]) < (
        _AT_LIMIT * scene.d_min
    ):
        bearings *= 2
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
    kept = best_chains(scene, nodes, best, _NEARLY, bearings // _PER_HOP, chains)
    if kept > 0 and chains[0, 0, 0] == scene.t_release:
        contacts = int(chains[0, 0, 1])
        chain = chain_of(chains[0, 1 : contacts + 1], legs)
        fly_links(start, 0.0, with_time(scene, inf), chain, 0, contacts - 1, inf)
        legs[contacts, 0] = DELAY
        return scene.t_release, contacts + 1
    time, count = refine_chains(start, scene, chains[:kept], 0.5 * TWO_PI / bearings, best, legs)
    return (time, count) if count > 0 else (best, found)
