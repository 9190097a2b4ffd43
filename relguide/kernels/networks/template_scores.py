"""A network of ways round the limit, evaluated for one situation, and decoded.

Out come a score of each kind, by which it is chosen, and its guess of two numbers; weights are
float32, as they were trained. Guesses are worked out for the kinds that are solved, and no others.
Situations on the right of the route are mirrored before, and what is flown after.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise; the leader is at (D/R, 0) at
t = 0 and keeps heading 0.
"""

from math import exp, inf

import numpy as np
from numba import njit

from relguide.kernels.base.angles import mirror_heading
from relguide.kernels.base.records import Pose, straight_scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.chain import MAX_CONTACTS
from relguide.kernels.contact.path_pieces import pieces_of
from relguide.kernels.networks.branch_scores import Layers, last_hidden
from relguide.kernels.networks.template_features import FEATURES, template_features
from relguide.kernels.networks.template_solutions import solve_template
from relguide.kernels.networks.templates import NONE, SEVERAL, SIZE
from relguide.kernels.words.branches import needs_mirror

Weights = tuple[FloatArray, ...]
"""The arrays of `Layers`, in that order."""
OUTPUTS = 3 * SIZE
"""Score of each kind, then its guess."""
LEGS = MAX_CONTACTS + 1
"""Room for the legs of a way, as the search has it."""
_MOST_LATE = 9.5  # the limit costs more in 1 of 200 situations, and then it is mostly a wrong way


@njit(cache=True, nogil=True)
def template_shares(
    x: float, y: float, h: float, slot: float, alpha: float, limit: float, free: FloatArray,
    layers: Layers, share: FloatArray,
) -> FloatArray:  # fmt: skip
    """How likely the network takes each kind to be that of the fastest way.

    Args:
        x: pursuer ahead of the slot [R].
        y: and left of it [R]; not `needs_mirror`.
        h: its heading [rad], in [0, 2π).
        slot: D [R].
        alpha: V_L/V_P, below 1.
        limit: d_min [R].
        free: the fastest extremal without the limit, a row of `solve`. shape (5,)
        layers: the weights.
        share: takes the shares, which sum up to 1. shape (SIZE,)

    Returns:
        the layer before the outputs, for `guess_of`.
    """
    told = np.empty(FEATURES)
    template_features(x, y, h, slot, alpha, limit, free, told)
    hidden = last_hidden(told, layers)
    score = layers.last_bias[:SIZE].copy()
    for i in range(len(hidden)):
        value = hidden[i]
        for kind in range(SIZE):
            score[kind] += value * layers.last[i, kind]
    most = score.max()
    for kind in range(SIZE):
        share[kind] = exp(score[kind] - most)
    share /= share.sum()
    return hidden


@njit(cache=True, nogil=True)
def guess_of(hidden: FloatArray, layers: Layers, kind: int, guess: FloatArray) -> None:
    """The two numbers of a kind's guess, as in `templates`."""
    for k in range(2):
        at = SIZE + 2 * kind + k
        value = layers.last_bias[at]
        for i in range(len(hidden)):
            value += hidden[i] * layers.last[i, at]
        guess[k] = value


@njit(cache=True, nogil=True)
def choose_template(
    x: float, y: float, h: float, slot: float, alpha: float, limit: float, free: FloatArray,
    layers: Layers, least_share: float, most: int, doubt: float, legs: FloatArray,
) -> tuple[int, int, float, int]:  # fmt: skip
    """Solve the kinds of ways that the network holds possible, next to its guesses, and no others.

    Args:
        x: as in `template_shares`.
        y: as there.
        h: as there.
        slot: as there.
        alpha: as there.
        limit: as there.
        free: as there; it breaks the limit: where that does not bind is not what was learnt.
        layers: the weights.
        least_share: kinds with a smaller share than this are left out.
        most: with more kinds than this, nothing is solved.
        doubt: nor is there an answer where the share of ways of other kinds, of none, and of those
            likelier than the first that was found, is more.
        legs: takes the legs of the fastest way, as `chain.fly_links`. shape (LEGS, 6)

    Returns:
        how many kinds are held possible, the kind of the way, its arrival [R/V_P] and how many
        legs it has; infinite and 0 if there is none.
    """
    share = np.empty(SIZE)
    hidden = template_shares(x, y, h, slot, alpha, limit, free, layers, share)
    held = 0
    for kind in range(SIZE):
        held += share[kind] >= least_share and kind != SEVERAL and kind != NONE
    unknown = share[SEVERAL] + share[NONE]
    if held > most or unknown > doubt:
        return held, SEVERAL, inf, 0
    guess = np.zeros(2)
    trial = np.zeros((LEGS, 6))
    best, count, chosen = inf, 0, NONE
    for _ in range(held):
        # the likeliest first: what is found makes the others cheaper
        kind = -1
        for k in range(SIZE):
            if k != SEVERAL and k != NONE and (kind < 0 or share[k] > share[kind]):
                kind = k
        held_share = share[kind]
        share[kind] = 0.0
        guess_of(hidden, layers, kind, guess)
        time, n = solve_template(x, y, h, slot, alpha, limit, kind, guess, best, trial)
        if n > 0:
            best, count, chosen = time, n, kind
            legs[:n] = trial[:n]
        if best == inf:
            unknown += held_share
    # kinds of which there is none next to its guess were held possible in vain
    if unknown > doubt or best > free[0] + _MOST_LATE:
        return held, SEVERAL, inf, 0
    return held, chosen, best, count


@njit(cache=True, nogil=True)
def way_round(
    x: float, y: float, h: float, slot: float, alpha: float, limit: float, free: FloatArray,
    radius: float, longest: float, weights: Weights, least_share: float, most: int, doubt: float,
) -> FloatArray:  # fmt: skip
    """The way of `choose_template` as pieces.

    Args:
        x: pursuer ahead of the slot [R].
        y: and left of it [R], or right.
        h: its heading [rad], in [0, 2π).
        slot: D [R].
        alpha: V_L/V_P, below 1.
        limit: d_min [R].
        free: what `network_view` found.
        radius: R [m].
        longest: ways that take longer count as none [R/V_P].
        weights: those of `Layers`; a plain tuple is handed over in half the time.
        least_share: as in `choose_template`.
        most: as there.
        doubt: as there.

    Returns:
        as `path_pieces.pieces_of`; no columns if there is no way. shape (3, pieces)
    """
    sense = 1.0
    if needs_mirror(y, h):
        y, h, sense = -y, mirror_heading(h), -1.0
    legs = np.zeros((LEGS, 6))
    _, _, time, count = choose_template(
        x, y, h, slot, alpha, limit, free, Layers(*weights), least_share, most, doubt, legs
    )
    if count == 0 or time > longest:
        return np.empty((3, 0))
    scene = straight_scene(alpha, slot, limit)
    return pieces_of(Pose(x, y, h), scene, radius, sense, time, legs[:count])
