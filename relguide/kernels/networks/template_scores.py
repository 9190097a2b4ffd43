"""The template network, evaluated for one situation, and decoded.

It gives a score for each template, by which templates are chosen, and its guess of two numbers;
weights are float32, as they were trained. Guesses are worked out for the templates that are solved,
and no others. Situations on the right of the route are mirrored before, and the path after.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise; the leader is at (D/R, 0) at
t = 0 and keeps heading 0.
"""

from math import exp, inf
from typing import NamedTuple

import numpy as np
from numba import njit

from relguide.kernels.base.records import Pose, Scene, straight_scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.chain import MAX_CONTACTS
from relguide.kernels.contact.path_pieces import pieces_of
from relguide.kernels.networks.branch_scores import Layers, last_hidden_layer
from relguide.kernels.networks.network_view import Where, mirror_to_left
from relguide.kernels.networks.template_features import FEATURES, template_features
from relguide.kernels.networks.template_solutions import solve_template
from relguide.kernels.networks.templates import NONE, SEVERAL, SIZE

Weights = tuple[FloatArray, ...]
"""The arrays of `Layers`, in that order."""
OUTPUTS = 3 * SIZE
"""Score of each template, then its guess."""
LEGS = MAX_CONTACTS + 1
"""Room for the legs of a path, as the search has it."""
_BESIDE = 1e-9  # least heading that is looked at [rad]
_MOST_LATE = 9.5  # the limit costs more in 1 of 200 situations, and then the path is mostly wrong


class Decision(NamedTuple):
    """What of a network's answer is solved, and when nothing is."""

    least_share: float
    """Templates with a smaller share are left out."""
    most: int
    """With more templates than this, nothing is solved."""
    doubt: float
    """Nor is there an answer where the share of paths of other templates, of no path, and of
    templates likelier than the first that led to a path, is more."""


class Choice(NamedTuple):
    """Where a network's answer leads."""

    held: int
    """How many templates are held possible."""
    template: int
    """That of the path; `SEVERAL` or `NONE` if there is none."""
    time: float
    """Arrival [R/V_P]; infinite if there is none."""
    legs: int
    """How many legs the path has; 0 if there is none."""


@njit(cache=True, nogil=True)
def template_shares(
    pose: Pose, scene: Scene, free: FloatArray, layers: Layers, share: FloatArray
) -> FloatArray:
    """How likely the network takes each template to be that of the fastest path.

    Args:
        pose: the pursuer's, slot frame, not `needs_mirror`; its heading in [0, 2π).
        scene: a leader that keeps straight, α below 1.
        free: the fastest extremal without the limit, a row of `solve`. shape (5,)
        layers: the weights.
        share: takes the shares, which sum up to 1. shape (SIZE,)

    Returns:
        the layer before the outputs, for `guess_of`.
    """
    numbers = np.empty(FEATURES)
    # on the leader's own heading some features jump: labels lie on either side, and none there
    beside = Pose(pose.x, pose.y, max(pose.h, _BESIDE))
    template_features(beside, scene, free, numbers)
    hidden = last_hidden_layer(numbers, layers)
    score = layers.last_bias[:SIZE].copy()
    for i in range(len(hidden)):
        value = hidden[i]
        for template in range(SIZE):
            score[template] += value * layers.last[i, template]
    most = score.max()
    for template in range(SIZE):
        share[template] = exp(score[template] - most)
    share /= share.sum()
    return hidden


@njit(cache=True, nogil=True)
def guess_of(hidden: FloatArray, layers: Layers, template: int, guess: FloatArray) -> None:
    """The two numbers of a template's guess, as in `templates`."""
    for k in range(2):
        at = SIZE + 2 * template + k
        value = layers.last_bias[at]
        for i in range(len(hidden)):
            value += hidden[i] * layers.last[i, at]
        guess[k] = value


@njit(cache=True, nogil=True)
def choose_template(
    pose: Pose, scene: Scene, free: FloatArray, layers: Layers, decision: Decision,
    legs: FloatArray,
) -> Choice:  # fmt: skip
    """Solve the templates that the network holds possible, next to its guesses, and no others.

    Args:
        pose: as in `template_shares`.
        scene: as there.
        free: as there; it breaks the limit: where that does not bind is not what was learnt.
        layers: the weights.
        decision: what is solved.
        legs: takes the legs of the fastest path, as `chain.Chain`. shape (LEGS, 6)
    """
    share = np.empty(SIZE)
    hidden = template_shares(pose, scene, free, layers, share)
    held = 0
    for template in range(SIZE):
        possible = share[template] >= decision.least_share
        held += possible and template != SEVERAL and template != NONE
    unknown = share[SEVERAL] + share[NONE]
    if held > decision.most or unknown > decision.doubt:
        return Choice(held, SEVERAL, inf, 0)
    guess = np.zeros(2)
    trial = np.zeros((LEGS, 6))
    best, count, chosen = inf, 0, NONE
    for _ in range(held):
        # the likeliest first: once there is a path, the others are cheaper
        template = _likeliest(share)
        held_share = share[template]
        share[template] = 0.0
        guess_of(hidden, layers, template, guess)
        time, n = solve_template(pose, scene, template, guess, best, trial)
        if n > 0:
            best, count, chosen = time, n, template
            legs[:n] = trial[:n]
        if best == inf:
            unknown += held_share
    # templates without a path next to their guess were held possible in vain
    if unknown > decision.doubt or best > free[0] + _MOST_LATE:
        return Choice(held, SEVERAL, inf, 0)
    return Choice(held, chosen, best, count)


@njit(cache=True, nogil=True)
def _likeliest(share: FloatArray) -> int:
    """The likeliest template that can be solved."""
    best = -1
    for template in range(SIZE):
        solvable = template != SEVERAL and template != NONE
        if solvable and (best < 0 or share[template] > share[best]):
            best = template
    return best


@njit(cache=True, nogil=True)
def constrained_pieces(
    where: Where, free: FloatArray, radius: float, longest: float, weights: Weights,
    decision: tuple[float, int, float],
) -> FloatArray:  # fmt: skip
    """The path of `choose_template` as pieces.

    Args:
        where: all are, as of `network_view`, on either side of the route.
        free: the fastest extremal without the limit, as of `network_view`. shape (5,)
        radius: R [m].
        longest: paths that take longer count as none [R/V_P].
        weights: those of `Layers`; a plain tuple is handed over in half the time.
        decision: the numbers of `Decision`.

    Returns:
        as `path_pieces.pieces_of`; no columns if there is no path. shape (3, pieces)
    """
    x, y, h, slot, alpha, d_min = where
    pose, mirrored = mirror_to_left(Pose(x, y, h))
    scene = straight_scene(alpha, slot, d_min)
    legs = np.zeros((LEGS, 6))
    chosen = choose_template(pose, scene, free, Layers(*weights), Decision(*decision), legs)
    if chosen.legs == 0 or chosen.time > longest:
        return np.empty((3, 0))
    sense = -1.0 if mirrored else 1.0
    return pieces_of(pose, scene, radius, sense, chosen.time, legs[: chosen.legs])
