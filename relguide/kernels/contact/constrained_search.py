"""Ways to the slot that touch d = d_min: the search when the best way without the limit breaks it.

Three searches follow each other: ways through one contact (see `one_contact`); a graph of contacts
joined by words and boundary arcs (see `contact_graph`); and the refinement of the best chains of it
(see `chain_refinement`).

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise; the leader is a table as in
`clearance`. The work is bounded: pieces × 2 × bearings contacts, each a few words, and a fixed
number of basins, hops and sweeps.
"""

from math import inf

import numpy as np
from numba import njit

from relguide.kernels.base.angles import TWO_PI
from relguide.kernels.base.records import Pose, Scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.chain import MAX_CONTACTS, WAIT, WORD, fly_links
from relguide.kernels.contact.chain_refinement import (
    GAIN,
    follow_edges,
    refine_chain,
    simplify_chain,
)
from relguide.kernels.contact.contact_graph import best_chains
from relguide.kernels.contact.one_contact import contact_nodes, descend_basins, scan_contacts
from relguide.kernels.contact.passage import best_word
from relguide.kernels.separation.clearance import piece_clears
from relguide.kernels.words.extremals import MAX_ROWS, fly_piece

MAX_LEGS = MAX_CONTACTS + 1
"""Legs of the longest way."""
_CHAINS = 4  # of the graph, refined
_PER_HOP = 5  # so many bearings on the disc let one contact be followed to all others
_NEARLY = 0.07  # how much a chain may fall below what the graph sees of it [R/V_P]
_AT_EDGE = 0.02  # or below where its bearings, one by one, get stuck at an edge [R/V_P]
_FIRST_TURNS = 48  # sizes of a first turn in `any_path`: every 7.5°
_LONGEST = 64.0  # longest straight tried there [R]: 200 NM for an airliner


@njit(cache=True, nogil=True)
def best_constrained_path(
    x: float, y: float, h: float, leader: FloatArray, alpha: float, delta: float, t_release: float,
    bearings: int, tangents: FloatArray, beat: float, legs: FloatArray,
) -> tuple[float, int]:  # fmt: skip
    """The fastest way to the slot that touches the disc.

    Args:
        x: start, slot frame [R].
        y: start [R].
        h: start heading [rad].
        leader: table of its pieces. shape (k, 5)
        alpha: V_L/V_P.
        delta: distance at the contacts, d_min and a graze more [R].
        t_release: when the slot opens [R/V_P].
        bearings: how finely the disc is scanned.
        tangents: contacts to be looked at besides, from `tangent.tangents`. shape (·, 4)
        beat: an arrival already known [R/V_P]; only earlier ones are looked for.
        legs: takes the legs of the way, as `chain.fly_links`. shape (MAX_LEGS, 6)

    Returns:
        arrival time [R/V_P] and the number of legs; `beat` and 0 if no way is faster.
    """
    sides, placed = contact_nodes(leader, alpha, delta, bearings, tangents)
    time, lower, values = np.empty_like(placed), np.empty_like(placed), np.empty_like(placed)
    way = np.empty((2, 5))
    start = x, y, h, leader, alpha, delta, t_release
    best = scan_contacts(*start, sides, placed, beat, time, lower, values, way)
    best = descend_basins(*start, sides, placed, values, bearings, best, way)
    found = 0
    if best < beat:
        found = 2
        legs[:2, 0] = WORD
        legs[:2, 1:6] = way
    chains = np.empty((_CHAINS, MAX_CONTACTS + 1, 4))
    kept = best_chains(
        leader, alpha, delta, t_release, sides, placed, time, lower, best, _NEARLY,
        bearings // _PER_HOP, chains,
    )  # fmt: skip
    rows = np.empty((MAX_ROWS, 5))
    if kept > 0 and chains[0, 0, 0] == t_release:
        contacts = int(chains[0, 0, 1])
        chain = chains[0, 1 : contacts + 1]
        fly_links(
            x, y, h, 0.0, leader, alpha, delta, t_release, chain, 0, contacts - 1, inf, rows, legs
        )
        legs[contacts, 0] = WAIT
        return t_release, contacts + 1
    return _refined(*start, chains[:kept], bearings, best, found, rows, legs)


