"""Paths to the slot that touch d = d_min: the search where the best one without it breaks it.

Three searches follow each other: paths through one contact (see `one_contact`); a graph of contacts
joined by words and boundary arcs (see `contact_graph`); and the refinement of the best chains of it
(see `chain_refinement`).

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise. The work is bounded: pieces × 2
× bearings contacts, each a few words, and a fixed number of basins, hops and sweeps.
"""

from math import inf

import numpy as np
from numba import njit

from relguide.kernels.base.angles import TWO_PI
from relguide.kernels.base.records import Pose, Scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.chain import (
    DELAY,
    MAX_CONTACTS,
    WORD,
    chain_of,
    fly_links,
    with_contacts,
)
from relguide.kernels.contact.chain_refinement import (
    GAIN,
    follow_edges,
    refine_chain,
    simplify_chain,
)
from relguide.kernels.contact.contact_graph import best_chains
from relguide.kernels.contact.nodes import contact_nodes
from relguide.kernels.contact.one_contact import descend_basins, scan_contacts
from relguide.kernels.contact.passage import best_word
from relguide.kernels.separation.clearance import piece_clears
from relguide.kernels.words.extremals import MAX_ROWS, fly_piece

MAX_LEGS = MAX_CONTACTS + 1
"""Legs of the longest path."""
_CHAINS = 4  # of the graph, refined
_PER_HOP = 5  # so many bearings on the disc let one contact be followed to all others
_NEARLY = 0.07  # how much a chain may fall below what the graph sees of it [R/V_P]
_AT_EDGE = 0.02  # or below where its bearings, one by one, get stuck at an edge [R/V_P]
_FIRST_TURNS = 48  # sizes of a first turn in `any_path`: every 7.5°
_LONGEST = 64.0  # longest straight tried there [R]: 200 NM for an airliner


@njit(cache=True, nogil=True)
def best_constrained_path(
    start: Pose, scene: Scene, bearings: int, tangents: FloatArray, beat: float, legs: FloatArray
) -> tuple[float, int]:
    """The fastest path to the slot that touches the disc.

    Args:
        start: where it begins, at t = 0.
        scene: what it has to reckon with.
        bearings: how finely the disc is scanned.
        tangents: contacts to be looked at besides, from `tangent.tangents`. shape (·, 4)
        beat: an arrival already known [R/V_P]; only earlier ones are looked for.
        legs: takes the legs of the path, as `chain.Chain`. shape (MAX_LEGS, 6)

    Returns:
        arrival time [R/V_P] and the number of legs; `beat` and 0 if no path is faster.
    """
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
        fly_links(start, 0.0, scene, chain, 0, contacts - 1, inf)
        legs[contacts, 0] = DELAY
        return scene.t_release, contacts + 1
    time, count = _refine(start, scene, chains[:kept], 0.5 * TWO_PI / bearings, best, legs)
    return (time, count) if count > 0 else (best, found)


@njit(cache=True, nogil=True)
def _refine(
    start: Pose, scene: Scene, chains: FloatArray, stride: float, best: float, legs: FloatArray
) -> tuple[float, int]:
    """The least arrival of the refined chains and its legs; `best` and 0 if none is earlier."""
    tried = np.empty((MAX_LEGS, 6))
    won = -1
    for k in range(len(chains)):
        chain = chain_of(chains[k, 1 : int(chains[k, 0, 1]) + 1], tried)
        here = refine_chain(start, scene, chain, chains[k, 0, 0], stride, best)
        if here < best + _AT_EDGE:
            along = follow_edges(start, scene, chain, here, stride)
            if along < here - GAIN:
                here = refine_chain(start, scene, chain, along, 0.1 * stride, best)
        if here < best - GAIN:
            best, won = here, k
    if won < 0:
        return best, 0
    contacts = int(chains[won, 0, 1])
    chain = chain_of(chains[won, 1 : contacts + 1], tried)
    if contacts > 2:
        best, contacts = simplify_chain(start, scene, chain, best, stride)
    shortest = with_contacts(chain_of(chain.contacts, legs), chain.contacts[:contacts])
    _, best = fly_links(start, 0.0, scene, shortest, 0, contacts, inf)
    return best, contacts + 1


@njit(cache=True, nogil=True)
def any_path(
    start: Pose, scene: Scene, beat: float, row: FloatArray
) -> tuple[float, float, float, float]:
    """Some path to the slot that keeps d_min: a first turn of any size, a straight, and a word.

    For when nothing else was found: that there is a path at all matters more than its time then.

    Args:
        start: where it begins, at t = 0.
        scene: what it has to reckon with.
        beat: an arrival already known [R/V_P]; only earlier ones are looked for.
        row: takes the row of the word. shape (5,)

    Returns:
        arrival, sign and angle of the first turn, length of the straight; `beat` and zeros if there
        is none.
    """
    best, best_sign, best_turn, best_straight = beat, 0.0, 0.0, 0.0
    rows = np.empty((MAX_ROWS, 5))
    for side in range(2):
        sign = 1.0 - 2.0 * side
        for j in range(_FIRST_TURNS + 1):
            turned = TWO_PI * j / _FIRST_TURNS
            if not piece_clears(start, sign, 0.0, turned, scene):
                break  # nor does any larger turn
            after_turn = fly_piece(start, sign, turned)
            straight = 0.0
            while straight <= _LONGEST:
                if not piece_clears(after_turn, 0.0, turned, straight, scene):
                    break
                pose = fly_piece(after_turn, 0.0, straight)
                arrival, i = best_word(pose, turned + straight, scene, best, rows)
                if arrival < best:
                    best, best_sign, best_turn, best_straight = arrival, sign, turned, straight
                    row[:] = rows[i]
                straight = 2.0 * straight + 0.25
    return best, best_sign, best_turn, best_straight