@njit(cache=True, nogil=True)
def _refined(
    x: float, y: float, h: float, leader: FloatArray, alpha: float, delta: float, t_release: float,
    chains: FloatArray, bearings: int, best: float, found: int, rows: FloatArray, legs: FloatArray,
) -> tuple[float, int]:  # fmt: skip
    """The least arrival of the refined chains and its legs; what is given if none is earlier."""
    tried = np.empty((MAX_LEGS, 6))
    stride = 0.5 * TWO_PI / bearings
    won = -1
    for k in range(len(chains)):
        chain = chains[k, 1 : int(chains[k, 0, 1]) + 1]
        link = leader, alpha, delta, t_release, chain
        here = refine_chain(x, y, h, *link, chains[k, 0, 0], stride, best, rows, tried)
        if here < best + _AT_EDGE:
            along = follow_edges(x, y, h, *link, here, stride, rows, tried)
            if along < here - GAIN:
                here = refine_chain(x, y, h, *link, along, 0.1 * stride, best, rows, tried)
        if here < best - GAIN:
            best, won = here, k
    if won < 0:
        return best, found
    contacts = int(chains[won, 0, 1])
    chain = chains[won, 1 : contacts + 1]
    if contacts > 2:
        best, contacts = simplify_chain(
            x, y, h, leader, alpha, delta, t_release, chain, best, stride, rows, tried
        )
    _, _, _, best = fly_links(
        x,
        y,
        h,
        0.0,
        leader,
        alpha,
        delta,
        t_release,
        chain[:contacts],
        0,
        contacts,
        inf,
        rows,
        legs,
    )
    return best, contacts + 1


@njit(cache=True, nogil=True)
def any_path(
    x: float, y: float, h: float, leader: FloatArray, alpha: float, limit: float, t_release: float,
    beat: float, way: FloatArray,
) -> tuple[float, float, float, float]:  # fmt: skip
    """Some way to the slot that clears: a first turn of any size, a straight, and a word.

    For when nothing else was found: whether there is a way at all matters more than its time then.

    Args:
        x: start, slot frame [R].
        y: start [R].
        h: start heading [rad].
        leader: table of its pieces. shape (k, 5)
        alpha: V_L/V_P.
        limit: least allowed separation [R].
        t_release: when the slot opens [R/V_P].
        beat: an arrival already known [R/V_P]; only earlier ones are looked for.
        way: takes the row of the word. shape (5,)

    Returns:
        arrival, sign and angle of the first turn, length of the straight; `beat` and zeros if none.
    """
    best, best_sign, best_turn, best_straight = beat, 0.0, 0.0, 0.0
    rows = np.empty((MAX_ROWS, 5))
    for side in range(2):
        sign = 1.0 - 2.0 * side
        for j in range(_FIRST_TURNS + 1):
            turned = TWO_PI * j / _FIRST_TURNS
            if not piece_clears(Pose(x, y, h), sign, 0.0, turned, Scene(leader, alpha, limit, 0.0)):
                break  # nor does any larger turn
            px, py, ph = fly_piece(Pose(x, y, h), sign, turned)
            straight = 0.0
            while straight <= _LONGEST:
                if not piece_clears(
                    Pose(px, py, ph), 0.0, turned, straight, Scene(leader, alpha, limit, 0.0)
                ):
                    break
                qx, qy, _ = fly_piece(Pose(px, py, ph), 0.0, straight)
                arrival, i = best_word(
                    qx, qy, ph, turned + straight, leader, alpha, limit, t_release, best, rows
                )
                if arrival < best:
                    best, best_sign, best_turn, best_straight = arrival, sign, turned, straight
                    way[:] = rows[i]
                straight = 2.0 * straight + 0.25
    return best, best_sign, best_turn, best_straight
